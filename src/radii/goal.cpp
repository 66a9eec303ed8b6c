#include "radii/rows.hpp"

#include <algorithm>
#include <cmath>

#include "core/error.hpp"
#include "core/math.hpp"
#include "radii/tuning.hpp"

namespace jam::inside {
namespace {

// x^q; exact to two doubles for whole numbers.
DoubleDouble power_of(double x, double q) {
  if (q != std::floor(q)) return math::pow(x, q);
  DoubleDouble out(1.0);
  for (double k = 0.0; k < std::fabs(q); ++k) out = out * DoubleDouble(x);
  return q < 0.0 ? DoubleDouble(1.0) / out : out;
}

double product(const double *a, const double *b, size_t n) {
  double sum = 0.0;
  for (size_t i = 0; i < n; ++i) sum += a[i] * b[i];
  return sum;
}

}  // namespace

RadiiGoal::RadiiGoal(const std::vector<double> &weight) : weight_(weight) {}

RadiiGoal::RadiiGoal(const Packing &start, std::vector<double> exponents)
    : exponent_(std::move(exponents)), length_(0.5 * diameter_mean(start)) {
  for (const double q : exponent_) start_.push_back(moment(start, q));
  linearise(start);
}

DoubleDouble RadiiGoal::moment(const Packing &p, double exponent) const {
  DoubleDouble sum(0.0);
  for (const double s : p.diameter) sum = sum + power_of(0.5 * s / length_, exponent);
  return sum;
}

// Of a ratio near 0 the difference to 1 has lost the digits.
static double log_of(const DoubleDouble &ratio) {
  const double more = static_cast<double>(ratio - DoubleDouble(1.0));
  return more > -0.5 ? math::log1p(more) : math::log(static_cast<double>(ratio));
}

double RadiiGoal::growth(const Packing &p, size_t q) const {
  return log_of(moment(p, exponent_[q]) / start_[q]) / exponent_[q];
}

// Gradients b_q = R^(q - 1) / P_q; b_q - b_first made orthonormal by Gram and Schmidt, twice.
void RadiiGoal::linearise(const Packing &p) {
  if (!moments()) return;
  const size_t n = p.n(), m = equations();
  std::vector<double> first(n);
  const auto gradient = [&](size_t q, double *out) {
    const double total = static_cast<double>(moment(p, exponent_[q])) * length_;
    for (size_t i = 0; i < n; ++i)
      out[i] = static_cast<double>(power_of(0.5 * p.diameter[i] / length_, exponent_[q] - 1.0)) / total;
  };
  gradient(0, first.data());
  here_ = moment(p, exponent_[0]);
  double sum = 0.0;
  for (const double b : first) sum += b;
  scale_ = static_cast<double>(n) / sum;
  weight_.resize(n);
  for (size_t i = 0; i < n; ++i) weight_[i] = scale_ * first[i];
  column_.resize(m * n), triangle_.assign(m * m, 0.0);
  for (size_t q = 0; q < m; ++q) {
    double *e = &column_[q * n];
    gradient(q + 1, e);
    for (size_t i = 0; i < n; ++i) e[i] -= first[i];
    for (int again = 0; again < 2; ++again)
      for (size_t k = 0; k < q; ++k) {
        const double along = product(e, &column_[k * n], n);
        for (size_t i = 0; i < n; ++i) e[i] -= along * column_[k * n + i];
        triangle_[k * m + q] += along;
      }
    const double rest = std::sqrt(product(e, e, n));
    if (!(rest > RadiiTuning::least_freedom * std::sqrt(product(first.data(), first.data(), n))))
      fail(JAM_E_ARGUMENT,
           "the radii are too alike for %zu moments, which would fix them all: start with radii that differ, at least "
           "%zu values, or give fewer moments",
           exponent_.size(), exponent_.size());
    for (size_t i = 0; i < n; ++i) e[i] /= rest;
    triangle_[q * m + q] = rest;
  }
}

std::vector<double> RadiiGoal::carried(const std::vector<double> &multiplier) const {
  std::vector<double> out = weight_;
  const size_t n = out.size();
  for (size_t q = 0; q < equations(); ++q)
    for (size_t i = 0; i < n; ++i) out[i] -= multiplier[q] * column_[q * n + i];
  return out;
}

// triangle^T out = g.
std::vector<double> RadiiGoal::wrong(const Packing &p) const {
  const size_t m = equations();
  std::vector<double> out(m);
  const double first = m > 0 ? growth(p, 0) : 0.0;
  for (size_t q = 0; q < m; ++q) {
    out[q] = growth(p, q + 1) - first;
    for (size_t k = 0; k < q; ++k) out[q] -= triangle_[k * m + q] * out[k];
    out[q] /= triangle_[q * m + q];
  }
  return out;
}

double RadiiGoal::gain(const std::vector<double> &step, double part, const Packing &to) const {
  const size_t n = weight_.size(), b = static_cast<size_t>(to.dim) + 1;
  double gain = 0.0;
  if (!moments()) {
    for (size_t i = 0; i < n; ++i) gain += weight_[i] * step[i * b + b - 1];
    return part * gain;
  }
  return scale_ * log_of(moment(to, exponent_[0]) / here_) / exponent_[0];
}

// Of the moments themselves; they add up to L.
std::vector<double> RadiiGoal::of_moments(const std::vector<double> &multiplier) const {
  const size_t m = equations();
  std::vector<double> y = multiplier, out(m + 1, scale_);
  for (size_t q = m; q-- > 0;) {
    for (size_t k = q + 1; k < m; ++k) y[q] -= triangle_[q * m + k] * y[k];
    y[q] /= triangle_[q * m + q];
  }
  for (size_t q = 0; q < m; ++q) out[0] += y[q], out[q + 1] = -y[q];
  return out;
}

double RadiiGoal::curvature(const Packing &p, const std::vector<double> &multiplier,
                            const std::vector<double> &x) const {
  if (!moments()) return 0.0;
  const std::vector<double> of = of_moments(multiplier);
  const size_t n = p.n(), b = static_cast<size_t>(p.dim) + 1;
  double out = 0.0;
  for (size_t q = 0; q < of.size(); ++q) {
    const double e = exponent_[q], total = static_cast<double>(moment(p, e));
    double first = 0.0, second = 0.0;
    for (size_t i = 0; i < n; ++i) {
      const double radius = 0.5 * p.diameter[i] / length_, t = x[i * b + b - 1] / length_;
      const double slope = static_cast<double>(power_of(radius, e - 1.0)) * t;
      first += slope, second += (e - 1.0) * slope * t / radius;
    }
    out += of[q] * (second / total - e * (first / total) * (first / total));
  }
  return out;
}

// What is left of it where the equations are kept and lambda stays.
std::vector<double> RadiiGoal::stiffness(const Packing &p, const std::vector<double> &multiplier) const {
  if (equations() == 0) return {};
  const std::vector<double> of = of_moments(multiplier);
  std::vector<double> out(p.n(), 0.0);
  for (size_t q = 0; q < of.size(); ++q) {
    const double e = exponent_[q];
    const double factor = of[q] * (e - 1.0) / (static_cast<double>(moment(p, e)) * length_ * length_);
    for (size_t i = 0; i < out.size(); ++i)
      out[i] -= factor * static_cast<double>(power_of(0.5 * p.diameter[i] / length_, e - 2.0));
  }
  for (double &v : out) v = std::max(v, 0.0);
  return out;
}

double RadiiGoal::lambda(const Packing &p) const { return math::exp(growth(p, 0)); }

double RadiiGoal::residual(const Packing &p) const {
  if (!moments()) return 0.0;
  const double first = growth(p, 0);
  double most = 0.0;
  for (size_t q = 1; q < exponent_.size(); ++q)
    most = std::max(most, std::fabs(math::expm1(exponent_[q] * (growth(p, q) - first))));
  return most;
}

std::vector<double> RadiiGoal::multipliers(const Packing &p, const std::vector<double> &of_columns) const {
  std::vector<double> out = of_moments(of_columns);
  for (size_t q = 0; q < out.size(); ++q)
    out[q] *= lambda(p) /
              (scale_ * exponent_[q] * static_cast<double>(moment(p, exponent_[q])) * math::pow(length_, exponent_[q]));
  return out;
}

}  // namespace jam::inside
