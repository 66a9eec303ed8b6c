#include "linalg/conjugate_gradients.hpp"

#include <algorithm>
#include <cmath>

#include "linalg/dot.hpp"

namespace jam::inside {
namespace {

void add(double factor, const std::vector<double> &x, double *y) {
  for (size_t k = 0; k < x.size(); ++k) y[k] += factor * x[k];
}

}  // namespace

void ConjugateGradients::forget(size_t unknowns) {
  count_ = 0;
  for (auto *v : {&residual_, &correction_, &now_.along, &now_.image}) v->resize(unknowns);
}

// The squared error in the norm of K is about r . M^-1 r; the energy of x is its squared size.
bool ConjugateGradients::solve(const double *b, double accuracy, int most, const Product &precondition,
                               const Product &times_k, double *x) {
  const size_t unknowns = residual_.size();
  std::copy(b, b + unknowns, residual_.begin());
  std::fill(x, x + unknowns, 0.0);
  std::fill(now_.along.begin(), now_.along.end(), 0.0);
  double energy = 0.0, product = 1.0;
  const auto go = [&](const Direction &d) {
    const double length = dot(d.along, residual_) / d.energy;
    energy += length * length * d.energy;
    add(length, d.along, x);
    add(-length, d.image, residual_.data());
  };
  for (size_t k = 0; k < count_; ++k) go(kept_[k]);
  for (int step = 0;; ++step) {
    precondition(residual_.data(), correction_.data());
    const double next = dot(residual_, correction_);
    if (!(next >= 0.0) || !std::isfinite(next)) return false;
    if (next <= accuracy * accuracy * (energy + next)) break;
    if (step == most) return false;
    const double keep = step == 0 ? 0.0 : next / product;
    product = next;
    for (size_t u = 0; u < unknowns; ++u) now_.along[u] = correction_[u] + keep * now_.along[u];
    for (size_t k = 0; k < count_; ++k)  // also to those of this solve: rounding makes them lose it
      add(-dot(kept_[k].image, now_.along) / kept_[k].energy, kept_[k].along, now_.along.data());
    times_k(now_.along.data(), now_.image.data());
    now_.energy = dot(now_.along, now_.image);
    go(now_);
    if (count_ >= static_cast<size_t>(most)) continue;
    if (kept_.size() == count_) kept_.emplace_back();
    kept_[count_++] = now_;
  }
  add(1.0, correction_, x);  // the last correction costs nothing
  return true;
}

}  // namespace jam::inside
