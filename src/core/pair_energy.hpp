// The energy of two spheres that overlap, for minimisers and Monte Carlo alike. A new energy is a class with the
// members of this one.
#pragma once
#include <cmath>
#include <cstdint>

#include "core/math.hpp"
#include "jam/jam.h"

namespace jam::inside {

// v = c x^alpha of the overlap x = (sigma - r) / l > 0, and 0 without overlap.
//   JAM_SOFT_RELATIVE  c = 1 / alpha, l = sigma     (O'Hern et al., Phys. Rev. E 68, 011306 (2003))
//   JAM_SOFT_ABSOLUTE  c = 1 / alpha, l = 1
//   JAM_SOFT_BARE      c = 1,         l = 1
// Monte Carlo chooses c freely, and l = sigma or 1.
class PairEnergy {
 public:
  PairEnergy() = default;
  // scale: one of JAM_SOFT_...
  PairEnergy(double alpha, int32_t scale)
      : PairEnergy(alpha, scale == JAM_SOFT_BARE ? 1.0 : 1.0 / alpha, scale == JAM_SOFT_RELATIVE) {
    slope_ = scale == JAM_SOFT_BARE ? alpha : 1.0;  // without the rounding of alpha (1 / alpha)
  }
  PairEnergy(double alpha, double c, bool relative)
      : alpha_(alpha),
        c_(c),
        slope_(c * alpha),
        relative_(relative),
        kind_(alpha == 2.0   ? Kind::linear
              : alpha == 1.5 ? Kind::root
              : alpha == 2.5 ? Kind::cubed_root
                             : Kind::any) {}

  double alpha() const { return alpha_; }
  bool relative() const { return relative_; }
  // f(v), where v(x) is the energy of x > 0. A loop inside f does not test the exponent at every pair.
  template <class F>
  double with_value(F &&f) const {
    const double c = c_, alpha = alpha_;
    switch (kind_) {
      case Kind::linear:
        return f([c](double x) { return c * x * x; });
      case Kind::root:
        return f([c](double x) { return c * x * std::sqrt(x); });
      case Kind::cubed_root:
        return f([c](double x) { return c * x * x * std::sqrt(x); });
      case Kind::any:
        break;
    }
    return f([c, alpha](double x) { return c * math::pow(x, alpha); });
  }
  double value(double x) const {
    return with_value([x](auto v) { return v(x); });
  }
  // dv/dx.
  double slope(double x) const { return slope_ * power(x); }
  // Force -dv/dr > 0 of the overlap delta = sigma - r; inverse: 1 / sigma.
  double force(double delta, double inverse) const {
    const double scale = relative_ ? inverse : 1.0;
    return slope_ * scale * power(scale * delta);
  }
  // v from the force f at the same overlap: v = f delta / alpha holds for every power law.
  double value_from_force(double delta, double f) const { return f * delta / alpha_; }
  // d2v / dr2 from the force: (alpha - 1) f / delta.
  double stiffness(double delta, double f) const { return (alpha_ - 1.0) * f / delta; }

 private:
  // Roots take a third of the time of pow.
  enum class Kind { linear, root, cubed_root, any };
  // x^(alpha - 1)
  double power(double x) const {
    switch (kind_) {
      case Kind::linear:
        return x;
      case Kind::root:
        return std::sqrt(x);
      case Kind::cubed_root:
        return x * std::sqrt(x);
      case Kind::any:
        break;
    }
    return math::pow(x, alpha_ - 1.0);
  }
  double alpha_ = 2.0, c_ = 0.5, slope_ = 1.0;
  bool relative_ = true;
  Kind kind_ = Kind::linear;
};

}  // namespace jam::inside
