#include "network/stress_cone.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/call_scope.hpp"
#include "core/rng.hpp"
#include "linalg/dot.hpp"
#include "network/tuning.hpp"

namespace jam::inside {
namespace {

using Tuning = StressConeTuning;

double mean_size(const std::vector<double> &f) {
  double sum = 0.0;
  for (const double v : f) sum += std::fabs(v);
  return f.empty() ? 0.0 : sum / static_cast<double>(f.size());
}

// No state of self-stress, or one: the signs of the null vector decide. Where f >= 0 has zeros, those contacts can
// open. With both signs all contacts can open.
StressCone of_one_state(const ConstraintRows &rows, const NormalSolver &solver, int64_t states) {
  StressCone out;
  const size_t m = rows.rows();
  std::vector<double> f(m, 0.0);
  if (states == 1) {
    f.assign(m, 1.0);
    project_on_balance(rows, solver, f);
    if (mean_size(f) < least_rest) {  // nearly orthogonal to (1, 1, ...): forces of both signs
      Rng rng(3, Stream::analysis_start);
      for (double &v : f) v = rng.normal();
      project_on_balance(rows, solver, f);
    }
    double sum = 0.0;
    for (const double v : f) sum += v;
    const double scale = (sum < 0.0 ? -1.0 : 1.0) / mean_size(f);
    for (double &v : f) v *= scale;
  }
  double push = 0.0, pull = 0.0;
  for (double &v : f) {
    const double size = std::fabs(v);
    if (size > RoundingTuning::zero && size < RoundingTuning::sure) return out;
    if (size <= RoundingTuning::zero) v = 0.0;
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
  if (!all) out.motion = nearest_motion(rows, solver, opening);
  out.force.assign(m, 0.0);
  if (positive) out.force = f;
  return out;
}

// The step length along dw that minimises - sum log(w + t dw), which is convex in t; inside the boundary.
double best_length(const std::vector<double> &w, const std::vector<double> &dw) {
  double low = 0.0, high = std::numeric_limits<double>::infinity();
  for (size_t k = 0; k < w.size(); ++k)
    if (dw[k] < 0.0) high = std::min(high, -w[k] / dw[k]);
  if (!std::isfinite(high)) return low;  // nothing closes: these rows carry no positive stress
  high *= 1.0 - 1e-12;
  for (int pass = 0; pass < 50; ++pass) {
    const double t = 0.5 * (low + high);
    double slope = 0.0;
    for (size_t k = 0; k < w.size(); ++k) slope -= dw[k] / (w[k] + t * dw[k]);
    (slope < 0.0 ? low : high) = t;
  }
  return low;
}

// Guesses of K+ from a point of the path: contacts with f > w, and those above the largest jump of the sorted forces,
// for a few that are much weaker or open much less.
std::vector<std::vector<char>> guess_support(const CentralPath &path) {
  const std::vector<double> &f = path.f();
  const size_t m = f.size();
  std::vector<char> larger(m), jumped(m);
  std::vector<double> sorted(f);
  std::sort(sorted.begin(), sorted.end());
  size_t jump = 0;
  for (size_t k = 1; k < m; ++k)
    if (jump == 0 || sorted[k] * sorted[jump - 1] > sorted[jump] * sorted[k - 1]) jump = k;
  for (size_t k = 0; k < m; ++k) larger[k] = f[k] > path.w()[k], jumped[k] = f[k] >= sorted[jump];
  return {std::move(larger), std::move(jumped)};
}

// The contacts of a guess on which its balanced forces do not pull, where these are nearly all: another guess. Forces
// that fall on the path for long before they stay are settled so.
bool drop_pulled(const std::vector<double> &force, std::vector<char> &guess) {
  size_t pulled = 0;
  for (size_t k = 0; k < guess.size(); ++k)
    if (guess[k] && !(force[k] > RoundingTuning::zero)) guess[k] = 0, ++pulled;
  return pulled > 0 && pulled <= Tuning::most_pulled;
}

enum class Support { no, positive, whole };

// Both certificates of a guess of K+: a positive stress on it, and a motion that opens the others and keeps it closed.
// positive: the first alone.
Support certify_support(const ConstraintRows &rows, const NormalSolver &solver, const CentralPath &path,
                        const std::vector<char> &guess, StressCone &out) {
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
    project_on_balance(on, *inner, f);
    mean = mean_size(f);
    size_t at = 0;
    for (size_t k = 0; k < m; ++k)
      if (out.carrying[k]) out.force[k] = f[at++] / mean;
    // A guess that carries nothing loses its forces in the projection.
    if (!(mean > least_rest)) return Support::no;
    if (!(*std::min_element(f.begin(), f.end()) > RoundingTuning::zero * mean)) return Support::no;
  }
  if (count == m) return Support::whole;
  // Opens what does not carry; what carries is closed again by the nearest correction.
  std::vector<double> x = path.x(), y(m);
  rows.multiply(x.data(), y.data());
  if (count > 0) {
    std::vector<double> open;
    for (size_t k = 0; k < m; ++k)
      if (out.carrying[k]) open.push_back(y[k]);
    const std::vector<double> back = nearest_motion(on, *inner, open);
    for (int32_t i = 0; i < sub.nodes; ++i)
      for (int c = 0; c < sub.dim; ++c) x[static_cast<size_t>(sub.sphere[i]) * sub.dim + c] -= back[i * sub.dim + c];
    // The strain of both is measured by the mean contact distance of its own rows.
    for (int q = 0; q < rows.strains; ++q)
      x[rows.g.unknowns() + q] -= back[sub.unknowns() + q] * rows.length / kept.length;
    rows.multiply(x.data(), y.data());
  }
  const double size = largest_entry(x);
  double least = std::numeric_limits<double>::infinity(), closed = 0.0;
  for (size_t k = 0; k < m; ++k)
    if (out.carrying[k])
      closed = std::max(closed, std::fabs(y[k]));
    else
      least = std::min(least, y[k]);
  out.motion = std::move(x);
  const bool opens = least > RoundingTuning::sure * size && closed < RoundingTuning::zero * size;
  return opens ? Support::whole : count > 0 ? Support::positive : Support::no;
}

// Least opening of a contact by x, over the largest displacement.
double least_opening(const ConstraintRows &rows, const std::vector<double> &x) {
  std::vector<double> y(rows.rows());
  rows.multiply(x.data(), y.data());
  const double size = largest_entry(x);
  return size > 0.0 ? *std::min_element(y.begin(), y.end()) / size : 0.0;
}

// A set with a positive state, and the forces of the path on all other contacts.
void keep_positive(const CentralPath &path, const std::vector<char> &guess, const std::vector<double> &force,
                   std::vector<char> &positive, std::vector<double> &path_force) {
  positive = guess;
  path_force = path.f();
  double sum = 0.0, count = 0.0;
  for (size_t k = 0; k < guess.size(); ++k)
    if (guess[k]) sum += path.f()[k], count += 1.0;
  for (size_t k = 0; k < guess.size(); ++k) path_force[k] = guess[k] ? force[k] : path.f()[k] * count / sum;
}

// The analytic centre of the states on K+: minimises - sum log w over w = w0 + A u, whose gradient is - A^T f with
// f = 1 / w, by damped Newton steps. w: 1 / f of a state near it, or all ones; then the unit solver makes the first
// step. Returns the forces, balanced to rounding, mean 1; empty when one of them vanishes.
std::vector<double> centre(const ConstraintRows &rows, const NormalSolver &unit, std::vector<double> w, bool ones,
                           int &factorisations) {
  const size_t m = rows.rows();
  std::vector<double> f(m), step(rows.columns()), dw(m), weight(m);
  NormalSolver solver(rows);
  double last = std::numeric_limits<double>::infinity();
  for (int pass = 0; pass < Tuning::most_steps; ++pass) {
    CallScope::report_share();
    const double widest = *std::max_element(w.begin(), w.end());
    if (!(widest < 1.0 / Tuning::least_mu * *std::min_element(w.begin(), w.end()))) return {};
    for (size_t k = 0; k < m; ++k) f[k] = 1.0 / w[k], weight[k] = f[k] * f[k];
    rows.transpose(f.data(), step.data());
    const std::vector<double> gradient = step;
    if (ones && pass == 0) {
      unit.solve(step.data());
    } else {
      solver.factorise(weight, 1e-13 * *std::max_element(weight.begin(), weight.end()));
      ++factorisations;
      solver.solve(step.data());
    }
    double decrement = 0.0;
    for (size_t k = 0; k < step.size(); ++k) decrement += gradient[k] * step[k];
    // A damped step leaves at most 2 d^2 of d, the root of the decrement, and the longer step is taken to do so too:
    // a larger one is rounding.
    if (!(decrement <= 4.0 * last * last)) break;
    if (pass > 0 || !ones) last = decrement;  // a step by the unit solver, of another shift, is no measure
    rows.multiply(step.data(), dw.data());
    // The damped step stays inside and lowers the sum. As the decrement vanishes, both lengths go to 1.
    const double length = std::max(1.0 / (1.0 + std::sqrt(decrement)), best_length(w, dw));
    for (size_t k = 0; k < m; ++k) w[k] += length * dw[k];
    if (decrement < 1e-12) break;
  }
  for (size_t k = 0; k < m; ++k) f[k] = 1.0 / w[k];
  double mean = mean_size(f);
  for (double &v : f) v /= mean;
  project_on_balance(rows, unit, f);
  mean = mean_size(f);
  for (double &v : f) v /= mean;
  if (*std::min_element(f.begin(), f.end()) <= RoundingTuning::zero) f.clear();
  return f;
}

}  // namespace

StressCone find_stress_cone(const ConstraintRows &rows, const NormalSolver &solver, int64_t states) {
  if (states == 0 || states == 1) return of_one_state(rows, solver, states);
  const size_t m = rows.rows();
  StressCone out;
  // Equal forces, balanced: where none of them pulls, every contact carries.
  std::vector<double> equal(m, 1.0);
  project_on_balance(rows, solver, equal);
  const double mean = mean_size(equal);
  if (mean > least_rest && *std::min_element(equal.begin(), equal.end()) > RoundingTuning::sure * mean) {
    out.decided = true, out.carrying.assign(m, 1), out.force = equal;
    for (double &v : out.force) v /= mean;
    const std::vector<double> f = centre(rows, solver, std::vector<double>(m, 1.0), true, out.factorisations);
    if (!f.empty()) out.force = f;
    return out;
  }
  CentralPath path(rows);
  double next = Tuning::next_guess * Tuning::next_guess, widest = RigidityTuning::flex_rounding;
  std::vector<double> opens_all;
  bool going = true;
  while (going && !out.decided && path.steps() < Tuning::most_steps && path.mu() > Tuning::least_mu) {
    going = path.step();
    if (path.mu() > next) continue;
    next = Tuning::next_guess * path.mu();
    std::vector<std::vector<char>> tried;
    const auto certify = [&](const std::vector<char> &guess, bool dropped) {
      if (out.decided || (!dropped && std::find(tried.begin(), tried.end(), guess) != tried.end()))
        return Support::positive;
      if (!dropped) tried.push_back(guess);
      Support found = certify_support(rows, solver, path, guess, out);
      // Pulled by less than doubles resolve, contacts may hold the rest all the same.
      if (found == Support::whole && dropped) found = Support::positive;
      out.decided = found == Support::whole;
      const auto size = [](const std::vector<char> &on) { return std::count(on.begin(), on.end(), 1); };
      std::vector<char> &positive = dropped ? out.pushed : out.positive;
      if (found == Support::positive && size(guess) > size(positive))
        keep_positive(path, guess, out.force, positive, dropped ? out.pushed_force : out.path_force);
      return found;
    };
    std::vector<char> guess(m, 1);
    for (int k = 0; k < Tuning::most_drops && certify(guess, k > 0) == Support::no; ++k)
      if (!drop_pulled(out.force, guess)) break;
    for (const std::vector<char> &other : guess_support(path)) certify(other, false);
    const double opening = least_opening(rows, path.x());
    if (opening > widest) widest = opening, opens_all = path.x();
  }
  if (!out.decided && !opens_all.empty()) {  // no force is balanced where a motion opens all contacts
    out.decided = true, out.motion = std::move(opens_all);
    out.carrying.assign(m, 0), out.force.assign(m, 0.0);
  }
  out.factorisations += path.steps();
  if (!out.decided || std::count(out.carrying.begin(), out.carrying.end(), 1) == 0) return out;
  const RigidityMatrix sub = subset(rows.g, out.carrying);
  const ConstraintRows kept(sub, rows.strains > 0);
  NormalSolver unit(kept);
  unit.factorise(std::vector<double>(kept.rows(), 1.0), solver.shift());
  ++out.factorisations;
  std::vector<double> w;
  for (size_t k = 0; k < m; ++k)
    if (out.carrying[k]) w.push_back(path.w()[k] / path.mu());
  const std::vector<double> f = centre(kept, unit, std::move(w), false, out.factorisations);
  for (size_t k = 0, at = 0; k < m && !f.empty(); ++k)
    if (out.carrying[k]) out.force[k] = f[at++];
  return out;
}

}  // namespace jam::inside
