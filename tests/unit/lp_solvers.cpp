// The packing LP, of a fixed and of a free cell: our interior point against Clp, both against the LP's own residuals.
#include <algorithm>
#include <cmath>
#include "test.h"

#include "crunch/phases.hpp"
#include "crunch_scenes.hpp"
#include "lp/interior_point.hpp"

using namespace jam::inside;

namespace {

// The LP of the pairs with gaps up to `reach` mean diameters.
struct Instance : PackingLp {
  Instance(const Packing &p, double reach, double within) : list(find_pairs(p, reach * diameter_mean(p), 1.0)) {
    PackingLp::operator=(make_lp(p, list, diameter_mean(p)));
    bound = within;
  }
  Instance(const Instance &) = delete;
  PairList list;
};

LpSolution interior(const PackingLp &lp) {
  NewtonSystem system;
  return InteriorPoint(system).solve(lp, IpmControl());
}

LpSolution agree(const PackingLp &lp) {
  const LpSolution a = interior(lp), b = solve_lp_clp(lp, 1e-10);
  assert_true(a.solved && b.solved);
  const LpCheck check = check_lp(lp, a);
  assert_true(check.infeasibility < 1e-13 && check.gamma < 1e-10 && check.balance < 1e-3 &&
              std::fabs(check.gap) < 1e-9);
  if (!(std::fabs(a.g - b.g) < 1e-9)) fail_msg("interior point %.15g, Clp %.15g", a.g, b.g);
  return a;
}

CASE(random_instances) {
  for (int dim = 2; dim <= 4; ++dim)
    for (int seed = 1; seed <= 3; ++seed) {
      const Packing p = start(60, dim, dim == 2 ? 0.4 : 0.2 / (dim - 2), seed);
      Instance lp(p, 0.8, 1.0);
      for (const double bound : {0.2, 0.02}) {
        lp.bound = bound;
        agree(lp);
      }
    }
}

// Factors in floats lead to the same optimum: each gain lies within its own duality gap of it, which rounding of the
// normal equations makes up to 6e-9 for these LPs. Where floats fail at once, doubles take over and give the bits of
// doubles.
CASE(floats_serve) {
  for (int dim = 2; dim <= 4; ++dim)
    for (int seed = 1; seed <= 6; ++seed) {
      const Packing p = start(60, dim, dim == 2 ? 0.4 : 0.2 / (dim - 2), seed);
      Instance lp(p, 0.8, 0.2);
      const LpSolution doubles = interior(lp);
      const double gap_doubles = std::fabs(check_lp(lp, doubles).gap);
      NewtonSystem system;
      InteriorPoint ipm(system, {0.0, 1e-3, 8});
      for (int again = 0; again < 2; ++again) {  // the second LP knows where floats failed
        const LpSolution floats = ipm.solve(lp, IpmControl());
        const LpCheck check = check_lp(lp, floats);
        assert_true(floats.solved && floats.s != doubles.s);
        assert_true(check.infeasibility < 1e-13 && check.gamma < 1e-10 && check.balance < 1e-4);
        assert_true(std::fabs(check.gap) < 6e-8);
        assert_true(std::fabs(floats.g - doubles.g) < std::fabs(check.gap) + gap_doubles + 1e-13);
      }
      const LpSolution refused = InteriorPoint(system, {0.0, 1e-3, 0}).solve(lp, IpmControl());
      assert_true(refused.s == doubles.s && refused.y == doubles.y);
      assert_true(refused.factorisations > doubles.factorisations);
    }
}

// Reports that repeat themselves in a long LP say how many factorisations it took so far.
CASE(long_lps_tell) {
  const Packing p = start(60, 3, 0.3, 4);
  Instance lp(p, 0.5, 0.2);
  NewtonSystem system;
  Monitor monitor;
  int64_t told = -1;
  monitor.begin();
  monitor.progress = [](const jam_progress *x, void *out) {
    return *static_cast<int64_t *>(out) = x->factorisations, 0;
  };
  monitor.progress_user = &told;
  const LpSolution x = InteriorPoint(system).solve(lp, IpmControl(), &monitor);
  while (told < 0) monitor.look();  // after a silence
  assert_true(x.factorisations > 2 && told >= x.factorisations - 1);
}

// Long steps bring rows that stood outside the normal equations to bind: they must be seen.
CASE(screened_rows_bind) {
  for (int seed = 1; seed <= 3; ++seed) {
    const Packing p = start(100, 3, 0.2, seed);
    Instance lp(p, 1.5, 0.6);
    WorkingSet split;
    split.choose(lp);
    const LpSolution x = interior(lp);
    size_t bind = 0;
    for (const size_t k : split.screened) bind += x.y[k] > 1e-6;
    print_message("%zu of %zu rows screened at first, %zu of them bind\n", split.screened.size(), lp.rows(), bind);
    assert_true(bind > 0);
    agree(lp);
  }
}

// A sequence of LPs, each solved from the multipliers of the one before and from nothing; and from multipliers that
// mislead.
CASE(warm_starts) {
  Packing p = start(80, 3, 0.3, 2);
  const double unit = diameter_mean(p);
  Multipliers known;
  int warm_iterations = 0, cold_iterations = 0, settled = 0, misled = 0;
  double bound = 0.3, step = 1.0;
  for (int k = 0; k < 200 && settled < 3; ++k) {
    const double reach = 2.2 * bound * unit;
    PairList pairs = find_pairs(p, reach, 1.0);
    PackingLp lp = make_lp(p, pairs, unit);
    lp.bound = bound;
    const LpSolution cold = interior(lp);
    const std::vector<double> forces = carry_over(known.pairs, known.y, pairs);
    std::vector<double> upside_down = forces;
    double largest = 0.0;
    for (const double y : forces) largest = std::max(largest, y);
    for (double &y : upside_down) y = 1.1 * largest - y;
    for (const std::vector<double> *y : {&forces, static_cast<const std::vector<double> *>(&upside_down)}) {
      NewtonSystem system;
      IpmControl control;
      control.multipliers = y;
      const LpSolution warm = InteriorPoint(system).solve(lp, control);
      const bool decided = y == &forces && step < 1e-5;  // the forces of the LP before are all but the answer
      if (decided) assert_true(warm.solved);
      misled += !warm.solved;
      if (!warm.solved) continue;  // it said so: the cold start follows
      assert_true(check_lp(lp, warm).infeasibility < 1e-13);
      if (!(std::fabs(warm.g - cold.g) < 1e-9)) fail_msg("bound %g: warm %.15g, cold %.15g", bound, warm.g, cold.g);
      if (decided) warm_iterations += warm.iterations, cold_iterations += cold.iterations, ++settled;
    }
    known = {pairs, cold.y};
    assert_true(take_step(p, pairs, reach, cold, unit) > 0.0);
    step = largest_step(cold, find_active_set(lp, cold, 1e-11), 3);
    bound = std::min(0.3, std::max({5.0 * step, cold.g, 1e-6}));
  }
  assert_true(settled > 2 && 2 * warm_iterations < cold_iterations);
  print_message("last LPs: %d iterations warm, %d cold; %d warm starts gave up\n", warm_iterations, cold_iterations,
                misled);
}

// An LP that ends early is strictly inside its rows, and its duality gap is the part of the gain that was asked for.
CASE(ends_early_inside_its_rows) {
  const Packing p = start(60, 3, 0.3, 4);
  Instance lp(p, 0.5, 0.2);
  NewtonSystem system;
  IpmControl control;
  control.early_fraction = 0.3;
  const LpSolution x = InteriorPoint(system).solve(lp, control), whole = interior(lp);
  assert_true(x.solved && x.iterations < whole.iterations);
  const double slack = *std::min_element(x.w.begin(), x.w.end());
  assert_true(slack > 1e-9 && x.g < whole.g && x.g > 0.6 * whole.g);  // gap <= 0.3 g, and the dual residual of 1e-3
}

// FCC in contact, with and without a vacancy: 18 rows a particle more than its motions need, every answer but g
// degenerate.
CASE(fcc_instances) {
  const double basis[12] = {0, 0, 0, 0, .5, .5, .5, 0, .5, .5, .5, 0};
  for (int vacancy = 0; vacancy < 2; ++vacancy)
    for (const double shrink : {1.0, 0.999}) {
      Packing p;
      for (int k = vacancy; k < 108; ++k) {
        const int cell = k / 4, at[3] = {cell % 3, cell / 3 % 3, cell / 9};
        for (int c = 0; c < 3; ++c) p.position.push_back((at[c] + basis[k % 4 * 3 + c]) / 3.0);
      }
      p.diameter.assign(108 - vacancy, shrink * std::sqrt(0.5) / 3.0);
      p.velocity.assign(p.position.size(), 0.0);
      Instance lp(p, 0.3, 1.0);
      for (const double bound : {0.05, 1e-3}) {
        lp.bound = bound;
        agree(lp);
      }
      // without a vacancy nothing can be won but the room to contact
      if (!vacancy) assert_true(std::fabs(interior(lp).g - (1.0 / (shrink * shrink) - 1.0)) < 1e-9);
    }
}

// Bounds down to nothing: g comes down to the smallest gap of the start, exactly at last, for there is no other point.
CASE(vanishing_bound) {
  const Packing p = start(60, 3, 0.2, 5);
  Instance lp(p, 0.8, 1.0);
  const double smallest = *std::min_element(lp.c.begin(), lp.c.end());
  for (const double bound : {1e-4, 1e-6, 1e-9}) {
    lp.bound = bound;
    const LpSolution x = agree(lp);
    assert_true(x.g >= smallest - 1e-13 && x.g <= smallest + 8.0 * bound);
    for (const double s : x.s) assert_true(std::fabs(s) <= bound * (1.0 + 1e-9));
  }
}

// A start that overlaps by 1e-9, as text files give it: g begins below zero and leaves it, and both solvers say so.
CASE(overlap_by_rounding) {
  Packing p = start(60, 3, 0.2, 9);
  const ClosestPair closest = closest_pair(p);
  for (double &s : p.diameter) s *= (1.0 + closest.gap) * (1.0 + 1e-9);
  assert_true(closest_pair(p).gap < -0.9e-9);
  Instance lp(p, 0.6, 0.1);
  assert_true(agree(lp).g > 1e-3);
  lp.bound = 1e-12;  // too tight to leave the overlap
  assert_true(std::fabs(agree(lp).g + 2e-9) < 1e-10);
}

// A wide bound around a state whose contacts are all but closed: many rows that started as screened cut the first
// steps. They join together instead of a few at a time, and the LP is solved.
CASE(far_rows_cut_steps) {
  Packing p = start(1024, 3, 0.3, 3);
  jam_crunch_options o = default_crunch_options();
  o.method = JAM_CRUNCH_SEQUENTIAL_LP, o.max_lps = 7;
  p = run(p, o).packing;
  Instance lp(p, 0.66, 0.3);
  NewtonSystem system;
  const LpSolution x = InteriorPoint(system).solve(lp, IpmControl());
  const LpCheck check = check_lp(lp, x);
  assert_true(x.solved && check.infeasibility < 1e-12 && std::fabs(check.gap) < 1e-10 && check.gamma < 1e-9);
}

// In a cell that is no cube, with spheres of two sizes.
Packing tilted(int n, int dim, double phi, int64_t seed) {
  std::vector<double> cell(dim * dim, 0.0);
  for (int c = 0; c < dim; ++c) cell[c * dim + c] = 1.0, cell[c * dim] += c ? 0.2 : 0.0;
  return start(n, dim, phi, seed, 1.4, cell.data());
}

CASE(free_cells) {
  for (int dim = 2; dim <= 4; ++dim)
    for (const bool tilts : {false, true}) {
      const Packing p = tilted(50, dim, dim == 2 ? 0.4 : 0.2 / (dim - 2), dim);
      const double unit = diameter_mean(p);
      const PairList pairs = find_pairs(p, 0.8 * unit, 1.0);
      const StrainBasis basis = strain_basis(dim, true, tilts);
      assert_int_equal(basis.count(), tilts ? dim * (dim + 1) / 2 - 1 : dim - 1);
      PackingLp lp = make_lp(p, pairs, unit, basis), fixed = make_lp(p, pairs, unit);
      for (const double bound : {0.1, 0.01}) {
        lp.bound = fixed.bound = bound;
        assert_true(agree(lp).g > interior(fixed).g + 1e-6);  // more may move
      }
    }
}

// Steps keep the volume, make no overlap, and gaps of listed pairs are at least what the LP says.
CASE(steps_are_safe) {
  for (int dim = 2; dim <= 3; ++dim) {
    Packing p = tilted(40, dim, 0.3, 7);
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

}  // namespace
