/* Watching a long call and stopping it: the state reached stays valid, and the work can continue from there. */
#include <jam/jam.h>
#include <stdio.h>

/* Called on this thread, at most every 0.05 s. A result other than 0 stops the call. */
static int32_t watch(const jam_progress *p, void *user) {
  double *enough = user;
  if (p->phase == JAM_PHASE_COMPRESS)
    printf("growing: packing fraction %.4f, p %.3g, %.2f s\n", p->packing_fraction, p->pressure, p->seconds);
  if (p->phase == JAM_PHASE_CRUNCH) printf("crunching: LP %lld, gain %.1e\n", (long long)p->steps, p->gain);
  return p->packing_fraction > *enough;
}

int main(void) {
  jam_create_options o;
  jam_info info;
  jam_system *sys = NULL;
  jam_status status;
  double enough = 0.55;

  jam_create_options_init(&o, sizeof o);
  o.n = 256;
  if (jam_create(&o, NULL, &sys) < 0) return 1;
  jam_set_progress(sys, watch, &enough);
  status = jam_compress(sys, NULL, NULL);
  info.struct_size = sizeof info;
  jam_get_info(sys, &info);
  printf("first call: %s at packing fraction %.4f\n", jam_status_string(status), info.packing_fraction);

  enough = 2.0; /* never */
  if (status >= 0) status = jam_compress(sys, NULL, NULL);
  jam_get_info(sys, &info);
  printf("second call: %s at packing fraction %.4f, p %.3g\n", jam_status_string(status), info.packing_fraction,
         info.pressure);
  jam_destroy(sys);
  return status < 0;
}
