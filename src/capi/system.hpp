// The opaque handle: in C++ the C name is the class, so nothing is cast.
#pragma once
#include <atomic>
#include <cmath>
#include <limits>
#include <optional>
#include <thread>

#include "crunch/crunch.hpp"
#include "dynamics/isoconfigurational/isoconfigurational.hpp"
#include "dynamics/observer.hpp"
#include "soft/shear.hpp"

namespace jam::inside {

// What a call answers: its status, and the sentence that jam_last_error gives for one above zero.
struct Answer {
  jam_status status;
  std::string text;  // empty: text_of_status(status)
  Answer(jam_status code) : status(code) {}
  Answer(jam_status code, std::string why) : status(code), text(std::move(why)) {}
};

// status.cpp: what a status above zero means where a call has no more to say.
const char *text_of_status(jam_status status);
// Of a call that ended for a jam_stop_reason: what stopped it, and the way out.
Answer stopped(jam_status status, int32_t stop_reason);

// The same of runs that continue with resume = 1; another call starts again.
Answer stopped_run(jam_status status, int32_t stop_reason);

// Who may enter a handle: any number of const calls together, or one call that changes it. The thread of that call may
// also make const calls, from its callbacks.
class CallGate {
 public:
  // Each try returns false when the handle is taken; after true the matching leave must follow.
  bool enter_alone() {
    int nobody = 0;
    if (!calls_.compare_exchange_strong(nobody, alone, std::memory_order_acquire)) return false;
    owner_.store(std::this_thread::get_id(), std::memory_order_relaxed);
    return true;
  }
  void leave_alone() {
    owner_.store(std::thread::id(), std::memory_order_relaxed);
    calls_.store(0, std::memory_order_release);
  }
  bool enter_const() {
    int count = calls_.load(std::memory_order_relaxed);
    do {
      if (count == alone) return false;
    } while (!calls_.compare_exchange_weak(count, count + 1, std::memory_order_acquire));
    return true;
  }
  void leave_const() { calls_.fetch_sub(1, std::memory_order_release); }
  // This thread runs the call that has the handle alone.
  bool owned() const { return owner_.load(std::memory_order_relaxed) == std::this_thread::get_id(); }

 private:
  static constexpr int alone = -1;
  std::atomic<int> calls_{0};  // const calls inside, or `alone`
  std::atomic<std::thread::id> owner_{std::thread::id()};
};

// What calls found out about the packing that a handle holds now. It is one value: every call that moves spheres clears
// all of it (jam_system::commit), copies and checkpoints take all of it.
struct Results {
  ContactNetwork contacts;  // of the report, or by distance; ask known_contacts or contacts_of_any_kind
  // Contacts are all pairs within this gap (jam_contacts_by_distance): without forces and without a report. NaN: not
  // so.
  double contact_gap = std::numeric_limits<double>::quiet_NaN();
  jam_crunch_report report{};
  bool has_report = false;
  std::vector<HistoryRow> history;  // of the crunch that led here; valid when has_history
  bool has_history = false;
  std::vector<KeptStep> kept_steps;     // of the same crunch; empty unless requested
  std::vector<ShearRow> shear_history;  // of the shear that led here; empty without one, not in checkpoints
  std::vector<SoftRow> soft_history;    // of the decompression that led here; empty without one

  // The contacts of a network that balances. NULL where no call searched for them, or a crunch was stopped before it
  // knew them.
  const ContactNetwork *known_contacts() const { return has_report && report.rattlers >= 0 ? &contacts : nullptr; }
  bool by_distance() const { return std::isfinite(contact_gap); }
  const ContactNetwork *contacts_of_any_kind() const { return by_distance() ? &contacts : known_contacts(); }
  void take_contacts_by_distance(ContactNetwork &&found, double gap) {
    contacts = std::move(found), contact_gap = gap;
    report = {}, has_report = false;
  }

  // results_archive.cpp. Reading throws JAM_E_FORMAT unless they fit the packing p.
  void archive(Archive &a, const Packing &p);
};

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
// results_archive.cpp: what a checkpoint holds beside the packing, which is `now`. What moves takes the place of what
// was paused, and there are no results of a packing that moves.
std::string archive_beside(const SystemState &s, const Moving &moving, const Packing &now);
// Into a state that holds the packing alone. Damaged bytes throw JAM_E_FORMAT.
void read_beside(SystemState &s, std::string bytes);

// Reports of calls that were stopped before they had made anything: measured numbers are NaN, counts of what was never
// searched for -1, and the packing fraction is that of the state. Work done is 0, which is true.
inline void set_blank(const SystemState &s, jam_md_report &r) {
  r = {};
  r.pressure = r.pressure_error = r.energy_drift = r.max_overlap = r.growth_rate = r.collisions_per_second = NAN;
  r.packing_fraction = s.packing_fraction;
}
inline void set_blank(const SystemState &s, jam_monte_carlo_report &r) {
  r = {};
  r.next_sweep = s.sweeps;
  r.acceptance = r.swap_acceptance = r.step = r.energy = r.energy_error = r.pressure = r.pressure_error =
      r.trials_per_second = NAN;
}
inline void set_blank(const SystemState &, jam_isoconf_report &r) {
  r = {};
  r.energy_drift = r.max_overlap = r.step = r.acceptance = NAN;
}
inline void set_blank(const SystemState &s, jam_relax_report &r) {
  r = {};
  r.force_residual = r.energy = r.pressure = r.distance = r.jammed_fraction = r.coordination = r.mean_overlap =
      r.max_overlap = r.stress_residual = NAN;
  r.packing_fraction = s.packing_fraction;
  r.contacts = r.stable = r.rattlers = -1;
}
inline void set_blank(const SystemState &s, jam_decompress_report &r) {
  r = {};
  r.same_network = -1;
  r.force_residual = r.energy = r.pressure = r.distance = r.jammed_fraction = r.crunch_fraction = r.force_difference =
      r.coordination = NAN;
  r.packing_fraction = s.packing_fraction;
  r.contacts = r.common_contacts = r.rattlers = -1;
}
inline void set_blank(const SystemState &s, jam_radii_report &r) {
  r = {};
  r.value = r.balance_residual = r.max_contact_gap = r.min_gap = r.min_force = r.radius_smallest = r.radius_largest =
      r.polydispersity = NAN;
  r.packing_fraction = s.packing_fraction;
  r.contacts = r.rattlers = r.at_bounds = r.excess = -1;
}
inline void set_blank(const SystemState &s, jam_shear_report &r) {
  r = {};
  r.strain = r.stress = r.pressure = r.energy = r.first_event = r.peak_stress = r.peak_strain = NAN;
  r.packing_fraction = s.packing_fraction;
  r.contacts = r.rattlers = -1;
}

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
