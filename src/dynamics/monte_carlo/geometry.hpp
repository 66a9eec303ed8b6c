// Distances and steps of Monte Carlo: in a cube larger than two contact distances, or in any cell with all images.
//
// Coordinates are integers with 2^64 to each cell vector, so that differences wrap by themselves and moving there and
// back gives the same bits. Lengths are in V^(1/d).
#pragma once
#include <cmath>

#include "core/cell.hpp"
#include "core/limits.hpp"
#include "dynamics/tuning.hpp"

namespace jam::inside {

template <int D, bool Cube>
class MonteCarloGeometry {
 public:
  using Place = std::array<uint64_t, D>;
  using Shift = std::array<int64_t, D>;
  static constexpr double scale = 0x1p64, unit = 0x1p-64;

  MonteCarloGeometry(const Cell &cell, double contact_max)
      : cell_(cell), height_(cell.height_min() / cell.side()), widest_(MonteCarloTuning::range * height_) {
    for (int c = 0; c < D; ++c)
      for (int k = 0; k <= c; ++k) row_[c][k] = cell.row(c)[k] / cell.side();
    for (int c = 0; c < D; ++c) closed_ |= cell.repeats(c) ? 0u : 1u << c;
    if (Cube || contact_max <= MonteCarloTuning::fullest * widest_) return;
    widest_ = MonteCarloTuning::beyond * contact_max;
    check_images();
    add_images(D - 1, {});
  }

  // Pairs up to this distance are seen, with all their images.
  double widest() const { return widest_; }
  // Least distance of two faces.
  double height() const { return height_; }

  Place place(const double *position) const {
    double s[D];
    cell_.fraction(position, s);
    Place x;
    for (int c = 0; c < D; ++c) x[c] = static_cast<uint64_t>(wrap(s[c], 1.0) * scale);
    return x;
  }
  void position(const Place &x, double *position) const {
    const double side = cell_.side();
    if (Cube) {
      for (int c = 0; c < D; ++c) position[c] = wrap(static_cast<double>(x[c]) * unit * side, side);
      return;
    }
    for (int c = 0; c < D; ++c) position[c] = static_cast<double>(x[c]) * unit;
    cell_.combine(position, position);
    cell_.wrap(position);
  }
  // From a step dx to integers and back.
  Shift shift_of(const double *dx) const {
    Shift shift;
    double s[D];
    for (int c = D - 1; c >= 0; --c) {
      s[c] = dx[c];
      if (!Cube) {
        for (int k = c + 1; k < D; ++k) s[c] -= s[k] * row_[k][c];
        s[c] /= row_[c][c];
      }
      shift[c] = static_cast<int64_t>(s[c] * scale);
    }
    return shift;
  }
  void add_step(const Shift &shift, double *moved) const {
    for (int c = 0; c < D; ++c) {
      double x = static_cast<double>(shift[c]) * unit;
      if (!Cube) {
        x *= row_[c][c];
        for (int k = c + 1; k < D; ++k) x += static_cast<double>(shift[k]) * unit * row_[k][c];
      }
      moved[c] += x;
    }
  }

  // Squared distance of the image that the difference wraps to.
  double distance2(const Place &a, const Place &b) const {
    double r[D];
    vector(a, b, r);
    return length2(r);
  }
  // Of the nearest image.
  double nearest2(const Place &a, const Place &b) const {
    if (Cube || image_.empty()) return distance2(a, b);
    double least = distance2(a, b);
    each_image2(a, b, [&least](double r2) { least = r2 < least ? r2 : least; });
    return least;
  }
  // f(squared distance) for every image that can be in range.
  template <class F>
  void each_image2(const Place &a, const Place &b, F &&f) const {
    if (Cube || image_.empty()) return f(distance2(a, b));
    double r[D];
    vector(a, b, r);
    for (const auto &image : image_) {
      double x[D];
      for (int c = 0; c < D; ++c) x[c] = r[c] + image[c];
      f(length2(x));
    }
  }

 private:
  void vector(const Place &a, const Place &b, double *r) const {
    for (int c = 0; c < D; ++c) r[c] = static_cast<double>(static_cast<int64_t>(a[c] - b[c])) * unit;
    if (Cube) return;
    for (int c = 0; closed_ && c < D; ++c)  // nothing is seen across a wall: back to the difference that did not wrap
      if (closed_ >> c & 1 && (r[c] < 0.0) != (a[c] < b[c]) && r[c] != 0.0) r[c] += r[c] < 0.0 ? 1.0 : -1.0;
    for (int c = 0; c < D; ++c) {
      r[c] *= row_[c][c];
      for (int k = c + 1; k < D; ++k) r[c] += r[k] * row_[k][c];
    }
  }
  static double length2(const double *r) {
    double r2 = 0.0;
    for (int c = 0; c < D; ++c) r2 += r[c] * r[c];
    return r2;
  }
  // A difference has no coefficient beyond 1/2. A vector shorter than widest_ has none beyond widest_ / height.
  double most_cells(int c) const {
    return cell_.repeats(c) ? std::floor(widest_ * cell_.side() / cell_.height(c) + 0.5) : 0.0;
  }
  void check_images() const {
    double images = 1.0;
    for (int c = 0; c < D; ++c) images *= 2.0 * most_cells(c) + 1.0;
    if (!(images <= limits::images_max))
      fail(JAM_E_UNSUPPORTED, "each pair has %.3g images in reach in this cell, Monte Carlo allows %g", images,
           limits::images_max);
  }
  void add_images(int c, const std::array<double, D> &above) {
    if (c < 0) {
      image_.push_back(above);
      return;
    }
    const double most = most_cells(c);
    for (double m = -most; m <= most; ++m) {
      std::array<double, D> image = above;
      for (int k = 0; k <= c; ++k) image[k] += m * row_[c][k];
      add_images(c - 1, image);
    }
  }

  Cell cell_;
  double height_, widest_;
  uint32_t closed_ = 0;  // axes with walls; in a Cube hard spheres never meet across one
  std::array<std::array<double, D>, D> row_{};
  std::vector<std::array<double, D>> image_;  // empty: the nearest is enough
};

}  // namespace jam::inside
