// Elastic moduli with the non-affine part, and comparing two packings.
#include <algorithm>
#include <cmath>
#include <map>
#include "analysis/spectrum.hpp"
#include "core/error.hpp"

namespace jam {
namespace {

// Energy of the strained network over its volume for contact elongations e: without and with the spheres relaxing.
// The relaxed energy is summed over what is left of each elongation, so nothing cancels.
void relax(const StableGraph &g, const ContactWeights &w, const PinnedSolver &solver, const std::vector<double> &e, double &affine, double &relaxed) {
  std::vector<double> t(g.contacts()), u(g.unknowns()), s(g.contacts());
  for (size_t k = 0; k < t.size(); ++k) t[k] = w.stiffness[k] * e[k];
  balance(g, t.data(), u.data());
  solver.solve(u.data(), 1);
  stretch(g, u.data(), s.data());
  affine = relaxed = 0.0;
  for (size_t k = 0; k < t.size(); ++k) {
    affine += w.stiffness[k] * e[k] * e[k];
    relaxed += w.stiffness[k] * (e[k] - s[k]) * (e[k] - s[k]);
  }
}

}  // namespace

jam_moduli elastic_moduli(const Packing &p, const StableGraph &g, const ContactWeights &w) {
  jam_moduli m{};
  const int d = p.dim;
  const double volume = std::pow(p.box, d);
  const PinnedSolver solver(g, w);
  std::vector<double> e(g.contacts());
  double affine = 0.0, relaxed = 0.0;
  for (size_t k = 0; k < e.size(); ++k) e[k] = g.distance[k] / d;  // isotropic strain of volume strain 1
  relax(g, w, solver, e, affine, relaxed);
  m.bulk_affine = affine / volume;
  m.bulk = relaxed / volume;
  const int planes = d * (d - 1) / 2;
  m.shear_min = std::numeric_limits<double>::infinity();
  for (int a = 0; a < d; ++a)
    for (int b = a + 1; b < d; ++b) {
      for (size_t k = 0; k < e.size(); ++k) e[k] = g.distance[k] * g.normal[k * d + a] * g.normal[k * d + b];
      relax(g, w, solver, e, affine, relaxed);
      m.shear_affine += affine / volume / planes;
      m.shear += relaxed / volume / planes;
      m.shear_min = std::min(m.shear_min, relaxed / volume);
      m.shear_max = std::max(m.shear_max, relaxed / volume);
    }
  return m;
}

jam_comparison compare_packings(const Packing &a, const ContactNetwork *na, const Packing &b, const ContactNetwork *nb,
                                std::vector<double> &displacement) {
  if (a.dim != b.dim || a.n() != b.n())
    fail(JAM_E_ARGUMENT, "the packings differ: d = %d and %d, n = %zu and %zu", a.dim, b.dim, a.n(), b.n());
  if (std::fabs(a.box / b.box - 1.0) > 1e-12) fail(JAM_E_ARGUMENT, "the boxes differ: %.17g and %.17g", a.box, b.box);
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
    for (size_t i = 0; i < n; ++i)
      for (size_t x = 0; x < d; ++x) {
        double u = b.position[i * d + x] - a.position[i * d + x] - shift[x];
        u -= a.box * std::nearbyint(u / a.box);
        displacement[i * d + x] = u;
        if (stable[i]) mean[x] += u / weight;
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
  c.overlap = all > 0 ? static_cast<double>(c.common_contacts) / static_cast<double>(all) : 1.0;
  return c;
}

}  // namespace jam
