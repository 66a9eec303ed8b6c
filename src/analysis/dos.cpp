// Density of states by Chebyshev moments in x = (2 lambda - high - low) / (high - low) = cos theta. Without pre-stress
// low = 0 and omega = omega_max sin((pi - theta) / 2): the resolution in theta is a uniform resolution in omega, also
// at omega = 0.
#include <algorithm>
#include <cmath>
#include <limits>
#include "analysis/modes.hpp"
#include "core/call_scope.hpp"
#include "core/rng.hpp"
#include "linalg/dot.hpp"

namespace jam::inside {

jam_dos_options default_dos_options() {
  jam_dos_options o{};
  o.struct_size = sizeof o;
  o.moments = 512;
  o.vectors = 16;
  o.points = 200;
  o.seed = 1;
  o.low = o.high = std::numeric_limits<double>::quiet_NaN();
  return o;
}

namespace {

// Upper bound of the spectrum: the smaller of Gershgorin's and a power estimate with its residual added.
double largest_eigenvalue(const RigidityMatrix &g, const BlockMatrix &h) {
  std::vector<double> x(h.rows()), y(h.rows());
  Rng rng(5, Stream::analysis_start);
  for (double &v : x) v = rng.normal();
  double lambda = 0.0, residual = 0.0;
  for (int pass = 0; pass < 60; ++pass) {
    CallScope::look();
    g.remove_symmetries(x.data());
    const double length = std::sqrt(dot(x, x));
    if (!(length > 0.0)) return 0.0;
    for (double &v : x) v /= length;
    h.multiply(x.data(), y.data());
    lambda = dot(x, y);
    residual = std::sqrt(std::max(0.0, dot(y, y) - lambda * lambda));
    x = y;
  }
  return std::min(h.norm_bound(), DosTuning::above_largest * lambda + 2.0 * residual);
}

// Lower bound of the spectrum: S~^T S~ has none below 0, and the pre-stress part takes no more than 2 max_i sum_j t_ij.
double smallest_eigenvalue(const RigidityMatrix &g, const ContactWeights &w) {
  std::vector<double> sum(g.nodes, 0.0);
  for (size_t k = 0; k < w.transverse.size(); ++k) {
    for_spheres(g.a[k], g.b[k], [&](int32_t i) { sum[i] += std::max(0.0, w.transverse[k]); });
  }
  return sum.empty() ? 0.0 : -2.0 * *std::max_element(sum.begin(), sum.end());
}

struct Interval {
  double low, high;
  double theta(double lambda) const {
    return math::acos(std::max(-1.0, std::min(1.0, (2.0 * lambda - high - low) / (high - low))));
  }
};

// mu_m = <v| T_m(x) |v>, m < moments, by two moments a product: T_{2m} = 2 T_m T_m - 1, T_{2m+1} = 2 T_{m+1} T_m - T_1.
void moments_of(const BlockMatrix &h, Interval span, std::vector<double> v, std::vector<double> &mu,
                const std::function<void()> &report_step) {
  const size_t n = v.size();
  const double scale = 2.0 / (span.high - span.low), shift = (span.high + span.low) / (span.high - span.low);
  auto apply = [&](const std::vector<double> &x, std::vector<double> &y) {
    h.multiply(x.data(), y.data());
    for (size_t k = 0; k < n; ++k) y[k] = scale * y[k] - shift * x[k];
  };
  std::vector<double> before = v, now(n), next(n);
  apply(before, now);
  mu[0] = dot(v, v);
  if (mu.size() > 1) mu[1] = dot(v, now);
  for (size_t m = 1; 2 * m < mu.size(); ++m) {
    report_step();
    mu[2 * m] = 2.0 * dot(now, now) - mu[0];
    apply(now, next);
    for (size_t k = 0; k < n; ++k) next[k] = 2.0 * next[k] - before[k];
    if (2 * m + 1 < mu.size()) mu[2 * m + 1] = 2.0 * dot(next, now) - mu[1];
    before.swap(now);
    now.swap(next);
  }
}

// Jackson's damping, which keeps the density positive.
double jackson(size_t m, size_t moments) {
  const double q = math::pi / static_cast<double>(moments + 1), x = static_cast<double>(m);
  return ((static_cast<double>(moments) - x + 1.0) * math::cos(q * x) +
          math::sin(q * x) * math::cos(q) / math::sin(q)) /
         static_cast<double>(moments + 1);
}

// sum (mu_m / m) sin(m theta), by Clenshaw's recurrence.
double sine_sum(const std::vector<double> &mu, double theta) {
  double b1 = 0.0, b2 = 0.0;
  const double c = 2.0 * math::cos(theta);
  for (size_t m = mu.size() - 1; m >= 1; --m) {
    const double b = mu[m] / static_cast<double>(m) + c * b1 - b2;
    b2 = b1;
    b1 = b;
  }
  return b1 * math::sin(theta);
}

// Share of the spectrum below omega: the density mu_0 + 2 sum mu_m cos(m theta) over pi, integrated over theta.
double share_below(const std::vector<double> &mu, Interval span, double omega) {
  const double theta = span.theta(omega * std::fabs(omega));
  return (mu[0] * (math::pi - theta) - 2.0 * sine_sum(mu, theta)) / math::pi;
}

// Mean over random vectors and its standard error.
struct Average {
  std::vector<double> sum, square;
  explicit Average(size_t n) : sum(n, 0.0), square(n, 0.0) {}
  void add(size_t k, double x) {
    sum[k] += x;
    square[k] += x * x;
  }
  void give(double count, std::vector<double> &mean, std::vector<double> &error) const {
    for (size_t k = 0; k < sum.size(); ++k) {
      mean.push_back(sum[k] / count);
      error.push_back(std::sqrt(std::max(0.0, square[k] / count - sum[k] * sum[k] / (count * count)) / (count - 1.0)));
    }
  }
};

[[noreturn]] void refuse_bins(double low, double high) {
  fail(JAM_E_ARGUMENT, "low is %g and high is %g: the bins need low < high, both finite", low, high);
}

}  // namespace

void check_dos_options(const jam_dos_options &o) {
  if (o.moments < 8 || o.moments > 1000000) fail(JAM_E_ARGUMENT, "moments is %d, it must be in 8..1e6", o.moments);
  if (o.vectors < 2 || o.vectors > 100000) fail(JAM_E_ARGUMENT, "vectors is %d, it must be in 2..1e5", o.vectors);
  if (o.points < 1 || o.points > 10000000) fail(JAM_E_ARGUMENT, "points is %d, it must be in 1..1e7", o.points);
  if (std::isinf(o.low) || std::isinf(o.high) || o.low >= o.high) refuse_bins(o.low, o.high);
}

DensityOfStates density_of_states(const RigidityMatrix &g, const ContactWeights &w, const jam_dos_options &o) {
  const BlockMatrix h = make_hessian(g, w);
  const size_t n = h.rows(), points = static_cast<size_t>(o.points), moments = static_cast<size_t>(o.moments);
  const Interval span{smallest_eigenvalue(g, w), largest_eigenvalue(g, h)};
  if (n <= static_cast<size_t>(g.dim) || !(span.high > 0.0))
    fail(JAM_E_TOO_FEW, "%d stable spheres have no density of states", g.nodes);
  const double first = std::isnan(o.low) ? -std::sqrt(-span.low) : o.low;
  const double last = std::isnan(o.high) ? std::sqrt(span.high) : o.high;
  if (!(last > first)) refuse_bins(first, last);
  DensityOfStates out;
  out.step = (last - first) / static_cast<double>(points);
  for (size_t k = 0; k < points; ++k) out.omega.push_back(first + out.step * (static_cast<double>(k) + 0.5));
  Average density(points), cumulative(points);
  std::vector<double> mu(moments), v(n);
  for (int32_t r = 0; r < o.vectors; ++r) {
    Rng rng(o.seed, Stream::analysis_start, static_cast<uint64_t>(r) << 32);
    do {  // of a few spheres, the signs may be those of a translation
      for (double &x : v) x = rng.bits() & 1 ? 1.0 : -1.0;
      g.remove_symmetries(v.data());
    } while (!(dot(v, v) > DosTuning::rounding));
    moments_of(h, span, v, mu, [&] { CallScope::report_share(r, static_cast<double>(r) / o.vectors); });
    // Each vector over its own length: the integral is 1 for every one of them.
    for (size_t m = moments; m-- > 0;) mu[m] *= jackson(m, moments) / mu[0];
    double before = share_below(mu, span, first);
    for (size_t k = 0; k < points; ++k) {
      CallScope::look();
      const double below = share_below(mu, span, out.omega[k] + 0.5 * out.step);
      density.add(k, (below - before) / out.step);  // mean over the bin, however wide
      cumulative.add(k, below);
      before = below;
    }
  }
  density.give(o.vectors, out.density, out.density_error);
  cumulative.give(o.vectors, out.cumulative, out.cumulative_error);
  return out;
}

}  // namespace jam::inside
