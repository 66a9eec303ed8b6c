// What a crunch will cost, from the particle graph and its elimination tree alone.
#include <algorithm>
#include <array>
#include <cmath>

#include "core/pair_rule.hpp"
#include "core/pairs.hpp"
#include "crunch/crunch.hpp"
#include "crunch/neighbour_selection.hpp"
#include "linalg/blas.hpp"
#include "linalg/block_cholesky.hpp"
#include "lp/working_set.hpp"

namespace jam {
namespace {

// Pairs a sphere that lists near jamming hold, d = 2..8: measured to d = 5, beyond by the kissing numbers' growth.
constexpr std::array<double, 9> jammed_pairs = {0, 0, 3.0, 5.0, 7.8, 12.0, 18.0, 27.0, 40.0};
// Factorisations from a state grown slowly to high pressure, median of five: 17 to 34 for N = 128 to 1024, 70 for 4096,
// 232 for 16384. Single packings scatter by a factor of two and more. A path to a duality gap of 1e-6 to 1e-9 takes
// 24 to 75 for N = 1024 to 65536. Sequential LPs take three times as many, dilute starts buckle again and again.
constexpr double steps_small = 17.0, steps_1024 = 34.0, steps_power = 0.69, steps_to_gap = 50.0, steps_dilute = 300.0;

double steps(const Packing &p, const jam_crunch_options &o) {
  if (free_spacing(p) > 0.05) return steps_dilute;
  const double grown = std::max(steps_small, steps_1024 * std::pow(static_cast<double>(p.n()) / 1024.0, steps_power));
  if (o.method == JAM_CRUNCH_SEQUENTIAL_LP) return 3.0 * grown;
  return o.duality_gap > 0.0 ? std::min(grown, steps_to_gap) : grown;
}

// Median contact gap below which the step bound of sequential LPs stays near its first value.
constexpr double close_gap = 3e-5;

// The list that the run begins with, a little denser as the spheres grow before it is shortened, and from a start with
// few neighbours at least as many of the nearest pairs as a list holds near jamming.
PairList longest_list(const Packing &p, const jam_crunch_options &o) {
  const double unit = diameter_mean(p), free = free_spacing(p),
               jammed = p.dim == 2 ? 0.84 : 0.64 * std::pow(0.7, p.dim - 3);
  const double lp_reach = 2.2 * (o.step_bound > 0.0           ? o.step_bound
                                 : contact_gap(p) > close_gap ? Tuning().max_bound
                                                              : 0.1 + 0.6 * free);
  double reach = unit * (o.method == JAM_CRUNCH_SEQUENTIAL_LP ? lp_reach
                         : o.step_bound > 0.0                 ? std::max(lp_reach, 0.15 + 1.5 * free)
                                                              : 0.15 + 1.5 * free);
  if (o.neighbour_radius > 0.0) reach = std::max(0.0, o.neighbour_radius * unit - diameter_max(p));
  // How far the diameters grow before the list gets shorter: sequential LPs and mixtures keep theirs, the path of equal
  // spheres shortens it early.
  const double part = o.method == JAM_CRUNCH_SEQUENTIAL_LP || diameter_max(p) > 1.3 * unit ? 1.0 : 0.3;
  const double grown = std::pow(std::max(1.0, jammed / packing_fraction(p)), part / p.dim);
  PairList pairs =
      o.method == JAM_CRUNCH_SEQUENTIAL_LP ? find_pairs(p, reach, grown) : select_neighbours(p, reach, grown);
  const double enough =
      std::min(jammed_pairs[p.dim], 0.5 * static_cast<double>(p.n() - 1)) * static_cast<double>(p.n());
  for (int k = 0; k < 40 && o.neighbour_radius == 0.0 && static_cast<double>(pairs.size()) < enough; ++k) {
    reach = 1.1 * reach + 0.01 * unit;
    pairs = find_pairs(p, reach, 1.0);
  }
  return pairs;
}

// The edges of the particle graph, sorted as the pairs are: several images of one pair are one edge.
struct Edges {
  std::vector<int32_t> i, j;
  void add(int32_t a, int32_t b) {
    if (a != b && (i.empty() || i.back() != a || j.back() != b)) i.push_back(a), j.push_back(b);
  }
  BlockCholesky::Sizes measure(const Packing &p, int threads) const {
    return BlockCholesky::measure(p.dim, static_cast<int32_t>(p.n()), i.data(), j.data(), i.size(), threads);
  }
};

// h = r / sigma - 1 of each pair.
std::vector<double> relative_gaps(const Packing &p, const PairList &pairs) {
  std::vector<double> gap(pairs.size());
  double r[JAM_MAX_DIM];
  for (size_t k = 0; k < gap.size(); ++k)
    gap[k] = std::sqrt(pair_vector(p, pairs, k, r)) / contact_distance(p, pairs.i[k], pairs.j[k]) - 1.0;
  return gap;
}

// Of the pairs that a path lists those that its matrix couples on most of its way: up to `far_slack` of the gap that
// the farthest carrying row has. A first LP with a wide bound couples more, for a few of the factorisations.
Edges coupled_edges(const Packing &p, const PairList &pairs) {
  const std::vector<double> gap = relative_gaps(p, pairs);
  const double slack = far_slack * carrying_slack(gap, p.dim, static_cast<int32_t>(p.n()));
  Edges edges;
  for (size_t k = 0; k < gap.size(); ++k)
    if (gap[k] <= slack) edges.add(pairs.i[k], pairs.j[k]);
  return edges;
}

// Flops a second of this core in blocks as large as the fronts are; a millisecond.
template <class Real>
double measured_rate(int size) {
  const BlasSingleThread single_thread;
  const Real one = 1, zero = 0;
  std::vector<Real> a(static_cast<size_t>(size) * size, Real(1e-3)), c(a.size());
  double best = 0.0;
  for (int k = 0; k < 3; ++k) {
    const double t0 = now_seconds();
    Blas<Real>::gemm("N", "T", &size, &size, &size, &one, a.data(), &size, a.data(), &size, &zero, c.data(), &size);
    best = std::max(best, 2.0 * size * size * static_cast<double>(size) / std::max(now_seconds() - t0, 1e-7));
  }
  return best;
}

}  // namespace

double contact_gap(const Packing &p) {
  const PairList pairs = find_pairs(p, 0.0, 1.5);
  const size_t wanted = static_cast<size_t>(p.dim) * p.n() / 2;
  if (pairs.size() <= wanted) return 0.5;
  std::vector<double> gap = relative_gaps(p, pairs);
  std::nth_element(gap.begin(), gap.begin() + wanted, gap.end());
  return gap[wanted];
}

jam_estimate estimate(const Packing &p, const jam_crunch_options &o) {
  check_options(p, o);
  PairList pairs = longest_list(p, o);
  Edges listed;
  for (size_t k = 0; k < pairs.size(); ++k) listed.add(pairs.i[k], pairs.j[k]);
  const double d = p.dim, n = static_cast<double>(p.n()), rows = static_cast<double>(pairs.size()),
               edges = static_cast<double>(listed.i.size());
  const BlockCholesky::Sizes most = listed.measure(p, o.threads);
  const BlockCholesky::Sizes usual =
      o.method == JAM_CRUNCH_SEQUENTIAL_LP ? most : coupled_edges(p, pairs).measure(p, o.threads);

  jam_estimate e{};
  e.pairs = static_cast<int64_t>(rows);
  e.flops = usual.flops;
  e.factor_bytes = 8.0 * static_cast<double>(most.factor + most.fronts);
  // Blocks before elimination; a dozen vectors and the rows themselves for each pair, two dozen for each unknown; three
  // pair lists; tables of the symbolic part (an index for each block of the factor among them).
  const double blocks = 8.0 * d * d * (n + edges), vectors = 8.0 * (rows * (14.0 + 2.0 * d) + n * d * 27.0);
  const double lists = 3.0 * rows * (8.0 + 8.0 * d),
               tables = 80.0 * (n + edges) + 8.0 * static_cast<double>(most.factor) / (d * d);
  e.bytes = e.factor_bytes + blocks + vectors + lists + tables;
  e.factorisations = steps(p, o);
  // Fronts run at about half the rate of one large product; the rest of a step goes over all pairs and the factor a few
  // times. Large factors are floats but for the last few.
  const double rate = usual.flops > Tuning().single.work ? measured_rate<float>(192) : measured_rate<double>(192);
  e.step_seconds =
      usual.flops / (0.5 * rate * std::min(o.threads, 2)) + 4e-9 * static_cast<double>(usual.factor) + 4e-7 * rows;
  e.seconds = e.factorisations * e.step_seconds;
  return e;
}

}  // namespace jam
