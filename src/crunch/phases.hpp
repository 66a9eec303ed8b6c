// The phases of a crunch, and what they share. Each phase returns the phase that follows.
#pragma once
#include "core/monitor.hpp"
#include "crunch/state.hpp"
#include "linalg/newton_system.hpp"

namespace jam::inside {

// ---- phase 1, approach: sequential LPs
Phase approach(CrunchState &s);
// Whether the cell is to be freed, after the packing has reached its optimum at fixed cell; the strains join the LPs.
// It ends strictly jammed, with d (N' - 1) + d (d + 1) / 2 contacts when it is disordered (Torquato and Jiao, Phys.
// Rev. E 82, 061302 (2010)).
bool frees_cell(const CrunchState &s);
Phase free_cell(CrunchState &s);

// Bound of the first LP: the free spacing of a dilute start, down to a tenth of a diameter near jamming.
double first_bound(const Packing &p, const jam_crunch_options &o, const Tuning &t);
// The largest diameter in mean diameters: no neighbour radius is smaller.
double widest_contact(const Packing &p);
// Pairs farther apart cannot meet in an LP of this bound.
double lp_reach(const Packing &p, const jam_crunch_options &o, const Tuning &t, double bound);
// The LP of the next bound at the present packing, into s.last. Returns the reach of its pairs.
double build_lp(CrunchState &s, double reach);

// Solves the LP in s.last: by the interior point, warm where the forces are nearly the same; then cold and without
// correctors; then by Clp. Answers that do not check out are refused.
enum class LpAnswer { kept, refused, interrupted };
LpAnswer solve_lp(CrunchState &s, IpmControl control);

struct LpStep {
  double gain, longest, part;
};
// Moves by the answer of the last LP, and records it.
LpStep make_step(CrunchState &s, double reach);

// Moves p by alpha (s, e, g), s in units of sigma_unit, with an alpha <= 1 for which no pair overlaps. Offsets follow
// when spheres are wrapped. Returns alpha (0: even tiny steps overlap, which only bad input can do).
double take_step(Packing &p, PairList &pairs, double reach, const LpSolution &answer, double sigma_unit,
                 const StrainBasis &basis = {});

// ---- phase 2: the barrier path, from the LP before it to the LPs after it
Phase follow_path(CrunchState &s);

struct BarrierPathControl {
  Tuning tuning;
  StrainBasis strain;      // that the path chooses; empty: a fixed cell
  PathPoint from;          // where a stopped path continues; mu 0: a new one
  double opening = 0.0;    // of a new one: the closest pair is opened to this relative gap at least
  double least_gap = 0.0;  // it ends at this duality gap, or at Tuning::path_end where that is larger
  int threads = 1;
  int64_t lps = 0;                          // solved before, for the progress
  std::function<double(double path)> done;  // part of the call that is done at this part of the path; may be empty
  std::function<void(double gap, size_t pairs, const PathPoint &at)> on_step;  // after every move; may be empty
};

struct BarrierPathResult {
  bool reached = false;  // it ended at its duality gap with balanced forces
  double gap = 0.0;
  int factorisations = 0;
  int increases = 0;        // of mu, at saddles
  Multipliers multipliers;  // of the last list
};

// Moves p towards its jamming point, always without overlap.
BarrierPathResult follow_barrier_path(Packing &p, const BarrierPathControl &control, NewtonSystem &system,
                                      Monitor &monitor);

// The pairs that the path lists: all with |r_ij| < reach + slope sigma_ij. A sphere without neighbours in some
// direction gets a longer reach of its own, doubled until it is covered or the reach is tuning.farthest_reach: rows
// that come and go as small spheres cross a hole leave the barrier without a maximum. Sorted as by find_pairs.
PairList select_neighbours(const Packing &p, double reach, double slope = 1.0, const Tuning &tuning = Tuning());

// ---- phase 3, identify: which contacts carry force, their last digits, and the verdict
Phase identify(CrunchState &s);
// Which contacts carry force, when the tolerance of a wide LP hides a weak force or a narrow gap: the duality gap of an
// LP shrinks with its step bound, which follows the steps down to a motion whose square is rounding.
Phase narrow_lps(CrunchState &s);
// Closes the contacts and balances the forces, as far as they do. False when the call was interrupted.
bool polish_contacts(CrunchState &s);
// Tests the packing. Where it is not shown to be jammed narrow LPs follow, then a decompression.
Phase decide_jamming(CrunchState &s);
// Decompresses the packing, and lets LPs and path begin again. False where no decompression is left.
bool recompress(CrunchState &s);
// Ends the crunch with the verdict that jam_rigidity would return; in a free cell also with the strict one.
// of_contacts: the test of its contacts, or nothing.
Phase give_verdict(CrunchState &s, const PackingVerdict &of_contacts);
// Narrow LPs and decompressions belong to the optimum of the wide LPs. A looser tolerance may end before it.
bool converged(const CrunchState &s);

// ---- all phases: stop, begin again, report and record a step
void stop(CrunchState &s, jam_stop_reason reason, jam_status status);
// Where the call was cancelled or its time is over: stops for that reason. True when it did.
bool stop_if_interrupted(CrunchState &s);
// Where no LP is left of those that the options allow: the same.
bool stop_at_lp_limit(CrunchState &s);
// Clears contacts and verdict of the report, because the spheres will move again.
void forget_contacts(CrunchState &s);
// LPs begin again with this bound: the packing was moved, or its cell is free now.
void restart_lps(CrunchState &s, double bound);

// Part of the crunch that is done: at this part of a path (NaN: off it), or after an LP with this gain.
double part_done(const CrunchState &s, double path, double gain);
// Calls the progress callback immediately; with `finished` it may read the details of the last step. True: stop.
bool report_step(CrunchState &s, jam_phase phase, double gain, double step, bool finished = true);

// A move that opens contacts and is no step of the path: its row, and its callback.
void record_opening(CrunchState &s);
// A row of the history for the move since the last row; `displacement` as in History::moved.
HistoryRow &record_step(CrunchState &s, jam_step_phase phase, const double *displacement = nullptr);
// Its columns of the network: so many contacts, and those of each sphere.
void record_contacts(CrunchState &s, HistoryRow &row, size_t contacts, const std::vector<int32_t> &coordination);

// ---- how far a packing is from jamming
// By how much the mean spacing of spheres, phi^(-1/d) diameters, exceeds that of a random jammed packing; 0 when
// denser.
double free_spacing(const Packing &p);
// h = r / sigma - 1 of each pair.
std::vector<double> relative_gaps(const Packing &p, const PairList &pairs);
// Median gap of the d n nearest pairs, the contacts to be; 0.5 when there are not as many.
double contact_gap(const Packing &p);

// ---- the last digits
enum class PolishEnd { done, no_contacts, interrupted, open_contact, too_few, negative_force, overlap };

// Changes p and contacts only when it returns done: all contacts closed to rounding, no overlap, and for a single
// self-stress all forces positive. The graph of `system` is replaced.
PolishEnd polish(Packing &p, ContactNetwork &contacts, NewtonSystem &system, int threads, const Tuning &tuning,
                 Monitor *monitor = nullptr);

}  // namespace jam::inside
