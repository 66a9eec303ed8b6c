// From any valid packing to a certified jammed one. Data flow:
//   packing -> [pairs -> LP -> checked answer -> safe step]* -> contact network -> polish -> certificate
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/monitor.hpp"
#include "core/notes.hpp"
#include "core/packing.hpp"
#include "crunch/options.hpp"
#include "crunch/record.hpp"
#include "crunch/tuning.hpp"
#include "lp/packing_lp.hpp"
#include "network/contact_network.hpp"

namespace jam::inside {

struct CrunchResult {
  Packing packing;          // always valid: the last good state
  ContactNetwork contacts;  // of the last LP; empty if none was solved
  jam_crunch_report report{};
  jam_status status = JAM_OK;
  Notes notes;       // what became of the vectors of a free cell
  std::string text;  // why, when status is not JAM_OK; empty where the stop reason says it all
};

// For tests and benches alone: what no input does at will. Each may be empty.
struct CrunchHooks {
  Tuning tuning;
  std::function<void(LpSolution &, jam_lp_solver)> answer;  // an LP's answer before it is checked
  std::function<void(const Packing &, ContactNetwork &)> before_polish;
};

// Throws for bad options, and where the estimate exceeds the memory of the call, else never: the result carries the
// status. history may be NULL. It ends with the steps of the
// attempt that is returned; its stage says where a stopped crunch begins, and where this one stopped.
CrunchResult crunch(const Packing &start, const jam_crunch_options &o, Monitor &monitor, History *history = nullptr,
                    const CrunchHooks *hooks = nullptr);

}  // namespace jam::inside
