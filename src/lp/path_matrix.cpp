#include "lp/path_matrix.hpp"

#include <algorithm>
#include <cmath>

#include "lp/working_set.hpp"

namespace jam::inside {
void PathMatrix::reset(size_t rows, size_t unknowns) {
  coupled_.clear(), ordered_rows_ = 0;
  weight_.resize(rows);
  diagonal_.resize(unknowns);
}

// Rows couple spheres up to far_slack times the slack of the carrying rows. They are chosen again for a new list, when
// a screened row came near, and when many could go.
void PathMatrix::choose_coupled(const Packing &p, const BarrierProblem &b) {
  const std::vector<double> &c = b.lp.c;
  using T = WorkingSetTuning;
  const double slack = T::far_slack * carrying_slack(c, p.dim, static_cast<int32_t>(p.n()));
  std::vector<char> coupled(c.size(), 0);
  for (const size_t k : coupled_) coupled[k] = 1;
  size_t wanted = 0, missing = 0;
  for (size_t k = 0; k < c.size(); ++k)
    wanted += c[k] <= slack, missing += !coupled[k] && c[k] <= T::close_screened * slack;
  if (!coupled_.empty() && missing == 0 &&
      static_cast<double>(wanted) > T::still_wanted * static_cast<double>(coupled_.size()))
    return;
  coupled_.clear();
  pairs_ = PairList();
  for (size_t k = 0; k < c.size(); ++k) {
    if (!(c[k] <= slack)) continue;
    coupled_.push_back(k);
    pairs_.i.push_back(b.pairs.i[k]), pairs_.j.push_back(b.pairs.j[k]);
  }
  a_.resize(coupled_.size() * p.dim), coupled_weight_.resize(coupled_.size());
  strain_.resize(coupled_.size() * static_cast<size_t>(b.lp.strains));
  // Near the end some rows come and go: an elimination order is still good then. In the plane, where separators are
  // small, a new one would cost more than the factorisation.
  const double rows = static_cast<double>(coupled_.size()), change = rows - static_cast<double>(ordered_rows_);
  const bool alike = p.dim == 2 && std::fabs(change) <= T::same_order * rows;
  if (!alike) ordered_rows_ = coupled_.size();
  system_.set_graph(p.dim, static_cast<int32_t>(p.n()), pairs_, threads_, alike);
}

void PathMatrix::weigh(const Packing &p, const BarrierProblem &b, double proximal) {
  choose_coupled(p, b);
  const int d = p.dim;
  const size_t strains = static_cast<size_t>(b.lp.strains), spheres = b.lp.spheres();
  std::fill(diagonal_.begin(), diagonal_.end(), proximal);
  size_t q = 0;
  for (size_t k = 0; k < b.y.size(); ++k) {
    const double *a = &b.lp.a[k * d];
    weight_[k] = b.y[k] / b.lp.c[k];
    if (q < coupled_.size() && coupled_[q] == k) {
      coupled_weight_[q] = weight_[k];
      std::copy_n(b.lp.strain.begin() + k * strains, strains, strain_.begin() + q * strains);
      std::copy(a, a + d, &a_[q++ * d]);
      continue;
    }
    double a1 = 0.0;
    for (int c = 0; c < d; ++c) a1 += std::fabs(a[c]);
    for (int c = 0; c < d; ++c)  // at least a a^T by Gershgorin's circles
      for_spheres(b.pairs.i[k], b.pairs.j[k],
                  [&](int32_t v) { diagonal_[static_cast<size_t>(v) * d + c] += weight_[k] * std::fabs(a[c]) * a1; });
    double b1 = 0.0;
    for (size_t e = 0; e < strains; ++e) b1 += std::fabs(b.lp.strain[k * strains + e]);
    for (size_t e = 0; e < strains; ++e)
      diagonal_[spheres + e] += weight_[k] * std::fabs(b.lp.strain[k * strains + e]) * b1;
  }
  b.add_wall_bending(diagonal_);
  if (strains > 0) system_.set_strain(strain_.data(), b.lp.strains);
}

bool PathMatrix::factorise(double gap) {
  return factor_.factorise(a_.data(), coupled_weight_.data(), diagonal_.data(), gap, 0.0);
}

bool PathMatrix::solve(const double *rhs, double h, double *ds, double *dg) { return factor_.solve(rhs, h, ds, dg, 1); }

}  // namespace jam::inside
