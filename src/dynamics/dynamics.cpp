#include "dynamics/dynamics.hpp"

#include "core/error.hpp"
#include "dynamics/event_driven/run.hpp"
#include "dynamics/isoconfigurational/isoconfigurational.hpp"

namespace jam::inside {

// Beside the phase. Checkpoints of packings outlive it: a stage of another form is refused, the rest of a file is not.
// Isoconfigurational runs have the form without it too.
static constexpr int32_t form = 1 << 8;

std::string write_dynamics(const Dynamics &dynamics) {
  Archive a;
  int32_t phase = dynamics.phase() | form;
  a(phase);
  const_cast<Dynamics &>(dynamics).archive(a);  // writing changes nothing
  return a.bytes();
}

std::unique_ptr<Dynamics> read_dynamics(const Packing &p, std::string bytes) {
  Archive from(std::move(bytes));
  int32_t phase = 0;
  from(phase);
  if ((phase & form) == 0 && phase != JAM_PHASE_ISOCONF)
    fail(JAM_E_FORMAT, "the checkpoint contains a stage of another version of libjam");
  phase &= ~form;
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
