// Velocities of a packing: kinetic energy, and Maxwell-Boltzmann draws.
#pragma once
#include "core/packing.hpp"
#include "core/rng.hpp"

namespace jam::inside {

// Sum of m v^2 about the centre of mass.
double twice_kinetic(const Packing &p);
// Takes the motion of the centre of mass off along axes that repeat, where it is more than rounding. False: nothing but
// rounding is left, the spheres are at rest or move as one.
bool take_drift(Packing &p);
// To exactly kT/m = 1, m the mean mass.
void scale_velocities(Packing &p);
// Maxwell-Boltzmann with zero total momentum, at about kT/m = 1.
void draw_velocities(Packing &p, Rng &rng);

}  // namespace jam::inside
