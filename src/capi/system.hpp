// The opaque handle: in C++ the C name is the class, so nothing is cast.
#pragma once
#include <atomic>
#include "core/contacts.hpp"
#include "core/monitor.hpp"
#include "core/packing.hpp"
#include "crunch/history.hpp"
#include "jam/jam.h"

struct jam_system {
  jam::Packing packing;          // the view buffers; their addresses stay for the life of the handle
  jam::ContactNetwork contacts;  // valid when has_report
  jam_report report{};
  bool has_report = false;
  std::vector<jam::HistoryRow> history;  // valid when has_history
  bool has_history = false;
  const jam::CrunchStep *step = nullptr;  // of the crunch that runs
  jam::Monitor monitor;
  std::atomic<bool> busy{false};

  // Moves a verb's result into the view buffers without changing their addresses. Never throws.
  void commit(const jam::Packing &result) noexcept;
  void drop_results() noexcept { has_report = has_history = false; }
};
