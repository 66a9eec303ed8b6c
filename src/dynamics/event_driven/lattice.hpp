// Lattice vectors of the periodic cell in the integer coordinates of the engine with offsets (engine.hpp).
#pragma once
#include <algorithm>
#include <cmath>

#include "core/cell.hpp"
#include "dynamics/event_driven/kernel/pair_kernel.hpp"
#include "dynamics/tuning.hpp"

namespace jam::inside {

// Lengths wrap as coordinates do, so that no number of a damaged checkpoint overflows.
inline int64_t wrapping_sum(int64_t a, int64_t b) {
  return static_cast<int64_t>(static_cast<uint64_t>(a) + static_cast<uint64_t>(b));
}

// Integer units to V^(1/d): a power of two. Without offsets differences wrap by themselves, to the nearest image of a
// cube. With offsets coordinates may lie some boxes outside. A cell that is no cube needs space for its longest vector.
template <Offsets O>
struct Units {
  static constexpr double scale = 0x1p64, unit = 0x1p-64, resolution = 0x1p-61;
  explicit Units(const Cell &) {}
};
template <>
struct Units<Offsets::listed> {
  const double scale, unit, resolution;
  explicit Units(const Cell &cell) : scale(scale_of(cell)), unit(1.0 / scale), resolution(unit) {}

 private:
  static double scale_of(const Cell &cell) {
    if (cell.cube()) return 0x1p61;
    double widest = 0.0;
    for (int c = 0; c < cell.dim(); ++c) {
      double width = 0.0;
      for (int k = c; k < cell.dim(); ++k) width += std::fabs(cell.row(k)[c]) / cell.side();
      widest = std::max(widest, width);
    }
    int power;  // the next power of two
    if (std::frexp(widest + ListTuning::longest_distance, &power) == 0.5) --power;
    return std::ldexp(1.0, 62 - power);
  }
};

template <int D>
class Lattice {
 public:
  using Vector = std::array<int64_t, D>;
  using Place = std::array<uint64_t, D>;

  Lattice(const Cell &cell, double scale) : cube_(cell.cube()), shortest_(cell.shortest() / cell.side()) {
    for (int c = 0; c < D; ++c) {
      for (int k = 0; k <= c; ++k) {
        row_[c][k] = cell.row(c)[k] / cell.side();
        units_[c][k] = static_cast<uint64_t>(std::llrint(row_[c][k] * scale));
      }
      edge_[c] = static_cast<double>(units_[c][c]);
      turns_[c] = 1.0 / edge_[c];
      height_[c] = cell.height(c) / cell.side();
    }
  }
  bool cube() const { return cube_; }
  double shortest() const { return shortest_; }      // length of the shortest vector, V^(1/d)
  double height(int c) const { return height_[c]; }  // distance of two faces, V^(1/d)

  uint64_t edge_units(int c) const { return units_[c][c]; }  // integer length of edge c

  // x = sum_c s_c a_c, in V^(1/d); in a cube x = s to the bit.
  void combine(const double *s, double *x) const {
    for (int c = 0; c < D; ++c) {
      x[c] = s[c] * row_[c][c];
      for (int k = c + 1; k < D && !cube_; ++k) x[c] += s[k] * row_[k][c];
    }
  }
  // s of x; by rounding a component of a place inside the cell can be 1 or a little below 0.
  template <class X>
  void fraction(const X &x, double *s) const {
    for (int c = D - 1; c >= 0; --c) {
      double rest = static_cast<double>(static_cast<int64_t>(x[c]));
      for (int k = c + 1; k < D; ++k) rest -= s[k] * static_cast<double>(static_cast<int64_t>(units_[k][c]));
      s[c] = rest / edge_[c];
    }
  }
  // Into the cell: 0 <= s < 1.
  template <class X>
  void wrap(X &x) const {
    if (cube_) {
      for (int c = 0; c < D; ++c) x[c] &= (uint64_t{1} << 61) - 1;
      return;
    }
    double s[D];
    for (int c = D - 1; c >= 0; --c) {
      double rest = static_cast<double>(static_cast<int64_t>(x[c]));
      for (int k = c + 1; k < D; ++k) rest -= s[k] * static_cast<double>(static_cast<int64_t>(units_[k][c]));
      s[c] = rest / edge_[c];
      if (s[c] >= 0.0 && s[c] < 1.0) continue;
      const double turns = std::floor(s[c]);
      s[c] -= turns;
      for (int k = 0; k <= c && turns != 0.0; ++k) x[k] -= static_cast<uint64_t>(std::llrint(turns)) * units_[c][k];
    }
  }
  void add(Vector &x, int c, int64_t turns) const {
    for (int k = cube_ ? c : 0; k <= c; ++k) x[k] = sum(x[k], static_cast<uint64_t>(turns) * units_[c][k]);
  }

  // f(shift) for every lattice vector with |r + shift| < cutoff, in ascending order of the components.
  template <class F>
  void images(const Vector &r, double cutoff, F &&f) const {
    found_.clear();
    const double cutoff2 = cutoff * cutoff;
    descend(D - 1, r, cutoff2 * (1.0 + 1e-12), Vector{});
    if (found_.size() > 1) std::sort(found_.begin(), found_.end());
    for (const Vector &shift : found_) {
      double r2 = 0.0;
      for (int c = 0; c < D; ++c) {
        const auto x = static_cast<double>(sum(r[c], static_cast<uint64_t>(shift[c])));
        r2 += x * x;
      }
      if (r2 < cutoff2) f(shift);
    }
  }

 private:
  static int64_t sum(int64_t a, uint64_t b) { return static_cast<int64_t>(static_cast<uint64_t>(a) + b); }
  // Components above c are chosen; r2 is what the rest of the vector may still have, squared.
  void descend(int c, const Vector &r, double r2, const Vector &above) const {
    if (c < 0) {
      found_.push_back(above);
      return;
    }
    const auto nearest = -std::llrint(static_cast<double>(sum(r[c], static_cast<uint64_t>(above[c]))) * turns_[c]);
    for (const int64_t step : {-1, 1})
      for (int64_t turns = step < 0 ? nearest : nearest + 1;; turns += step) {
        Vector shift = above;
        add(shift, c, turns);
        const auto x = static_cast<double>(sum(r[c], static_cast<uint64_t>(shift[c])));
        const double rest = r2 - x * x;
        if (!(rest > 0.0)) break;
        descend(c - 1, r, rest, shift);
      }
  }

  bool cube_;
  double shortest_;
  std::array<std::array<double, D>, D> row_{};
  std::array<std::array<uint64_t, D>, D> units_{};     // int64_t that wrap
  std::array<double, D> edge_{}, turns_{}, height_{};  // turns: 1 / edge
  mutable std::vector<Vector> found_;                  // scratch
};

}  // namespace jam::inside
