#include "soft/relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "soft/tuning.hpp"

namespace jam::inside {
namespace {

double largest(const std::vector<double> &force, size_t n, int d, const std::vector<char> *of) {
  double most = 0.0;
  for (size_t i = 0; i < n; ++i) {
    if (of && !(*of)[i]) continue;
    double f2 = 0.0;
    for (int c = 0; c < d; ++c) f2 += force[i * d + c] * force[i * d + c];
    most = std::max(most, f2);
  }
  return std::sqrt(most);
}

}  // namespace

double Relaxation::residual() const {
  if (sums.coincident > 0) return std::numeric_limits<double>::infinity();
  const double mean = sums.mean_force();
  if (mean > weak_force) return std::max(largest(force, state.n(), state.dim(), nullptr) / mean, sums.stress);
  return at_rest() || weak_force > 0.0 ? 0.0 : std::numeric_limits<double>::infinity();
}

double Relaxation::stable_residual() const {
  if (sums.coincident > 0) return std::numeric_limits<double>::infinity();
  const SoftContacts contacts = state.contacts();
  const std::vector<char> on = stable_contacts(state, contacts);
  std::vector<char> stable(state.n(), 0);
  double sum = 0.0;
  int64_t count = 0;
  for (size_t k = 0; k < contacts.size(); ++k) {
    if (!on[k]) continue;
    for_spheres(state.pairs().i[contacts.pair[k]], state.pairs().j[contacts.pair[k]],
                [&](int32_t s) { stable[s] = 1; });
    sum += contacts.force[k];
    ++count;
  }
  if (count == 0 || sums.mean_force() <= weak_force) return residual();
  return std::max(largest(force, state.n(), state.dim(), &stable) * static_cast<double>(count) / sum, sums.stress);
}

bool Relaxation::yields() const {
  if (state.cell().beyond.empty()) return false;
  const std::vector<double> e = strain_between(start, state.base().cell);
  return std::any_of(e.begin(), e.end(), [](double x) { return std::fabs(x) > RelaxTuning::most_strain; });
}

bool Relaxation::must_stop(DescentEnd &end, bool long_steps) const {
  if (effort.evaluations >= effort.max_evaluations) {
    end = DescentEnd::limit;
    return true;
  }
  if (effort.monitor && (long_steps || effort.evaluations % 64 == 1)) {
    jam_progress p = progress_of(effort.phase);
    p.packing_fraction = effort.packing_fraction;
    p.pressure = effort.pressure;
    p.steps = effort.steps;
    p.factorisations = effort.factorisations;
    if (effort.monitor->report(p) || effort.monitor->interrupted()) {
      end = DescentEnd::interrupted;
      return true;
    }
    if (yields()) {
      end = DescentEnd::yields;
      return true;
    }
  }
  return false;
}

}  // namespace jam::inside
