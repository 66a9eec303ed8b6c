// What a set of diameters is, and which density it can reach in disorder.
#include <algorithm>
#include <cmath>
#include <numeric>
#include <queue>

#include "core/limits.hpp"
#include "core/math.hpp"
#include "core/size_laws.hpp"

namespace jam::inside {
namespace {

// x ascends. Differences from the least are summed: that of equal numbers is exact.
double mean_of(const std::vector<double> &x) {
  double more = 0.0;
  for (const double v : x) more += v - x.front();
  return x.front() + more / static_cast<double>(x.size());
}

double deviation_of(const std::vector<double> &x, double mean) {
  double sum = 0.0;
  for (const double v : x) sum += (v - mean) * (v - mean);
  return std::sqrt(sum / static_cast<double>(x.size()));
}

// The diameter below which a share of the volume lies. Half of a sphere's volume counts below its diameter; between two
// spheres the logarithm of the diameter is linear in the share. s ascends.
double volume_quantile(const std::vector<double> &s, int dim, double share) {
  double all = 0.0, sum = 0.0, before = 0.0;
  for (const double x : s) all += math::pow(x / s.back(), dim);
  for (size_t k = 0; k < s.size(); ++k) {
    const double v = math::pow(s[k] / s.back(), dim) / all, middle = sum + 0.5 * v;
    if (middle >= share) {
      if (k == 0 || s[k] == s[k - 1]) return s[k];
      return s[k - 1] * math::pow(s[k] / s[k - 1], (share - before) / (middle - before));
    }
    sum += v;
    before = middle;
  }
  return s.back();
}

// Random close packing by Farr and Groot, J. Chem. Phys. 131, 244104 (2009): a line cuts the spheres into rods. The
// rods go onto a circle, longest first, each into the largest gap. Two neighbours keep a gap of at least f times the
// shorter. The share that the rods cover is the packing fraction. Their f = 0.7654 for d = 3. The same construction in
// other d, with f fitted to packings of 400 or 500 spheres that libjam compressed to p = 1e5 and crunched: equal
// spheres 0.4577, 0.310, 0.202, 0.128, 0.0795 (d = 4 to 8); disks 1 : 1.4 half and half 0.8455, since equal ones order.
double covered_by_rods(int dim, const std::vector<double> &ascending) {
  static constexpr double gap[] = {0.2469, 0.7654, 1.685, 3.207, 5.741, 9.987, 17.0};
  constexpr int rods = 4096;
  const double f = gap[dim - 2], golden = 0.61803398874989485;
  std::vector<double> rod;
  double all = 0.0, sum = 0.0;
  for (const double s : ascending) all += math::pow(s / ascending.back(), dim - 1);
  size_t i = 0;
  for (int k = 0; k < rods; ++k) {
    // A line meets a sphere with a probability of s^(d - 1), at a distance r from its centre with one of r^(d - 2).
    const double target = (k + 0.5) / rods;
    double next = math::pow(ascending[i] / ascending.back(), dim - 1) / all;
    while (sum + next < target && i + 1 < ascending.size())
      sum += next, next = math::pow(ascending[++i] / ascending.back(), dim - 1) / all;
    const double turns = golden * k + 0.5, r2 = math::pow(turns - std::floor(turns), 2.0 / (dim - 1));
    rod.push_back(ascending[i] * std::sqrt(1.0 - r2));
  }
  std::sort(rod.begin(), rod.end(), [](double a, double b) { return a > b; });
  std::priority_queue<double> gaps;
  gaps.push(f * rod[0]);
  for (int k = 1; k < rods; ++k) {
    const double widest = gaps.top();
    gaps.pop();
    gaps.push(f * rod[k]);
    gaps.push(std::max(f * rod[k], widest - (1.0 + f) * rod[k]));
  }
  const double covered = std::accumulate(rod.begin(), rod.end(), 0.0);
  double open = 0.0;
  for (; !gaps.empty(); gaps.pop()) open += gaps.top();
  return covered / (covered + open);
}

}  // namespace

// Zhang and Torquato, Phys. Rev. E 88, 053312 (2013), for d = 2 to 8.
double sequential_fraction(int dim) {
  static constexpr double saturation[] = {0.5470735, 0.3841307, 0.2600781, 0.1707761, 0.109302, 0.068404, 0.0423};
  return saturation[dim - 2];
}

double jammed_fraction(int dim) { return dim == 2 ? 0.84 : 0.64 * math::pow(0.7, dim - 3); }

Reach jammed_reach(int dim, const std::vector<double> &diameters) {
  std::vector<double> s = diameters;
  std::sort(s.begin(), s.end());
  const double mean = mean_of(s);
  if (dim == 2 && deviation_of(s, mean) < 0.08 * mean) return {0.90689968211710893, JAM_REACH_CRYSTAL};
  return {covered_by_rods(dim, s), dim == 3 ? JAM_REACH_FARR_GROOT : JAM_REACH_MEASURED};
}

void check_reach(int dim, const std::vector<double> &diameters, double wanted) {
  const Reach reach = jammed_reach(dim, diameters);
  // Slow growth ends denser, small packings scatter and order, and the estimate has an error: against libjam's own
  // packings, ratios up to 3 and log-normal widths up to 0.5, it is 0.03 too high to 0.012 too low.
  const double margin =
      reach.source == JAM_REACH_CRYSTAL ? 0.0 : 0.02 + 0.3 / std::sqrt(static_cast<double>(diameters.size()));
  if (!(wanted > reach.fraction + margin)) return;
  const char *const source = reach.source == JAM_REACH_FARR_GROOT ? "estimate of Farr and Groot 2009"
                             : reach.source == JAM_REACH_CRYSTAL  ? "hexagonal packing"
                                                                  : "estimate from packings of libjam";
  fail(JAM_E_UNPLACEABLE,
       "packing fraction %.6g (porosity %.6g): these sizes jam near %.3f in bulk in d = %d (%s), and random sequential "
       "addition ends near %.3f",
       wanted, 1.0 - wanted, reach.fraction, dim, source, sequential_fraction(dim));
}

jam_size_report size_report(int dim, const std::vector<double> &diameters) {
  check_dim(dim);
  if (diameters.empty()) fail(JAM_E_ARGUMENT, "diameters is empty");
  for (size_t k = 0; k < diameters.size(); ++k)
    if (!(diameters[k] > 0.0) || !std::isfinite(diameters[k]))
      fail(std::isfinite(diameters[k]) ? JAM_E_ARGUMENT : JAM_E_NONFINITE,
           "diameters[%zu] is %g, it must be positive and finite", k, diameters[k]);
  const auto [least, most] = std::minmax_element(diameters.begin(), diameters.end());
  check_range("the least diameter", *least, limits::size_min, limits::size_max);
  check_range("the largest diameter", *most, limits::size_min, limits::size_max);
  std::vector<double> s = diameters;
  std::sort(s.begin(), s.end());
  jam_size_report r{};
  r.n = static_cast<int64_t>(s.size());
  r.mean = mean_of(s);
  r.deviation = deviation_of(s, r.mean);
  r.polydispersity = r.deviation / r.mean;
  r.least = s.front();
  r.largest = s.back();
  r.d10 = volume_quantile(s, dim, 0.1);
  r.d50 = volume_quantile(s, dim, 0.5);
  r.d90 = volume_quantile(s, dim, 0.9);
  double sum = 0.0;
  for (const double x : s) sum += math::pow(x / s.back(), dim);
  r.volume = sum * unit_sphere_volume(dim) * math::pow(s.back(), dim);
  r.largest_share = 1.0 / sum;
  r.sequential_fraction = sequential_fraction(dim);
  const Reach reach = jammed_reach(dim, s);
  r.jammed_fraction = reach.fraction;
  r.source = reach.source;
  return r;
}

}  // namespace jam::inside
