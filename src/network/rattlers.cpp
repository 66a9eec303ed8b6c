#include "network/rattlers.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <limits>
#include <numeric>

#include "core/pairs.hpp"
#include "jam/jam.h"
#include "network/tuning.hpp"

namespace jam::inside {
namespace {

// The point of the hull of contact vectors nearest to the origin (P. Wolfe, Math. Programming 11, 128 (1976)). It is a
// sum of unit vectors, so its error is a rounding of 1, however near it is.
class NearestPoint {
 public:
  explicit NearestPoint(int dim) : d_(dim) {}

  // The largest s found for which a unit vector `direction` has n . direction >= s for every contact vector n: the
  // distance of the hull from the origin except for rounding. 0 where the origin is inside.
  double distance(const std::vector<double> &normal, std::vector<double> &direction) {
    const int z = static_cast<int>(normal.size()) / d_;
    support_.assign(1, 0), weight_.assign(1, 1.0);
    Column x = point(normal);
    for (int pass = 0; pass < 3 * z + 10 && static_cast<int>(support_.size()) <= d_; ++pass) {
      const int farthest = lowest(normal, x);
      if (!(column(normal, farthest).dot(x) < x.dot(x) * (1.0 - 1e-12))) break;
      if (std::find(support_.begin(), support_.end(), farthest) != support_.end()) break;
      support_.push_back(farthest), weight_.push_back(0.0);
      settle(normal);
      x = point(normal);
    }
    const double length = x.norm();
    direction.assign(d_, 0.0);
    if (!(length > 0.0)) return 0.0;
    x = straight(normal, x / length);
    for (int c = 0; c < d_; ++c) direction[c] = x[c];
    return std::max(0.0, column(normal, lowest(normal, x)).dot(x));
  }

 private:
  using Column = Eigen::Matrix<double, Eigen::Dynamic, 1, 0, JAM_MAX_DIM + 1, 1>;
  using Small = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, JAM_MAX_DIM + 1, JAM_MAX_DIM + 1>;

  Column column(const std::vector<double> &normal, int k) const {
    return Eigen::Map<const Eigen::VectorXd>(&normal[static_cast<size_t>(k) * d_], d_);
  }
  int lowest(const std::vector<double> &normal, const Column &x) const {
    const int z = static_cast<int>(normal.size()) / d_;
    int best = 0;
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < z; ++k) {
      const double now = column(normal, k).dot(x);
      if (now < least) least = now, best = k;
    }
    return best;
  }
  Column point(const std::vector<double> &normal) const {
    Column x = Column::Zero(d_);
    for (size_t q = 0; q < support_.size(); ++q) x += weight_[q] * column(normal, support_[q]);
    return x;
  }
  // Differences of the support, which span its plane.
  Small plane(const std::vector<double> &normal) const {
    Small a(d_, support_.size() - 1);
    for (size_t q = 1; q < support_.size(); ++q)
      a.col(q - 1) = column(normal, support_[q]) - column(normal, support_[0]);
    return a;
  }
  // Weights of the nearest point of that plane, signs free.
  std::vector<double> of_plane(const std::vector<double> &normal) const {
    std::vector<double> y(1, 1.0);
    if (support_.size() == 1) return y;
    const Column t = plane(normal).colPivHouseholderQr().solve(-column(normal, support_[0]));
    for (const double w : t) y.push_back(w), y[0] -= w;
    return y;
  }
  // A direction off the plane by the rounding of a near point is made normal to it.
  Column straight(const std::vector<double> &normal, Column x) const {
    if (support_.size() == 1) return x;
    const Small a = plane(normal);
    const Eigen::ColPivHouseholderQR<Small> qr(a);
    for (int pass = 0; pass < 2 && x.norm() > 0.5; ++pass) {
      x -= a * qr.solve(x);
      x.normalize();
    }
    return x;
  }
  // Weights of the nearest point of the hull of the support; vectors without weight leave it.
  void settle(const std::vector<double> &normal) {
    for (;;) {
      const std::vector<double> y = of_plane(normal);
      double step = 1.0;
      for (size_t q = 0; q < y.size(); ++q)
        if (!(y[q] > 0.0)) step = std::min(step, weight_[q] / (weight_[q] - y[q]));
      std::vector<int> kept;
      std::vector<double> weight;
      for (size_t q = 0; q < y.size(); ++q) {
        const double w = weight_[q] + step * (y[q] - weight_[q]);
        if (w > 1e-15) kept.push_back(support_[q]), weight.push_back(w);
      }
      const bool all = kept.size() == support_.size();
      support_ = kept, weight_ = weight;
      if (all || support_.size() < 2) return;
    }
  }

  int d_;
  std::vector<int> support_;
  std::vector<double> weight_;
};

}  // namespace

std::vector<Release> release_unbalanced(int d, size_t n, const std::vector<int32_t> &i, const std::vector<int32_t> &j,
                                        const std::vector<double> &normal, std::vector<char> &on,
                                        const std::vector<double> &error) {
  std::vector<Release> out;
  std::vector<std::vector<size_t>> of(n);
  for (size_t k = 0; k < on.size(); ++k)
    if (on[k] && i[k] != j[k]) for_spheres(i[k], j[k], [&](int32_t s) { of[s].push_back(k); });
  std::vector<char> queued(n, 1);
  std::vector<size_t> queue(n);
  std::iota(queue.begin(), queue.end(), size_t{0});
  NearestPoint hull(d);
  std::vector<double> vectors, direction;
  while (!queue.empty()) {
    const size_t s = queue.back();
    queue.pop_back();
    queued[s] = 0;
    std::vector<size_t> live;
    vectors.clear();
    double clear = error.empty() ? clear_distance : 0.0;
    for (const size_t k : of[s]) {
      if (!on[k]) continue;
      live.push_back(k);
      if (!error.empty()) clear = std::max(clear, error[k]);
      const double sign = static_cast<size_t>(i[k]) == s ? 1.0 : -1.0;
      for (int c = 0; c < d; ++c) vectors.push_back(sign * normal[k * d + c]);
    }
    if (live.empty() || !(hull.distance(vectors, direction) > clear)) continue;
    for (const size_t k : live) {
      on[k] = 0;
      const int32_t other = static_cast<size_t>(i[k]) == s ? j[k] : i[k];
      if (other >= 0 && !queued[other]) queued[other] = 1, queue.push_back(other);
    }
    out.push_back({static_cast<int32_t>(s), std::move(live), direction});
  }
  return out;
}

void drop_unbalanced(int dim, size_t n, const std::vector<int32_t> &i, const std::vector<int32_t> &j,
                     const std::vector<double> &normal, std::vector<char> &on) {
  release_unbalanced(dim, n, i, j, normal, on);
}

void drop_loose(int dim, size_t n, const Container &walls, const std::vector<int32_t> &i, const std::vector<int32_t> &j,
                std::vector<char> &on) {
  std::vector<int32_t> z;
  for (bool again = true; again;) {
    again = false;
    z.assign(n, 0);
    for (size_t k = 0; k < on.size(); ++k)
      if (on[k]) for_spheres(i[k], j[k], [&](int32_t s) { ++z[s]; });
    for (size_t k = 0; walls.curved() != 0 && k < on.size(); ++k)
      if (on[k] && j[k] < 0) z[i[k]] += walls[wall_partner(j[k])].curved_directions();
    for (size_t k = 0; k < on.size(); ++k)
      if (on[k] && std::min(z[i[k]], z[j[k] < 0 ? i[k] : j[k]]) <= dim) on[k] = 0, again = true;
  }
}

}  // namespace jam::inside
