// Every number that steers the interior points and the simplex method. Lengths are in mean diameters; mu and duality
// gaps are in units of Gamma.
#pragma once
#include <cstddef>

namespace jam::inside {

// ---- which rows are in the matrix
struct WorkingSetTuning {
  // About d n rows carry force at the end. Rows slacker than far_slack times the slack of the row of this rank are
  // screened: what they couple is weak by the square of that, and every step is searched on all rows anyway.
  static constexpr double carrying_rows = 1.05, far_slack = 2.0;
  static constexpr double per_bound = 0.1;   // in an LP also those that a step may well close: slack over its bound
  static constexpr double nearly_all = 0.9;  // where the working set is this share of all rows, it is all
  static constexpr size_t rows_per_dim = 4;  // a sphere with at most d rows gets so many times d of its tightest
  // The step may take this share of a screened row's slack. A row joins when it has lost `joins` of
  // the threshold; then all rows that have lost `joins_too` join too.
  static constexpr double of_screened = 0.9, joins = 0.3, joins_too = 0.5;
  static constexpr double blocks = 0.5;  // a screened row that leaves less of the step joins
  // On the path the set is chosen again when a screened row has lost `joins_too` of the limit.
  static constexpr double same_order = 0.05;  // change of its size up to which the elimination order stays
};

// ---- the interior point of an LP
struct InteriorPointTuning {
  // First slack of the tightest row: shares of the median slack and of the bound; warm, the gain that the multipliers
  // leave times `ahead`. Nearer to the end rounding of the rows upsets the force balance.
  static constexpr double first_slack = 0.1, slack_per_bound = 0.01, ahead = 3.0, least_slack = 1e-12;
  // Converged: dual residual before the tolerance is reached, and at it (what rounding of the normal equations leaves;
  // the polish takes the rest).
  static constexpr double rough_balance = 1e-3, balance = 1e-5;
  // Steps that better neither gap nor balance by a tenth end it; solved is what comes near the tolerance of the gap,
  // roughly balanced.
  static constexpr double progress = 0.9, near_gap = 1e3;
  static constexpr int max_stalled = 8, max_stalled_warm = 3;
  static constexpr int max_correctors = 3;
  static constexpr double max_cut = 0.05, least_cut = 1e-6, cut_per_gap = 0.1;  // of the step to the boundary
  static constexpr double least_ratio = 1e-8, of_tolerance = 0.1;               // targets of mu
  static constexpr double least_win = 0.03;                                     // of both steps, by one corrector more
};

// ---- factors in single precision (tests/bench/README.md). Below 150 flops per number of the factor, solves take as
// long as it saves. A direction may be as wrong as forces are before the end, and take 8 products.
struct SingleTuning {
  static constexpr double work = 150.0, accuracy = InteriorPointTuning::rough_balance;
  static constexpr int max_products = 8;
};

// ---- correctors of LPs and of the path: products y c are pulled into this band around mu, for a step so much longer.
// Multipliers of other rows begin in it too: in a wider one weak contacts cut first steps short, in a narrower one
// forces are lost.
struct CorrectorTuning {
  static constexpr double band = 10.0, ahead = 0.3;
};

// ---- the barrier problem: search along a direction, up to this share of the way to the boundary
struct LineSearchTuning {
  static constexpr double longest = 4.0, of_feasible = 0.995;  // longer moves of an LP are at its bound
  static constexpr int golden_sections = 14;
  // Within this part of 1 a step is whole: the path then takes the Newton step, and a direction of an LP gets no
  // further corrector. Correctors of the path have their own whole_step.
  static constexpr double nearly_whole = 0.1;
};

// ---- what a solver may leave: of rows, over the bound; of multipliers, over their mean; of |sum y - 1|. Spheres that
// grow by less stay. The loosest lp_tolerance too.
constexpr double lp_rounding = 1e-9;

// ---- on diagonals, over their mean: holds translations
constexpr double translation_ground = 1e-12;

// ---- Clp. More pivots a row than any packing needed: degenerate LPs can go round. Far below the largest number
// tolerances mean nothing.
constexpr double clp_largest = 1e30;
constexpr int clp_pivots_a_row = 10;

}  // namespace jam::inside
