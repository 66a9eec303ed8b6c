// One isoconfigurational run of Metropolis Monte Carlo.
#include <algorithm>
#include <cmath>

#include "dynamics/isoconfigurational/isoconfigurational.hpp"
#include "dynamics/tuning.hpp"

namespace jam::inside {

void run_metropolis(const RunPlan &plan, int64_t run, const RunControl &control, RunRecord &record) {
  const std::unique_ptr<MonteCarlo> mc =
      make_engine_for(control, record, [&] { return make_monte_carlo(plan.start, plan.monte_carlo, run); });
  if (!mc) return;
  const double n = static_cast<double>(plan.start.n()), d = plan.start.dim;
  const size_t coordinates = plan.start.position.size();
  int64_t sweep = 0;
  for (size_t m = 0; m < plan.instants.size(); ++m) {
    for (const int64_t goal = std::llround(plan.instants[m]); sweep < goal; ++sweep) {
      mc->sweep(sweep);
      if (sweep % EnsembleTuning::sweeps_between_looks != 0) continue;
      if (!control.stopped()) continue;
      record.stop_reason = control.monitor.why_interrupted();
      return;
    }
    std::copy(mc->displacement().begin(), mc->displacement().end(),
              record.displacement.begin() + static_cast<std::ptrdiff_t>(m * coordinates));
    double *series = &record.series[m * isoconf_columns];
    series[JAM_ISOCONF_TIME] = static_cast<double>(sweep);
    const double energy = mc->energy() / n;
    series[JAM_ISOCONF_ENERGY] = energy;
    series[JAM_ISOCONF_ENERGY2] = energy * energy;
    series[JAM_ISOCONF_PRESSURE] = plan.monte_carlo.alpha > 0.0
                                       ? 1.0 + mc->virial() / (d * n * plan.monte_carlo.temperature)
                                       : std::numeric_limits<double>::quiet_NaN();
    take_moments(plan, m, record);
  }
  record.acceptance = mc->counts.acceptance();
}

}  // namespace jam::inside
