/* Steps that several test programs take. One that goes wrong fails the test. */
#ifndef JAM_TESTS_STEPS_H
#define JAM_TESTS_STEPS_H

#include <stdio.h>
#include <stdlib.h>
#include <unistd.h>

#include "systems.h"

static inline void same(const jam_system *a, const jam_system *b) {
  for (int32_t k = JAM_VIEW_POSITIONS; k <= JAM_VIEW_VELOCITIES; ++k) same_view(a, b, k);
}

/* Equal spheres at random; fraction 0: the usual one. */
static inline jam_system *random_spheres(int32_t dim, int64_t n, double fraction, int64_t seed) {
  DEFAULTS(create, o);
  o.dim = dim, o.n = n, o.seed = seed;
  if (fraction > 0.0) o.packing_fraction = fraction;
  return created(&o);
}

/* Disks of diameter 1 that touch along both axes. */
static inline jam_system *square_lattice(int side) {
  const double one = 1.0;
  double *const x = (double *)malloc(2 * (size_t)(side * side) * sizeof *x);
  for (int k = 0; k < side * side; ++k) x[2 * k] = k % side, x[2 * k + 1] = k / side;
  DEFAULTS(create, o);
  o.dim = 2, o.n = side * side, o.box = side;
  jam_system *const sys = created_from(&o, x, 2 * (size_t)(side * side), &one, 1);
  free(x);
  return sys;
}

/* What a checkpoint holds. */
static inline jam_system *from_checkpoint(const jam_system *sys) {
  char path[40];
  jam_system *back = NULL;
  snprintf(path, sizeof path, "checkpoint-%ld.bin", (long)getpid());
  assert_int_equal(jam_write_checkpoint(sys, path), JAM_OK);
  if (jam_read_checkpoint(path, NULL, NULL, &back) != JAM_OK) fail_msg("%s", jam_last_error());
  remove(path);
  return back;
}

static inline int32_t stop_at_once(const jam_progress *p, void *user) {
  (void)p, (void)user;
  return 1;
}

/* Spheres of two sizes, 1 : 1.4: so few equal ones would order, and end with more contacts than isostatic. */
static inline jam_system *soft_start(int64_t n, double phi, int64_t seed) {
  jam_system *sys = NULL;
  double *size = (double *)malloc((size_t)n * sizeof *size);
  for (int64_t k = 0; k < n; ++k) size[k] = k % 2 ? 1.4 : 1.0;
  DEFAULTS(create, o);
  o.n = n, o.packing_fraction = phi, o.seed = seed, o.overlap = JAM_OVERLAP_ALLOW;
  assert_int_equal(create_from(&o, NULL, 0, size, (size_t)n, &sys), JAM_OK);
  free(size);
  return sys;
}

static inline jam_md_report run(jam_system *sys, double collisions) {
  DEFAULTS(run, r);
  r.collisions_per_particle = collisions;
  SIZED(jam_md_report, report);
  assert_int_equal(jam_run(sys, &r, &report), JAM_OK);
  return report;
}

#endif /* JAM_TESTS_STEPS_H */
