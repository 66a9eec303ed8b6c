// Limited-memory BFGS with a line search on the slope alone: near the minimum the energy keeps half the digits of the
// forces and can no longer show which of two points is lower.
#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>

#include "core/math.hpp"
#include "linalg/dot.hpp"
#include "soft/relaxation.hpp"
#include "soft/tuning.hpp"

namespace jam::inside {
namespace {

// Newton's method on the stable spheres, with pre-stress; and the production method, L-BFGS until contacts settle and
// then Newton.

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
    double now = r.stable_residual();
    if (r.renew_origin(now, tolerance)) now = r.stable_residual(), fresh = false;
    const SoftContacts contacts = state.contacts();
    const std::vector<char> on = stable_contacts(state, contacts);
    if (now < tolerance && r.residual() < std::max(tolerance, NewtonTuning::rattlers_balanced))
      return DescentEnd::balanced;
    if (step == 0) start = now;
    if (now > NewtonTuning::leaves_saddle * start) return DescentEnd::stalled;
    DescentEnd end;
    if (r.must_stop(end, true)) return end;
    if (std::find(on.begin(), on.end(), 1) == on.end()) return DescentEnd::stalled;
    if (!(fresh && now < NewtonTuning::good_factor * last && hessian.has_contacts(state, contacts))) {
      if (!if_it_fits(r.effort, false,
                      [&] { return hessian.factorise(state, contacts, on, shift, r.effort.factorisations); }))
        return DescentEnd::stalled;
      fresh = true;
      convex = hessian.shift() == 0.0;
    }
    last = now;
    const std::vector<double> force = r.force;
    way = force;
    hessian.solve(way);
    const double most = largest_entry(way);
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

struct Update {
  std::vector<double> s, y;
  double rho;
};

// Two-loop recursion: way := H force, with H = 1 / first_stiffness before any update.
void descent_way(const std::deque<Update> &updates, double first_stiffness, std::vector<double> &way) {
  std::vector<double> a(updates.size());
  for (size_t q = updates.size(); q-- > 0;) {
    a[q] = updates[q].rho * dot(updates[q].s, way);
    for (size_t k = 0; k < way.size(); ++k) way[k] -= a[q] * updates[q].y[k];
  }
  const double scale =
      updates.empty() ? 1.0 / first_stiffness : 1.0 / (updates.back().rho * dot(updates.back().y, updates.back().y));
  for (double &x : way) x *= scale;
  for (size_t q = 0; q < updates.size(); ++q) {
    const double b = updates[q].rho * dot(updates[q].y, way);
    for (size_t k = 0; k < way.size(); ++k) way[k] += (a[q] - b) * updates[q].s[k];
  }
}

// The last residual that was half of the one before it, and the step that it was found at.
struct LeastResidual {
  double value = std::numeric_limits<double>::infinity();
  int64_t count = 0;
};

// Whether a descent of first order ends before its step `count`, and how.
bool descent_ends(Relaxation &r, int64_t count, double tolerance, LeastResidual &least, DescentEnd &end) {
  if (r.at_rest()) return end = DescentEnd::no_overlaps, true;
  if (r.residual() < tolerance) return end = DescentEnd::balanced, true;
  if (count % evaluations_between_looks == 0) {
    const double now = r.stable_residual();
    if (now < tolerance) return end = DescentEnd::balanced, true;
    if (now < 0.5 * least.value)
      least = {now, count};
    else if (!r.renew_origin(now, tolerance) && count > 2 * least.count + RelaxTuning::patience &&
             r.at_rounding(now, tolerance))
      return end = DescentEnd::rounding, true;
  }
  return r.must_stop(end);
}

}  // namespace

// FIRE 2.0: dynamics with friction that is turned off while the motion goes downhill (Bitzek et al., Phys. Rev. Lett.
// 97, 170201 (2006); Guenole et al., Comput. Mater. Sci. 175, 109584 (2020)).
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
  LeastResidual least;
  for (int64_t count = 0;; ++count) {
    DescentEnd end;
    if (descent_ends(r, count, tolerance, least, end)) return end;
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

DescentEnd lbfgs(Relaxation &r, double tolerance) {
  SoftState &state = r.state;
  const int d = state.dim();
  const double move_limit = LbfgsTuning::longest_move * state.diameter_mean();
  std::deque<Update> updates;
  std::vector<double> way, before;
  LeastResidual least;
  for (int64_t count = 0;; ++count) {
    DescentEnd end;
    if (descent_ends(r, count, tolerance, least, end)) return end;
    before = way = r.force;
    descent_way(updates, r.stiffness, way);
    double slope = dot(before, way);
    if (!(slope > 0.0)) {  // no descent: begin again along the force
      updates.clear();
      way = before;
      for (double &x : way) x /= r.stiffness;
      slope = dot(before, way);
    }
    const double most = largest_squared(way, state.blocks(), d);
    if (most > move_limit * move_limit) {
      const double part = move_limit / std::sqrt(most);
      for (double &x : way) x *= part;
      slope *= part;
    }
    double at = 0.0, next = 1.0;
    for (int attempt = 0; attempt < 5; ++attempt) {
      std::vector<double> &u = state.displacement();
      for (size_t k = 0; k < u.size(); ++k) u[k] += (next - at) * way[k];
      at = next;
      r.evaluate();
      const double now = dot(r.force, way);
      if (now > -LbfgsTuning::overshoot * slope) break;
      next = std::max(LbfgsTuning::least_return * at, at * slope / (slope - now));
    }
    Update made{way, before, 0.0};
    for (size_t k = 0; k < way.size(); ++k) made.s[k] *= at, made.y[k] -= r.force[k];
    const double sy = dot(made.s, made.y);
    if (sy > 1e-10 * std::sqrt(dot(made.s, made.s) * dot(made.y, made.y))) {
      made.rho = 1.0 / sy;
      updates.push_back(std::move(made));
      if (updates.size() > LbfgsTuning::memory) updates.pop_front();
    }
  }
}

DescentEnd hybrid(Relaxation &r, double tolerance, bool near_minimum, bool &convex) {
  SoftHessian hessian;
  // The last residual asked of L-BFGS: contacts that change after it may raise the residual again.
  const double least = NewtonTuning::next_target * tolerance;
  double target = std::max(NewtonTuning::settled, tolerance);
  for (bool descend = !near_minimum;; descend = true) {
    if (descend) {
      convex = false;
      const DescentEnd end = lbfgs(r, target);
      if (end != DescentEnd::balanced) return end;
      centre_rattlers(r.state);
      r.evaluate();
      // The tolerance is met, and Newton's method could leave this balance.
      if (target <= tolerance && r.stable_residual() < tolerance) return DescentEnd::balanced;
    }
    const DescentEnd end = newton(r, tolerance, hessian, 0.0, convex);
    if (end != DescentEnd::stalled) return end;
    if (!descend) continue;
    if (target <= least) return DescentEnd::stalled;
    target = std::max(least, NewtonTuning::next_target * std::min(target, r.stable_residual()));
  }
}

}  // namespace jam::inside
