// Elastic moduli with the non-affine part, and comparing two packings.
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>
#include "analysis/spectrum.hpp"
#include "core/error.hpp"

namespace jam {
namespace {

// Second derivative of the energy when contact vectors change by du (contacts, d) times a strain: affine, and with
// relaxed spheres. The relaxed one is summed over the residual of each du, so that no digits cancel.
struct Strained {
  const RigidityMatrix &g;
  const ContactWeights &w;
  const GroundedSolver &solver;

  double transverse(size_t k) const { return w.transverse.empty() ? 0.0 : w.transverse[k]; }
  // Block k of the Hessian times x: stiffness k along n, -t across.
  void force(size_t k, const double *x, double *f) const {
    const double *n = &g.normal[k * g.dim], t = transverse(k);
    double along = 0.0;
    for (int c = 0; c < g.dim; ++c) along += n[c] * x[c];
    for (int c = 0; c < g.dim; ++c) f[c] = (w.stiffness[k] + t) * along * n[c] - t * x[c];
  }
  double energy(size_t k, const double *x) const {
    const double *n = &g.normal[k * g.dim];
    double along = 0.0, all = 0.0;
    for (int c = 0; c < g.dim; ++c) along += n[c] * x[c], all += x[c] * x[c];
    return w.stiffness[k] * along * along - transverse(k) * (all - along * along);
  }

  void relax(const std::vector<double> &du, double &affine, double &relaxed) const {
    const size_t d = static_cast<size_t>(g.dim);
    std::vector<double> u(g.unknowns(), 0.0), f(d), left(d);
    for (size_t k = 0; k < g.contacts(); ++k) {
      force(k, &du[k * d], f.data());
      for (size_t c = 0; c < d; ++c) {
        u[static_cast<size_t>(g.a[k]) * d + c] += f[c];
        u[static_cast<size_t>(g.b[k]) * d + c] -= f[c];
      }
    }
    solver.solve(u.data(), 1);
    affine = relaxed = 0.0;
    for (size_t k = 0; k < g.contacts(); ++k) {
      for (size_t c = 0; c < d; ++c)
        left[c] = du[k * d + c] - (u[static_cast<size_t>(g.a[k]) * d + c] - u[static_cast<size_t>(g.b[k]) * d + c]);
      affine += energy(k, &du[k * d]);
      relaxed += energy(k, left.data());
    }
  }
};

}  // namespace

// With pre-stress the strain measure matters. Shear: simple shear x_a += gamma x_b, both ways round, G = E'' / V. Bulk:
// K = V d^2 E / dV^2 = (E'' - (d - 1) E') / (d^2 V) for a stretch of all lengths, E' = -sum (force times length).
jam_moduli elastic_moduli(const Packing &p, const RigidityMatrix &g, const ContactWeights &w,
                          const CancellationPoint &cancel_point) {
  jam_moduli m{};
  const int d = p.dim;
  const size_t width = static_cast<size_t>(d);
  const double volume = p.cell.volume(), directions = d * (d - 1);
  const GroundedSolver solver(g, w);
  if (!w.transverse.empty() && solver.shift() > 1e-9 * solver.hessian().norm_bound())
    fail(JAM_E_STATE,
         "with this pre-stress the Hessian has negative eigenvalues: the network is unstable and has no moduli");
  const Strained strained{g, w, solver};
  std::vector<double> du(g.contacts() * width);
  double affine = 0.0, relaxed = 0.0, pressure = 0.0;
  for (size_t k = 0; k < g.contacts(); ++k) {
    for (size_t c = 0; c < width; ++c)
      du[k * width + c] = g.distance[k] * g.normal[k * width + c] / d;  // volume strain 1
    pressure += strained.transverse(k) * g.distance[k] * g.distance[k] / (d * volume);
  }
  strained.relax(du, affine, relaxed);
  m.bulk_affine = affine / volume + pressure * (d - 1) / d;
  m.bulk = relaxed / volume + pressure * (d - 1) / d;
  m.shear_min = std::numeric_limits<double>::infinity();
  m.shear_max = -m.shear_min;
  for (int a = 0; a < d; ++a)
    for (int b = 0; b < a; ++b) {
      double plane = 0.0;
      for (const auto &[x, y] : {std::pair<int, int>(a, b), std::pair<int, int>(b, a)}) {
        cancel_point();
        std::fill(du.begin(), du.end(), 0.0);
        for (size_t k = 0; k < g.contacts(); ++k) du[k * width + x] = g.distance[k] * g.normal[k * width + y];
        strained.relax(du, affine, relaxed);
        m.shear_affine += affine / volume / directions;
        m.shear += relaxed / volume / directions;
        plane += 0.5 * relaxed / volume;
      }
      m.shear_min = std::min(m.shear_min, plane);
      m.shear_max = std::max(m.shear_max, plane);
    }
  return m;
}

jam_comparison compare_packings(const Packing &a, const ContactNetwork *na, const Packing &b, const ContactNetwork *nb,
                                std::vector<double> &displacement) {
  if (a.dim != b.dim || a.n() != b.n())
    fail(JAM_E_ARGUMENT, "the packings differ: d = %d and %d, n = %zu and %zu", a.dim, b.dim, a.n(), b.n());
  for (int c = 0; c < a.dim; ++c)
    for (int k = 0; k <= c; ++k)
      if (std::fabs(a.cell.row(c)[k] - b.cell.row(c)[k]) > 1e-12 * a.cell.side())
        fail(JAM_E_ARGUMENT, "the cells differ: component %d of vector %d is %.17g and %.17g", k, c, a.cell.row(c)[k],
             b.cell.row(c)[k]);
  jam_comparison c{};
  const size_t n = a.n(), d = static_cast<size_t>(a.dim);
  std::vector<char> stable(n, 1);
  for (size_t i = 0; i < n; ++i) stable[i] = (!na || na->coordination[i] > 0) && (!nb || nb->coordination[i] > 0);
  const auto count = std::count(stable.begin(), stable.end(), 1);
  if (count == 0) std::fill(stable.begin(), stable.end(), 1);
  const double weight = static_cast<double>(count ? count : static_cast<std::ptrdiff_t>(n));
  c.packing_fraction_change = packing_fraction(b) - packing_fraction(a);
  displacement.assign(n * d, 0.0);
  // The mean is taken out of nearest-image displacements; taking it out can change nearest images, hence the passes.
  std::vector<double> shift(d, 0.0);
  for (int pass = 0; pass < 5; ++pass) {
    std::vector<double> mean(d, 0.0);
    for (size_t i = 0; i < n; ++i) {
      double *u = &displacement[i * d];
      for (size_t x = 0; x < d; ++x) u[x] = b.position[i * d + x] - a.position[i * d + x] - shift[x];
      a.cell.nearest(u);
      for (size_t x = 0; x < d; ++x)
        if (stable[i]) mean[x] += u[x] / weight;
    }
    for (size_t x = 0; x < d; ++x) shift[x] += mean[x];
  }
  const double unit = diameter_mean(a);
  for (size_t i = 0; i < n; ++i) {
    if (!stable[i]) continue;
    double u2 = 0.0;
    for (size_t x = 0; x < d; ++x) u2 += displacement[i * d + x] * displacement[i * d + x];
    c.displacement_rms += u2 / weight;
    c.displacement_max = std::max(c.displacement_max, std::sqrt(u2) / unit);
  }
  c.displacement_rms = std::sqrt(c.displacement_rms) / unit;
  c.stable_in_both = static_cast<int64_t>(count);
  if (!na || !nb) return c;
  std::map<std::pair<int32_t, int32_t>, int> left;
  for (size_t k = 0; k < na->size(); ++k) ++left[{na->pairs.i[k], na->pairs.j[k]}];
  for (size_t k = 0; k < nb->size(); ++k) {
    auto it = left.find({nb->pairs.i[k], nb->pairs.j[k]});
    if (it != left.end() && it->second > 0) --it->second, ++c.common_contacts;
  }
  c.contacts_a = static_cast<int64_t>(na->size());
  c.contacts_b = static_cast<int64_t>(nb->size());
  const int64_t all = c.contacts_a + c.contacts_b - c.common_contacts;
  const auto common = static_cast<double>(c.common_contacts);
  c.overlap = all > 0 ? common / static_cast<double>(all) : 1.0;
  c.overlap_a = c.contacts_a > 0 ? common / static_cast<double>(c.contacts_a) : 1.0;
  return c;
}

}  // namespace jam
