// The energy of a pair of overlapping spheres. A new energy is a class with the members of this one.
#pragma once
#include <cmath>
#include <cstdint>

#include "jam/jam.h"

namespace jam {

// v = c (delta / l)^alpha of the overlap delta = sigma - r > 0, and 0 without overlap; energies in units of epsilon.
//   JAM_SOFT_RELATIVE  c = 1 / alpha, l = sigma     (O'Hern et al., Phys. Rev. E 68, 011306 (2003))
//   JAM_SOFT_ABSOLUTE  c = 1 / alpha, l = 1
//   JAM_SOFT_BARE      c = 1,         l = 1
class SoftEnergy {
 public:
  SoftEnergy() = default;
  SoftEnergy(double alpha, int32_t scale)
      : alpha_(alpha),
        factor_(scale == JAM_SOFT_BARE ? alpha : 1.0),
        relative_(scale == JAM_SOFT_RELATIVE),
        kind_(alpha == 2.0   ? Kind::linear
              : alpha == 1.5 ? Kind::root
              : alpha == 2.5 ? Kind::cubed_root
                             : Kind::any) {}

  double alpha() const { return alpha_; }
  bool relative() const { return relative_; }
  // Force -dv/dr > 0; inverse: 1 / sigma.
  double force(double delta, double inverse) const {
    const double scale = relative_ ? inverse : 1.0;
    return factor_ * scale * power(scale * delta);
  }
  // v from the force f at the same overlap: v = f delta / alpha holds for every power law.
  double value(double delta, double f) const { return f * delta / alpha_; }
  // d2v / dr2 from the force: (alpha - 1) f / delta.
  double stiffness(double delta, double f) const { return (alpha_ - 1.0) * f / delta; }

 private:
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
    return std::pow(x, alpha_ - 1.0);
  }
  double alpha_ = 2.0, factor_ = 1.0;
  bool relative_ = true;
  Kind kind_ = Kind::linear;
};

}  // namespace jam
