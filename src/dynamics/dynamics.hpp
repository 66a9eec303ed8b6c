// What every dynamics has in common: run, observe, archive. Event-driven dynamics is EventDrivenRun
// (event_driven/run.hpp).
// A new dynamics derives from Dynamics and gets one line in read_dynamics (dynamics.cpp).
#pragma once
#include <functional>
#include <limits>
#include <memory>

#include "core/archive.hpp"
#include "core/monitor.hpp"
#include "core/packing.hpp"

namespace jam::inside {

class Observer;
constexpr int64_t not_begun = -1;  // in an archive: it was stopped before it had an engine
constexpr double no_limit = std::numeric_limits<double>::infinity();

// The first limit that is reached ends a call of Dynamics::run.
struct Limits {
  double per_particle = no_limit;  // collisions (or Monte Carlo moves) of each particle since the dynamics began
  double time = no_limit;          // simulated time since the dynamics began; Monte Carlo has none
  double wall_time = no_limit;     // seconds, of this call
};

// The listeners during a run; observer and on_snapshot may be empty.
struct Listeners {
  Monitor *monitor = nullptr;  // cancellation, progress, log
  Observer *observer = nullptr;
  std::function<void(const Packing &)> on_snapshot;  // called before a snapshot is reported
};

// A simulation that has begun and can pause between two events. A pause changes no bit of what follows.
class Dynamics {
 public:
  virtual ~Dynamics() = default;
  // The jam_phase of its verb: a paused simulation is resumed by that verb only.
  virtual int32_t phase() const = 0;
  // Adds to the report of the derived class. Returns JAM_OK at the aim, JAM_LIMIT or JAM_CANCELLED when paused.
  virtual jam_status run(const Limits &limits, const Listeners &listeners) = 0;
  // The state when the last run returned.
  virtual const Packing &packing() const = 0;
  // The state now, for listeners during a run.
  virtual Packing current() const = 0;
  // Writes or reads all that the coming events depend on. Observers are not part of it.
  virtual void archive(Archive &a) = 0;
};

// Bytes of a paused simulation, and the simulation that they hold; p is its packing. Damaged bytes throw JAM_E_FORMAT.
std::string write_dynamics(const Dynamics &dynamics);
std::unique_ptr<Dynamics> read_dynamics(const Packing &p, std::string bytes);

}  // namespace jam::inside
