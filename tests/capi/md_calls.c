/* jam_run and jam_compress: statuses, exact ends, starts at contact. */
#include <math.h>

#include "steps.h"

static jam_md_report empty_report(void) {
  SIZED(jam_md_report, r);
  return r;
}

CASE(without_collisions_runs_end_at_once) {
  OWNED jam_system *sys = random_spheres(3, 1, 0.1, 1);
  jam_md_report report = empty_report();
  double zero[60] = {0.0};
  assert_int_equal(jam_run(sys, NULL, &report), JAM_NOT_CONVERGED);
  assert_int_equal(report.stop_reason, JAM_STOP_STALLED);
  /* Growing ends when the sphere touches its own images. */
  assert_int_equal(jam_compress(sys, NULL, &report), JAM_NOT_CONVERGED);
  assert_true(fabs(info_of(sys).packing_fraction - 3.14159265358979 / 6.0) < 1e-9);
  jam_destroy(sys);
  sys = random_spheres(3, 20, 0.2, 1);
  assert_int_equal(jam_set_velocities(sys, zero, 60), JAM_OK);
  assert_int_equal(jam_run(sys, NULL, &report), JAM_NOT_CONVERGED);
  assert_int_equal(report.stop_reason, JAM_STOP_STALLED);
  assert_int_equal(report.collisions, 0);
  assert_int_equal(jam_compress(sys, NULL, &report), JAM_OK); /* draws velocities */
}

CASE(exact_packing_fraction) {
  OWNED jam_system *sys = random_spheres(3, 100, 0.2, 1);
  jam_md_report report = empty_report();
  DEFAULTS(compress, c);
  c.packing_fraction = 0.45;
  c.pressure = 1e12;
  assert_int_equal(jam_compress(sys, &c, &report), JAM_OK);
  assert_int_equal(report.stop_reason, JAM_STOP_PACKING_FRACTION);
  assert_true(fabs(info_of(sys).packing_fraction - 0.45) < 1e-13);
  assert_true(fabs(report.packing_fraction - 0.45) < 1e-13);
  /* Growth leads to no target below the present one, and says so; the present one is there already. */
  assert_int_equal(jam_compress(sys, &c, &report), JAM_OK);
  assert_int_equal(report.collisions, 0);
  c.packing_fraction = 0.3;
  SAYS(jam_compress(sys, &c, &report), JAM_NOT_CONVERGED, "above the 0.3 that is wanted");
  assert_int_equal(report.stop_reason, JAM_STOP_PACKING_FRACTION);
  assert_int_equal(report.collisions, 0);
  assert_true(fabs(info_of(sys).packing_fraction - 0.45) < 1e-13);
}

/* A simple cubic lattice. */
static jam_system *lattice(double diameter) {
  double x[27 * 3];
  for (int k = 0; k < 27; ++k) {
    x[3 * k] = (k % 3) / 3.0;
    x[3 * k + 1] = (k / 3 % 3) / 3.0;
    x[3 * k + 2] = (k / 9) / 3.0;
  }
  DEFAULTS(create, o);
  o.n = 27;
  return created_from(&o, x, 81, &diameter, 1);
}

CASE(starts_at_contact) {
  /* A row of three that touch at the start, and one sphere apart. */
  const double row[] = {0.25, 0.5, 0.5, 0.5, 0.5, 0.5, 0.75, 0.5, 0.5, 0.5, 0.125, 0.125}, diameter = 0.25;
  jam_md_report report = empty_report();
  DEFAULTS(run, r);
  r.collisions_per_particle = 200.0;
  r.wall_time = 10.0;
  DEFAULTS(compress, c);
  c.wall_time = 10.0;
  DEFAULTS(create, o);
  o.n = 4;
  OWNED jam_system *sys = created_from(&o, row, 12, &diameter, 1);
  assert_int_equal(jam_run(sys, &r, &report), JAM_OK);
  assert_true(report.max_overlap < 1e-14 && report.energy_drift < 1e-12);
  jam_destroy(sys);
  assert_int_equal(create_from(&o, row, 12, &diameter, 1, &sys), JAM_OK);
  assert_int_equal(jam_compress(sys, &c, &report), JAM_OK);
  assert_true(report.max_overlap < 1e-13);
  jam_destroy(sys);
  /* All at contact, but for the rounding of thirds to doubles: the engine resolves these gaps, at p = 1e16. */
  sys = lattice(1.0 / 3.0);
  assert_int_equal(jam_run(sys, &r, &report), JAM_OK);
  assert_true(report.pressure > 1e15 && report.time > 0.0 && report.energy_drift < 1e-12);
  jam_status status = jam_compress(sys, &c, &report);
  assert_true(status >= 0 && report.seconds < 15.0 && report.max_overlap < 1e-13);
  jam_destroy(sys);
  sys = lattice(0.999 / 3.0);
  assert_int_equal(jam_run(sys, &r, &report), JAM_OK);
  assert_true(report.max_overlap < 1e-14 && report.energy_drift < 1e-12);
}

/* Positions in a box of another side are the same packing, scaled. */
CASE(box_only_scales) {
  OWNED jam_system *a = random_spheres(3, 60, 0.3, 1), *b = NULL;
  const double *const x = view_of(a, JAM_VIEW_POSITIONS), *const d = view_of(a, JAM_VIEW_DIAMETERS);
  double scaled[180], diameter = 8.0 * d[0];
  jam_md_report ra = empty_report(), rb = empty_report();
  for (int k = 0; k < 180; ++k) scaled[k] = 8.0 * x[k];
  DEFAULTS(create, o);
  o.n = 60;
  o.box = 8.0;
  assert_int_equal(create_from(&o, scaled, 180, &diameter, 1, &b), JAM_OK);
  assert_int_equal(jam_compress(a, NULL, &ra), JAM_OK);
  assert_int_equal(jam_compress(b, NULL, &rb), JAM_OK);
  assert_true(ra.pressure == rb.pressure && ra.collisions == rb.collisions && ra.time == rb.time);
  for (int k = 0; k < 180; ++k) assert_true(view_of(b, JAM_VIEW_POSITIONS)[k] == 8.0 * x[k]);
  assert_true(view_of(b, JAM_VIEW_DIAMETERS)[0] == 8.0 * d[0]);
}
