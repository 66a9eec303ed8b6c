/* Order by g(r) of equal spheres: its value at sqrt 2 mean diameters, where disordered packings have a minimum, over
 * its mean in 1.2 .. 1.6. Below 1 in a good glass, about 10 in a perfect FCC crystal. */
#ifndef JAM_TESTS_CRYSTAL_H
#define JAM_TESTS_CRYSTAL_H

#include <jam/jam.h>
#include <math.h>

/* -1 where g(r) cannot be had. */
static inline double crystal_score(const jam_system *sys) {
  double g[400], near_peak = 0.0, around = 0.0, near_weight = 0.0, weight = 0.0;
  jam_correlation_options o;
  jam_info info;
  size_t k, needed;
  info.struct_size = sizeof info;
  if (jam_get_info(sys, &info) < 0 || jam_correlation_options_init(&o, sizeof o) < 0) return -1.0;
  o.r_max = 2.0, o.bins = 400;
  if (jam_pair_correlation(sys, &o, NULL, 0, g, 400, &needed) < 0) return -1.0;
  for (k = 0; k < 400; ++k) {
    const double r = 0.005 * ((double)k + 0.5), shell = pow(r, info.dim - 1);
    if (fabs(r - sqrt(2.0)) < 0.02) near_peak += g[k] * shell, near_weight += shell;
    if (r > 1.2 && r < 1.6) around += g[k] * shell, weight += shell;
  }
  return around > 0.0 ? near_peak / near_weight / (around / weight) : 0.0;
}

#endif /* JAM_TESTS_CRYSTAL_H */
