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
  // step. A step that lowers mu by less than this part ends the path.
  static constexpr double least = 1e-3;
  // Predictor and corrector: the correction is at most these parts of the target. Within the target itself, a square
  // lattice with noise of 1e-6 is undecided.
  static constexpr double most_down = 10.0, most_up = 0.9;
  // Steps end at this part of the way to the boundary, and are tried shorter by the second one. With 0.9 for both a
  // triangular crystal with vacancies and noise of 1e-11 is undecided.
  static constexpr double to_boundary = 0.99, shorter = 0.8;
};

// ---- contacts from geometry
struct JumpTuning {
  static constexpr size_t most_candidates = 12;
  // A true jump separates rounding from real gaps: decades, and far more of them than the next candidate.
  static constexpr double wide = 100.0;
};

// ---- rattlers: distance of the origin from the convex hull of the contact vectors, above which no forces can balance,
// while vectors may still change: this rule never takes out a sphere that carries force at the end
constexpr double clear_distance = 1e-3;

// ---- relative gaps of first neighbours in a lattice whose digits are few. Without a true jump in the sorted gaps no
// wider one is a contact, except for what the digits hide.
constexpr double nearly_touching = 0.01;

// ---- a wider error of gaps than of this reach, over the contact distance, says nothing about contacts at all
constexpr double widest_reach = 0.5;

// ---- rounding: below the first a number is zero, above the second it is not; between them the digits do not decide.
// Of forces over the mean |force|, of openings of contacts where the largest displacement is 1, of pivots over the
// largest one, and of a rotation about a line through all spheres over its length without that.
struct RoundingTuning {
  static constexpr double zero = 1e-11, sure = 1e-9;
};

// ---- what a projection leaves of a vector, over its length: less is none (a state of self-stress of mean force 1; a
// motion without symmetries or those of other parts; a zero mode without those found). Also the largest net force
// over the mean force, above which forces do not name contacts. A motion that goes across a contact by less opens it by
// rounding alone.
constexpr double least_rest = 1e-6;

// ---- the softest modes by block iteration
struct SoftestModesTuning {
  static constexpr size_t first_block = 4, largest_block = 32;  // it doubles while all of it are flexes
  static constexpr double settled = 1e-3;                       // relative change of the margin in one pass
  static constexpr double converged = 0.3;                      // part of the value one pass before that a flex keeps
};

// ---- the cone of self-stresses
struct StressConeTuning {
  // On the path, and to the analytic centre: a decrement that rounding holds at 1/4 or more never exceeds the bound of
  // `centre`, 4 times the square of the last one.
  static constexpr int most_steps = 60;
  // The support is guessed each time when mu has fallen to the first part, and first at its square: a guess at 0.1 took
  // three more factorisations for 2048 disks, a fifth of the verdict. The path ends at the second mu: there some forces
  // are by this smaller than others, and the centre is given up. At 1e-11 the triangular crystal that
  // CentralPathTuning names is undecided.
  static constexpr double next_guess = 0.1, least_mu = 1e-12;
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
  // The curvature of a round wall holds a flex, or does not, by more than this part of the mean force times curvature:
  // a flex itself closes contacts by up to 1e-6.
  static constexpr double least_curvature = 1e-5;
  // Spheres at round walls stay: squared displacements across them below this, in a flex of length 1. That length opens
  // or closes no gap that doubles distinguish from a contact.
  static constexpr double still = undecided_gap_limit * undecided_gap_limit;
  // Forces that balance worse than this, over the mean force, prove nothing; worse than least_rest, they do not
  // even name the contacts.
  static constexpr double most_residual = 1e-10;
  // Trial forces for dependent contacts, over the mean force. The first value that leaves no tensile force is used.
  static constexpr double dependent_forces[] = {0.1, 1e-3, 0.0};
};

// ---- the last digits where the curvature of a round wall stabilises flexes: the largest dense matrix
constexpr int most_unknowns_at_curved_maximum = 1500;

}  // namespace jam::inside
