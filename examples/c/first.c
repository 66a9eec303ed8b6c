/* From nothing to a jammed packing in one page. Build: cc first.c $(pkg-config --cflags --libs jam) */
#include <jam/jam.h>
#include <stdio.h>

static int failed(jam_system *sys) {
  fprintf(stderr, "%s\n", jam_last_error());
  jam_destroy(sys);
  return 1;
}

int main(void) {
  jam_create_options o;
  jam_crunch_report report;
  jam_system *sys = NULL;

  jam_create_options_init(&o, sizeof o); /* all defaults: d = 3, unit box, random start at packing fraction 0.2 */
  o.n = 128;
  o.seed = 1;
  if (jam_create(&o, NULL, &sys) < 0) return failed(sys);
  if (jam_compress(sys, NULL, NULL) < 0) return failed(sys); /* grow slowly to reduced pressure 1e6 */
  report.struct_size = sizeof report;
  if (jam_crunch(sys, NULL, &report) < 0) return failed(sys); /* to the jamming point */
  printf("%s: packing fraction %.9f, %lld contacts, %lld more than isostatic, force imbalance %.1e\n",
         report.jammed ? "jammed" : "not jammed", report.packing_fraction, (long long)report.contacts,
         (long long)report.excess_contacts, report.force_residual);
  if (jam_write(sys, "first.xyz", JAM_FORMAT_AUTO) < 0) return failed(sys); /* opens in OVITO */
  jam_destroy(sys);
  return 0;
}
