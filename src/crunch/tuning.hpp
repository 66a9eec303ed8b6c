// Every number that steers a crunch. Lengths are in mean diameters; mu and duality gaps are in units of Gamma.
// README.md holds the table of tests/bench/ablation: what each mechanism is worth on the named sets.
#pragma once
#include <algorithm>
#include <cstddef>

#include "core/packing.hpp"
#include "lp/mixed_factor.hpp"

namespace jam {

struct Tuning {
  // ---- approach: sequential LPs
  // Bound of the first LP: part of a diameter plus a share of the free spacing, at most so many square roots of the
  // median contact gap. Floppy motion goes some tens of these square roots.
  double first_bound = 0.1, bound_per_spacing = 0.6, bound_per_root_gap = 100.0;
  // Every LP sees motions up to min_bound, so that one without gain proves that no motion gains.
  double min_bound = 1e-2, max_bound = 0.5;
  double bound_per_step = 5.0;   // next bound over the longest step of the last LP
  double reach_per_bound = 2.2;  // listed gaps over the bound: two spheres meet from either side
  double early_gap = 0.02;       // an LP ends at this share of its gain, or at its optimum
  double warm_step = 1e-5;       // after a shorter step the next LP starts from the last multipliers
  int max_stalled_lps = 12;      // LPs below the gain tolerance that lead to no verdict

  // ---- from LPs to the barrier path and back
  double long_step = 1e-2;        // longer steps belong to the path
  double curvature_ratio = 10.0;  // a step l opens contacts by l^2; above so many gains LPs go in circles
  double min_opening = 1e-10;     // the path opens contacts to this gap at least: rounding blurs smaller ones
  // Free cell: the path at fixed cell ends at this duality gap, and the one with strain begins at this opening.
  double free_gap = 1e-6, free_opening = 1e-4;
  double crystal_rows = 1.05;  // rows that carry force over d n; above it sequential LPs are cheaper
  double crystal_gap = 1e-5;   // on the path counted from this gain or duality gap on: a large mu blurs the forces

  // ---- barrier path
  double end_roundings = 4.0;  // the path ends at a duality gap of so many roundings of a closed contact
  int max_path_factorisations = 600;
  double centrality = 100.0;  // products y c stay within this factor of mu
  double least_reach = 0.15;  // listed gaps; dilute starts list reach_per_spacing free spacings more
  double reach_per_spacing = 1.5;
  int max_correctors = 5;  // Gondzio's correctors of one direction
  double corrector_band = 10.0, corrector_ahead = 0.3;
  double whole_step = 0.95;  // longer steps need no corrector

  // ---- memory
  double estimate_too_high = 2.0;  // estimates over what crunches took: to 1.6 in tests/bench/estimate.py, 1.8 in d = 8

  // ---- factors in single precision, of LPs and of the path (tests/bench/README.md, "Factors in single precision")
  // Below 150 flops a number of the factor, solves eat up what it wins. A direction may be wrong by 1e-3, and take 8
  // products.
  SinglePrecision single{150.0, 1e-3, 8};

  // ---- schedule of mu
  double reduction = 0.2;       // of mu at its maximum
  double centred = 0.005;       // squared Newton decrement a row that counts as the maximum
  double nearly_centred = 4.0;  // within this factor of it, mu falls instead of rising
  int max_steps_at_mu = 40;     // more of them, or max_short_steps without progress, are a saddle
  int max_short_steps = 8;
  double progress = 0.6;   // the decrement falls by this factor: short steps count anew
  double increase = 10.0;  // of mu at a saddle

  // ---- neighbours of spheres in wide holes
  double covered = 0.9;  // a direction is covered by a line to a neighbour within 1/sqrt(d) times this
  double farthest_reach = 2.4;

  // ---- identify: active set, exact vertex, verdict
  double closing_gap = 1e-8;                    // a contact that stays wider when all are closed is none
  double closed_gap = 3e-14;                    // rounding of closed contacts in a box of ten diameters
  double narrow_bound = 1e-3, narrower = 0.01;  // of the first narrow LP; where an LP gains nothing, of the next
  int max_narrow_lps = 20;
  int max_excess = 8;  // contacts too many that are dropped where they do not close; a crystal has more
  // At a finite duality gap a contact is in doubt where its force on the path over the mean is within this factor
  // squared of twice its gap. An LP that ends at part_of_gap of the path's gap names contacts (finite_gap.py: 1e-2
  // names one in a thousand more, 1e-4 no fewer).
  double doubt = 100.0, part_of_gap = 1e-3;
  double doubles_from = 1e-11;  // gap in that LP from which factors are doubles: floats no longer balance there
  double lp_over_path = 0.6;    // duality gap of that LP's forces over the gap of the path: 0.50 to 0.59
  double balanced = 1e-10;      // largest net force on a sphere there, over the mean force
  // Diagonal that fixes translations beside rows of unit vectors; the second where squared forces weigh the rows.
  double ground = 1e-12, weighted_ground = 1e-14;
  int max_kicks = 30;  // motions along a flex
  double kick = 0.02;  // the longest

  // ---- progress: parts of the time, before the path and until the verdict
  double part_before_path = 0.05, part_before_verdict = 0.95;

  // Rounding of closed contacts grows with the box over the diameter.
  double closed_limit(const Packing &p) const {
    return closed_gap * std::max(1.0, 0.1 * p.cell.side() / diameter_mean(p));
  }
  double path_end(const Packing &p) const { return end_roundings * closed_limit(p); }
};

}  // namespace jam
