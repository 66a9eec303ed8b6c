// Reduced pressure p = P V / (N k T) from the sums of a run.
#pragma once

namespace jam {

// p = 1 + virial / (d N kT t), with the virial sum of r . dp over collisions in the time t. The total momentum is
// constant, so kT = sum m v^2 / (d (N - 1)) about the centre of mass; kinetic_integral is sum m v^2 over time. Two hard
// spheres then have their exact p = 1 + 2 phi / (1 - 4 phi) in three dimensions.
inline double reduced_pressure(double virial, double kinetic_integral, double n) {
  return 1.0 + (n - 1.0) / n * (virial / kinetic_integral);
}

}  // namespace jam
