// Every number that steers the search for the largest sum of radii. Lengths are in units of (V / n)^(1/d), weights and
// forces in units of the mean weight.
#pragma once

namespace jam::inside {

struct RadiiTuning {
  // ---- start
  static constexpr double room = 0.1;           // share of a radius above its lower bound that is taken off first
  static constexpr double least_room = 1e-6;    // of a radius that begins at its lower bound
  static constexpr double least_mu = 1e-10;     // with which a path begins
  static constexpr double reach = 2.0;          // pairs with a gap below this are rows
  static constexpr double most_weight = 1e100;  // sums stay finite
  // ---- path
  static constexpr double mu_factor = 0.2;     // from one maximum to the next
  static constexpr double decrement = 0.3;     // of Newton's method, squared: below, a maximum is near enough
  static constexpr double to_boundary = 0.95;  // of the way to the nearest closing row
  static constexpr double least_ascent = 0.1;  // share of the ascent that the gradient predicts
  static constexpr double shortest = 1e-10;    // part of a step that is still tried
  static constexpr int steps_at_one_mu = 60;   // Newton's method
  static constexpr int longer = 4;             // times that a step may double
  static constexpr double ridge = 1e-13;       // on the diagonal, over its mean: holds translations
  // ---- moments
  static constexpr double least_exponent = 0.01, most_exponent = 8.0;
  static constexpr double least_radius = 1e-3, least_ratio = 2e-4;  // of the smallest radius at the start; the largest
  static constexpr double least_freedom = 1e-7;   // share of a moment's gradient that others do not have
  static constexpr double kept = 4e-15;           // relative error of moments after a step
  static constexpr int corrections = 60;          // of radii, that keep them
  static constexpr double bordered_ridge = 1e-9;  // between its bias and the digits that it leaves
  static constexpr int settle_steps = 12;         // of Newton's method where contacts are fewer than unknowns
  static constexpr size_t most_motions = 12;      // that it deals with
  // ---- end
  static constexpr double polish_from = 1e-4, mu_end = 1e-14;  // mu
  static constexpr int polish_steps = 30;                      // Newton steps that close the contacts
  static constexpr double polish_ridge = 1e-14;
  static constexpr double longest_polish = 0.05;  // sum of the steps of a polish
  static constexpr double closed = 4e-15;         // gap of a closed contact, over the longest edge of the cell
  static constexpr int balance_steps = 20;        // that balance forces
  static constexpr double balanced = 1e-10;       // largest residual that is a balance
  static constexpr double no_force = -1e-11;      // a force above this is one that rounding made negative
  static constexpr double near = 1e-11;           // pairs nearer than this are tested in two doubles
  // ---- saddles
  static constexpr int projections = 4;      // of a random motion on those that keep all contacts closed
  static constexpr double no_motion = 1e-5;  // rest of it where there is none
  static constexpr double turning = 1e-7;    // rate at which such a motion opens contacts
  static constexpr double push = 1e-2, mu_after_push = 1e-3;
  static constexpr int pushes = 30;
};

}  // namespace jam::inside
