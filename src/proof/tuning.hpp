// The numbers that steer a proof. None of them is part of what is proved: a bad choice loses a proof, never makes one.
#pragma once

namespace jam::proof_tuning {

constexpr int refinements = 3;          // of a solve: each takes condition times rounding off
constexpr int inverse_iterations = 30;  // to some percent of the smallest eigenvalue
constexpr int newton_steps = 2;         // a third one gains nothing (tests/bench/results/proof.json)
// Shifts that are tried, as parts of the smallest eigenvalue: the largest one proves the most.
constexpr double parts_of_eigenvalue[] = {0.6, 0.3, 0.1};
constexpr int patch = 6;             // tiles that far from a contact may imply it
constexpr double clear_turn = 1e-3;  // least sine of a tile's corner: far above any radius
constexpr double near = 1e-3;        // relative gaps up to this are looked at with exact numbers

}  // namespace jam::proof_tuning
