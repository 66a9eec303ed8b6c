#include "dynamics/observer.hpp"

#include <algorithm>
#include <cmath>

#include "core/limits.hpp"
#include "core/pair_levels.hpp"
#include "core/rng.hpp"
#include "core/shells.hpp"

namespace jam::inside {

// ---- sums over pairs

PairSums::Slot &PairSums::find(uint64_t key) {
  size_t at = static_cast<size_t>(mix64(key)) & (slots_.size() - 1);
  while (slots_[at].key != empty && slots_[at].key != key) at = (at + 1) & (slots_.size() - 1);
  return slots_[at];
}

void PairSums::add(int32_t i, int32_t j, double momentum) {
  if (2 * (used_ + 1) > slots_.size()) {
    std::vector<Slot> old(std::max<size_t>(1024, 2 * slots_.size()));
    old.swap(slots_);
    for (const Slot &s : old)
      if (s.key != empty) find(s.key) = s;
  }
  const uint64_t key = static_cast<uint64_t>(std::min(i, j)) << 32 | static_cast<uint64_t>(std::max(i, j));
  Slot &slot = find(key);
  if (slot.key == empty) slot.key = key, ++used_;
  ++slot.collisions;
  slot.momentum += momentum;
}

std::vector<PairSums::Slot> PairSums::sorted() const {
  std::vector<Slot> out;
  for (const Slot &s : slots_)
    if (s.key != empty) out.push_back(s);
  std::sort(out.begin(), out.end(), [](const Slot &a, const Slot &b) { return a.key < b.key; });
  return out;
}

// ---- histograms

void Histogram::start(std::vector<double> edges) {
  edge = std::move(edges);
  sum.assign(edge.empty() ? 0 : edge.size() - 1, 0.0);
  square = sum;
}

void Histogram::add(const std::vector<double> &density) {
  ++samples;
  for (size_t k = 0; k < sum.size(); ++k) sum[k] += density[k], square[k] += density[k] * density[k];
}

double Histogram::error(size_t bin) const {
  if (samples < 2) return std::numeric_limits<double>::quiet_NaN();
  const double m = static_cast<double>(samples), average = sum[bin] / m;
  return std::sqrt(std::max(0.0, square[bin] / m - average * average) / (m - 1.0));
}

// ---- options

jam_observe_options default_observe_options() {
  jam_observe_options o{};
  o.struct_size = sizeof o;
  o.sample_every = 10.0;
  o.gap_min = 1e-8;
  o.gap_max = 1.0;
  o.r_max = 4.0;
  o.snapshot_factor = 1.0;
  return o;
}

void check_observe_options(const jam_observe_options &o) {
  check_flag(o.collisions, "collisions");
  if (o.gap_bins < 0 || o.gap_bins == 1 || o.gap_bins > 1000000)
    fail(JAM_E_ARGUMENT, "gap_bins is %d, it must be 0 or in 2..1000000", o.gap_bins);
  if (o.r_bins < 0 || o.r_bins > 1000000) fail(JAM_E_ARGUMENT, "r_bins is %d, it must be in 0..1000000", o.r_bins);
  check_positive(o.sample_every, "sample_every");
  check_range("gap_min", o.gap_min, limits::distance_min, 10.0);
  check_range("gap_max", o.gap_max, limits::distance_min, 10.0);
  if (o.gap_max <= o.gap_min)
    fail(JAM_E_ARGUMENT, "gap_max is %g, it must be above gap_min, which is %g", o.gap_max, o.gap_min);
  check_range("r_max", o.r_max, limits::distance_min, limits::radius_max);
  check_not_negative(o.snapshot_every, "snapshot_every");
  if (!(o.snapshot_factor >= 1.0) || !std::isfinite(o.snapshot_factor))
    fail(JAM_E_ARGUMENT, "snapshot_factor is %g, it must be >= 1 and finite", o.snapshot_factor);
}

// ---- the observer

namespace {
// Collisions of the whole system that give each sphere so many; the largest integer when infinite.
int64_t in_all(double per_particle, double n) {
  const double all = std::ceil(0.5 * per_particle * n);
  return all < 9e18 ? std::max<int64_t>(1, static_cast<int64_t>(all)) : std::numeric_limits<int64_t>::max();
}
}  // namespace

Observer::Observer(const Packing &p, const jam_observe_options &o)
    : stress(static_cast<size_t>(p.dim)),
      options_(o),
      dim_(static_cast<size_t>(p.dim)),
      n_(static_cast<double>(p.n())),
      momentum_kept_(p.container.momentum_kept()),
      snapshot_step_(o.snapshot_every) {
  next_block_ = in_all(o.sample_every / blocks, n_);
  next_snapshot_ = std::numeric_limits<int64_t>::max();
  if (o.snapshot_every > 0.0) {
    snapshot_at_ = snapshot_step_;
    next_snapshot_ = in_all(snapshot_at_, n_);
  }
  if (p.container && (o.gap_bins > 0 || o.r_bins > 0)) {  // refused now, not at the first sample
    const std::vector<char> all(p.n(), 1);
    pairs_of_even_spread(p, all, all, {0.0, 0.0});
  }
  travel_.assign(p.n() * dim_, 0.0);
  if (o.collisions) collisions_.assign(p.n(), 0);
  if (o.gap_bins > 0) {
    std::vector<double> edge{0.0};
    for (int32_t k = 0; k < o.gap_bins; ++k)
      edge.push_back(o.gap_min * math::pow(o.gap_max / o.gap_min, static_cast<double>(k) / (o.gap_bins - 1)));
    gaps_.start(std::move(edge));
  }
  if (o.r_bins > 0) {
    std::vector<double> edge;
    for (int32_t k = 0; k <= o.r_bins; ++k) edge.push_back(o.r_max * k / o.r_bins);
    correlation_.start(std::move(edge));
  }
}

bool Observer::end_block(const PressureSums &block) {
  blocks_.push_back(block);
  left = PressureSums();
  ++blocks_made_;
  // Histograms are taken inside the second half of a sample, at a time that is not tied to a collision.
  const bool wanted = gaps_.bins() > 0 || correlation_.bins() > 0;
  if (wanted && 2 * blocks_.size() == blocks && std::isinf(histograms_at_))
    histograms_at_ = time + 0.5 * (time - sample_time_);
  next_block_ = std::max(seen + 1, in_all(static_cast<double>(blocks_made_ + 1) * options_.sample_every / blocks, n_));
  return blocks_.size() == blocks;
}

int64_t Observer::end_snapshot() {
  snapshot_step_ *= options_.snapshot_factor;
  snapshot_at_ += snapshot_step_;
  next_snapshot_ = std::max(seen + 1, in_all(snapshot_at_, n_));
  return ++snapshots_;
}

void Observer::take_sample(const Packing &now, const std::vector<double> &displacement) {
  Sample s{};
  s.time = sample_time_ = time;
  s.collisions = 2.0 * static_cast<double>(seen) / n_;
  s.packing_fraction = packing_fraction(now);
  PressureSums all;
  for (const PressureSums &block : blocks_) all += block;
  s.pressure =
      all.time_has_passed() ? all.reduced_pressure(n_, momentum_kept_) : std::numeric_limits<double>::quiet_NaN();
  double spread = 0.0;
  for (const PressureSums &block : blocks_) {
    const double p = block.reduced_pressure(n_, momentum_kept_);
    spread += (p - s.pressure) * (p - s.pressure);
  }
  s.error = std::sqrt(spread / (blocks * (blocks - 1)));
  for (double x : displacement) s.displacement2 += x * x;
  s.displacement2 *= now.cell.side() * now.cell.side() / n_;
  samples_.push_back(s);
  blocks_.clear();
}

void Observer::take_histograms(const Packing &now) {
  std::vector<double> gaps, correlation;
  if (gaps_.bins() > 0) gaps = sample_gaps(now);
  if (correlation_.bins() > 0) correlation = sample_correlation(now);
  // Both or none: a search for pairs may have been left.
  if (gaps_.bins() > 0) gaps_.add(gaps);
  if (correlation_.bins() > 0) correlation_.add(correlation);
  histograms_at_ = std::numeric_limits<double>::infinity();
}

// Numbers of pairs over those of spheres with partners spread evenly where the walls leave their centres room.
std::vector<double> Observer::between_walls(const Packing &p, const std::vector<double> &edge, bool of_contact,
                                            std::vector<double> pairs) const {
  const std::vector<char> all(p.n(), 1);
  const std::vector<double> even = pairs_of_even_spread(p, all, all, edge, of_contact);
  for (size_t k = 0; k < pairs.size(); ++k) {
    const double ideal = 0.5 * (n_ - 1.0) / n_ * even[k];  // each pair once, and none with itself
    pairs[k] = ideal > 0.0 ? pairs[k] / ideal : 0.0;
  }
  return pairs;
}

// Number of pairs in each bin of the gap h over that of an ideal gas; for equal spheres this is g at contact.
std::vector<double> Observer::sample_gaps(const Packing &p) const {
  std::vector<double> density(gaps_.bins(), 0.0);
  visit_pairs(p, 0.0, 1.0 + options_.gap_max, [&](const PairList &pairs) {
    double r[JAM_MAX_DIM];
    for (size_t k = 0; k < pairs.size(); ++k) {
      if (pairs.i[k] == pairs.j[k]) continue;
      const double sigma = contact_distance(p, pairs.i[k], pairs.j[k]);
      const double gap = std::sqrt(pair_vector(p, pairs, k, r)) / sigma - 1.0;
      const auto at = std::upper_bound(gaps_.edge.begin() + 1, gaps_.edge.end(), gap);
      if (at != gaps_.edge.end()) density[static_cast<size_t>(at - gaps_.edge.begin()) - 1] += 1.0;
    }
  });
  if (p.container) {
    std::vector<double> edge(gaps_.edge);
    for (double &h : edge) h += 1.0;
    return between_walls(p, edge, true, std::move(density));
  }
  // The ideal gas has N^2/2 <sigma_ij^d> V_d d(1+h)^d / V pairs in dh. The mean of sigma_ij^d follows from powers of
  // sigma.
  std::vector<double> moment(dim_ + 1, 0.0);
  for (double s : p.diameter)
    for (size_t m = 0; m <= dim_; ++m) moment[m] += math::pow(s / p.cell.side(), static_cast<double>(m)) / n_;
  double mean = 0.0, choose = 1.0;
  for (size_t m = 0; m <= dim_; ++m) {
    mean += choose * moment[m] * moment[dim_ - m] * math::pow(0.5, static_cast<double>(dim_));
    choose *= static_cast<double>(dim_ - m) / static_cast<double>(m + 1);
  }
  const double ideal =
                   0.5 * n_ * (n_ - 1.0) * mean * unit_sphere_volume(p.dim) * math::pow(2.0, static_cast<double>(dim_)),
               d = static_cast<double>(dim_);
  for (size_t k = 0; k < density.size(); ++k)
    density[k] /=
        ideal * (math::expm1(d * math::log1p(gaps_.edge[k + 1])) - math::expm1(d * math::log1p(gaps_.edge[k])));
  return density;
}

std::vector<double> Observer::sample_correlation(const Packing &p) const {
  std::vector<double> density(correlation_.bins(), 0.0);
  const double sigma = diameter_mean(p), width = options_.r_max / options_.r_bins;
  visit_pairs(p, options_.r_max * sigma, 0.0, [&](const PairList &pairs) {
    double r[JAM_MAX_DIM];
    for (size_t k = 0; k < pairs.size(); ++k) {
      if (pairs.i[k] == pairs.j[k]) continue;
      const auto bin = static_cast<size_t>(std::sqrt(pair_vector(p, pairs, k, r)) / (sigma * width));
      if (bin < density.size()) density[bin] += 1.0;
    }
  });
  if (p.container) {
    std::vector<double> edge(correlation_.edge);
    for (double &x : edge) x *= sigma;
    return between_walls(p, edge, false, std::move(density));
  }
  const double d = static_cast<double>(dim_);
  const double ideal = 0.5 * n_ * (n_ - 1.0) * unit_sphere_volume(p.dim) * math::pow(2.0 * sigma / p.cell.side(), d);
  for (size_t k = 0; k < density.size(); ++k)
    density[k] /= ideal * (math::pow(correlation_.edge[k + 1], d) - math::pow(correlation_.edge[k], d));
  return density;
}

}  // namespace jam::inside
