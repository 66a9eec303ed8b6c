/* Steps that several test programs take. One that goes wrong fails the test. */
#ifndef JAM_TESTS_STEPS_H
#define JAM_TESTS_STEPS_H

#include <stdlib.h>

#include "systems.h"

static inline void same(const jam_system *a, const jam_system *b) {
  for (int32_t k = JAM_VIEW_POSITIONS; k <= JAM_VIEW_VELOCITIES; ++k) same_view(a, b, k);
}

/* Spheres of two sizes, 1 : 1.4: so few equal ones would order, and end with more contacts than isostatic. */
static inline jam_system *soft_start(int64_t n, double phi, int64_t seed) {
  jam_system *sys = NULL;
  double *size = malloc((size_t)n * sizeof *size);
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
