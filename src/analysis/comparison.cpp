#include <algorithm>
#include <cmath>
#include <limits>

#include "analysis/structure.hpp"
#include "core/error.hpp"
#include "linalg/dot.hpp"

namespace jam::inside {
namespace {

// Components of cell vectors, over the side of the cell.
constexpr double same_cell = 1e-12;
// Ratios of diameters: each step of growth rounds once.
constexpr double same_ratio = 1e-9;

bool same_shifts(const Packing &a, const Packing &b) {
  const auto same = [](const MkRedrawn &x, const MkRedrawn &y) {
    return x.i == y.i && x.j == y.j && x.attempt == y.attempt;
  };
  return a.mk_zeta == 0.0 || (a.seed == b.seed && std::equal(a.mk_redrawn.begin(), a.mk_redrawn.end(),
                                                             b.mk_redrawn.begin(), b.mk_redrawn.end(), same));
}

void check_models(const Packing &a, const Packing &b) {
  if (a.model != b.model)
    fail(JAM_E_ARGUMENT, "the models differ: %s of Mari and Kurchan",
         a.model == JAM_MODEL_MK ? "sys alone is" : "other alone is");
  if (a.non_additivity != b.non_additivity)
    fail(JAM_E_ARGUMENT, "the models differ: non_additivity is %.17g and %.17g", a.non_additivity, b.non_additivity);
  if (a.model != JAM_MODEL_MK) return;
  if (a.mk_zeta != b.mk_zeta)
    fail(JAM_E_ARGUMENT, "the models differ: mk_zeta is %.17g and %.17g", a.mk_zeta, b.mk_zeta);
  if (!same_shifts(a, b))
    fail(JAM_E_ARGUMENT, "the shifts of the Mari-Kurchan pairs differ: they are drawn from seeds %lld and %lld%s",
         static_cast<long long>(a.seed), static_cast<long long>(b.seed),
         a.seed == b.seed ? ", and some again when the starts were planted" : "");
}

void check_comparable(const Packing &a, const Packing &b) {
  if (a.dim != b.dim || a.n() != b.n())
    fail(JAM_E_ARGUMENT, "the packings differ: d = %d and %d, n = %zu and %zu", a.dim, b.dim, a.n(), b.n());
  for (int c = 0; c < a.dim; ++c)
    for (int k = 0; k <= c; ++k)
      if (std::fabs(a.cell.row(c)[k] - b.cell.row(c)[k]) > same_cell * a.cell.side())
        fail(JAM_E_ARGUMENT, "the cells differ: component %d of vector %d is %.17g and %.17g", k, c, a.cell.row(c)[k],
             b.cell.row(c)[k]);
  check_models(a, b);
}

void doubt(std::string &doubts, const std::string &more) { doubts += (doubts.empty() ? "" : "; ") + more; }

// The sphere whose ratio to the mean diameter differs most. A common factor is no difference: growth has one.
void compare_diameters(const Packing &a, const Packing &b, std::string &doubts) {
  const double mean_a = diameter_mean(a), mean_b = diameter_mean(b);
  size_t worst = 0, differ = 0;
  double most = same_ratio;
  for (size_t i = 0; i < a.n(); ++i) {
    const double x = a.diameter[i] / mean_a, y = b.diameter[i] / mean_b, apart = std::fabs(x - y) / std::max(x, y);
    differ += apart > same_ratio;
    if (apart > most) most = apart, worst = i;
  }
  if (differ == 0) return;
  doubt(doubts, sentence("the diameters of %zu of %zu spheres differ by more than a common factor, most for sphere %zu "
                         "with %.9g and %.9g mean diameters: spheres of the same number were compared",
                         differ, a.n(), worst, a.diameter[worst] / mean_a, b.diameter[worst] / mean_b));
}

// All spheres when none is.
std::vector<char> stable_in_both(size_t n, const ContactNetwork *na, const ContactNetwork *nb, Comparison &c) {
  std::vector<char> stable(n, 1);
  for (size_t i = 0; i < n; ++i) stable[i] = (!na || na->coordination[i] > 0) && (!nb || nb->coordination[i] > 0);
  c.numbers.stable_in_both = static_cast<int64_t>(std::count(stable.begin(), stable.end(), 1));
  return c.numbers.stable_in_both > 0 ? stable : std::vector<char>(n, 1);
}

void compare_positions(const Packing &a, const Packing &b, const std::vector<char> &stable, Comparison &c) {
  const size_t n = a.n(), d = static_cast<size_t>(a.dim);
  const auto weight = static_cast<double>(std::count(stable.begin(), stable.end(), 1));
  c.displacement.assign(n * d, 0.0);
  // The mean is taken out of nearest-image displacements; taking it out can change nearest images, hence the passes.
  std::vector<double> shift(d, 0.0);
  for (int pass = 0; pass < 5; ++pass) {
    std::vector<double> mean(d, 0.0);
    for (size_t i = 0; i < n; ++i) {
      double *u = &c.displacement[i * d];
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
    const double u2 = squared(&c.displacement[i * d], a.dim);
    c.numbers.displacement_rms += u2 / weight;
    c.numbers.displacement_max = std::max(c.numbers.displacement_max, std::sqrt(u2) / unit);
  }
  c.numbers.displacement_rms = std::sqrt(c.numbers.displacement_rms) / unit;
}

void compare_contacts(const ContactNetwork *na, const ContactNetwork *nb, Comparison &c) {
  jam_comparison_report &found = c.numbers;
  found.contacts_a = na ? static_cast<int64_t>(na->size()) : -1;
  found.contacts_b = nb ? static_cast<int64_t>(nb->size()) : -1;
  if (!na != !nb)
    doubt(c.doubts, std::string(na ? "other" : "sys") + " has no contact network: contacts were not compared");
  if (!na || !nb) {
    found.common_contacts = -1;
    found.overlap = found.overlap_a = std::numeric_limits<double>::quiet_NaN();
    return;
  }
  found.common_contacts = static_cast<int64_t>(common_contacts(*na, *nb).size());
  const int64_t all = found.contacts_a + found.contacts_b - found.common_contacts;
  const auto common = static_cast<double>(found.common_contacts);
  found.overlap = all > 0 ? common / static_cast<double>(all) : 1.0;
  found.overlap_a = found.contacts_a > 0 ? common / static_cast<double>(found.contacts_a) : 1.0;
}

}  // namespace

Comparison compare_packings(const Packing &a, const ContactNetwork *na, const Packing &b, const ContactNetwork *nb) {
  check_comparable(a, b);
  Comparison c;
  compare_diameters(a, b, c.doubts);
  const std::vector<char> stable = stable_in_both(a.n(), na, nb, c);
  compare_positions(a, b, stable, c);
  compare_contacts(na, nb, c);
  c.numbers.packing_fraction_change = packing_fraction(b) - packing_fraction(a);
  return c;
}

}  // namespace jam::inside
