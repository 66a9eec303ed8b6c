#include "network/stress_cone.hpp"

#include <algorithm>
#include <cmath>

#include "core/rng.hpp"

namespace jam {
namespace {

// In units of the mean |force|: below the first a force is zero, above the second it is not; between them the digits
// do not decide.
constexpr double zero_force = 1e-11, sure_force = 1e-9;

double mean_size(const std::vector<double> &f) {
  double sum = 0.0;
  for (const double v : f) sum += std::fabs(v);
  return f.empty() ? 0.0 : sum / static_cast<double>(f.size());
}

// No state, or one: the null vector decides by its signs. A f >= 0 state with zeros leaves them to open, one with both
// signs lets all contacts open.
StressCone of_one_state(const ConstraintRows &rows, const NormalSolver &solver, int64_t states,
                        const CancellationPoint &cancel_point) {
  StressCone out;
  const size_t m = rows.rows();
  std::vector<double> f(m, 0.0);
  if (states == 1) {
    f.assign(m, 1.0);
    project_on_balance(rows, solver, f, cancel_point);
    if (mean_size(f) < 1e-6) {  // nearly orthogonal to (1, 1, ...): forces of both signs
      Rng rng(3, Stream::analysis_start);
      for (double &v : f) v = rng.normal();
      project_on_balance(rows, solver, f, cancel_point);
    }
    double sum = 0.0;
    for (const double v : f) sum += v;
    const double scale = (sum < 0.0 ? -1.0 : 1.0) / mean_size(f);
    for (double &v : f) v *= scale;
  }
  double push = 0.0, pull = 0.0;
  for (double &v : f) {
    const double size = std::fabs(v);
    if (size > zero_force && size < sure_force) return out;
    if (size <= zero_force) v = 0.0;
    (v > 0.0 ? push : pull) += std::fabs(v);
  }
  out.decided = true;
  const bool positive = push > 0.0 && pull == 0.0;
  out.carrying.assign(m, 0);
  bool all = true;
  std::vector<double> opening(m, 1.0);
  for (size_t k = 0; k < m; ++k) {
    out.carrying[k] = positive && f[k] > 0.0;
    all = all && out.carrying[k];
    if (positive)
      opening[k] = out.carrying[k] ? 0.0 : 1.0;
    else if (f[k] != 0.0)
      opening[k] = static_cast<double>(m) / (2.0 * (f[k] > 0.0 ? push : pull));  // orthogonal to f
  }
  if (!all) out.motion = nearest_motion(rows, solver, opening, cancel_point);
  out.force.assign(m, 0.0);
  if (positive) out.force = f;
  return out;
}

// The central path of the self-dual problem A^T f = x, w = A x + delta, f w = 1, f > 0, w > 0. As delta falls, f grows
// as 1 / delta on K+ and w stays finite on all others, where x opens them (Goldman and Tucker 1956; path following as
// in S. J. Wright, Primal-Dual Interior-Point Methods, SIAM 1997, with Mehrotra's corrector). On K+ the limit of
// delta f is the analytic centre: the state that maximises sum log f at a given sum.
class CentralPath {
 public:
  CentralPath(const ConstraintRows &rows, const CancellationPoint &cancel_point)
      : rows_(rows),
        cancel_point_(cancel_point),
        solver_(rows),
        x_(rows.columns(), 0.0),
        f_(rows.rows(), 1.0),
        w_(rows.rows(), 1.0) {}

  // One step towards a smaller delta. False where steps end.
  bool step() {
    cancel_point_();
    const size_t m = f_.size();
    std::vector<double> weight(m);
    for (size_t k = 0; k < m; ++k) weight[k] = f_[k] / w_[k];
    solver_.factorise(weight, 1.0);
    std::vector<double> df, dw, dx, correction(m, 0.0);
    direction(0.0, correction, df, dw, dx);
    const double reach = std::min(longest(f_, df), longest(w_, dw));
    const double target = delta_ * std::max(1e-3, std::min(0.9, std::pow(1.0 - reach, 2.0)));
    for (size_t k = 0; k < m; ++k) correction[k] = -reach * reach * df[k] * dw[k];
    direction(target, correction, df, dw, dx);
    const double length = std::min(1.0, 0.99 * std::min(longest(f_, df), longest(w_, dw)));
    for (size_t k = 0; k < m; ++k) f_[k] += length * df[k], w_[k] += length * dw[k];
    for (size_t k = 0; k < x_.size(); ++k) x_[k] += length * dx[k];
    delta_ += length * (target - delta_);
    ++steps_;
    return length > 1e-3;
  }

  double delta() const { return delta_; }
  int steps() const { return steps_; }
  const std::vector<double> &f() const { return f_; }
  const std::vector<double> &w() const { return w_; }
  const std::vector<double> &x() const { return x_; }

 private:
  static double longest(const std::vector<double> &v, const std::vector<double> &dv) {
    double t = 1.0;
    for (size_t k = 0; k < v.size(); ++k)
      if (v[k] + t * dv[k] < 0.0) t = -v[k] / dv[k];
    return t;
  }
  // Newton: A^T (f + df) = x + dx, A (x + dx) + delta = w + dw, f w + w df + f dw = 1 + correction.
  void direction(double delta, const std::vector<double> &correction, std::vector<double> &df, std::vector<double> &dw,
                 std::vector<double> &dx) const {
    const size_t m = f_.size();
    std::vector<double> gap(m), g(m);
    rows_.multiply(x_.data(), gap.data());
    for (size_t k = 0; k < m; ++k) {
      gap[k] += delta - w_[k];
      g[k] = (1.0 + correction[k] - f_[k] * gap[k]) / w_[k];  // f + df without the part of A dx
    }
    dx.resize(x_.size());
    rows_.transpose(g.data(), dx.data());
    for (size_t k = 0; k < dx.size(); ++k) dx[k] -= x_[k];
    solver_.solve(dx.data());
    dw.resize(m), df.resize(m);
    rows_.multiply(dx.data(), dw.data());
    for (size_t k = 0; k < m; ++k) {
      df[k] = g[k] - f_[k] / w_[k] * dw[k] - f_[k];
      dw[k] += gap[k];
    }
  }

  const ConstraintRows &rows_;
  const CancellationPoint &cancel_point_;
  NormalSolver solver_;
  std::vector<double> x_, f_, w_;
  double delta_ = 1.0;
  int steps_ = 0;
};

// Guesses of K+ from a point of the path: f is of the order 1 / delta on K+ and 1 elsewhere. First the middle between
// both; then the largest jump of the sorted forces, for a few that are much weaker or open much less.
std::vector<std::vector<char>> guess_support(const CentralPath &path) {
  const std::vector<double> &f = path.f();
  const auto above = [&](double limit) {
    std::vector<char> on(f.size());
    for (size_t k = 0; k < f.size(); ++k) on[k] = f[k] > limit;
    return on;
  };
  std::vector<double> sorted(f);
  std::sort(sorted.begin(), sorted.end());
  size_t jump = 0;
  for (size_t k = 1; k < sorted.size(); ++k)
    if (jump == 0 || sorted[k] * sorted[jump - 1] > sorted[jump] * sorted[k - 1]) jump = k;
  std::vector<std::vector<char>> out{above(1.0 / std::sqrt(path.delta()))};
  const std::vector<char> second = jump > 0 ? above(sorted[jump - 1]) : out[0];
  if (second != out[0]) out.push_back(second);
  return out;
}

// Both certificates of a guess of K+: a positive stress on it, and a motion that opens the others and keeps it closed.
bool certify_support(const ConstraintRows &rows, const NormalSolver &solver, const CentralPath &path,
                     const std::vector<char> &guess, StressCone &out, const CancellationPoint &cancel_point) {
  const size_t m = rows.rows();
  out.carrying = guess;
  const auto count = static_cast<size_t>(std::count(guess.begin(), guess.end(), 1));
  out.force.assign(m, 0.0), out.motion.clear();
  const RigidityMatrix sub = subset(rows.g, out.carrying);
  const ConstraintRows kept(sub, rows.strains > 0);
  std::unique_ptr<NormalSolver> own;
  const NormalSolver *inner = &solver;
  if (count > 0 && count < m) {
    own = std::make_unique<NormalSolver>(kept);
    own->factorise(std::vector<double>(count, 1.0), solver.shift());
    ++out.factorisations;
    inner = own.get();
  }
  const ConstraintRows &on = count == m ? rows : kept;
  if (count > 0) {
    std::vector<double> f;
    for (size_t k = 0; k < m; ++k)
      if (out.carrying[k]) f.push_back(path.f()[k]);
    double mean = mean_size(f);
    for (double &v : f) v /= mean;
    project_on_balance(on, *inner, f, cancel_point);
    mean = mean_size(f);
    size_t at = 0;
    for (size_t k = 0; k < m; ++k)
      if (out.carrying[k]) out.force[k] = f[at++] / mean;
    for (const double v : f)
      if (!(v > zero_force * mean)) return false;
  }
  if (count == m) return true;
  // Opens what does not carry; what carries is closed again by the nearest correction.
  std::vector<double> x = path.x(), y(m);
  rows.multiply(x.data(), y.data());
  if (count > 0) {
    std::vector<double> open;
    for (size_t k = 0; k < m; ++k)
      if (out.carrying[k]) open.push_back(y[k]);
    const std::vector<double> back = nearest_motion(on, *inner, open, cancel_point);
    for (int32_t i = 0; i < sub.nodes; ++i)
      for (int c = 0; c < sub.dim; ++c) x[static_cast<size_t>(sub.sphere[i]) * sub.dim + c] -= back[i * sub.dim + c];
    // The strain of both is measured by the mean contact distance of its own rows.
    for (int q = 0; q < rows.strains; ++q)
      x[rows.g.unknowns() + q] -= back[sub.unknowns() + q] * rows.length / kept.length;
    rows.multiply(x.data(), y.data());
  }
  double largest = 0.0, least = -1.0, closed = 0.0;
  for (size_t k = 0; k < m; ++k) {
    largest = std::max(largest, std::fabs(y[k]));
    if (out.carrying[k])
      closed = std::max(closed, std::fabs(y[k]));
    else if (least < 0.0 || y[k] < least)
      least = std::max(0.0, y[k]);
  }
  out.motion = std::move(x);
  return least > sure_force * largest && closed < zero_force * largest;
}

// The analytic centre of the states on K+: minimises - sum log(1 + A u), whose gradient is A^T f with f = 1 / (1 + A
// u), by Newton steps from a point near it. The last projection on the balance takes the rest out.
void centre(const RigidityMatrix &all, bool strain, const CentralPath &path, StressCone &out,
            const CancellationPoint &cancel_point) {
  constexpr int most_steps = 20;
  const RigidityMatrix sub = subset(all, out.carrying);
  const ConstraintRows rows(sub, strain);
  const size_t m = rows.rows();
  if (m == 0) return;
  std::vector<double> w, f(m), step(rows.columns()), dw(m), weight(m);
  for (size_t k = 0; k < out.carrying.size(); ++k)
    if (out.carrying[k]) w.push_back(path.w()[k] / path.delta());
  NormalSolver solver(rows);
  for (int pass = 0; pass < most_steps; ++pass) {
    cancel_point();
    double largest = 0.0;
    for (size_t k = 0; k < m; ++k) f[k] = 1.0 / w[k], weight[k] = f[k] * f[k], largest = std::max(largest, weight[k]);
    solver.factorise(weight, 1e-13 * largest);
    ++out.factorisations;
    rows.transpose(f.data(), step.data());
    const std::vector<double> gradient = step;
    solver.solve(step.data());
    double decrement = 0.0, length = 1.0;
    for (size_t k = 0; k < step.size(); ++k) decrement += gradient[k] * step[k];
    rows.multiply(step.data(), dw.data());
    for (size_t k = 0; k < m; ++k)
      if (w[k] + dw[k] < 0.01 * w[k]) length = std::min(length, -0.99 * w[k] / dw[k]);
    if (decrement > 0.25) length = std::min(length, 1.0 / (1.0 + std::sqrt(decrement)));
    for (size_t k = 0; k < m; ++k) w[k] += length * dw[k];
    if (decrement < 1e-16) break;
  }
  for (size_t k = 0; k < m; ++k) f[k] = 1.0 / w[k];
  const double mean = mean_size(f);
  for (double &v : f) v /= mean;
  solver.factorise(std::vector<double>(m, 1.0), 1e-12);
  project_on_balance(rows, solver, f, cancel_point);
  const double scale = mean_size(f);
  if (*std::min_element(f.begin(), f.end()) <= zero_force * scale) return;  // the certified forces stay
  size_t at = 0;
  for (size_t k = 0; k < out.carrying.size(); ++k)
    if (out.carrying[k]) out.force[k] = f[at++] / scale;
}

}  // namespace

StressCone find_stress_cone(const ConstraintRows &rows, const NormalSolver &solver, int64_t states,
                            const CancellationPoint &cancel_point) {
  if (states == 0 || states == 1) return of_one_state(rows, solver, states, cancel_point);
  constexpr double first_guess = 1e-2, least_delta = 1e-7;
  constexpr int most_steps = 60;
  CentralPath path(rows, cancel_point);
  StressCone out;
  double next = first_guess;
  bool going = true;
  while (going && path.steps() < most_steps && path.delta() > least_delta) {
    going = path.step();
    if (path.delta() > next) continue;
    next = 0.1 * path.delta();
    for (const std::vector<char> &guess : guess_support(path))
      if (!out.decided) out.decided = certify_support(rows, solver, path, guess, out, cancel_point);
    if (out.decided) break;
  }
  out.factorisations += path.steps();
  if (out.decided) centre(rows.g, rows.strains > 0, path, out, cancel_point);
  return out;
}

}  // namespace jam
