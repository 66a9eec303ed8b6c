// The stress tensor of dynamics, as momentum that crosses a plane: by collisions, and carried by the spheres
// themselves. The traces are PressureSums, which are taken at the same moments.
#pragma once
#include <cstddef>
#include <vector>

namespace jam::inside {

class StressSums {
 public:
  explicit StressSums(size_t dim) : dim_(dim), virial_(dim * dim, 0.0), kinetic_(virial_), moving_(virial_) {}

  // The momenta are counted again, and have been there since then.
  void restart(double since) { moving_.assign(dim_ * dim_, 0.0), since_ = since; }
  // weight: m, negative to take a sphere out.
  template <int D>
  void add(double weight, const double *v) {
    each<D>([&](size_t at, int a, int b) { moving_[at] += weight * (v[a] * v[b]); });
  }
  // Of a new origin of time: then, which is `now` by the old one.
  template <int D>
  void advance(double now, double then) {
    const double time = now - since_;
    each<D>([&](size_t at, int, int) { kinetic_[at] += time * moving_[at]; });
    since_ = then;
  }
  // Momentum along n over the distance of centres: their product is the work.
  template <int D>
  void collide(double work, const double *n) {
    each<D>([&](size_t at, int a, int b) { virial_[at] += work * (n[a] * n[b]); });
  }
  // P_ab V / (N kT), with the trace d PressureSums::reduced_pressure; NaN before any time has passed.
  std::vector<double> reduced(double n, double kept) const {
    double trace = 0.0;
    for (size_t c = 0; c < dim_; ++c) trace += kinetic_[c * (dim_ + 1)];
    const double unit = static_cast<double>(dim_) / trace;
    std::vector<double> out(dim_ * dim_);
    for (size_t a = 0; a < dim_; ++a)
      for (size_t b = a; b < dim_; ++b) {
        const size_t at = a * dim_ + b;
        out[at] = out[b * dim_ + a] = unit * (kinetic_[at] + (n - kept) / n * virial_[at]);
      }
    return out;
  }

 private:
  template <int D, class F>
  static void each(F &&f) {
    for (int a = 0; a < D; ++a)
      for (int b = a; b < D; ++b) f(static_cast<size_t>(a * D + b), a, b);
  }

  size_t dim_;
  std::vector<double> virial_, kinetic_, moving_;  // sum of r dp; integral of sum m v v over time; that sum now: b >= a
  double since_ = 0.0;
};

}  // namespace jam::inside
