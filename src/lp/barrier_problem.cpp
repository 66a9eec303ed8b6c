#include "lp/barrier_problem.hpp"
#include "core/math.hpp"
#include "core/pair_rule.hpp"
#include "lp/tuning.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace jam::inside {
using T = LineSearchTuning;

bool BarrierProblem::linearise(const Packing &p) {
  lp = make_lp(p, pairs, unit, strain);
  sigma2_.resize(lp.rows());
  vector_.resize(lp.strains > 0 ? lp.rows() * static_cast<size_t>(p.dim) : 0);
  for (size_t k = 0; k < lp.rows(); ++k) {
    if (lp.strains > 0) {
      double *r = &vector_[k * p.dim];
      pair_vector(p, pairs, k, r);
      for (int c = 0; c < p.dim; ++c) r[c] /= unit;
    }
    const double sigma = contact_distance(p, pairs.i[k], pairs.j[k]) / unit;
    sigma2_[k] = sigma * sigma;
    if (!(lp.c[k] > 0.0)) return false;
  }
  if (p.container.curved() != 0) list_curved_walls(p);
  return true;
}

void BarrierProblem::list_curved_walls(const Packing &p) {
  container_ = p.container;
  curved_.clear(), curved_of_.assign(lp.rows(), -1);
  for (size_t k = 0; k < lp.rows(); ++k) {
    if (!pairs.wall(k) || !container_[wall_partner(pairs.j[k])].curved()) continue;
    const int w = wall_partner(pairs.j[k]);
    const Surface &wall = container_[w];
    CurvedRow row{k, w, {}, contact_distance(p, pairs.i[k], pairs.j[k]), 0.0, 0.0};
    std::copy_n(&p.position[static_cast<size_t>(pairs.i[k]) * p.dim], p.dim, row.x.begin());
    row.distance = wall.distance(row.x.data());
    const double a = 2.0 * unit * row.distance / (row.radius * row.radius);
    row.bending = a * unit * std::min(wall.curvature(row.x.data()), 1.0 / row.radius);  // a cone at the centre
    curved_of_[k] = static_cast<int32_t>(curved_.size());
    curved_.push_back(row);
  }
}

void BarrierProblem::add_wall_bending(std::vector<double> &diagonal) const {
  for (const CurvedRow &row : curved_)
    for (int c = 0; c < lp.dim; ++c)
      if (container_[row.w].turning().along(c))
        diagonal[static_cast<size_t>(pairs.i[row.k]) * lp.dim + c] += y[row.k] * row.bending;
}

double BarrierProblem::curved_gap(const BarrierStep &x, size_t k, double alpha) const {
  const CurvedRow &row = curved_[curved_of_[k]];
  std::array<double, JAM_MAX_DIM> to = row.x;
  for (int c = 0; c < lp.dim; ++c) to[c] += alpha * unit * x.s[static_cast<size_t>(pairs.i[k]) * lp.dim + c];
  const double distance = container_[row.w].distance(to.data());
  if (!(distance > 0.0)) return -1.0;
  return (distance - row.radius) * (distance + row.radius) / (row.radius * row.radius) - alpha * x.g;
}

// sqrt(1 + alpha g) <= 1 + alpha g / 2: the sphere meets the wall no earlier than with this growth of its radius.
double BarrierProblem::time_to_curved_wall(const BarrierStep &x, const CurvedRow &row) const {
  std::array<double, JAM_MAX_DIM> v{};
  for (int c = 0; c < lp.dim; ++c) v[c] = unit * x.s[static_cast<size_t>(pairs.i[row.k]) * lp.dim + c];
  return container_[row.w].approach(row.x.data(), v.data(), row.radius, 0.5 * row.radius * x.g, row.distance).time();
}

double BarrierProblem::duality_gap() const {
  double sum = 0.0;
  for (size_t k = 0; k < y.size(); ++k) sum += y[k] * lp.c[k];
  return sum;
}

double BarrierProblem::decrement(const BarrierStep &x) const {
  double slope = -x.g / mu;
  for (size_t k = 0; k < y.size(); ++k) slope -= x.w[k] / lp.c[k] - x.g;
  return -slope;
}

double BarrierProblem::longest_move(const BarrierStep &x) const {
  double largest = 1e-300;
  for (size_t k = 0; k < lp.spheres(); k += lp.dim) {
    double s2 = 0.0;
    for (int c = 0; c < lp.dim; ++c) s2 += x.s[k + c] * x.s[k + c];
    if (!(s2 <= largest)) largest = s2;  // lets a NaN through
  }
  return std::sqrt(largest);
}

std::vector<double> BarrierProblem::strain_of(const BarrierStep &x, double alpha) const {
  if (lp.strains == 0) return {};
  return strain_matrix(strain, {x.s.end() - lp.strains, x.s.end()}, alpha);
}

double BarrierProblem::strain_norm(const BarrierStep &x) const {
  double e2 = 0.0;
  for (const double e : strain_of(x, 1.0)) e2 += e * e;
  return std::sqrt(e2);
}

double BarrierProblem::longest_dual(const BarrierStep &x) const {
  double alpha = 1.0;
  for (size_t k = 0; k < y.size(); ++k)
    if (x.y[k] < 0.0) alpha = std::min(alpha, -T::of_feasible * y[k] / x.y[k]);
  return alpha;
}

void BarrierProblem::bend(const BarrierStep &x) {
  const int d = lp.dim;
  bend_.resize(y.size());
  const std::vector<double> e = strain_of(x, 1.0);
  for (size_t k = 0; k < y.size(); ++k) {
    if (pairs.wall(k)) {  // a = 2 n r / sigma^2 in units, r = sigma sqrt(1 + c)
      const double w = x.w[k] + x.g;
      bend_[k] = w * w / (4.0 * (1.0 + lp.c[k]));
      continue;
    }
    const size_t i = static_cast<size_t>(pairs.i[k]) * d, j = static_cast<size_t>(pairs.j[k]) * d;
    double s2 = 0.0;
    for (int c = 0; c < d; ++c) {
      double change = x.s[i + c] - x.s[j + c];
      for (int b = c; b < d && !e.empty(); ++b) change += e[c * d + b] * vector_[k * d + b];
      s2 += change * change;
    }
    bend_[k] = s2 / sigma2_[k];
  }
}

// Longest alpha at which every true gap and Gamma itself are still positive.
double BarrierProblem::max_feasible_alpha(const BarrierStep &x) const {
  double alpha = x.g < 0.0 ? std::min(T::longest, -1.0 / x.g) : T::longest;
  for (size_t k = 0; k < y.size(); ++k) {
    const double c = lp.c[k], b = x.w[k], disc = b * b - 4.0 * bend_[k] * c;
    if (b < 0.0 && disc > 0.0) alpha = std::min(alpha, 2.0 * c / (-b + std::sqrt(disc)));
  }
  for (const CurvedRow &row : curved_) alpha = std::min(alpha, time_to_curved_wall(x, row));
  return alpha;
}

double BarrierProblem::merit(const BarrierStep &x, double alpha) const {
  const double g = alpha * x.g;
  if (!(1.0 + g > 0.0)) return std::numeric_limits<double>::infinity();
  double sum = 0.0, product = 1.0;  // one logarithm for many factors
  for (size_t k = 0; k < y.size(); ++k) {
    const double ratio = gap_after(x, k, alpha) / ((1.0 + g) * lp.c[k]);
    if (!(ratio > 0.0)) return std::numeric_limits<double>::infinity();
    product *= ratio;
    if (!(product > 1e-100 && product < 1e100)) sum += math::log(product), product = 1.0;
  }
  return -math::log(1.0 + g) - mu * (sum + math::log(product));
}

// Golden sections. The whole Newton step if that is about as good.
BarrierProblem::Best BarrierProblem::search(const BarrierStep &x) {
  bend(x);
  const double most = T::of_feasible * max_feasible_alpha(x), part = T::golden;
  double low = 0.0, high = most, a = high - part * (high - low), b = low + part * (high - low);
  double at_a = merit(x, a), at_b = merit(x, b);
  for (int k = 0; k < T::golden_sections; ++k) {
    if (at_a <= at_b) {
      high = b, b = a, at_b = at_a;
      a = high - part * (high - low), at_a = merit(x, a);
    } else {
      low = a, a = b, at_a = at_b;
      b = low + part * (high - low), at_b = merit(x, b);
    }
  }
  Best best = at_a <= at_b ? Best{a, at_a} : Best{b, at_b};
  if (std::fabs(best.alpha - 1.0) < T::nearly_whole && most > 1.0) best = {1.0, merit(x, 1.0)};
  return best;
}

}  // namespace jam::inside
