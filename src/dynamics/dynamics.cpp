#include "dynamics/dynamics.hpp"

#include "dynamics/event_driven/run.hpp"
#include "dynamics/isoconfigurational/isoconfigurational.hpp"

namespace jam::inside {

std::string write_dynamics(const Dynamics &dynamics) {
  Archive a;
  int32_t phase = dynamics.phase();
  a(phase);
  const_cast<Dynamics &>(dynamics).archive(a);  // writing changes nothing
  return a.bytes();
}

std::unique_ptr<Dynamics> read_dynamics(const Packing &p, std::string bytes) {
  Archive from(std::move(bytes));
  int32_t phase = 0;
  from(phase);
  std::unique_ptr<Dynamics> dynamics;
  switch (phase) {
    case JAM_PHASE_RUN:
    case JAM_PHASE_COMPRESS:
      dynamics = std::make_unique<EventDrivenRun>(p, from);
      break;
    case JAM_PHASE_MONTE_CARLO:
      dynamics = std::make_unique<MonteCarloRun>(p, from);
      break;
    case JAM_PHASE_ISOCONF:
      dynamics = std::make_unique<Isoconfigurational>(p, from);
      break;
    default:
      Archive::check(false);
  }
  from.end();
  Archive::check(dynamics->phase() == phase);
  return dynamics;
}

}  // namespace jam::inside
