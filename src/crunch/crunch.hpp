// From any valid packing to a certified jammed one. Data flow:
//   packing -> [pairs -> LP -> checked answer -> safe step]* -> contact network -> polish -> certificate
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "core/monitor.hpp"
#include "core/packing.hpp"
#include "crunch/history.hpp"
#include "crunch/stage.hpp"
#include "crunch/tuning.hpp"
#include "lp/packing_lp.hpp"
#include "network/certificate.hpp"
#include "network/contact_network.hpp"

namespace jam {

jam_crunch_options default_crunch_options();

struct CrunchResult {
  Packing packing;          // always valid: the last good state
  ContactNetwork contacts;  // of the last LP; empty if none was solved
  jam_crunch_report report{};
  jam_status status = JAM_OK;
  std::string text;  // why, when status is not JAM_OK; empty where the stop reason says it all
};

// For tests and benches alone: what no input does at will. Each may be empty.
struct CrunchHooks {
  Tuning tuning;
  std::function<void(LpSolution &, jam_lp_solver)> answer;  // an LP's answer before it is checked
  std::function<void(const Packing &, ContactNetwork &)> before_polish;
};

// options.cpp: throws for options that make no sense and for packings that cannot be crunched.
void check_options(const Packing &p, const jam_crunch_options &o);

// Throws for bad options, and where the estimate exceeds the memory of the call, else never: the result carries the
// status. history may be NULL. It ends with the steps of the
// attempt that is returned; its stage says where a stopped crunch begins, and where this one stopped.
CrunchResult crunch(const Packing &start, const jam_crunch_options &o, Monitor &monitor, History *history = nullptr,
                    const CrunchHooks *hooks = nullptr);

// estimate.cpp: memory and work of a crunch before it runs. Throws for bad options.
jam_estimate estimate(const Packing &start, const jam_crunch_options &o);

// Packing fraction of random jammed packings: 0.84 in d = 2, about 0.64 * 0.7^(d-3) above.
double jammed_fraction(int dim);
// By how much the mean spacing of spheres, phi^(-1/d) diameters, exceeds that of a random jammed packing: how far a
// sphere may have to travel. 0 when denser.
double free_spacing(const Packing &p);
// estimate.cpp: median gap of the d n nearest pairs, the contacts to be; 0.5 when there are not as many.
double contact_gap(const Packing &p);

// approach.cpp: bound of the first LP: the free spacing of a dilute start, down to a tenth of a diameter near jamming
// and less where gaps are closed.
double first_bound(const Packing &p, const jam_crunch_options &o, const Tuning &t);
// Pairs farther apart cannot meet in an LP of this bound.
double lp_reach(const Packing &p, const jam_crunch_options &o, const Tuning &t, double bound);

// ---- parts, one file each

// step.cpp: moves p by alpha (s, g) with the largest alpha <= 1 for which no pair outside the list overlaps.
// Offsets follow when spheres are wrapped. s in units of sigma_unit. Returns alpha (0: even tiny steps overlap, which
// only bad input can do).
double take_step(Packing &p, PairList &pairs, double reach, const LpSolution &answer, double sigma_unit,
                 const StrainBasis &basis = {});

}  // namespace jam
