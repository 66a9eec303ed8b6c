// Every number that steers the minimisation and decompression of soft spheres. Lengths are in mean diameters, residuals
// are forces over the mean contact force.
#pragma once
#include <cstddef>
#include <cstdint>

namespace jam::inside {

// ---- FIRE: parameters of Guenole et al., except the longest step. In units of 1 / sqrt(stiffness of a contact /
// mass), 0.35 to 0.5 cost the same and 0.65 five times as much (N = 1024, phi = 0.70; soft_minimise.py at f1287b58).
struct FireTuning {
  static constexpr double first_step = 0.05, longest_step = 0.45, shortest_step = 1e-4;
  static constexpr double mixing_start = 0.25, mixing_factor = 0.99, step_up = 1.1, step_down = 0.5;
  static constexpr int steps_before_growth = 20;
  static constexpr double longest_move = 0.1;  // in one step
};

// ---- limited-memory BFGS
struct LbfgsTuning {
  static constexpr size_t memory = 10;  // pairs of steps and changes of force
  static constexpr double longest_move = 0.1;
  static constexpr double overshoot = 0.9;     // largest slope behind the minimum of a line, over that at its start
  static constexpr double least_return = 0.1;  // of the way to a point behind the minimum
};

// ---- both: evaluations between two tests of which spheres are stable
constexpr int64_t evaluations_between_looks = 64;

// ---- Newton's method after L-BFGS, by Levenberg and Marquardt
struct NewtonTuning {
  static constexpr double settled = 1e-4;  // residual from which Newton is tried first
  // Descent continues to this part of the residual after Newton has failed, or where spheres are not held yet.
  static constexpr double next_target = 0.1;
  static constexpr double longest_move = 0.05;       // in one step
  static constexpr double good_factor = 0.2;         // a step that leaves less of the residual needs no new factor
  static constexpr double energy_is_blind = 1e-6;    // residual below which the slope is tested in place of the energy
  static constexpr double leaves_saddle = 100.0;     // growth of the residual: the start was near a saddle
  static constexpr double rattlers_balanced = 1e-6;  // forces on rattlers: what touches them is done
  static constexpr int most_steps = 60;
  // Gain over that of the quadratic model: above the first the shift of the Hessian falls, below the second it grows.
  // In units of the mean stiffness of a contact; a small part of the first shift is none.
  static constexpr double as_modelled = 0.75, too_little = 0.25;
  static constexpr double first_shift = 1e-7, no_shift = 0.01 * first_shift, shift_down = 0.1, shift_up = 4.0;
  static constexpr double diverged = 1e300;  // displacements of a matrix that is nearly singular
};

// ---- the Hessian
struct SoftHessianTuning {
  // Of a rattler to its place, in units of the mean stiffness: what touches it can push it away.
  static constexpr double rattler_spring = 1e-3;
  // Shifts that are tried until the matrix is positive, in the same unit.
  static constexpr double first_try = 1e-6, next_try = 10.0, last_try = 100.0;
};

// ---- the centre of a rattler's cage by steps away from the nearest neighbour, each a little shorter than the one
// before, from the first one on. A gap this wide is enough.
struct CageTuning {
  static constexpr double first_step = 0.1, step_factor = 0.9, wide_gap = 0.05;
  static constexpr int sweeps = 120;
};

// ---- neighbour lists: reach beyond contact. It grows where lists are rebuilt within few evaluations.
struct SkinTuning {
  static constexpr double shortest = 0.1, longest = 0.4, grow = 1.5, shrink = 0.5;
  static constexpr int64_t few_evaluations = 25, many_evaluations = 250;
};

// ---- coincident centres: squares of distances up to this one have lost their digits; the distance that then stands
// for them, in sigma_ij.
struct CoincidentTuning {
  static constexpr double tiny = 1e-280, distance = 1e-16;
};

// ---- relaxation
struct RelaxTuning {
  // The minimum of a fixed cell is found to this residual before the cell is free. Above it, what seems a saddle is
  // minimised to less before spheres are moved away.
  static constexpr double before_strain = 1e-6;
  // The resulting state has rounded positions. Where they do not balance, the descent continues, at most this
  // many times.
  static constexpr int most_roundings = 4;
  // What is left of forces is rounding where the residual is below so many roundings of an overlap and was not halved
  // for so many steps, and for as many as it took to get there. Residuals end at 5e-16 to 4e-15 (unit/soft_minimise).
  static constexpr double roundings = 32.0;
  static constexpr int64_t patience = 8192;
  // Loads are fixed in the cell where they were last taken, which costs this many more descents. A cell that strains
  // farther under them flows.
  static constexpr int most_loadings = 40;
  static constexpr double most_strain = 1.0;
  // Straight lines of compressed spheres buckle, lattices with few contacts too: forces balance at a saddle. There a
  // contact of spheres that are not held has more than this part of the mean force, or the Hessian a curvature below
  // this part of -force / distance. Displacements of the last parts of the mean diameter leave it, one after the other.
  static constexpr double loose_force = 1e-3, saddle_curvature = 1e-3;
  // Without Newton's method a factor of more numbers is not computed for the test: FIRE is chosen for its little
  // memory.
  static constexpr size_t most_factor = 10000000;
  static constexpr double saddle_moves[] = {1e-6, 1e-4, 1e-2};
};

// ---- a cell at a pressure far from that of the start
struct PressureTuning {
  static constexpr double shrink = 0.02;  // largest amplitude of a strain of a cell without overlaps, at a time
  // Overlaps fall by this factor from one pressure to the next. In one step contacts open and close many times, and the
  // minimisation takes far longer.
  static constexpr double overlaps_fall = 100.0;
};

// ---- decompression
struct DecompressTuning {
  // A step that failed is tried again with the square root of its factor, up to this one.
  static constexpr double last_factor = 0.95;
  // A step may take this many times all evaluations of the call so far, those of failed steps included. A step that
  // takes more follows a weak instability, whose forces fall with the overlaps. A shorter step does the same at larger
  // overlaps.
  static constexpr int64_t work_share = 4;
  // It may always take this share of max_evaluations: a start near its minimum takes almost none and sets no scale.
  static constexpr int64_t least_share = 20;
  static constexpr double longest_guess = 0.1;  // displacement that the Hessian predicts for smaller diameters
};

// ---- shear
struct ShearTuning {
  // A step is halved where its energy departs from the work of the mean stress by more than this part of V |changes of
  // stress and strain|. A contact that opens or closes departs by 1/8 of its share of the modulus, a curve by 1/12.
  // tests/bench/results/shear.json: events that steps of several sizes find.
  static constexpr double suspicious = 0.2;
  static constexpr double energy_digits = 1e-13;  // of the enthalpy: smaller differences are rounding
  // A step is an event where shearing back leaves more than this part of its displacement.
  static constexpr double irreversible = 0.1;
  // Of steps and resolutions: coordinates resolve no smaller strain, and bisection finds no double in between.
  static constexpr double least_strain = 1e-15;
  static constexpr double series_ends = 1e-19;       // last term of exp(strain)
  static constexpr double rounding_of_turns = 1e-9;  // a rest of a step that is smaller is none
};

}  // namespace jam::inside
