// FIRE 2.0: dynamics with friction that is turned off while the motion goes downhill (Bitzek et al., Phys. Rev. Lett.
// 97, 170201 (2006); Guenole et al., Comput. Mater. Sci. 175, 109584 (2020)).
#include <algorithm>
#include <cmath>

#include "core/math.hpp"
#include "soft/relaxation.hpp"
#include "soft/tuning.hpp"

namespace jam::inside {

DescentEnd fire(Relaxation &r, double tolerance) {
  SoftState &state = r.state;
  const size_t d = static_cast<size_t>(state.dim()), size = r.force.size();
  const double mean = state.diameter_mean(), move_limit = FireTuning::longest_move * mean;
  // Masses go with the stiffness of a sphere's contacts, so that all spheres of a mixture take the same time step.
  std::vector<double> inverse_mass(state.blocks(), 1.0);
  if (state.energy().relative())
    for (size_t i = 0; i < state.n(); ++i) inverse_mass[i] = math::pow(state.base().diameter[i] / mean, 2);
  std::vector<double> v(size, 0.0);
  double step = FireTuning::first_step, mixing = FireTuning::mixing_start;
  int downhill = 0;
  for (int64_t count = 0;; ++count) {
    if (r.at_rest()) return DescentEnd::no_overlaps;
    if (r.residual() < tolerance || (count % evaluations_between_looks == 0 && r.stable_residual() < tolerance))
      return DescentEnd::balanced;
    DescentEnd end;
    if (r.must_stop(end)) return end;
    std::vector<double> &u = state.displacement(), &f = r.force;
    const double dt = step / std::sqrt(r.stiffness);
    double power = 0.0;
    for (size_t k = 0; k < size; ++k) power += f[k] * v[k];
    if (power > 0.0) {
      if (++downhill > FireTuning::steps_before_growth) {
        step = std::min(step * FireTuning::step_up, FireTuning::longest_step);
        mixing *= FireTuning::mixing_factor;
      }
    } else {
      if (count > FireTuning::steps_before_growth && step * FireTuning::step_down >= FireTuning::shortest_step)
        step *= FireTuning::step_down;
      mixing = FireTuning::mixing_start;
      downhill = 0;
      for (size_t k = 0; k < size; ++k) u[k] -= 0.5 * dt * v[k], v[k] = 0.0;
    }
    double vv = 0.0, aa = 0.0;
    for (size_t i = 0; i < state.blocks(); ++i)
      for (size_t k = i * d; k < (i + 1) * d; ++k) {
        const double a = f[k] * inverse_mass[i];
        v[k] += dt * a;
        vv += v[k] * v[k];
        aa += a * a;
      }
    const double turn = aa > 0.0 ? mixing * std::sqrt(vv / aa) : 0.0;
    double most = 0.0;
    for (size_t i = 0; i < state.blocks(); ++i) {
      double v2 = 0.0;
      for (size_t k = i * d; k < (i + 1) * d; ++k) {
        v[k] = (1.0 - mixing) * v[k] + turn * f[k] * inverse_mass[i];
        v2 += v[k] * v[k];
      }
      most = std::max(most, v2);
    }
    const double length = dt * std::sqrt(most);
    const double part = length > move_limit ? move_limit / length : 1.0;
    for (size_t k = 0; k < size; ++k) {
      v[k] *= part;
      u[k] += dt * v[k];
    }
    r.evaluate();
  }
}

}  // namespace jam::inside
