// What the phases of a crunch pass to each other.
#pragma once
#include <map>

#include "crunch/crunch.hpp"
#include "lp/interior_point.hpp"
#include "verdict/verdict.hpp"

namespace jam::inside {

// Which rows of an LP carry force, and which spheres they touch.
struct ActiveSet {
  std::vector<size_t> rows;           // indices into the LP's pairs, ascending
  std::vector<int32_t> coordination;  // n
  int64_t stable = 0;                 // spheres with a force
};

// One flag a row: it carries force, or its slack is below `closed`.
std::vector<char> force_carrying(const PackingLp &lp, const LpSolution &answer, double closed);
ActiveSet find_active_set(const PackingLp &lp, const LpSolution &answer, double closed);
// Largest |s| over spheres with a force; over all, mean included, if no sphere has one.
double largest_step(const LpSolution &answer, const ActiveSet &active, int dim, uint32_t closed_axes = 0);
// Of displacements x (n, d) over `unit`, without their mean along all axes but those closed by walls (bits). With
// `coordination` only spheres that have a contact count.
struct Spread {
  double largest = 0.0, mean_square = 0.0;
};
Spread spread(const std::vector<double> &x, int dim, double unit, const std::vector<int32_t> *coordination = nullptr,
              uint32_t closed_axes = 0);
// The active rows as contacts of p: unit vectors, gaps, forces from the multipliers.
ContactNetwork make_contacts(const Packing &p, const PairList &pairs, const LpSolution &answer,
                             const ActiveSet &active);
// True when more rows carry force than one state of self-stress has: a crystal in the making, whose path meets one
// saddle after the other. y: multipliers, sum 1; isostatic: d n.
bool hyperstatic(const std::vector<double> &y, double isostatic, const Tuning &tuning);

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

// Closed pairs of the start as in the test of jamming, and those that digits cannot distinguish from them. Found before
// the work: after it the time of the call may be over.
struct Touching {
  std::map<std::pair<int32_t, int32_t>, int64_t> images;  // that touch, of each pair
  int64_t total = -1;                                     // -1: not known, as the call was stopped
};

struct CrunchState {
  CrunchState(const Packing &p, const jam_crunch_options &options, Monitor &m, History &h,
              const CrunchHooks &for_tests);

  const Packing &start;
  const jam_crunch_options o;
  const CrunchHooks &hooks;
  const Tuning tuning = hooks.tuning;
  Monitor &monitor;
  History &history;  // its stage is where a stopped crunch continues
  CrunchResult out;
  NewtonSystem system;
  InteriorPoint interior_point{system, tuning.single};
  LastLp last;
  NextLp next;
  CrunchFindings found;
  Touching touching;
  double first_gain = 0.0;  // of an LP, for the progress
};

Touching find_touching(const Packing &start);

// The final network certified, the verdict and the counters of the work.
void report_end(CrunchState &s);
// Out of memory, or no LP solved: the state is the last good one, without contacts. It allocates only what it must.
void report_failure(CrunchState &s);
// What the crunch did to the packing that it was given.
void report_changes(CrunchState &s);

}  // namespace jam::inside
