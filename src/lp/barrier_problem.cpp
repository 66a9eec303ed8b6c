#include "lp/barrier_problem.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/math.hpp"
#include "core/pair_rule.hpp"
#include "linalg/dot.hpp"
#include "lp/interior_point.hpp"
#include "lp/tuning.hpp"

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
    const double s2 = squared(&x.s[k], lp.dim);
    if (!(s2 <= largest)) largest = s2;  // lets a NaN through
  }
  return std::sqrt(largest);
}

std::vector<double> BarrierProblem::strain_of(const BarrierStep &x, double alpha) const {
  if (lp.strains == 0) return {};
  return strain_matrix(strain, {x.s.end() - lp.strains, x.s.end()}, alpha);
}

double BarrierProblem::strain_norm(const BarrierStep &x) const { return norm(strain_of(x, 1.0)); }

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

// Golden sections: (sqrt(5) - 1) / 2. The whole Newton step if that is about as good.
BarrierProblem::Best BarrierProblem::search(const BarrierStep &x) {
  bend(x);
  const double most = T::of_feasible * max_feasible_alpha(x), part = 0.6180339887498949;
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

void PathMatrix::reset(size_t rows, size_t unknowns) {
  coupled_.clear(), ordered_rows_ = 0;
  weight_.resize(rows);
  diagonal_.resize(unknowns);
}

// Rows couple spheres up to far_slack times the slack of the carrying rows. They are chosen again for a new list, and
// when a screened row came near.
void PathMatrix::choose_coupled(const Packing &p, const BarrierProblem &b) {
  const std::vector<double> &c = b.lp.c;
  using T = WorkingSetTuning;
  const double slack = T::far_slack * carrying_slack(c, p.dim, static_cast<int32_t>(p.n()));
  std::vector<char> coupled(c.size(), 0);
  for (const size_t k : coupled_) coupled[k] = 1;
  bool near = coupled_.empty();
  for (size_t k = 0; k < c.size(); ++k) near = near || (!coupled[k] && c[k] <= T::joins_too * slack);
  if (!near) return;
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
