// From any valid packing to a certified jammed one. Data flow:
//   packing -> [pairs -> LP -> checked answer -> safe step]* -> contact network -> polish -> certificate
#pragma once
#include <functional>

#include "core/notes.hpp"
#include "crunch/record.hpp"
#include "crunch/tuning.hpp"
#include "network/contact_network.hpp"

namespace jam::inside {

// Options of jam_crunch: defaults and what is refused.
jam_crunch_options default_crunch_options();
// Throws for options that make no sense and for packings that cannot be crunched.
void check_options(const Packing &p, const jam_crunch_options &o);

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

// What a crunch will cost, from the particle graph and its elimination tree alone.

// Memory and work of a crunch before it runs. Throws for bad options.
[[gnu::cold]] jam_estimate_report estimate(const Packing &start, const jam_crunch_options &o);

}  // namespace jam::inside
