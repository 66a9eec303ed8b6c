// The numbers that steer a proof. None of them is part of what is proved: a bad choice loses a proof, never makes one.
#pragma once
#include <cstddef>

namespace jam::inside::proof_tuning {

constexpr double leaning = 1e-2;  // forces in the middle over those that close, in a proof of such pairs
// Inverse iterations, which give the smallest eigenvalue to some percent. Rounds: in each all contacts that do not
// close leave, and overlapping pairs enter. LPs about positions in two doubles.
constexpr int most_rounds = 30;
// Doubles hold gaps, states and positions of a round to this part: what is left waits for the next round. A motion by
// as much opens pairs that hold spheres by its square, over Gamma.
constexpr double vanishing = 1e-9, nearly_closed = vanishing * vanishing;
// LPs move by the length `vanishing`, over the diameter of ratio 1, then by as small a part of it, which is what an LP
// leaves of its step. Pairs count as closed where |r|^2 / sigma^2 - Gamma, in two doubles (rounding 1e-32), is below
// what an LP leaves of a step of length nearly_closed.
constexpr double closed = nearly_closed * vanishing;
constexpr double still_climbs = 1e-3;  // gain of Gamma over the step, above which a step of this length is repeated
constexpr size_t largest_lp = 4000;    // rows that Clp solves in seconds; it is not asked to stop in between
constexpr double weak = 1e-5;          // forces over the mean, below which listed contacts may be open ones
// Shifts that are tried, as parts of the smallest eigenvalue: the largest one proves the most.
constexpr double parts_of_eigenvalue[] = {0.6, 0.3, 0.1};
constexpr int patch = 6;  // tiles that far from a contact may imply it
// Far above any radius of a proof. Relative gaps up to this are examined with exact numbers; the sine of a corner of a
// tile is at least this. A rattler moves out of an overlap by no more, over its size.
constexpr double far_above = 1e-3;

}  // namespace jam::inside::proof_tuning
