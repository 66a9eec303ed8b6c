// Newton's method on the stable spheres, with pre-stress; and the production method, FIRE (L-BFGS below alpha = 2)
// until contacts settle and then Newton.
#include <algorithm>
#include <cmath>

#include "linalg/dot.hpp"
#include "soft/relaxation.hpp"
#include "soft/soft_hessian.hpp"
#include "soft/tuning.hpp"

namespace jam::inside {
namespace {

// Levenberg and Marquardt: a shift of the Hessian that grows where contacts change and steps gain less energy than the
// quadratic model says. `stalled` when the steps do not lead to the tolerance.
DescentEnd newton(Relaxation &r, double tolerance, SoftHessian &hessian, double shift, bool &convex) {
  SoftState &state = r.state;
  const double move_limit = NewtonTuning::longest_move * state.diameter_mean();
  bool fresh = false;
  double last = 0.0, start = 0.0;
  std::vector<double> way;
  for (int step = 0; step < NewtonTuning::most_steps; ++step) {
    if (r.at_rest()) return DescentEnd::no_overlaps;
    const SoftContacts contacts = state.contacts();
    const std::vector<char> on = stable_contacts(state, contacts);
    const double now = r.stable_residual();
    if (now < tolerance && r.residual() < std::max(tolerance, NewtonTuning::rattlers_balanced))
      return DescentEnd::balanced;
    if (step == 0) start = now;
    if (now > NewtonTuning::leaves_saddle * start) return DescentEnd::stalled;
    DescentEnd end;
    if (r.must_stop(end, true)) return end;
    if (std::find(on.begin(), on.end(), 1) == on.end()) return DescentEnd::stalled;
    if (!(fresh && now < NewtonTuning::good_factor * last && hessian.has_contacts(state, contacts))) {
      if (!hessian.factorise(state, contacts, on, shift, r.effort.factorisations)) return DescentEnd::stalled;
      fresh = true;
      convex = hessian.shift() == 0.0;
    }
    last = now;
    const std::vector<double> force = r.force;
    way = force;
    hessian.solve(way);
    double most = 0.0;
    for (const double x : way) most = std::max(most, std::fabs(x));
    if (!(most < NewtonTuning::diverged)) return DescentEnd::stalled;
    const double part = most > move_limit ? move_limit / most : 1.0;
    for (double &x : way) x *= part;
    const double slope = dot(force, way), model = (part - 0.5 * part * part) / part * slope;
    const double energy = r.sums.enthalpy();
    for (size_t k = 0; k < way.size(); ++k) state.displacement()[k] += way[k];
    r.evaluate();
    // Near the minimum the energy has no digits left: then the slope behind the step must have fallen.
    const double gain = now > NewtonTuning::energy_is_blind ? (energy - r.sums.enthalpy()) / model
                                                            : 1.0 - std::fabs(dot(r.force, way)) / slope;
    if (gain > NewtonTuning::as_modelled && part == 1.0) {
      shift = shift < NewtonTuning::no_shift ? 0.0 : shift * NewtonTuning::shift_down;
    } else if (gain < NewtonTuning::too_little) {
      shift = std::max(NewtonTuning::shift_up * std::max(shift, hessian.shift()), NewtonTuning::first_shift);
      fresh = false;
    }
    if (gain <= 0.0) {
      for (size_t k = 0; k < way.size(); ++k) state.displacement()[k] -= way[k];
      r.evaluate();
      fresh = false;
    }
  }
  return DescentEnd::stalled;
}

}  // namespace

DescentEnd hybrid(Relaxation &r, double tolerance, bool near_minimum, bool &convex) {
  SoftHessian hessian;
  // Below alpha = 2 the stiffness of a contact grows without bound as it opens. The time step of FIRE follows the mean
  // one, so such contacts chatter: at alpha = 3/2 it stays at a residual of 1e-4, while L-BFGS continues.
  const bool stiffens_at_contact = r.state.energy().alpha() < 2.0;
  double target = NewtonTuning::settled;
  for (bool descend = !near_minimum;; descend = true) {
    DescentEnd end;
    if (descend) {
      convex = false;
      end = stiffens_at_contact ? lbfgs(r, std::max(target, tolerance)) : fire(r, std::max(target, tolerance));
      if (end != DescentEnd::balanced) return end;
    }
    if (descend) {
      centre_rattlers(r.state);
      r.evaluate();
    }
    end = newton(r, tolerance, hessian, 0.0, convex);
    if (end != DescentEnd::stalled) return end;
    if (!descend) continue;
    if (target <= tolerance) return r.stable_residual() < tolerance ? DescentEnd::balanced : DescentEnd::stalled;
    target = NewtonTuning::next_target * std::min(target, r.stable_residual());
  }
}

DescentEnd hybrid(Relaxation &r, double tolerance, bool near_minimum) {
  bool convex = false;
  return hybrid(r, tolerance, near_minimum, convex);
}

}  // namespace jam::inside
