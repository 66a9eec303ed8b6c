// One LP of a sequence: its bound and pairs, and the step that its answer allows.
#pragma once
#include "crunch/state.hpp"

namespace jam::inside {

// Bound of the first LP: the free spacing of a dilute start, down to a tenth of a diameter near jamming.
double first_bound(const Packing &p, const jam_crunch_options &o, const Tuning &t);
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

// Moves p by alpha (s, e, g) with the largest alpha <= 1 for which no pair outside the list overlaps. Offsets follow
// when spheres are wrapped. s in units of sigma_unit. Returns alpha (0: even tiny steps overlap, which only bad input
// can do).
double take_step(Packing &p, PairList &pairs, double reach, const LpSolution &answer, double sigma_unit,
                 const StrainBasis &basis = {});

}  // namespace jam::inside
