// The opaque handle: in C++ the C name is the class, so nothing is cast.
#pragma once
#include <atomic>
#include <memory>
#include <optional>
#include "capi/call_gate.hpp"
#include "core/call_scope.hpp"
#include "core/monitor.hpp"
#include "core/packing.hpp"
#include "crunch/history.hpp"
#include "dynamics/dynamics.hpp"
#include "dynamics/isoconfigurational.hpp"
#include "dynamics/observer.hpp"
#include "jam/jam.h"
#include "network/contact_network.hpp"
#include "soft/decompression.hpp"

struct jam_system {
  jam::Packing packing;          // the view buffers; their addresses stay for the life of the handle
  jam::ContactNetwork contacts;  // valid when has_report
  jam_crunch_report report{};
  bool has_report = false;
  std::vector<jam::HistoryRow> history;  // valid when has_history
  bool has_history = false;
  std::vector<jam::KeptStep> kept_steps;          // of the same crunch; empty unless asked for
  std::vector<jam::SoftRow> soft_history;         // of the last decompression; empty without one
  const jam::History *crunching = nullptr;        // of the crunch that runs
  std::optional<jam::CrunchStage> crunch_paused;  // the last change of spheres was a crunch that did not reach its end
  jam::Monitor monitor;
  double memory_limit = jam::default_memory_limit();  // bytes that one call may take
  mutable jam::CallGate gate;
  std::unique_ptr<jam::Dynamics> paused;               // was stopped early and can be resumed
  const jam::Dynamics *live = nullptr;                 // runs now, while callbacks are called
  std::unique_ptr<jam::Isoconfigurational> runs;       // the last ones from one configuration, complete or not
  int64_t sweeps = 0;                                  // of Monte Carlo made so far: where its streams go on
  std::unique_ptr<jam::Observer> observer;             // what was observed
  bool observing = false;                              // and still is
  double packing_fraction = 0.0, diameter_mean = 0.0;  // of the diameters in `packing`: note_diameters()
  bool monodisperse = true;

  // Copies positions, diameters and velocities into the view buffers, whose addresses stay. Never throws.
  void show(const jam::Packing &state) noexcept;
  // What jam_info tells of the diameters, once for each change of them.
  void note_diameters() noexcept;
  // The same as show, for a verb's result: a stage that waits has lost its packing.
  void commit(const jam::Packing &result) noexcept;
  void drop_results() noexcept { has_report = has_history = false; }
};
