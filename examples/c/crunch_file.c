/* Brings a packing from a file to its jamming point and writes it again.
 * usage: crunch_file IN OUT      e.g. of a file made by: jam-pack --n 100 --dim 2 --no-crunch --output IN */
#include <jam/jam.h>
#include <stdio.h>

static int failed(jam_system *sys) {
  fprintf(stderr, "%s\n", jam_last_error());
  jam_destroy(sys);
  return 1;
}

int main(int argc, char **argv) {
  jam_crunch_options o;
  jam_info info;
  jam_crunch_report r;
  jam_system *sys = NULL;
  jam_status status;
  if (argc != 3) {
    fprintf(stderr, "usage: %s IN OUT\n", argv[0]);
    return 2;
  }
  if (jam_read(argv[1], NULL, NULL, NULL, &sys) < 0)
    return failed(sys); /* plain text or extended XYZ; the text names a bad line */
  info.struct_size = sizeof info;
  jam_get_info(sys, &info);
  printf("%s: %lld spheres in d = %d, packing fraction %.6f\n", argv[1], (long long)info.n, (int)info.dim,
         info.packing_fraction);

  jam_crunch_options_init(&o, sizeof o);
  o.wall_time = 600; /* seconds; what was reached by then is kept */
  r.struct_size = sizeof r;
  status = jam_crunch(sys, &o, &r);
  if (status < 0) return failed(sys);
  printf("%s (%s): packing fraction %.12f\n", jam_status_string(status), jam_stop_string(r.stop_reason),
         r.packing_fraction);
  printf("%lld contacts, %lld more than one state of self-stress needs, %lld rattlers, %lld bucklers\n",
         (long long)r.contacts, (long long)r.excess_contacts, (long long)r.rattlers, (long long)r.bucklers);
  printf("certificate: overlap %.1e, force imbalance %.1e, smallest gap %.1e\n", r.max_overlap, r.force_residual,
         r.min_gap);
  if (jam_write(sys, argv[2], JAM_FORMAT_AUTO) < 0) return failed(sys);
  jam_destroy(sys);
  return !r.jammed;
}
