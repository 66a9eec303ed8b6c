// What the phases of a crunch pass to each other: data alone. control.hpp has what all phases do with it.
#pragma once
#include <cstdint>

#include "crunch/approach/active_set.hpp"
#include "crunch/crunch.hpp"
#include "lp/interior_point.hpp"
#include "verdict/verdict.hpp"

namespace jam::inside {

// approach: sequential LPs. barrier_path: Newton steps on the true gaps. identify: contacts, last digits, verdict.
// narrow_lps: where these leave it open which contacts carry force. Each phase function returns the phase that follows.
enum class Phase { approach, barrier_path, identify, narrow_lps, done };

struct LastLp {
  PairList pairs;
  PackingLp lp;
  LpSolution answer;
  ActiveSet active;
  bool early = false;    // it ended before its optimum: its duality gap leaves room for a gain
  int64_t at_bound = 0;  // displacements that its bound ended
};

struct NextLp {
  double bound = 0.0;
  double gain_tolerance = 0.0;  // of the options; the default one once contacts did not close at a looser one
  StrainBasis strain;           // that it may choose, once the cell is free
  Multipliers multipliers;      // of the last LP or path
  double moved = 1.0;           // longest step since then; 0 after a path that reached its end
  int stalled = 0;              // LPs below the gain tolerance so far
};

struct CrunchFindings {
  bool narrow = false;     // the last LPs were narrow ones
  bool polished = false;   // the last polish closed its contacts
  PackingVerdict verdict;  // on the packing as it ends
  int32_t strictly_jammed = JAM_VERDICT_UNTESTED;
  bool start_tested = false;  // the verdict on the start was asked for
};

struct CrunchState {
  CrunchState(const Packing &packing_of_call, const jam_crunch_options &options, Monitor &monitor_of_call,
              History &history_of_call, const CrunchHooks &hooks_of_call);

  const Packing &start;
  const jam_crunch_options o;
  const Tuning tuning;
  Monitor &monitor;
  History &history;  // its stage is where a stopped crunch continues
  const CrunchHooks &hooks;
  CrunchResult out;
  NewtonSystem system;
  InteriorPoint interior_point{system, tuning.single};
  LastLp last;
  NextLp next;
  CrunchFindings found;
  double first_gain = 0.0;  // of an LP, for the progress
};

}  // namespace jam::inside
