// What the phases of a crunch hand to each other.
#pragma once
#include <map>
#include <utility>
#include <vector>

#include "crunch/crunch.hpp"
#include "crunch/tuning.hpp"
#include "lp/interior_point.hpp"
#include "lp/packing_lp.hpp"
#include "network/rigidity_test.hpp"

namespace jam {

// approach: sequential LPs. barrier_path: Newton steps on the true gaps. identify: contacts, last digits, verdict.
// exact_vertex: narrow LPs where these leave it open.
enum class Phase { approach, barrier_path, identify, exact_vertex, done };

// Rows of an LP that carry force, and the spheres that they touch.
struct ActiveSet {
  std::vector<size_t> rows;           // indices into the LP's pairs, ascending
  std::vector<int32_t> coordination;  // n
  int64_t stable = 0;                 // spheres with a force
};
// One flag a row: it carries force, or its slack is below `closed`.
std::vector<char> force_carrying(const PackingLp &lp, const LpSolution &answer, double closed);
ActiveSet find_active_set(const PackingLp &lp, const LpSolution &answer, double closed);
// Largest |s| over spheres with a force, their mean taken out; over all spheres if no sphere has one.
double largest_step(const LpSolution &answer, const ActiveSet &active, int dim);
// Contacts above those of one state of self-stress.
int64_t excess_of(const ActiveSet &active, int dim);
// The active rows as contacts of p: unit vectors, gaps, forces from the multipliers.
ContactNetwork make_contacts(const Packing &p, const PairList &pairs, const LpSolution &answer,
                             const ActiveSet &active);

struct CrunchState {
  CrunchState(const Packing &start, const jam_crunch_options &o, Monitor &monitor, History &history,
              const CrunchHooks &hooks);

  void stop(jam_stop_reason reason, jam_status status) { out.report.stop_reason = reason, out.status = status; }
  // True where the call was cancelled or its time is over; the stop reason then says which.
  bool interrupted();
  // Part of the crunch that is done: at this part of a path (NaN: off it), or after an LP with this gain.
  double done(double path, double gain);
  // Calls the progress callback at once; with `finished` it may ask for the details of the last step. True: stop.
  bool show(jam_phase phase, double gain, double step, bool finished = true);

  const jam_crunch_options o;
  const Tuning tuning;
  Monitor &monitor;
  History &history;
  const CrunchHooks &hooks;
  CrunchResult out;
  NewtonSystem system;
  InteriorPoint interior_point{system, tuning.single};
  // the last LP
  PairList pairs;
  PackingLp lp;
  LpSolution answer;
  ActiveSet active;
  bool early = false;       // it ended before its optimum: its duality gap leaves room for a gain
  int64_t at_bound = 0;     // displacements that its bound ended
  Multipliers multipliers;  // of the last LP or path
  double bound = 0.0;       // of the next LP
  double gain_tolerance;    // of the options; the default one once contacts did not close at a looser one
  StrainBasis strain;       // of the LPs, once the cell is free
  double moved = 1.0;       // longest step since `multipliers`; 0 after a path that reached its end
  int stalled = 0, kicks = 0;
  double first_gain = 0.0;
  bool path_taken = false;
  bool exact = false;     // the last LPs were narrow ones
  bool polished = false;  // the last polish closed its contacts
  bool jammed = false;    // by the test of the final network
  int32_t strictly_jammed = JAM_VERDICT_UNTESTED;
};

// free_cell.cpp: the cell joins the LPs, after the packing has reached its optimum at fixed cell.
bool frees_cell(const CrunchState &s);
Phase free_cell(CrunchState &s);
// Moves along the flex of a strict test. False without one, or where near pairs block it.
bool leave_strained_saddle(CrunchState &s, const PackingVerdict &strict);
void shorten_cell(Packing &p);  // where strains made its vectors long
// approach.cpp. Each phase function returns the phase that follows.
Phase approach(CrunchState &s);
// The LP of this bound at the present packing, into s.pairs and s.lp. Returns the reach of its pairs.
double build_lp(CrunchState &s, double reach);
// Moves by the answer, and records it.
struct LpStep {
  double gain, longest, part;
};
LpStep make_step(CrunchState &s, double reach);
// exact_vertex.cpp
Phase exact_vertex(CrunchState &s);
// saddle.cpp: moves along the flex of a saddle until pairs block it.
enum class Kick { none, blocked, free };
Kick leave_saddle(CrunchState &s, const PackingVerdict &verdict);
// path_phase.cpp
Phase follow_path(CrunchState &s);
bool path_is_shorter(const CrunchState &s, double gain, double step);
// finite_gap.cpp: ends a crunch that was asked for a duality gap, with contacts named by an LP. False where
// their forces do not balance or leave a larger gap, or when interrupted.
bool ends_at_gap(CrunchState &s, const Multipliers &path);
// identify.cpp
Phase identify(CrunchState &s);
Phase judge(CrunchState &s);
void finish(CrunchState &s);
void finish_failed(CrunchState &s);
// changes.cpp: what the crunch did to the packing that it was given, into the report. Which pairs touched is found
// before the work: after it the time of the call may be over.
struct Touching {
  std::map<std::pair<int32_t, int32_t>, int64_t> images;  // that touch, of each pair
  int64_t total = -1;                                     // -1: not known, as the call was stopped
};
Touching find_touching(const Packing &start, bool own_images);
void report_changes(Touching start, double packing_fraction_start, CrunchState &s);

}  // namespace jam
