// Every number that steers the work on contact networks. Limits of gaps are in resolution.hpp, those of eigenvalues
// in rigidity_test.hpp: they are part of what a verdict means.
#pragma once
#include <cstddef>

#include "network/resolution.hpp"

namespace jam::inside {

// ---- the smallest gap of a pair that is no contact: radii of search over the contact distance, one after the other
constexpr double gap_searches[] = {1.2, 2.0};

// ---- interior point to the centre of the balanced forces
struct CentralPathTuning {
  // No product f w falls below this part of their mean, so that no contact is stuck at the boundary, nor mu in one
  // step. A shorter step ends the path.
  static constexpr double least = 1e-3;
  // Predictor and corrector: mu falls to this part at most; the correction is at most these parts of the target; steps
  // end at this part of the way to the boundary, and are tried shorter by the last one.
  static constexpr double flattest = 0.95, most_down = 10.0, most_up = 0.9, to_boundary = 0.99, shorter = 0.8;
};

// ---- contacts from geometry
struct JumpTuning {
  static constexpr size_t most_candidates = 12;
  // A true jump separates rounding from real gaps: decades, and far more of them than the next candidate.
  static constexpr double wide = 100.0;
  // Gap of a contact without a true jump, or so many times what the digits of coordinates resolve.
  static constexpr double widest_contact = 0.01, resolutions = 3.0;
};

// ---- solver of a Hessian whose translations are tied: springs over the norm, and refinement until residuals fall
// slowly
struct GroundedTuning {
  static constexpr double spring = 0.1, slow = 0.3;
};

// ---- rattlers: distance of the origin from the convex hull of the contact vectors, above which no forces can balance,
// while vectors may still change: this rule never takes out a sphere that carries force at the end
constexpr double clear_distance = 1e-3;

// ---- resolution of gaps. A wider error says nothing about contacts at all. Pairs within the second part of the mean
// diameter are the first neighbours of a lattice whose digits are few.
struct ResolutionTuning {
  static constexpr double widest_reach = 0.5, first_neighbours = 0.02;
};

// ---- what a projection leaves of a vector, over its length: less is none (a state of self-stress of mean force 1; a
// motion without symmetries, or without those of other parts)
constexpr double least_rest = 1e-6;

// ---- zero modes: a new one has kept a good part of a random vector, and has no curvature (over the norm)
struct ZeroModeTuning {
  static constexpr double kept = 1e-4, curvature = 1e-10;
};

// ---- the softest modes by block iteration
struct SoftestModesTuning {
  static constexpr int first_block = 4, largest_block = 32, most_passes = 200;
  static constexpr double settled = 1e-3;                // relative change of the margin in one pass
  static constexpr double zero = 1e-8, converged = 0.3;  // of the limit of a flex; part of the value one pass before
};

// ---- the cone of self-stresses
struct StressConeTuning {
  // In units of the mean |force|: below the first a force is zero, above the second it is not; between them the digits
  // do not decide. The same for the opening of a contact, where the largest displacement is 1.
  static constexpr double zero = 1e-11, sure = 1e-9;
  static constexpr int most_steps = 60;  // on the path, and to the analytic centre
  // The path: mu of the first guess of the support, the part of it at the next one, and its end: there some forces are
  // by this smaller than others, and the centre is given up.
  static constexpr double first_guess = 1e-2, next_guess = 0.1, least_mu = 1e-12;
  // The centre: longest step, and the decrement above which a step is damped.
  static constexpr double longest_step = 1e3, damped = 0.25;
  // Contacts that are pulled leave a guess so often, where they are no more than this. Of equal disks, N = 1000, seed
  // 29 is undecided without; 50 packings of 100 and 20 of 300 are as they were.
  static constexpr int most_drops = 4;
  static constexpr size_t most_pulled = 20;
};

// ---- the test of rigidity
struct RigidityTuning {
  static constexpr size_t most_flexes = 512;  // that are counted
  // A flex may close a contact by no more than this, where the largest displacement is 1: a motion of length t closes
  // it by 1e-8 t and opens it by t^2 / 2, so the overlap on the way stays below the rounding of a gap. One that opens
  // all contacts by more rules out every balance of forces, also near these positions.
  static constexpr double flex_rounding = 1e-8;
  // Contacts of spheres that move less across than along open less. Where that closes a contact by more than this part
  // of rounding, the flex is changed so that contacts which it opens by less than rounding stay closed.
  static constexpr double least_across = 1e-6;
  // The curvature of a round wall holds a flex, or does not, by more than this part of the mean force times curvature:
  // a flex itself closes contacts by up to 1e-6.
  static constexpr double least_curvature = 1e-5;
  // Spheres at round walls stay: squared displacements across them below this, in a flex of length 1. That length opens
  // or closes no gap that doubles distinguish from a contact.
  static constexpr double still = undecided_gap_limit * undecided_gap_limit;
  // A rotation of the spheres about a line through all of them leaves less than this of a length, by rounding; a
  // symmetry leaves less of the largest pivot.
  static constexpr double no_rotation = 1e-9;
  // Forces that balance worse than this, over the mean force, prove nothing; worse than the second they do not even
  // name the contacts.
  static constexpr double most_residual = 1e-10, useless_residual = 1e-6;
  // Trial forces for dependent contacts, over the mean force. The first value that leaves no tensile force is used.
  static constexpr double dependent_forces[] = {0.1, 1e-3, 0.0};
};

// ---- refinement of solutions of the rows
constexpr int most_refinements = 30;

// ---- force balance: a diagonal that fixes translations where squared forces weigh the rows
constexpr double weighted_ground = 1e-14;

// ---- the last digits where the curvature of a round wall stabilises flexes: the largest matrix, and the longest step
// (in diameters and mean forces)
struct CurvedMaximumTuning {
  static constexpr int most_unknowns = 1500;
  static constexpr double longest = 1.0;
};

}  // namespace jam::inside
