// Reduced pressure p = P V / (N k T) from the sums of a run.
#pragma once

namespace jam::inside {

// Over some collisions and the time between them.
struct PressureSums {
  double virial = 0.0;            // sum of r . dp, of momentum exchanged without the growth part
  double kinetic_integral = 0.0;  // integral of sum m v^2 over time
  PressureSums &operator+=(const PressureSums &more) {
    virial += more.virial;
    kinetic_integral += more.kinetic_integral;
    return *this;
  }
  PressureSums operator+(const PressureSums &more) const { return PressureSums(*this) += more; }
  PressureSums operator-(const PressureSums &less) const {
    return {virial - less.virial, kinetic_integral - less.kinetic_integral};
  }
  bool time_has_passed() const { return kinetic_integral > 0.0; }
  // p = 1 + virial / (d N kT t) for n spheres. The total momentum is constant, so kT = sum m v^2 / (d (N - 1)) about
  // the centre of mass. Two hard spheres then have their exact p = 1 + 2 phi / (1 - 4 phi) in three dimensions. Of
  // walls the virial has radius times momentum: then p is beta P V / N with the P that acts on the walls and the whole
  // V of the container. `kept`: the share of components of the momentum that is constant (Container::momentum_kept).
  double reduced_pressure(double n, double kept = 1.0) const {
    return 1.0 + (n - kept) / n * (virial / kinetic_integral);
  }
};

}  // namespace jam::inside
