#include "network/rattlers.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <numeric>

#include "jam/jam.h"

namespace jam {
namespace {

// Distance of the origin from the convex hull of the contact vectors, above which no forces can balance. A smaller
// distance is left to the test of the whole network, so that this rule never takes out a sphere that carries force.
constexpr double clear_distance = 1e-3;

// Non-negative least squares of (N f, sum f) = (0, 1) by the active set of Lawson and Hanson (Solving Least Squares
// Problems, 1974, ch. 23), N with the contact vectors as columns. With the residual (-p, s) every vector has n . p >=
// s, and |p|^2 = s - s^2: the hull lies at the distance sqrt(s / (1 - s)) from the origin, in the direction p.
class HullDistance {
 public:
  explicit HullDistance(int dim) : d_(dim) {}

  double operator()(const std::vector<double> &normal, std::vector<double> &direction) {
    const int z = static_cast<int>(normal.size()) / d_;
    force_.assign(z, 0.0), passive_.clear();
    Column residual = target();
    for (int pass = 0; pass < 3 * z + 10; ++pass) {
      int best = -1;
      double slope = 1e-12;
      for (int k = 0; k < z; ++k) {
        if (force_[k] > 0.0) continue;
        const double now = column(normal, k).dot(residual);
        if (now > slope) slope = now, best = k;
      }
      if (best < 0 || static_cast<int>(passive_.size()) > d_) break;
      passive_.push_back(best);
      if (!settle(normal)) break;
      residual = target();
      for (const int k : passive_) residual -= force_[k] * column(normal, k);
    }
    const double s = residual[d_];
    direction.assign(d_, 0.0);
    double length = 0.0;
    for (int c = 0; c < d_; ++c) length += residual[c] * residual[c];
    if (!(length > 0.0) || !(s > 0.0)) return 0.0;
    for (int c = 0; c < d_; ++c) direction[c] = -residual[c] / std::sqrt(length);
    return s < 1.0 ? std::sqrt(s / (1.0 - s)) : 1.0;
  }

 private:
  using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, JAM_MAX_DIM + 1, 1>;
  using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, JAM_MAX_DIM + 1, JAM_MAX_DIM + 1>;

  Column target() const {
    Column t = Column::Zero(d_ + 1);
    t[d_] = 1.0;
    return t;
  }
  Column column(const std::vector<double> &normal, int k) const {
    Column a(d_ + 1);
    for (int c = 0; c < d_; ++c) a[c] = normal[static_cast<size_t>(k) * d_ + c];
    a[d_] = 1.0;
    return a;
  }
  // Least squares on the passive set; columns that turn negative leave it. False when the set no longer changes.
  bool settle(const std::vector<double> &normal) {
    const int added = passive_.back();
    while (!passive_.empty()) {
      Small a(d_ + 1, passive_.size());
      for (size_t q = 0; q < passive_.size(); ++q) a.col(q) = column(normal, passive_[q]);
      const Column x = a.colPivHouseholderQr().solve(target());
      double step = 1.0;
      for (size_t q = 0; q < passive_.size(); ++q)
        if (!(x[q] > 0.0)) step = std::min(step, force_[passive_[q]] / (force_[passive_[q]] - x[q]));
      bool cut = false;
      std::vector<int> kept;
      for (size_t q = 0; q < passive_.size(); ++q) {
        double &f = force_[passive_[q]];
        f = step < 1.0 || !(x[q] > 0.0) ? f + step * (x[q] - f) : x[q];
        if (f > 1e-14)
          kept.push_back(passive_[q]);
        else
          f = 0.0, cut = true;
      }
      passive_ = kept;
      if (!cut) return true;
    }
    return force_[added] > 0.0;
  }

  int d_;
  std::vector<double> force_;
  std::vector<int> passive_;
};

}  // namespace

std::vector<Release> release_unbalanced(int d, size_t n, const std::vector<int32_t> &i, const std::vector<int32_t> &j,
                                        const std::vector<double> &normal, std::vector<char> &on) {
  std::vector<Release> out;
  std::vector<std::vector<size_t>> of(n);
  for (size_t k = 0; k < on.size(); ++k)
    if (on[k] && i[k] != j[k]) of[i[k]].push_back(k), of[j[k]].push_back(k);
  std::vector<char> queued(n, 1);
  std::vector<size_t> queue(n);
  std::iota(queue.begin(), queue.end(), size_t{0});
  HullDistance distance(d);
  std::vector<double> vectors, direction;
  while (!queue.empty()) {
    const size_t s = queue.back();
    queue.pop_back();
    queued[s] = 0;
    std::vector<size_t> live;
    vectors.clear();
    for (const size_t k : of[s]) {
      if (!on[k]) continue;
      live.push_back(k);
      const double sign = static_cast<size_t>(i[k]) == s ? 1.0 : -1.0;
      for (int c = 0; c < d; ++c) vectors.push_back(sign * normal[k * d + c]);
    }
    if (live.empty() || !(distance(vectors, direction) > clear_distance)) continue;
    for (const size_t k : live) {
      on[k] = 0;
      const size_t other = static_cast<size_t>(i[k]) == s ? j[k] : i[k];
      if (!queued[other]) queued[other] = 1, queue.push_back(other);
    }
    out.push_back({static_cast<int32_t>(s), std::move(live), direction});
  }
  return out;
}

void drop_unbalanced(int dim, size_t n, const std::vector<int32_t> &i, const std::vector<int32_t> &j,
                     const std::vector<double> &normal, std::vector<char> &on) {
  release_unbalanced(dim, n, i, j, normal, on);
}

void drop_loose(int dim, size_t n, const std::vector<int32_t> &i, const std::vector<int32_t> &j,
                std::vector<char> &on) {
  std::vector<int32_t> z;
  for (bool again = true; again;) {
    again = false;
    z.assign(n, 0);
    for (size_t k = 0; k < on.size(); ++k)
      if (on[k]) ++z[i[k]], ++z[j[k]];
    for (size_t k = 0; k < on.size(); ++k)
      if (on[k] && std::min(z[i[k]], z[j[k]]) <= dim) on[k] = 0, again = true;
  }
}

}  // namespace jam
