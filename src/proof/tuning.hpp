// The numbers that steer a proof. None of them is part of what is proved: a bad choice loses a proof, never makes one.
#pragma once
#include <cstddef>

namespace jam::inside::proof_tuning {

constexpr int refinements = 3;          // of a solve: each takes condition times rounding off
constexpr int inverse_iterations = 30;  // to some percent of the smallest eigenvalue
constexpr int newton_steps = 2;         // a third one gains nothing (tests/bench/README.md, "Proofs")
constexpr double closed = 1e-26;        // |r|^2 / sigma^2 - Gamma in two doubles; rounding is 1e-32
constexpr double leaning = 1e-2;        // forces in the middle over those that close, in a proof of such pairs
// Rounds: in each all contacts that do not close leave, and overlapping pairs enter. LPs about positions in two
// doubles.
constexpr int most_rounds = 50;
// Doubles hold gaps, states and positions of a round to this part: what is left waits for the next round. A motion by
// as much opens pairs that hold spheres by its square, over Gamma.
constexpr double vanishing = 1e-9, nearly_closed = vanishing * vanishing;
// LPs: first the length `vanishing`, over the diameter of ratio 1, then this part of it, down to the last one. An LP
// leaves 1e-9 of its step.
constexpr double shorter_step = 1e-5, last_step = 1e-30;
constexpr double still_climbs = 1e-3;  // gain of Gamma over the step, above which a step of this length is repeated
constexpr double beyond_step = 30.0;   // gaps over the step that two spheres cannot close
constexpr size_t largest_lp = 4000;    // rows that Clp solves in seconds; it is not asked to stop in between
constexpr double freed = 1e-6;         // longest way of a rattler out of an overlap, over its size
constexpr double as_narrow = 4.0;      // gaps over the overlap of a rattler that has no room between them
constexpr int turns = 1000;            // of the search for it
constexpr double weak = 1e-5;          // forces over the mean, below which listed contacts may be open ones
// Shifts that are tried, as parts of the smallest eigenvalue: the largest one proves the most.
constexpr double parts_of_eigenvalue[] = {0.6, 0.3, 0.1};
constexpr int patch = 6;             // tiles that far from a contact may imply it
constexpr double clear_turn = 1e-3;  // least sine of a tile's corner: far above any radius
constexpr double near = 1e-3;        // relative gaps up to this are examined with exact numbers

}  // namespace jam::inside::proof_tuning
