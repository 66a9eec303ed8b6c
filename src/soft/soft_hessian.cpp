#include "soft/soft_hessian.hpp"

#include <algorithm>

namespace jam {
namespace {

// Of a rattler to its place, in units of the mean stiffness: what touches it can push it away.
constexpr double rattler_spring = 1e-3;

}  // namespace

// Block of a contact: k n n^T - (f / r) (1 - n n^T), plus on both diagonal blocks, minus off them.
void SoftHessian::assemble(const SoftState &state, const SoftContacts &contacts, const std::vector<char> &on) {
  const int d = state.dim(), dd = d * d;
  ei_.clear(), ej_.clear(), off_.clear();
  diag_.assign(state.n() * static_cast<size_t>(dd), 0.0);
  std::vector<char> stable(state.n(), 0);
  double sum = 0.0;
  int64_t count = 0;
  for (size_t q = 0; q < contacts.size(); ++q) {
    const int32_t i = state.pairs().i[contacts.pair[q]], j = state.pairs().j[contacts.pair[q]];
    if (i == j) continue;  // an image of itself moves with the sphere
    if (on[q]) stable[i] = stable[j] = 1;
    if (ei_.empty() || ei_.back() != i || ej_.back() != j) {  // images of one pair stand one after the other
      ei_.push_back(i), ej_.push_back(j);
      off_.resize(off_.size() + dd, 0.0);
    }
    const double k = state.energy().stiffness(contacts.overlap[q], contacts.force[q]),
                 t = contacts.force[q] / contacts.distance[q];
    const double *n = &contacts.normal[q * d];
    double *off = &off_[off_.size() - dd], *di = &diag_[static_cast<size_t>(i) * dd],
           *dj = &diag_[static_cast<size_t>(j) * dd];
    for (int r = 0; r < d; ++r)
      for (int c = 0; c < d; ++c) {
        const double x = (k + t) * n[r] * n[c] - (r == c ? t : 0.0);
        off[r * d + c] -= x;
        di[r * d + c] += x;
        dj[r * d + c] += x;
      }
    sum += k;
    ++count;
  }
  unit_ = count > 0 ? sum / static_cast<double>(count) : 1.0;
  bool tied = false;
  for (size_t i = 0; i < state.n(); ++i) {
    const double spring = !stable[i] ? rattler_spring : tied ? 0.0 : 1.0;
    tied = tied || stable[i];
    for (int c = 0; c < d; ++c) diag_[i * dd + c * d + c] += spring * unit_;
  }
}

bool SoftHessian::has_contacts(const SoftState &state, const SoftContacts &contacts) const {
  size_t at = 0;
  for (size_t q = 0; q < contacts.size(); ++q) {
    const int32_t i = state.pairs().i[contacts.pair[q]], j = state.pairs().j[contacts.pair[q]];
    if (i == j) continue;
    if (at > 0 && ei_[at - 1] == i && ej_[at - 1] == j) continue;
    if (at == ei_.size() || ei_[at] != i || ej_[at] != j) return false;
    ++at;
  }
  return at == ei_.size();
}

bool SoftHessian::factorise(const SoftState &state, const SoftContacts &contacts, const std::vector<char> &on,
                            double shift, int64_t &factorisations) {
  assemble(state, contacts, on);
  if (ei_ != analysed_i_ || ej_ != analysed_j_) {
    // A few contacts more or less leave the elimination order good.
    if (analysed_i_.empty())
      cholesky_.analyse(state.dim(), static_cast<int32_t>(state.n()), ei_.data(), ej_.data(), ei_.size());
    else
      cholesky_.analyse_keep_order(state.dim(), static_cast<int32_t>(state.n()), ei_.data(), ej_.data(), ei_.size());
    analysed_i_ = ei_, analysed_j_ = ej_;
    cholesky_.set_pivot_rule(1e-14, 0.0);
  }
  const int d = state.dim();
  std::vector<double> shifted;
  for (double s = shift; s<100.0; s = s> 0.0 ? 10.0 * s : 1e-6) {
    shifted = diag_;
    for (size_t i = 0; i < state.n(); ++i)
      for (int c = 0; c < d; ++c) shifted[i * d * d + c * d + c] += s * unit_;
    ++factorisations;
    if (cholesky_.factorise(shifted.data(), off_.data()) == 0) {
      shift_ = s;
      return true;
    }
  }
  return false;
}

}  // namespace jam
