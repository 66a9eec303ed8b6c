// The barrier function of the path: its value along a line against true distances, its slope against differences, its
// best step against a scan; paths from saddles, and crunches of equal disks.
#include <cmath>
#include <random>
#include "test.h"

#include "crunch/phases.hpp"
#include "lp/barrier_problem.hpp"
#include "lp/interior_point.hpp"
#include "unit/crunch_scenes.hpp"

using namespace jam::inside;

namespace {

struct Scene {
  Packing p;
  BarrierProblem b;
  BarrierStep x;
};

// A packing, its pairs, and a random direction no longer than `length` mean diameters a component; free: strains too.
void make_scene(Scene &w, int dim, double ratio, double length, int64_t seed, bool free = false) {
  w.p = start(40, dim, dim == 2 ? 0.5 : dim == 3 ? 0.3 : 0.1, seed, ratio);
  w.b.unit = diameter_mean(w.p), w.b.mu = 1e-3;
  if (free) w.b.strain = strain_basis(dim, true, true);
  w.b.pairs = find_pairs(w.p, 0.5 * w.b.unit, 1.0);
  assert_true(w.b.linearise(w.p));
  std::mt19937_64 random(static_cast<uint64_t>(seed));
  std::uniform_real_distribution<double> one(-1.0, 1.0);
  const size_t rows = w.b.pairs.size();
  w.x.s.resize(w.b.lp.unknowns()), w.x.w.resize(rows), w.x.y.assign(rows, 0.0);
  for (double &s : w.x.s) s = length * one(random);
  w.x.g = length * one(random);
  rows_times(w.b.lp, w.x.s.data(), w.x.w.data());
  for (double &v : w.x.w) v -= w.x.g;
  w.b.y.assign(rows, 1.0 / static_cast<double>(rows));
}

// -log Gamma - mu sum log c from true distances of the packing moved by alpha x, less its value before. A strain is
// taken before it is brought back to the old volume, which opens gaps further.
double brute(const Scene &w, double alpha) {
  Packing q = w.p;
  const std::vector<double> strain = w.b.strain_of(w.x, alpha);
  const size_t d = static_cast<size_t>(w.p.dim);
  for (size_t k = 0; k < q.position.size(); ++k) q.position[k] += alpha * w.b.unit * w.x.s[k];
  const double gamma = 1.0 + alpha * w.x.g;
  for (double &s : q.diameter) s *= std::sqrt(gamma);
  double sum = 0.0, r[JAM_MAX_DIM];
  for (size_t k = 0; k < w.b.pairs.size(); ++k) {
    const auto c = [&](const Packing &p) {
      const double sigma = 0.5 * (p.diameter[w.b.pairs.i[k]] + p.diameter[w.b.pairs.j[k]]);
      double r2 = pair_vector(p, w.b.pairs, k, r), r0[JAM_MAX_DIM];
      if (&p == &q && !strain.empty()) {
        pair_vector(w.p, w.b.pairs, k, r0);
        r2 = 0.0;
        for (size_t a = 0; a < d; ++a) {
          for (size_t b = 0; b < d; ++b) r[a] += strain[a * d + b] * r0[b];
          r2 += r[a] * r[a];
        }
      }
      return r2 / (sigma * sigma) - 1.0;
    };
    sum += std::log(c(q) / c(w.p));
  }
  return -std::log(gamma) - w.b.mu * sum;
}

// The bent rows are exact, so the merit is; the best step is the best of a fine scan, and its slope is minus the
// decrement.
CASE(merit_is_true) {
  const double lengths[] = {1e-4, 1e-3, 0.05};
  for (const int dim : {2, 3, 5})
    for (int k = 0; k < 6; ++k) {
      const double length = lengths[k % 3];
      Scene w;
      make_scene(w, dim, dim == 3 ? 1.0 : 1.4, length, 3 + dim, k >= 3);
      if (w.b.decrement(w.x) < 0.0) {  // downhill
        for (double &s : w.x.s) s = -s;
        for (double &v : w.x.w) v = -v;
        w.x.g = -w.x.g;
      }
      const BarrierProblem::Best best = w.b.search(w.x);
      assert_true(best.alpha > 0.0 && best.merit < 0.0);
      assert_true(std::fabs(brute(w, best.alpha) - best.merit) < 1e-11 * (1.0 + std::fabs(best.merit)));
      const double h = 1e-6 / length, slope = (brute(w, h) - brute(w, -h)) / (2.0 * h);
      assert_true(std::fabs(slope + w.b.mu * w.b.decrement(w.x)) < 1e-5 * std::fabs(slope));
      // No point of a scan beats the search by more than a whole Newton step may differ from the minimum (a tenth of
      // its length).
      double least = 0.0;
      const double farthest = std::min(2.0 * best.alpha, 3.98);  // four directions at most
      for (int k = 1; k < 400; ++k) {
        const double value = brute(w, farthest * k / 400.0);
        if (!std::isfinite(value)) break;  // through a wall
        least = std::min(least, value);
      }
      assert_true(!(least < best.merit - 0.02 * std::fabs(best.merit)));
    }
}

// Two spheres that would run through each other: the step ends before they touch, however far the minimum of the line
// lies.
CASE(walls_stop) {
  Scene w;
  w.p.set_cube(2, 1.0), w.p.position = {0.4, 0.5, 0.55, 0.5}, w.p.diameter = {0.1, 0.1}, w.p.velocity.assign(4, 0.0);
  w.b.unit = 0.1, w.b.mu = 1e-9;
  w.b.pairs = find_pairs(w.p, 0.1, 1.0);
  assert_true(w.b.linearise(w.p) && w.b.pairs.size() == 1);
  w.x.s = {1.0, 0.0, 0.0, 0.0}, w.x.w.resize(1), w.x.y = {0.0};
  rows_times(w.b.lp, w.x.s.data(), w.x.w.data());
  w.x.g = 0.1, w.x.w[0] -= w.x.g;
  w.b.y = {1.0};
  const BarrierProblem::Best best = w.b.search(w.x);
  double r[2];
  Packing q = w.p;
  q.position[0] += best.alpha * 0.1;
  for (double &s : q.diameter) s *= std::sqrt(1.0 + best.alpha * w.x.g);
  assert_true(pair_vector(q, w.b.pairs, 0, r) > q.diameter[0] * q.diameter[0]);
  assert_true(best.alpha > 0.3);  // they meet after 0.48: most of the way is used
}

// Where gaps weigh more than the density, a step that would take more than the diameters ends while Gamma is positive.
CASE(diameters_stay_positive) {
  Scene w;
  make_scene(w, 3, 1.0, 1e-3, 8);
  for (double &v : w.x.w) v += w.x.g + 10.0;
  w.x.g = -10.0, w.b.mu = 1.0;
  const BarrierProblem::Best best = w.b.search(w.x);
  assert_true(best.alpha > 0.0 && 1.0 + best.alpha * w.x.g > 0.0);
  assert_true(best.merit < 0.0 && std::fabs(brute(w, best.alpha) - best.merit) < 1e-9 * std::fabs(best.merit));
}

struct PathRun {
  BarrierPathResult end;
  std::vector<double> gaps, phi;
};

// With as many saddles as it takes, in crystals too.
BarrierPathControl patient() {
  BarrierPathControl control;
  control.tuning.close_gap = 0.0;
  return control;
}

PathRun follow(Packing &p, BarrierPathControl control) {
  NewtonSystem system;
  Monitor monitor;
  monitor.begin();
  PathRun run;
  control.on_step = [&](double gap, size_t, const PathPoint &) {
    run.gaps.push_back(gap), run.phi.push_back(packing_fraction(p));
  };
  run.end = follow_barrier_path(p, control, system, monitor);
  return run;
}

// A square lattice, off its sites by a millionth, is a saddle of the density: the path must leave it for something
// denser without an overlap. One that may not take any step more says that it did not arrive.
CASE(saddle_is_left) {
  Packing p;
  const int m = 8;
  p.set_cube(2, 1.0);
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> one(-1.0, 1.0);
  for (int i = 0; i < m; ++i)
    for (int j = 0; j < m; ++j)
      p.position.push_back((i + 0.5 + 1e-6 * one(random)) / m),
          p.position.push_back((j + 0.5 + 1e-6 * one(random)) / m);
  p.diameter.assign(m * m, (1.0 - 1e-5) / m);
  p.velocity.assign(2 * m * m, 0.0);
  const double square = packing_fraction(p);
  assert_true(std::fabs(square / 0.785398 - 1.0) < 1e-4);
  Packing q = p;
  BarrierPathControl control;
  control.tuning.max_path_factorisations = 4;
  const PathRun few = follow(q, control);
  assert_true(!few.end.reached && closest_pair(q).gap > 0.0);
  const PathRun whole = follow(p, patient());
  assert_true(whole.end.reached && closest_pair(p).gap > 0.0 && packing_fraction(p) > 1.02 * square);
}

// What a path that arrived leaves to gain: its duality gap. One LP in full says so.
void nothing_left(Packing &p, const PathRun &run) {
  jam_crunch_options o = default_crunch_options();
  o.method = JAM_CRUNCH_SEQUENTIAL_LP, o.max_lps = 1;
  assert_true(run.end.reached && run.end.gap <= Tuning().path_end(p) && closest_pair(p).gap > 0.0);
  assert_true(::jam::inside::run(p, o).report.gain < 2.0 * run.end.gap);
}

Packing near_start(int n, int dim, int seed) {
  return near_jamming(start(n, dim, dim == 2 ? 0.5 : 0.3, seed, dim == 2 ? 1.4 : 1.0));
}

// Some paths meet saddles on their way and leave them by a warmer barrier, where the duality gap is larger.
CASE(arrives) {
  int saddles = 0;
  for (const int dim : {2, 3})
    for (int seed = 1; seed <= 6; ++seed) {
      Packing p = near_start(64, dim, seed);
      const PathRun run = follow(p, patient());
      double rise = 0.0;
      for (size_t k = 0; k < run.gaps.size(); ++k)  // the gap follows mu within some steps
        for (size_t q = k > 8 ? k - 8 : 0; q < k; ++q) rise = std::max(rise, run.gaps[k] / run.gaps[q]);
      // Newton steps between two maxima make it rise too, but by less than mu rises at a saddle.
      assert_true(run.end.increases > 0 ? rise > 2.0 : rise < Tuning().increase);
      saddles += run.end.increases > 0;
      nothing_left(p, run);
    }
  assert_true(saddles > 0);
}

// Floats serve down to small gaps: the path arrives, and nothing is left to gain. Where they fail at once, doubles take
// over and the path has the bits of doubles alone.
CASE(floats_serve) {
  for (const int dim : {2, 3}) {
    const Packing begin = near_start(100, dim, 1);
    BarrierPathControl control = patient();
    control.tuning.single.work = 1e300;
    Packing doubles = begin, floats = begin, failing = begin;
    const PathRun full = follow(doubles, control);
    control.tuning.single.work = 0.0;
    const PathRun single = follow(floats, control);
    nothing_left(floats, single);
    assert_true(single.phi != full.phi);
    print_message("d %d: %d factorisations, %d in doubles\n", dim, single.end.factorisations, full.end.factorisations);
    control.tuning.single.max_products = 0;
    const PathRun refused = follow(failing, control);
    assert_true(refused.phi == full.phi && failing.position == doubles.position);
    assert_true(refused.end.factorisations > full.end.factorisations);
  }
}

}  // namespace
