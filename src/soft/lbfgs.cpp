// Limited-memory BFGS with a line search on the slope alone: near the minimum the energy keeps half the digits of the
// forces and can no longer show which of two points is lower.
#include <algorithm>
#include <cmath>
#include <deque>

#include "linalg/dot.hpp"
#include "soft/relaxation.hpp"
#include "soft/tuning.hpp"

namespace jam::inside {
namespace {

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

}  // namespace

DescentEnd lbfgs(Relaxation &r, double tolerance) {
  SoftState &state = r.state;
  const int d = state.dim();
  const double move_limit = LbfgsTuning::longest_move * state.diameter_mean();
  std::deque<Update> updates;
  std::vector<double> way, before;
  for (int64_t count = 0;; ++count) {
    if (r.at_rest()) return DescentEnd::no_overlaps;
    if (r.residual() < tolerance || (count % evaluations_between_looks == 0 && r.stable_residual() < tolerance))
      return DescentEnd::balanced;
    DescentEnd end;
    if (r.must_stop(end)) return end;
    before = way = r.force;
    descent_way(updates, r.stiffness, way);
    double slope = dot(before, way);
    if (!(slope > 0.0)) {  // no descent: begin again along the force
      updates.clear();
      way = before;
      for (double &x : way) x /= r.stiffness;
      slope = dot(before, way);
    }
    double most = 0.0;
    for (size_t i = 0; i < state.blocks(); ++i) {
      double w2 = 0.0;
      for (int c = 0; c < d; ++c) w2 += way[i * d + c] * way[i * d + c];
      most = std::max(most, w2);
    }
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

}  // namespace jam::inside
