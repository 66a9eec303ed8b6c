#include "proof/newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "core/call_scope.hpp"
#include "core/rng.hpp"
#include "linalg/dot.hpp"
#include "proof/expansion.hpp"
#include "proof/tuning.hpp"

namespace jam::inside {

NormalMatrix::NormalMatrix(const ProofScene &s, const ProofEquations &e) : scene_(s), equations_(e) {
  const size_t d = static_cast<size_t>(s.dim), dd = d * d;
  m_.dim = s.dim, m_.nodes = static_cast<int32_t>(s.ends());
  m_.diag.assign(s.ends() * dd, 0.0);
  std::map<std::pair<size_t, size_t>, std::vector<double>> off;
  const auto add = [&](double *block, size_t p, size_t q, const double *r, double weight) {
    for (size_t k = 0; k < d; ++k)
      for (size_t m = 0; m < d; ++m)
        if (s.moves(p, static_cast<int>(k)) && s.moves(q, static_cast<int>(m)))
          block[k * d + m] += weight * (r[k] * r[m]);
  };
  for (size_t c = 0; c < s.contacts(); ++c) {
    const double *r = &e.row[c * d];
    s.each_end(c, [&](size_t p, double wp) {
      s.each_end(c, [&](size_t q, double wq) {
        if (p == q) add(&m_.diag[p * dd], p, p, r, wp * wp);
        if (s.pinned(p) || p >= q) return;
        std::vector<double> &block = off[{p, q}];
        block.resize(dd, 0.0);
        add(block.data(), p, q, r, wp * wq);
      });
    });
  }
  double trace = 0.0;
  for (size_t i = 0; i < s.unknowns(); ++i) trace += m_.diag[i * d + i % d];
  for (size_t i = 0; i < s.unknowns(); ++i)
    if (!s.moves(i / d, static_cast<int>(i % d))) m_.diag[i * d + i % d] = trace / static_cast<double>(s.unknowns());
  for (auto &[pair, block] : off) {
    m_.ei.push_back(static_cast<int32_t>(pair.first)), m_.ej.push_back(static_cast<int32_t>(pair.second));
    m_.off.insert(m_.off.end(), block.begin(), block.end());
  }
}

void NormalMatrix::pin(std::vector<double> &v) const {
  for (size_t i = 0; i < v.size(); ++i)
    if (!scene_.moves(i / scene_.dim, static_cast<int>(i % scene_.dim))) v[i] = 0.0;
}

bool NormalMatrix::factorise() {
  factor_ = std::make_unique<ShiftedFactor>(m_);
  return factor_->factorise(0.0);
}

// nearest() and project_on_balance() end where the residual no longer halves: the last solve was rounding alone.
std::vector<double> NormalMatrix::nearest(const std::vector<double> &y) const {
  std::vector<double> v(scene_.unknowns(), 0.0), step(v.size()), left(y), image(y.size());
  for (double last = std::numeric_limits<double>::infinity();;) {
    CallScope::look();
    multiply_columns(scene_, equations_, left.data(), step.data());
    const double now = norm(step);
    if (!(now < 0.5 * last)) break;
    last = now;
    factor_->solve(step.data());
    for (size_t k = 0; k < v.size(); ++k) v[k] += step[k];
    multiply_rows(scene_, equations_, v.data(), image.data());
    for (size_t c = 0; c < y.size(); ++c) left[c] = y[c] - image[c];
  }
  pin(v);
  return v;
}

void NormalMatrix::project_on_balance(std::vector<double> &f) const {
  std::vector<double> step(scene_.unknowns()), image(f.size());
  const std::vector<double> target = balance_target(scene_);
  for (double last = std::numeric_limits<double>::infinity();;) {
    multiply_columns(scene_, equations_, f.data(), step.data());
    for (size_t k = 0; k < step.size(); ++k) step[k] -= target[k];
    const double now = norm(step);
    if (!(now < 0.5 * last)) break;
    last = now;
    factor_->solve(step.data());
    multiply_rows(scene_, equations_, step.data(), image.data());
    for (size_t c = 0; c < f.size(); ++c) f[c] -= image[c];
  }
}

// Inverse iteration from a start without a special direction. An estimate alone: nothing proved rests on it.
double NormalMatrix::smallest_eigenvalue() const {
  std::vector<double> v(scene_.unknowns(), 0.0), y(scene_.contacts());
  Rng random(7, Stream::analysis_start);
  for (size_t k = scene_.pinned(0) ? scene_.dim : 0; k < v.size(); ++k) v[k] = random.uniform() - 0.5;
  double value = 0.0;
  for (int pass = 0; pass < proof_tuning::most_rounds; ++pass) {
    CallScope::look();
    factor_->solve(v.data());
    pin(v);
    const double length = dot(v, v);
    if (!(length > 0.0)) return 0.0;
    for (double &x : v) x /= std::sqrt(length);
    multiply_rows(scene_, equations_, v.data(), y.data());
    value = dot(y, y);
  }
  return value;
}

// |R'^T R' - M| in the 2-norm, R' the rounded rows: each entry is a sum of at most z products of three, so it is
// gamma_(z + 4) |R'|^T |R'| (its 2-norm is at most the product of the largest row and column sum).
double NormalMatrix::forming_error() const {
  const size_t d = static_cast<size_t>(scene_.dim);
  std::vector<double> column(scene_.unknowns());
  std::vector<int32_t> z(scene_.ends(), 0);
  double largest_row = 0.0;
  multiply_columns(scene_, equations_, std::vector<double>(scene_.contacts(), 1.0).data(), column.data(), true);
  for (size_t c = 0; c < scene_.contacts(); ++c) {
    std::vector<double> part;
    scene_.each_end(c, [&](size_t node, double weight) {
      for (size_t k = 0; k < d; ++k) part.push_back(std::fabs(weight * equations_.row[c * d + k]));
      ++z[node];
    });
    largest_row = std::max(largest_row, mul_up(sum_up(part), 1.0 + 2.0 * half_ulp));
  }
  const double most = *std::max_element(z.begin(), z.end());
  const double largest_column =
      mul_up(*std::max_element(column.begin(), column.end()), add_up(1.0, gamma_of(most + 3.0)));
  return mul_up(gamma_of(most + 4.0), mul_up(largest_row, largest_column));
}

NormalMatrix::Bound NormalMatrix::bound() {
  Bound out;
  out.eigenvalue = smallest_eigenvalue();
  const double rows = norm_up(equations_.row);
  for (const double part : proof_tuning::parts_of_eigenvalue) {
    const double mu = part * out.eigenvalue;
    ShiftedFactor shifted(m_);
    if (!(mu > 0.0) || !shifted.factorise(-mu)) continue;
    const ShiftedFactor::Size size = shifted.size();
    // The factor's matrix has M's diagonal less mu, rounded.
    double diagonal = 0.0;
    for (size_t i = 0; i < scene_.unknowns(); ++i)
      diagonal = std::max(diagonal, m_.diag[i * scene_.dim + i % scene_.dim]);
    out.rounding = add_up(add_up(mul_up(gamma_of(static_cast<double>(size.longest_row) + 4.0), size.absolute_square),
                                 mul_up(2.0 * half_ulp, diagonal)),
                          forming_error());
    const double left = sub_down(mu, out.rounding);
    if (!(left > 0.0)) continue;
    // R differs from its rounded rows by half_ulp in each entry; a row is at each of its ends.
    const double all = mul_up(rows, sqrt_up(largest_weight(scene_)));
    out.singular = std::max(0.0, sub_down(sqrt_down(left), mul_up(2.0 * half_ulp, mul_up(2.0, all))));
    if (out.singular > 0.0) return out;
  }
  out.singular = 0.0;
  return out;
}

}  // namespace jam::inside
