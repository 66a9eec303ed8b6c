// The barrier path: one interior-point method for the true, curved problem instead of one for each LP. After every
// Newton step the spheres move, the diameters grow, and the rows are computed again at the true distances; the
// multipliers stay. Every step is safe because the linearised set lies inside the true one. The barrier is the entropy
// of cell theory: this is a slower quench than sequential LPs and may end at another jamming point.
#pragma once
#include <functional>

#include "core/monitor.hpp"
#include "core/packing.hpp"
#include "crunch/record.hpp"
#include "crunch/tuning.hpp"
#include "linalg/newton_system.hpp"
#include "lp/packing_lp.hpp"

namespace jam::inside {

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

}  // namespace jam::inside
