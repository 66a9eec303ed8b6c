#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

#include "core/math.hpp"
#include "core/pair_rule.hpp"
#include "core/size_laws.hpp"
#include "crunch/phases.hpp"
#include "linalg/blas.hpp"
#include "linalg/tuning.hpp"
#include "lp/interior_point.hpp"

namespace jam::inside {
namespace {

using T = EstimateTuning;

double ratio_of_diameters(const Packing &p) {
  return diameter_max(p) / *std::min_element(p.diameter.begin(), p.diameter.end());
}

double size_spread(const Packing &p) { return 1.0 - 1.0 / ratio_of_diameters(p); }

double steps(const Packing &p, const jam_crunch_options &o) {
  const double far = contact_gap(p) < Tuning().close_gap ? 0.0 : T::from_afar;
  const double alike = T::near_jamming * std::sqrt(static_cast<double>(p.n())) +
                       (o.method == JAM_CRUNCH_SEQUENTIAL_LP ? T::steps_of_lp * far : far);
  // Small spheres of a mixture roam in holes, where the barrier has saddles. A decade of sizes doubles the
  // factorisations of equal spheres, a little more than measured: 1.1, 1.8 and 2.2 times as many at ratios of 3, 10 and
  // 30, with half of the spheres small or with equal volumes an octave.
  return alike * (1.0 + math::log(ratio_of_diameters(p)) / math::log(10.0));
}

// A list of pairs, and the matrix of those that it couples.
struct Part {
  double rows = 0.0, edges = 0.0;
  BlockCholesky::Sizes sizes{};

  double bytes(double d, double n) const {
    return NewtonSystem::bytes(d, n, rows, edges, static_cast<double>(sizes.factor), static_cast<double>(sizes.fronts));
  }
  double seconds(double rate, int threads) const {
    const double solves = SingleTuning::work * static_cast<double>(sizes.factor);  // as long as so many flops
    return (sizes.flops / std::min(threads, ThreadTuning::most_parts) + solves) / (T::front_rate * rate) +
           T::per_pair * rows;
  }
};

// Several images of one pair, which follow each other, are one edge of the particle graph.
Part part_of(const Packing &p, const PairList &coupled, size_t rows, int threads) {
  std::vector<int32_t> a, b;
  for (size_t k = 0; k < coupled.size(); ++k) {
    const int32_t i = coupled.i[k], j = coupled.j[k];
    if (j >= 0 && i != j && (a.empty() || a.back() != i || b.back() != j)) a.push_back(i), b.push_back(j);
  }
  return {static_cast<double>(rows), static_cast<double>(a.size()),
          BlockCholesky::measure(p.dim, static_cast<int32_t>(p.n()), a.data(), b.data(), a.size(), threads)};
}

// Factor by which the diameters grow before a list gets shorter: this part of the way to jamming.
double growth(const Packing &p, double part) {
  return math::pow(std::max(1.0, jammed_fraction(p.dim) / packing_fraction(p)), part / p.dim);
}

double pairs_near_jamming(const Packing &p) {
  return math::pow(T::pairs_per_dim, p.dim + 1.0) * static_cast<double>(p.n());
}

// From a start with few neighbours at least as many of the nearest pairs as a list has near jamming, and about twice as
// many at most.
PairList enough_pairs(const Packing &p, const jam_crunch_options &o, PairList pairs, double reach) {
  const double n = static_cast<double>(p.n()), wanted = std::min(pairs_near_jamming(p), 0.5 * n * (n - 1.0));
  while (o.neighbour_radius == 0.0 && static_cast<double>(pairs.size()) < wanted) {
    reach = math::pow(2.0, 1.0 / p.dim) * std::max(reach, Tuning().min_bound * diameter_mean(p));
    pairs = find_pairs(p, reach, 1.0);
  }
  return pairs;
}

// The LP that a crunch begins with, or the widest of sequential ones, which keep their list while the spheres grow.
Part largest_lp(const Packing &p, const jam_crunch_options &o) {
  const Tuning t;
  const bool sequence = o.method == JAM_CRUNCH_SEQUENTIAL_LP;
  const bool widens = sequence && o.step_bound == 0.0 && contact_gap(p) > t.close_gap;
  const double bound = widens ? t.max_bound : first_bound(p, o, t), reach = lp_reach(p, o, t, bound);
  const PairList pairs = enough_pairs(p, o, find_pairs(p, reach, sequence ? growth(p, 1.0) : 1.0), reach);
  PackingLp lp = make_lp(p, pairs, diameter_mean(p));
  lp.bound = bound;
  WorkingSet split;
  split.choose(lp);
  return part_of(p, split.pairs, pairs.size(), o.threads);
}

// The list that the path begins with, a little denser as the spheres grow before it is shortened.
Part barrier_path(const Packing &p, const jam_crunch_options &o) {
  const Tuning t;
  const double reach = diameter_mean(p) * (t.least_reach + t.reach_per_spacing * free_spacing(p));
  const double grown = growth(p, std::max(T::grown, size_spread(p)));  // mixtures shorten it late
  const PairList pairs = enough_pairs(p, o, select_neighbours(p, reach, grown), reach);
  const std::vector<double> gap = relative_gaps(p, pairs);
  const double slack = WorkingSetTuning::far_slack * carrying_slack(gap, p.dim, static_cast<int32_t>(p.n()));
  PairList coupled;
  for (size_t k = 0; k < pairs.size(); ++k)
    if (gap[k] <= slack) coupled.append(pairs, k);
  return part_of(p, coupled, pairs.size(), o.threads);
}

// Least processor time of a few runs: beside other jobs the clock would count theirs.
template <class Work>
double least_seconds(const Work &work) {
  const auto now = [] {
    timespec t{};
    if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t) != 0) return now_seconds();
    return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
  };
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const double begun = now();
    work();
    best = std::min(best, now() - begun);
  }
  return best;
}

// Seconds a step that the path spends on new lists: almost none for spheres of similar size, which stay in their cages,
// and more than a factorisation for small ones, which cross their holes in one step.
double list_seconds(const Packing &p) {
  const double share = size_spread(p), reach = Tuning().least_reach * diameter_mean(p);
  return share == 0.0 ? 0.0 : share * least_seconds([&] { select_neighbours(p, reach); });
}

// Flops a second of this core in blocks as large as the fronts are; a millisecond.
template <class Real>
double measured_rate(int size) {
  const BlasThreads one(1);
  std::vector<Real> a(static_cast<size_t>(size) * size, Real(1e-9)), c(a.size());
  const double seconds = least_seconds([&] {
    Blas<Real>::minus_product(size, size, size, a.data(), size, a.data(), size, Result::written, c.data(), size);
  });
  return 2.0 * size * size * static_cast<double>(size) / std::max(seconds, 1e-7);
}

// Equal disks crystallise in parts, and crystals have more contacts than unknowns: narrow LPs and decompressions follow
// a path that says nothing of them. Pairs that an LP without gain would close are contacts here.
double scatter(const Packing &p) {
  const size_t touching = find_pairs(p, 0.0, 1.0 + Tuning().min_bound).size();
  const bool wide = (p.dim == 2 && size_spread(p) == 0.0) || static_cast<double>(touching) > pairs_near_jamming(p);
  return wide ? T::scatter * T::scatter * T::scatter : T::scatter;
}

}  // namespace

jam_estimate_report estimate(const Packing &p, const jam_crunch_options &o) {
  check_options(p, o);
  const double d = p.dim, n = static_cast<double>(p.n());
  const Part lp = largest_lp(p, o), path = o.method == JAM_CRUNCH_SEQUENTIAL_LP ? lp : barrier_path(p, o);
  const Part &most = lp.bytes(d, n) > path.bytes(d, n) ? lp : path;
  const bool floats = path.sizes.flops > Tuning().single.work * static_cast<double>(path.sizes.factor);
  const double rate = floats ? measured_rate<float>(192) : measured_rate<double>(192);

  jam_estimate_report e{};
  e.pairs = static_cast<int64_t>(std::max(lp.rows, path.rows));
  e.flops = path.sizes.flops;
  e.factor_bytes = 8.0 * static_cast<double>(most.sizes.factor + most.sizes.fronts);
  e.bytes = most.bytes(d, n);
  e.factorisations = steps(p, o);
  const double in_lp = std::min(T::steps_of_lp / e.factorisations, 0.5);
  e.step_seconds = (1.0 - in_lp) * path.seconds(rate, o.threads) + in_lp * lp.seconds(rate, o.threads);
  if (o.method != JAM_CRUNCH_SEQUENTIAL_LP) e.step_seconds += (1.0 - in_lp) * list_seconds(p);
  e.seconds = e.factorisations * e.step_seconds;
  const double over = scatter(p), rounds = o.strain == JAM_STRAIN_NONE ? 1.0 : 2.0;  // fixed cell, then free
  e.seconds_low = e.seconds / over, e.seconds_high = e.seconds * over * rounds;
  return e;
}

}  // namespace jam::inside
