// The packing LP of a free cell: interior point against Clp, safe steps, and where a sequence of LPs ends.
#include <algorithm>
#include <cmath>
#include "test.h"

#include "core/create.hpp"
#include "crunch/approach/lp_step.hpp"
#include "lp/interior_point.hpp"

using namespace jam::inside;

namespace {

Packing start(int n, int dim, double phi, int64_t seed) {
  jam_create_options o = default_create_options();
  o.n = n, o.dim = dim, o.packing_fraction = phi, o.seed = seed;
  std::vector<double> sizes(n, 1.0);
  for (int k = 0; k < n; k += 2) sizes[k] = 1.4;
  std::vector<double> cell(dim * dim, 0.0);
  for (int c = 0; c < dim; ++c) cell[c * dim + c] = 1.0, cell[c * dim] += c ? 0.2 : 0.0;
  return make_packing(o, nullptr, 0, sizes.data(), sizes.size(), cell.data());
}

LpSolution interior(const PackingLp &lp, double tolerance = 1e-15) {
  NewtonSystem system;
  IpmControl control;
  control.tolerance = tolerance;
  return InteriorPoint(system).solve(lp, control);
}

CASE(agrees_with_clp) {
  for (int dim = 2; dim <= 4; ++dim)
    for (const bool tilts : {false, true}) {
      const Packing p = start(50, dim, dim == 2 ? 0.4 : 0.2 / (dim - 2), dim);
      const double unit = diameter_mean(p);
      const PairList pairs = find_pairs(p, 0.8 * unit, 1.0);
      const StrainBasis basis = strain_basis(dim, true, tilts);
      assert_int_equal(basis.count(), tilts ? dim * (dim + 1) / 2 - 1 : dim - 1);
      PackingLp lp = make_lp(p, pairs, unit, basis), fixed = make_lp(p, pairs, unit);
      for (const double bound : {0.1, 0.01}) {
        lp.bound = fixed.bound = bound;
        const LpSolution a = interior(lp), b = solve_lp_clp(lp, 1e-10);
        assert_true(a.solved && b.solved);
        const LpCheck check = check_lp(lp, a);
        assert_true(check.infeasibility < 1e-13 && check.gamma < 1e-10 && check.balance < 1e-3 &&
                    std::fabs(check.gap) < 1e-9);
        assert_true(std::fabs(a.g - b.g) < 1e-9);
        assert_true(a.g > interior(fixed).g + 1e-6);  // more may move
      }
    }
}

// Steps keep the volume, make no overlap, and gaps of listed pairs are at least what the LP says.
CASE(steps_are_safe) {
  for (int dim = 2; dim <= 3; ++dim) {
    Packing p = start(40, dim, 0.3, 7);
    const double unit = diameter_mean(p), reach = 0.3 * unit;
    PairList pairs = find_pairs(p, reach, 1.0);
    const StrainBasis basis = strain_basis(dim, true, true);
    PackingLp lp = make_lp(p, pairs, unit, basis);
    lp.bound = 0.1;
    const LpSolution x = interior(lp);
    const Packing before = p;
    const double alpha = take_step(p, pairs, reach, x, unit, basis);
    assert_true(alpha > 0.1);
    assert_true(std::fabs(p.cell.volume() / before.cell.volume() - 1.0) < 1e-13);
    assert_true(p.cell.row(1)[0] != before.cell.row(1)[0]);
    assert_true(closest_pair(p).gap >= -1e-14);
    double r[JAM_MAX_DIM];
    for (size_t k = 0; k < pairs.size(); ++k) {
      const double sigma = 0.5 * (p.diameter[pairs.i[k]] + p.diameter[pairs.j[k]]);
      const double old_sigma = 0.5 * (before.diameter[pairs.i[k]] + before.diameter[pairs.j[k]]);
      const double slack = (pair_vector(p, pairs, k, r) - sigma * sigma) / (old_sigma * old_sigma);
      assert_true(slack >= alpha * x.w[k] - 1e-12);
    }
  }
}

// Torquato and Jiao, Phys. Rev. E 82, 061302 (2010): LPs with a free cell end in strictly jammed packings, with
// d (N' - 1) + d (d + 1) / 2 contacts when they are disordered.
CASE(ends_with_the_strict_count) {
  for (int dim = 2; dim <= 3; ++dim)
    for (int64_t seed = 1; seed <= 3; ++seed) {
      Packing p = start(dim == 2 ? 48 : 40, dim, 0.3, seed);
      const StrainBasis basis = strain_basis(dim, true, true);
      const double volume = p.cell.volume();
      double bound = 0.1, gain = 1.0;
      for (int k = 0; k < 60 && gain > 1e-12; ++k) {
        const double unit = diameter_mean(p), reach = 4.0 * bound * unit;
        PairList pairs = find_pairs(p, reach, 1.0);
        PackingLp lp = make_lp(p, pairs, unit, basis);
        lp.bound = bound;
        const LpSolution x = interior(lp);
        assert_true(x.solved);
        const ActiveSet active = find_active_set(lp, x, 3e-14);
        take_step(p, pairs, reach, x, unit, basis);
        gain = x.g, bound = std::min(bound, std::max(0.01, 5.0 * largest_step(x, active, dim)));
        if (gain <= 1e-12) assert_int_equal(active.rows.size(), dim * (active.stable - 1) + dim * (dim + 1) / 2);
      }
      assert_true(gain <= 1e-12);
      assert_true(std::fabs(p.cell.volume() / volume - 1.0) < 1e-12);
      assert_true(closest_pair(p).gap > -1e-13);
    }
}

}  // namespace
