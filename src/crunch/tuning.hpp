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
  // Round walls: of the growth that an LP promises, the least part that its step must bring (Armijo's rule).
  static constexpr double least_growth = 0.25;
  int max_attempts = 30;  // LPs below the gain tolerance that lead to no verdict

  // ---- approach: sequential LPs
  // Bound of the first LP: part of a diameter plus a share of the free spacing.
  double first_bound = 0.1, bound_per_spacing = 0.6;
  // Every LP allows motions up to min_bound, so that one without gain proves that no such motion gains. Longer steps
  // belong to the path.
  double min_bound = 1e-2, max_bound = 0.5;
  double bound_per_step = 5.0;   // next bound over the longest step of the last LP
  double shrink = 0.7;           // next bound over the last one where a pair outside the list cut the step
  double reach_per_bound = 2.2;  // listed gaps over the bound: two spheres meet from either side
  double early_gap = 0.02;       // an LP ends at this share of its gain, or at its optimum
  double warm_step = 1e-5;       // after a shorter step the next LP starts from the last multipliers
  // An answer may violate rows and shrink spheres by lp_rounding, and miss |sum y - 1| by lp_unit_sum. With a larger
  // duality gap it may be worse than spheres that stay by more than this: lp_rounding is the loosest lp_tolerance too.
  static constexpr double lp_rounding = 1e-9, lp_unit_sum = 1e-6;
  static constexpr double least_part = 1e-6;  // of the step of an answer; if less is safe, the input was bad

  // ---- from LPs to the barrier path and back
  double curvature_ratio = 10.0;  // a step l opens contacts by l^2; above so many gains LPs go in circles
  // The path opens contacts to this gap at least, since rounding blurs smaller ones, and to this share of the median
  // gap and of the square of the LP's longest step.
  double min_opening = 1e-10, opening = 0.1;
  // Free cell: the path at fixed cell ends at this duality gap, and the one with strain begins at this opening.
  double free_gap = 1e-6, free_opening = 1e-4;
  // A crystal: more rows than carrying_rows of lp/tuning.hpp have this share of the mean force. There sequential LPs
  // are cheaper. Counted from this gain or duality gap on: a large mu blurs the forces.
  double crystal_force = 0.1, crystal_gap = 1e-5;

  // ---- barrier path
  double end_roundings = 4.0;  // it ends at a duality gap of so many roundings of a closed contact
  int max_path_factorisations = 600;
  double centrality = 100.0;  // products y c stay within this factor of mu
  double least_reach = 0.15;  // listed gaps; dilute starts list reach_per_spacing free spacings more
  double reach_per_spacing = 1.5;
  double reach_per_move = 6.0;  // a new list reaches so many of the recent steps
  int max_correctors = 5;       // Gondzio's correctors of one direction
  double whole_step = 0.95;     // longer steps need no corrector

  SinglePrecision single{SingleTuning::work, SingleTuning::accuracy, SingleTuning::max_products};  // of LPs and path

  // ---- schedule of mu
  double reduction = 0.2;    // of mu at its maximum
  double centred = 0.005;    // squared Newton decrement a row that counts as the maximum
  int max_steps_at_mu = 40;  // more of them, or max_short_steps without progress, are a saddle
  int max_short_steps = 8;
  double progress = 0.6;   // the decrement falls by this factor: short steps are counted again
  double increase = 10.0;  // of mu at a saddle

  // ---- neighbours of spheres in wide holes
  double covered = 0.9;  // a direction is covered by a line to a neighbour within 1/sqrt(d) times this
  double farthest_reach = 2.4;

  // ---- identify: active set, narrow LPs, verdict
  // Newton steps of the polish: so many, while they at least halve gaps that are above rounding.
  static constexpr int polish_steps = 4;
  static constexpr double polish_progress = 0.5, polish_end = 1e-16;
  double closing_gap = 1e-8;                    // a contact that stays wider when all are closed is none
  double closed_gap = 3e-14;                    // rounding of closed contacts in a box of ten diameters
  double narrow_bound = 1e-3, narrower = 0.01;  // of the first narrow LP; where an LP gains nothing, of the next
  int max_narrow_lps = 20;
  int max_excess = 8;  // contacts too many that are dropped where they do not close; a crystal has more
  // A start that cannot grow but has flexes: phi rises by less than this where a crunch has not left its density. Of so
  // many spheres all decompressions are tried before it ends there (64 disks with vacancies need up to three; of 400
  // and 900 none helps, in 3 and 13 s), of more the first.
  double same_density = 1e-9;
  size_t most_retried = 1000;
  // Where a packing is not shown to be jammed: parts of diameters by which it is decompressed, one after the other, and
  // the share of the gaps that each of two spheres may use up when all are displaced. A free cell is strained by what
  // this leaves.
  std::array<double, 5> decompression{1e-4, 1e-3, 1e-2, 3e-2, 0.1};
  double displaced = 0.45;

  // ---- end at a finite duality gap
  // A contact is undecided where its force on the path over the mean is within the square of ambiguity_ratio of twice
  // its gap. An LP that ends at lp_gap_fraction of the path's gap names contacts (finite_gap.py: 1e-2 names one in a
  // thousand more, 1e-4 no fewer).
  double ambiguity_ratio = 100.0, lp_gap_fraction = 1e-3;
  double doubles_from = 1e-11;  // gap in that LP from which factors are doubles: floats no longer balance there
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

// ---- progress: parts of the time, before the path and until the verdict
struct CrunchProgress {
  static constexpr double before_path = 0.05, before_verdict = 0.95;
};

// ---- costs that the estimate of a crunch takes as known
struct EstimateTuning {
  // Pairs a sphere that lists near jamming have, d = 2..8: measured to d = 5, beyond by the kissing numbers' growth.
  static constexpr std::array<double, 9> jammed_pairs = {0, 0, 3.0, 5.0, 7.8, 12.0, 18.0, 27.0, 40.0};
  // Lists of fewer pairs are widened: by a tenth and a hundredth of a diameter at a time.
  static constexpr double widen = 1.1, widen_at_least = 0.01;
  // Median gap of contacts to be of a packing near jamming. The step bound of its sequential LPs stays near its first
  // value.
  static constexpr double close_gap = 3e-5;
  // Factorisations of a path, as a power of N / 1024. Near jamming, grown at 3e-4 or 1e-3, medians are 17 (N = 128), 34
  // (512), 34 and 63 (1024), 83 (2048), 70 (4096), 232 (16384); to a duality gap of 1e-6 to 1e-9, 24 to 75 for all N.
  // From p = 500 they are 82 (1024) and 175 (2048), from random starts 156 and 241 (tests/bench/estimate.py). Single
  // packings scatter by a factor of two and more. Sequential LPs take several times as many.
  static constexpr double size = 1024.0;
  static constexpr double steps_least = 17.0, steps_near = 45.0, power_near = 0.58, steps_to_gap = 50.0,
                          times_near = 2.0;
  static constexpr double steps_far = 120.0, power_far = 0.8, times_far = 10.0;
  // From random starts of 128 to 512 spheres they are 102 to 134. The small spheres of a mixture roam in holes, where
  // the barrier has saddles: at ratios of 3, 10 and 30 a path takes 1.1, 1.8 and 2.2 times as many, with half the
  // spheres small or with equal volumes an octave.
  static constexpr double steps_least_far = 90.0, more_per_e_fold = 0.35;
  // Factorisations of the LP that a path begins with, at most half of all; the later half of them are in doubles.
  static constexpr double steps_of_lp = 13.0;
  // Fronts run at about half the rate of one large product; the rest of a step goes over all pairs and the factor a few
  // times: seconds a number of the factor, and a pair.
  static constexpr double front_rate = 0.5, per_factor = 6e-9, per_pair = 4e-7;
  // A list gets shorter after this part of the growth to jamming; late where the largest diameter is so many means.
  static constexpr double grown = 0.3, mixed = 1.3;
  // What nine of ten crunches took, over the estimate: of most packings (grown spheres and mixtures of 128 to 512, d =
  // 2 and 3: 0.75 to 3.8), of disks in d = 2 that differ in size by less than `alike` (128 to 1000: 1.4 to 23; twenty
  // of 1000: median 19, one 705), and of crystals, which have crystal_pairs times as many pairs with gaps up to
  // crystal_gap as unknowns; grown packings have 1.0 to 1.3, triangular lattices with vacancies 1.42, FCC ones 1.97. A
  // free cell follows a fixed one.
  static constexpr double low = 0.3, high = 5.0, alike = 1.1, low_disks = 0.5, high_disks = 300.0, crystal_gap = 1e-2,
                          crystal_pairs = 1.35, low_crystal = 0.02, high_crystal = 100.0, rounds_of_free_cell = 3.0;
  // Over what crunches took: to 1.6 in tests/bench/estimate.py, 1.8 in d = 8. Above the memory limit a crunch is
  // refused.
  static constexpr double too_high = 2.0;
};

}  // namespace jam::inside
