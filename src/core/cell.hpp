// The periodic cell: the lattice on which the packing repeats. Every layer asks here for images, widths and the volume;
// a new kind of cell is added here alone. Molecular dynamics has the lattice vectors in integers:
// dynamics/event_driven/lattice.hpp. Monte Carlo has integers along the cell vectors:
// dynamics/monte_carlo/geometry.hpp.
//
// The rows of a lower-triangular matrix are the cell vectors a_0, a_1, ...; its diagonal is positive. Then a_c is the
// only vector up to c with a component c. So spheres can be in the brick [0, a_00) x [0, a_11) x ..., which repeats
// on the lattice as the cell does. Likewise images are found one component after the other, from the last one.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "jam/jam.h"

namespace jam::inside {

class Cell {
 public:
  using Vector = std::array<double, JAM_MAX_DIM>;

  explicit Cell(int dim = 3, double side = 1.0);
  // From lower-triangular rows (dim, dim) with a positive diagonal.
  static Cell from_triangle(int dim, const double *rows);

  int dim() const { return dim_; }
  bool cube() const { return cube_; }
  // V^(1/d): of a cube its side. The unit in which limits are stated.
  double side() const { return side_; }
  double volume() const { return volume_; }
  const double *row(int c) const { return rows_[c].data(); }
  double edge(int c) const { return rows_[c][c]; }
  double edge_min() const {
    double least = rows_[0][0];
    for (int c = 1; c < dim_; ++c) least = std::min(least, rows_[c][c]);
    return least;
  }
  // (dim, dim): all vectors, one a row.
  std::vector<double> rows() const {
    std::vector<double> all;
    for (int c = 0; c < dim_; ++c) all.insert(all.end(), row(c), row(c) + dim_);
    return all;
  }
  // Distance of the two faces that a_c joins.
  double height(int c) const;
  double height_min() const;
  // From now on nothing repeats along these axes (bits), which are at right angles to all others: walls bound them
  // (core/container.hpp). Edges, heights and the shortest vector stay those of the brick.
  void close(uint32_t axes) { closed_ = axes; }
  uint32_t closed() const { return closed_; }
  bool repeats(int c) const { return (closed_ >> c & 1u) == 0; }
  // Length of the shortest lattice vector: a sphere wider than that overlaps its image.
  double shortest() const;
  // No point is farther than this from the nearest image of another.
  double half_diagonal() const;

  // s from x = sum_c s_c a_c; x and s may be the same.
  void fraction(const double *x, double *s) const {
    for (int c = dim_ - 1; c >= 0; --c) {
      double rest = x[c];
      for (int k = c + 1; !right_ && k < dim_; ++k) rest -= s[k] * rows_[k][c];
      s[c] = rest / rows_[c][c];
    }
  }
  // x = sum_c s_c a_c; x and s may be the same.
  void combine(const double *s, double *x) const {
    for (int c = 0; c < dim_; ++c) {
      double sum = s[c] * rows_[c][c];
      for (int k = c + 1; !right_ && k < dim_; ++k) sum += s[k] * rows_[k][c];
      x[c] = sum;
    }
  }

  // Puts x into the brick. `shift`, unless NULL, becomes old minus new, a lattice vector.
  void wrap(double *x, double *shift = nullptr) const;
  // Takes a lattice vector off x so that each component is at most half an edge. That is the nearest image whenever it
  // is shorter than half the shortest edge; for longer vectors images() finds it.
  void nearest(double *x) const {
    for (int c = dim_ - 1; c >= 0; --c) {
      if (!(std::fabs(x[c]) > 0.5 * rows_[c][c]) || !repeats(c)) continue;
      const double m = std::nearbyint(x[c] / rows_[c][c]);
      for (int k = right_ ? c : 0; k <= c; ++k) x[k] -= m * rows_[c][k];
    }
  }
  // The lattice vector that takes the difference of two points of the brick to the image that nearest() chooses.
  void nearest_shift(const double *dx, double *shift) const {
    if (right_ && !closed_) {
      for (int c = 0; c < dim_; ++c) {
        const double edge = rows_[c][c];
        shift[c] = dx[c] > 0.5 * edge ? -edge : dx[c] < -0.5 * edge ? edge : 0.0;
      }
      return;
    }
    std::fill(shift, shift + dim_, 0.0);
    for (int c = dim_ - 1; c >= 0; --c) {
      const double x = dx[c] + shift[c];
      if (!(std::fabs(x) > 0.5 * rows_[c][c]) || !repeats(c)) continue;
      const double m = -std::nearbyint(x / rows_[c][c]);
      for (int k = right_ ? c : 0; k <= c; ++k) shift[k] += m * rows_[c][k];
    }
  }
  // Calls f(shift) for every lattice vector with |dx + shift| < cutoff.
  template <class F>
  void images(const double *dx, double cutoff, F &&f) const {
    Vector shift{};
    descend(dim_ - 1, dx, cutoff * cutoff, shift, f);
  }

 private:
  // Components above c are chosen; r2 is what the rest of the vector may still have, squared.
  template <class F>
  void descend(int c, const double *dx, double r2, const Vector &above, F &f) const {
    if (c < 0) return f(above.data());
    const double edge = rows_[c][c], x = dx[c] + above[c];
    double centre = -std::nearbyint(x / edge), reach = std::floor(std::sqrt(r2) / edge + 0.5);
    if (closed_ && !repeats(c)) centre = reach = 0.0;
    for (double m = centre - reach; m <= centre + reach; ++m) {
      Vector shift = above;
      for (int k = right_ ? c : 0; k <= c; ++k) shift[k] += m * rows_[c][k];
      const double y = dx[c] + shift[c], rest = r2 - y * y;
      if (rest > 0.0) descend(c - 1, dx, rest, shift, f);
    }
  }

  int dim_;
  bool cube_ = true, right_ = true;  // right_: all angles are
  uint32_t closed_ = 0;
  double side_, volume_;
  std::array<Vector, JAM_MAX_DIM> rows_{};
};

// Wraps x into [0, period). Also right for values like -1e-20, where x + period rounds to period.
double wrap(double x, double period);

}  // namespace jam::inside
