// The re-linearising interior point: one barrier path for the true, curved problem instead of one for each LP.
// After every Newton step the spheres move, the diameters grow and the rows are made anew at the true distances; the
// multipliers stay. Safe because the linearised set lies inside the true one. The barrier is the entropy of cell
// theory, so this is another quench than the chain of LPs and may end at another jamming point.
#pragma once
#include <functional>

#include "core/monitor.hpp"
#include "core/packing.hpp"
#include "lp/newton_system.hpp"
#include "lp/packing_lp.hpp"

namespace jam {

struct BarrierPathControl {
  double target = 1e-12;  // stop when the duality gap, in units of Gamma, is below this: a few LPs decide the rest
  double room = 0.0;      // the closest pair is opened to this relative gap at least
  const Multipliers *start = nullptr;  // NULL or empty: those of the central path at the gaps of the start
  int max_factorisations = 600;
  int threads = 1;
  bool saddle_ends =
      false;             // where one cooling more would be the last, a saddle ends the path instead of warming it up
  int solves_worth = 0;  // a factorisation costs as much as so many triangular solves; 0: from the sizes of both
  std::function<void(double gap, size_t pairs)> on_step;  // after every move that stays; may be empty
};

struct BarrierPathResult {
  bool reached = false;  // gap below target with balanced forces
  double gap = 0.0;
  int factorisations = 0;
  int reheats = 0;          // saddles left by warming up
  Multipliers multipliers;  // of the last list
};

// Moves p (always without overlap) towards its jamming point.
BarrierPathResult follow_barrier_path(Packing &p, const BarrierPathControl &control, NewtonSystem &system,
                                      Monitor &monitor);

}  // namespace jam
