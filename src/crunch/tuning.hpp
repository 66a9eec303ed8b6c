// Every number that steers a crunch; those of its LPs and line searches are in lp/tuning.hpp. Lengths are in mean
// diameters; mu and duality gaps are in units of Gamma. README.md says what each mechanism is worth.
#pragma once
#include <algorithm>
#include <array>

#include "core/packing.hpp"
#include "lp/mixed_factor.hpp"
#include "lp/tuning.hpp"
#include "network/tuning.hpp"

namespace jam::inside {

struct Tuning {
  // ---- approach: sequential LPs
  // Bound of the first LP: part of a diameter plus a share of the free spacing.
  double first_bound = 0.1, bound_per_spacing = 0.6;
  // Every LP allows motions up to min_bound: one without gain proves that none gains. Longer steps belong to the path.
  double min_bound = 1e-2, max_bound = 0.5;
  double bound_per_step = 5.0;   // next bound over the longest step of the last LP
  double shrink = 0.7;           // next bound over the last one where a pair outside the list cut the step
  double reach_per_bound = 2.2;  // listed gaps over the bound: two spheres meet from either side
  double early_gap = 0.02;       // an LP ends at this share of its gain, or at its optimum
  // Close to jamming is a gain, a duality gap or a median gap below close_gap: there forces of a crystal are counted,
  // and the cell may become free. After a step shorter than warm_step the next LP starts from the last multipliers.
  double close_gap = 1e-5, warm_step = close_gap;
  static constexpr double least_growth = 0.25;  // at round walls, of the growth that an LP promises (Armijo's rule)
  // |sum y - 1| of an answer that is used: as near to its tolerance as the gap of one that counts as solved.
  static constexpr double lp_unit_sum = InteriorPointTuning::near_gap * lp_rounding;

  // ---- from LPs to the barrier path and back
  // The path opens contacts to contact_gap_limit at least, since rounding blurs smaller gaps, and to this share of the
  // median gap, as the first point of an LP does, and of the square of the LP's longest step l. A step opens contacts
  // by about l^2: LPs that gain less than that share go in circles.
  double opening = InteriorPointTuning::first_slack;
  // A crystal, where LPs are cheaper: more rows than carrying_rows of lp/tuning.hpp have this share of the mean force.
  // Not counted above close_gap: a large mu blurs the forces.
  double crystal_force = 0.1;

  // ---- barrier path
  double end_roundings = 4.0;  // it ends at a duality gap of so many roundings of a closed contact, or after
  int max_path_factorisations = 600;
  // Products y c stay within this factor of mu: twice as far as correctors aim, in decades.
  static constexpr double centrality = CorrectorTuning::band * CorrectorTuning::band;
  double least_reach = 0.15;  // listed gaps; dilute starts list reach_per_spacing free spacings more
  double reach_per_spacing = 1.5;
  double reach_per_move = 6.0;  // a new list reaches so many of the recent steps
  int max_correctors = 5;       // Gondzio's correctors of one direction
  double whole_step = 0.95;     // longer steps need no corrector
  SinglePrecision single{SingleTuning::work, SingleTuning::accuracy, SingleTuning::max_products};  // of LPs and path
  // ---- schedule of mu
  double reduction = 0.2;    // of mu at its maximum
  double centred = 0.005;    // squared Newton decrement a row that counts as the maximum
  int max_steps_at_mu = 40;  // more of them, or as many short ones without progress as stall an LP, are a saddle
  // The decrement falls by this factor: short steps are counted again. Steps of the polish that gain less are the last.
  double progress = 0.6;
  double increase = CorrectorTuning::band;  // of mu at a saddle: products y c stay in the band of the correctors
  // Spheres in wide holes: a direction is covered by a line to a neighbour within 1/sqrt(d) times the first.
  double covered = 0.9, farthest_reach = 2.4;

  // ---- identify: active set, narrow LPs, verdict
  double closing_gap = 1e-8;                    // a contact that stays wider when all are closed is none
  double closed_gap = 3e-14;                    // rounding of closed contacts in a box of ten diameters
  double narrow_bound = 1e-3, narrower = 0.01;  // of the first narrow LP; where an LP gains nothing, of the next
  int max_narrow_lps = InteriorPointTuning::max_stalled;  // as many wide LPs without gain end a crunch without polish
  int max_excess = 8;  // contacts too many that are dropped where they do not close; a crystal has more
  // A start that cannot grow but has flexes: phi rises by less than lp_rounding where a crunch has not left its
  // density. Of so many spheres all decompressions are tried before it ends there (64 disks with vacancies need up to
  // three; of 400 and 900 none helps, in 3 and 13 s), of more the first.
  size_t most_retried = 1000;
  // Where a packing is not shown to be jammed: parts of diameters by which it is decompressed.
  std::array<double, 5> decompression{1e-4, 1e-3, 1e-2, 3e-2, 0.1};

  // ---- end at a finite duality gap
  // An LP names contacts. Its tolerance is the path's gap over near_gap, so that an answer that counts as solved has no
  // larger gap than the path (finite_gap.py: ten times as much names 1e-3 more contacts, a tenth no fewer).
  double lp_to_path_gap = 0.6;  // duality gap of that LP's forces over the gap of the path: 0.50 to 0.59
  double balanced = RigidityTuning::most_residual;  // largest net force on a sphere there, over the mean force

  // Rounding of closed contacts grows with the box over the diameter.
  double closed_limit(const Packing &p) const {
    return closed_gap * std::max(1.0, 0.1 * p.cell.side() / diameter_mean(p));
  }
  // Of closed contacts after polish; doubles cannot hold the positions more exactly.
  double rounded_overlap(const Packing &p) const { return closed_limit(p) / 3.0; }
  double step_overlap(const Packing &p) const { return 10.0 * rounded_overlap(p); }  // what a step may leave
  double path_end(const Packing &p) const { return end_roundings * closed_limit(p); }
};

// ---- progress: part of the time that LPs and path take, before the verdict
constexpr double before_verdict = 0.95;

// ---- costs that the estimate of a crunch takes as known
struct EstimateTuning {
  // Lists near jamming have this to the power of d + 1 pairs a sphere (d = 2 ... 5: 3, 5, 7.8, 12).
  static constexpr double pairs_per_dim = 1.5;
  // Factorisations: this times sqrt(N), and where the median gap of contacts to be is above close_gap, so many more.
  // Medians near jamming, grown at 3e-4 or 1e-3: 17 (N = 128), 34 (512), 34 and 63 (1024), 83 (2048), 70 (4096), 232
  // (16384); from p = 500: 82 (1024) and 175 (2048); from random starts 102 to 134 (128 to 512), 156 (1024) and 241
  // (2048); to duality gaps of 1e-6 to 1e-9: 24 to 75. Of sequential LPs, so many more LPs.
  static constexpr double near_jamming = 1.4, from_afar = 100.0;
  static constexpr double steps_of_lp = 13.0;  // factorisations of one LP
  // Fronts run at this part of the rate of one large product. All else that a step does: seconds a pair.
  static constexpr double front_rate = 0.5, per_pair = 4e-7;
  static constexpr double grown = 0.3;  // a list gets shorter after this part of the growth to jamming
  // Nine of ten crunches take between the estimate over and times the first: 33 of estimate.py took 0.5 to 3.9 times,
  // mixtures: tests/bench/results/estimate_mixtures.json. Its third power is for crystals and equal disks: by an
  // earlier estimate of more numbers 0.02 to 100 times, and 1.4 to 23 (twenty of 1000: median 19, one 705).
  static constexpr double scatter = 7.0;
  static constexpr double too_high = 2.0;  // memory over what crunches took: to 1.6 in estimate.py, 1.8 in d = 8
};

}  // namespace jam::inside
