// Density of states by Chebyshev moments. With x = 2 lambda / lambda_max - 1 = cos theta, omega = omega_max sin((pi - theta) / 2):
// the resolution in theta is a uniform resolution in omega, also at omega = 0.
#include <algorithm>
#include <cmath>
#include "analysis/spectrum.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"

namespace jam {

jam_dos_options default_dos_options() {
  jam_dos_options o{};
  o.struct_size = sizeof o;
  o.moments = 512;
  o.vectors = 16;
  o.points = 200;
  o.seed = 1;
  return o;
}

namespace {

double dot(const std::vector<double> &x, const std::vector<double> &y) {
  double s = 0.0;
  for (size_t k = 0; k < x.size(); ++k) s += x[k] * y[k];
  return s;
}

// Upper bound of the spectrum: the smaller of Gershgorin's and a power estimate with its residual added.
double largest_eigenvalue(const StableGraph &g, const BlockMatrix &h) {
  std::vector<double> x(h.rows()), y(h.rows());
  Rng rng(5, Stream::analysis_start);
  for (double &v : x) v = rng.normal();
  double lambda = 0.0, residual = 0.0;
  for (int pass = 0; pass < 60; ++pass) {
    remove_translation(g.dim, g.nodes, x.data());
    const double length = std::sqrt(dot(x, x));
    if (!(length > 0.0)) return 0.0;
    for (double &v : x) v /= length;
    h.multiply(x.data(), y.data());
    lambda = dot(x, y);
    residual = std::sqrt(std::max(0.0, dot(y, y) - lambda * lambda));
    x = y;
  }
  return std::min(h.norm_bound(), 1.05 * lambda + 2.0 * residual);
}

// mu_m = <v| T_m(x) |v>, m < moments, by two moments a product: T_{2m} = 2 T_m T_m - 1, T_{2m+1} = 2 T_{m+1} T_m - T_1.
bool moments_of(const BlockMatrix &h, double lambda_max, std::vector<double> v, std::vector<double> &mu,
                const std::function<bool()> &stop) {
  const size_t n = v.size();
  auto apply = [&](const std::vector<double> &x, std::vector<double> &y) {
    h.multiply(x.data(), y.data());
    for (size_t k = 0; k < n; ++k) y[k] = 2.0 * y[k] / lambda_max - x[k];
  };
  std::vector<double> before = v, now(n), next(n);
  apply(before, now);
  mu[0] = dot(v, v);
  if (mu.size() > 1) mu[1] = dot(v, now);
  for (size_t m = 1; 2 * m < mu.size(); ++m) {
    if (stop()) return false;
    mu[2 * m] = 2.0 * dot(now, now) - mu[0];
    apply(now, next);
    for (size_t k = 0; k < n; ++k) next[k] = 2.0 * next[k] - before[k];
    if (2 * m + 1 < mu.size()) mu[2 * m + 1] = 2.0 * dot(next, now) - mu[1];
    before.swap(now);
    now.swap(next);
  }
  return true;
}

// Jackson's damping, which keeps the density positive.
double jackson(size_t m, size_t moments) {
  const double q = M_PI / static_cast<double>(moments + 1), x = static_cast<double>(m);
  return ((static_cast<double>(moments) - x + 1.0) * std::cos(q * x) + std::sin(q * x) / std::tan(q)) / static_cast<double>(moments + 1);
}

}  // namespace

jam_status density_of_states(const StableGraph &g, const BlockMatrix &h, const jam_dos_options &o, Monitor &monitor, DensityOfStates &out) {
  if (o.moments < 8 || o.moments > 1000000) fail(JAM_E_ARGUMENT, "moments is %d, it must be in 8..1e6", o.moments);
  if (o.vectors < 2 || o.vectors > 100000) fail(JAM_E_ARGUMENT, "vectors is %d, it must be in 2..1e5", o.vectors);
  if (o.points < 1 || o.points > 10000000) fail(JAM_E_ARGUMENT, "points is %d, it must be in 1..1e7", o.points);
  const size_t n = h.rows(), points = static_cast<size_t>(o.points), moments = static_cast<size_t>(o.moments);
  const double lambda_max = largest_eigenvalue(g, h);
  if (n <= static_cast<size_t>(g.dim) || !(lambda_max > 0.0)) fail(JAM_E_TOO_FEW, "%d stable spheres have no density of states", g.nodes);
  const double omega_max = std::sqrt(lambda_max), modes = static_cast<double>(n) - g.dim;
  std::vector<double> sum(points, 0.0), sum2(points, 0.0), mu(moments), v(n);
  for (int32_t r = 0; r < o.vectors; ++r) {
    Rng rng(o.seed, Stream::analysis_start, static_cast<uint64_t>(r) << 32);
    for (double &x : v) x = rng.bits() & 1 ? 1.0 : -1.0;
    remove_translation(g.dim, g.nodes, v.data());
    auto stop = [&] {
      jam_progress p{};
      p.phase = JAM_PHASE_ANALYSE;
      p.steps = r;
      p.fraction = static_cast<double>(r) / o.vectors;
      return monitor.report(p);
    };
    if (!moments_of(h, lambda_max, v, mu, stop)) return JAM_CANCELLED;
    for (size_t m = 0; m < moments; ++m) mu[m] *= jackson(m, moments) / modes;
    for (size_t k = 0; k < points; ++k) {
      const double s = (static_cast<double>(k) + 0.5) / static_cast<double>(points), half = std::asin(s), theta = M_PI - 2.0 * half;
      // Clenshaw's recurrence for mu_0 + 2 sum mu_m cos(m theta)
      double b1 = 0.0, b2 = 0.0;
      const double c = 2.0 * std::cos(theta);
      for (size_t m = moments - 1; m >= 1; --m) {
        const double b = 2.0 * mu[m] + c * b1 - b2;
        b2 = b1;
        b1 = b;
      }
      const double density = (mu[0] + 0.5 * c * b1 - b2) / M_PI * 2.0 / (omega_max * std::cos(half));
      sum[k] += density;
      sum2[k] += density * density;
    }
  }
  const double count = o.vectors;
  for (size_t k = 0; k < points; ++k) {
    out.omega.push_back(omega_max * (static_cast<double>(k) + 0.5) / static_cast<double>(points));
    out.density.push_back(sum[k] / count);
    out.error.push_back(std::sqrt(std::max(0.0, sum2[k] / count - sum[k] * sum[k] / (count * count)) / (count - 1.0)));
  }
  return JAM_OK;
}

}  // namespace jam
