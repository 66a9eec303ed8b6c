// The opaque handle: in C++ the C name is the class, so nothing is cast.
#pragma once
#include <memory>
#include <optional>
#include <string>

#include "capi/call_gate.hpp"
#include "capi/results.hpp"
#include "core/call_scope.hpp"
#include "core/monitor.hpp"
#include "core/notes.hpp"
#include "core/packing.hpp"
#include "dynamics/dynamics.hpp"
#include "dynamics/isoconfigurational/isoconfigurational.hpp"
#include "dynamics/observer.hpp"

namespace jam::inside {

inline std::unique_ptr<Dynamics> clone(const Dynamics &paused) {
  return read_dynamics(paused.packing(), write_dynamics(paused));
}
template <class T>
std::unique_ptr<T> clone(const T &x) {
  return std::make_unique<T>(x);
}
// A pointer with the meaning of a value: its copy owns a copy.
template <class T>
class Owned : public std::unique_ptr<T> {
 public:
  using std::unique_ptr<T>::unique_ptr;
  using std::unique_ptr<T>::operator=;
  Owned() = default;
  Owned(Owned &&) noexcept = default;
  Owned(const Owned &other) : std::unique_ptr<T>(other ? clone(*other) : nullptr) {}
  Owned &operator=(Owned &&) noexcept = default;
  Owned &operator=(const Owned &) = delete;
};

// All that a handle holds between two calls. jam_copy copies it member by member, so a new member cannot be forgotten.
struct SystemState : Results {
  Packing packing;                               // the view buffers; their addresses stay for the life of the handle
  std::optional<CrunchStage> crunch_paused;      // the last change of spheres was a crunch that did not reach its end
  Owned<Dynamics> paused;                        // was stopped early and can be resumed
  Owned<Isoconfigurational> runs;                // the last ones from one configuration, complete or not
  int64_t sweeps = 0;                            // of Monte Carlo made so far: where its streams continue
  Owned<Observer> observer;                      // what was observed
  bool observing = false;                        // and still is
  double memory_limit = default_memory_limit();  // bytes that one call may take
  double packing_fraction = 0.0, diameter_mean = 0.0;  // of the diameters in `packing`: update_diameters()
  bool monodisperse = true;
  Notes notes;  // on how it was made

  Results &results() { return *this; }
};

// What moves the packing while a callback writes a checkpoint; both NULL: nothing.
struct Moving {
  const Dynamics *dynamics = nullptr;
  const CrunchStage *crunch = nullptr;
};
// results_archive.cpp: what a checkpoint holds beside the packing. What moves takes the place of what was paused, and
// there are no results of a packing that moves.
std::string archive_beside(const SystemState &s, const Moving &moving);
// Into a state that holds the packing alone. Damaged bytes throw JAM_E_FORMAT.
void read_beside(SystemState &s, std::string bytes);

}  // namespace jam::inside

struct jam_system : jam::inside::SystemState {
  jam_system() = default;
  explicit jam_system(const jam::inside::SystemState &state) : SystemState(state) {}

  // Of the call that runs now; a copy has none of it.
  const jam::inside::History *crunching = nullptr;  // of the crunch that runs
  const jam::inside::Dynamics *live = nullptr;      // runs now, while callbacks are called
  mutable jam::inside::Monitor monitor;             // const calls note there which cancels they have answered
  mutable jam::inside::CallGate gate;

  // Copies positions, diameters and velocities into the view buffers, whose addresses stay. Never throws.
  void show(const jam::inside::Packing &state) noexcept;
  // What jam_info gives of the diameters, once for each change of them.
  void update_diameters() noexcept;
  // The end of every move: shows its packing and results. Drops a paused stage and all earlier results. Pressures
  // are kept only by commit_measured, after dynamics that measured them for this packing.
  void commit(const jam::inside::Packing &result, jam::inside::Results &&found = {}) noexcept;
  void commit_measured(const jam::inside::Packing &result, jam::inside::Results &&found = {}) noexcept;
};
