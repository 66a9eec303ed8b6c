// The phases of a crunch. Each returns the phase that follows.
#pragma once
#include "core/monitor.hpp"
#include "crunch/state.hpp"
#include "linalg/newton_system.hpp"

namespace jam::inside {

// ---- phase 1, approach: sequential LPs. Each LP maximises Gamma over displacements within a bound; the spheres move,
// and the pairs are listed again (Artiaco et al., Phys. Rev. E 106, 055310 (2022)).
Phase approach(CrunchState &s);
// A free cell: path and LPs with strain amplitudes start from the optimum at fixed cell. They end in a
// strictly jammed packing, with d (N' - 1) + d (d + 1) / 2 contacts when it is disordered (Torquato and Jiao, Phys.
// Rev. E 82, 061302 (2010)). Whether the cell is to be freed, after the packing has reached its optimum at fixed cell:
bool frees_cell(const CrunchState &s);
// The strains join the LPs.
Phase free_cell(CrunchState &s);

// ---- phase 2: the barrier path, from the LP before it to the LPs after it
Phase follow_path(CrunchState &s);
// The end of a crunch at a finite duality gap. On the path y c = mu for every row: a contact has much force and a small
// gap, another pair the reverse. The linear program at this point parts those in between, from the multipliers of the
// path in a few iterations. A curved path may still part some of them the other way: they are counted.
//
//   multipliers of the path -> LP -> contacts and forces -> forces that balance -> duality gap of these forces
//
// False where the forces of the LP do not balance or leave a larger gap than the options allow, or when interrupted.
bool ends_at_gap(CrunchState &s, const Multipliers &path);

// ---- phase 3, identify: which contacts carry force, their last digits, and the verdict
//
//   active set of the LP -> closed contacts, balanced forces (polish) -> test of collective jamming -> jammed, or a
//   flex
//
// A flex is a motion that opens contacts: the packing is a saddle of the density. A decompression leads away from it.
Phase identify(CrunchState &s);
// Narrow LPs find which contacts carry force when the tolerance of a wide LP hides a weak force or a narrow gap: the
// duality gap of an LP shrinks with its step bound. The bound follows the steps down to a motion whose square is
// rounding. No regularising diagonal is added: it would take the weak force of the third contact of a sphere between
// two nearly opposite ones.
Phase narrow_lps(CrunchState &s);
// Closes the contacts and balances the forces, as far as they do. False when the call was interrupted.
bool polish_contacts(CrunchState &s);
// Tests the packing. Where it is not shown to be jammed narrow LPs follow, then a decompression.
Phase decide_jamming(CrunchState &s);
// Decompresses the packing, displaces every sphere at random within the room that this gives, and lets LPs and path
// begin again. Each time it decompresses farther, so that the packing ends near the first one. False where no
// decompression is left.
bool recompress(CrunchState &s);
// Ends the crunch with its verdict, the one that jam_rigidity would return: collectively jammed or not, from positions
// alone; and in a free cell strictly. of_contacts: the test of its contacts, or nothing.
Phase give_verdict(CrunchState &s, const PackingVerdict &of_contacts);
// Narrow LPs and decompressions belong to the optimum of the wide LPs. A looser tolerance may end before it.
bool converged(const CrunchState &s);

// What every phase of a crunch does with its state: stop, begin again, report and record a step.

void stop(CrunchState &s, jam_stop_reason reason, jam_status status);
// Where the call was cancelled or its time is over: stops for that reason. True when it did.
bool stop_if_interrupted(CrunchState &s);
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

// How far a packing is from jamming.
// By how much the mean spacing of spheres, phi^(-1/d) diameters, exceeds that of a random jammed packing: how far a
// sphere may have to travel. 0 when denser.
double free_spacing(const Packing &p);
// h = r / sigma - 1 of each pair.
std::vector<double> relative_gaps(const Packing &p, const PairList &pairs);
// Median gap of the d n nearest pairs, the contacts to be; 0.5 when there are not as many.
double contact_gap(const Packing &p);

// The last digits: contacts closed by Newton steps on the positions and one common diameter factor, forces projected on
// the null space of S^T.

enum class PolishEnd { done, no_contacts, interrupted, open_contact, too_few, negative_force, overlap };

// Changes p and contacts only when it returns done: all contacts closed to rounding, no overlap, and for a single
// self-stress all forces positive. A contact too many that does not close with the others is dropped. Where contacts
// still do not close, balance or push, narrow LPs find the vertex (identify.cpp).
// The graph of `system` is replaced.
PolishEnd polish(Packing &p, ContactNetwork &contacts, NewtonSystem &system, int threads, const Tuning &tuning,
                 Monitor *monitor = nullptr);

}  // namespace jam::inside
