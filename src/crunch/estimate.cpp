#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>

#include "core/math.hpp"
#include "core/pair_rule.hpp"
#include "core/size_laws.hpp"
#include "crunch/approach/lp_step.hpp"
#include "crunch/path/barrier_path.hpp"
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

double steps(const Packing &p, const jam_crunch_options &o) {
  const bool near = contact_gap(p) < T::close_gap;
  const double size = static_cast<double>(p.n()) / T::size;
  const double alike = near ? std::max(T::steps_least, T::steps_near * math::pow(size, T::power_near))
                            : std::max(T::steps_least_far, T::steps_far * math::pow(size, T::power_far));
  const double path = alike * (1.0 + T::more_per_e_fold * math::log(ratio_of_diameters(p)));
  if (o.method == JAM_CRUNCH_SEQUENTIAL_LP) return path * (near ? T::times_near : T::times_far);
  return near && o.duality_gap > 0.0 ? std::min(path, T::steps_to_gap) : path;
}

// A list of pairs, and the matrix of those that it couples.
struct Part {
  double rows = 0.0, edges = 0.0;
  BlockCholesky::Sizes sizes{};

  double factor_bytes() const { return 8.0 * static_cast<double>(sizes.factor + sizes.fronts); }
  double bytes(double d, double n) const {
    return NewtonSystem::bytes(d, n, rows, edges, static_cast<double>(sizes.factor), static_cast<double>(sizes.fronts));
  }
  double seconds(double rate, int threads) const {
    return sizes.flops / (T::front_rate * rate * std::min(threads, ThreadTuning::most_parts)) +
           T::per_factor * static_cast<double>(sizes.factor) + T::per_pair * rows;
  }
};

// The edges of the particle graph, sorted as the pairs are: several images of one pair are one edge.
class Edges {
 public:
  void add(int32_t a, int32_t b) {
    if (b >= 0 && a != b && (i_.empty() || i_.back() != a || j_.back() != b)) i_.push_back(a), j_.push_back(b);
  }
  Part part(const Packing &p, size_t rows, int threads) const {
    return {static_cast<double>(rows), static_cast<double>(i_.size()),
            BlockCholesky::measure(p.dim, static_cast<int32_t>(p.n()), i_.data(), j_.data(), i_.size(), threads)};
  }

 private:
  std::vector<int32_t> i_, j_;
};

// Factor by which the diameters grow before a list gets shorter: this part of the way to jamming.
double growth(const Packing &p, double part) {
  return math::pow(std::max(1.0, jammed_fraction(p.dim) / packing_fraction(p)), part / p.dim);
}

// From a start with few neighbours at least as many of the nearest pairs as a list has near jamming.
PairList enough_pairs(const Packing &p, const jam_crunch_options &o, PairList pairs, double reach) {
  const double wanted =
      std::min(T::jammed_pairs[p.dim], 0.5 * static_cast<double>(p.n() - 1)) * static_cast<double>(p.n());
  for (int k = 0; k < 40 && o.neighbour_radius == 0.0 && static_cast<double>(pairs.size()) < wanted; ++k) {
    reach = T::widen * reach + T::widen_at_least * diameter_mean(p);
    pairs = find_pairs(p, reach, 1.0);
  }
  return pairs;
}

// The LP that a crunch begins with, or the widest of sequential ones, which keep their list while the spheres grow.
Part largest_lp(const Packing &p, const jam_crunch_options &o) {
  const Tuning t;
  const bool sequence = o.method == JAM_CRUNCH_SEQUENTIAL_LP;
  const bool widens = sequence && o.step_bound == 0.0 && contact_gap(p) > T::close_gap;
  const double bound = widens ? t.max_bound : first_bound(p, o, t), reach = lp_reach(p, o, t, bound);
  const PairList pairs = enough_pairs(p, o, find_pairs(p, reach, sequence ? growth(p, 1.0) : 1.0), reach);
  PackingLp lp = make_lp(p, pairs, diameter_mean(p));
  lp.bound = bound;
  WorkingSet split;
  split.choose(lp);
  Edges edges;
  for (size_t k = 0; k < split.pairs.size(); ++k) edges.add(split.pairs.i[k], split.pairs.j[k]);
  return edges.part(p, pairs.size(), o.threads);
}

// The list that the path begins with, a little denser as the spheres grow before it is shortened. Its matrix couples
// pairs up to `far_slack` of the gap that the farthest carrying row has.
Part barrier_path(const Packing &p, const jam_crunch_options &o) {
  const Tuning t;
  const double unit = diameter_mean(p), reach = unit * (t.least_reach + t.reach_per_spacing * free_spacing(p));
  const double grown = growth(p, diameter_max(p) > T::mixed * unit ? 1.0 : T::grown);  // mixtures shorten it late
  const PairList pairs = enough_pairs(p, o, select_neighbours(p, reach, grown), reach);
  const std::vector<double> gap = relative_gaps(p, pairs);
  const double slack = WorkingSetTuning::far_slack * carrying_slack(gap, p.dim, static_cast<int32_t>(p.n()));
  Edges edges;
  for (size_t k = 0; k < pairs.size(); ++k)
    if (gap[k] <= slack) edges.add(pairs.i[k], pairs.j[k]);
  return edges.part(p, pairs.size(), o.threads);
}

// Processor time of this thread: beside other jobs the clock would count theirs.
double thread_seconds() {
  timespec t{};
  if (clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t) != 0) return now_seconds();
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

// Seconds a step that the path spends on new lists. Spheres of similar size stay in their cages and need almost none.
// Small ones cross their holes in one step, and a list that covers all of them costs more than a factorisation.
double list_seconds(const Packing &p) {
  const double share = 1.0 - 1.0 / ratio_of_diameters(p), reach = Tuning().least_reach * diameter_mean(p);
  if (share == 0.0) return 0.0;
  double best = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 2; ++k) {
    const double t0 = thread_seconds();
    select_neighbours(p, reach);
    best = std::min(best, thread_seconds() - t0);
  }
  return share * best;
}

// Flops a second of this core in blocks as large as the fronts are; a millisecond.
template <class Real>
double measured_rate(int size) {
  const BlasThreads one(1);
  std::vector<Real> a(static_cast<size_t>(size) * size, Real(1e-9)), c(a.size());
  double best = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double t0 = thread_seconds();
    Blas<Real>::minus_product(size, size, size, a.data(), size, a.data(), size, Result::written, c.data(), size);
    best = std::max(best, 2.0 * size * size * static_cast<double>(size) / std::max(thread_seconds() - t0, 1e-7));
  }
  return best;
}

struct Factors {
  double low, high;
};

// Equal disks crystallise in parts, and crystals have more contacts than unknowns: narrow LPs and decompressions follow
// a path that says nothing of them.
Factors factors_of(const Packing &p) {
  const bool alike = ratio_of_diameters(p) < T::alike;
  const PairList closed = find_pairs(p, 0.0, 1.0 + T::crystal_gap);
  const double unknowns = p.dim * static_cast<double>(p.n());
  if (static_cast<double>(closed.size()) > T::crystal_pairs * unknowns) return {T::low_crystal, T::high_crystal};
  if (alike && p.dim == 2) return {T::low_disks, T::high_disks};
  return {T::low, T::high};
}

}  // namespace

jam_estimate_report estimate(const Packing &p, const jam_crunch_options &o) {
  check_options(p, o);
  const double d = p.dim, n = static_cast<double>(p.n());
  const Part lp = largest_lp(p, o), path = o.method == JAM_CRUNCH_SEQUENTIAL_LP ? lp : barrier_path(p, o);
  const Part &most = lp.bytes(d, n) > path.bytes(d, n) ? lp : path;
  const bool floats = path.sizes.flops > Tuning().single.work * static_cast<double>(path.sizes.factor);
  const double full = measured_rate<double>(192), rate = floats ? measured_rate<float>(192) : full;

  jam_estimate_report e{};
  e.pairs = static_cast<int64_t>(std::max(lp.rows, path.rows));
  e.flops = path.sizes.flops;
  e.factor_bytes = most.factor_bytes();
  e.bytes = most.bytes(d, n);
  e.factorisations = steps(p, o);
  const double in_lp = std::min(T::steps_of_lp / e.factorisations, 0.5);
  e.step_seconds = (1.0 - in_lp) * path.seconds(rate, o.threads) +
                   0.5 * in_lp * (lp.seconds(rate, o.threads) + lp.seconds(full, o.threads));
  if (o.method != JAM_CRUNCH_SEQUENTIAL_LP) e.step_seconds += (1.0 - in_lp) * list_seconds(p);
  e.seconds = e.factorisations * e.step_seconds;
  const Factors over = factors_of(p);
  const double rounds = o.strain == JAM_STRAIN_NONE ? 1.0 : T::rounds_of_free_cell;
  e.seconds_low = e.seconds * over.low, e.seconds_high = e.seconds * over.high * rounds;
  return e;
}

}  // namespace jam::inside
