// The cone of non-negative self-stresses {f >= 0, A^T f = 0}: its largest support, the state in its middle, and a
// motion that opens all other contacts.
#pragma once
#include <vector>

#include "network/constraint_rows.hpp"

namespace jam::inside {

struct StressCone {
  bool decided = false;        // both certificates below hold
  std::vector<char> carrying;  // K+: contacts with a positive force in some state
  std::vector<double> force;   // positive on K+, 0 elsewhere, mean 1 on K+; A^T f = 0 to rounding
  std::vector<double> motion;  // A x = 0 on K+, > 0 on all other contacts; empty when all contacts carry
  // Where not decided: the largest set with a positive state that was found, and forces > 0 near it on all contacts.
  std::vector<char> positive;
  std::vector<double> path_force;
  // The same for guesses without pulled contacts: they may prove a packing jammed, and nothing else.
  std::vector<char> pushed;
  std::vector<double> pushed_force;
  int factorisations = 0;
};
// states: dimension of the null space of A^T, -1 when not known. solver: of `rows`, factored with unit weights.
StressCone find_stress_cone(const ConstraintRows &rows, const NormalSolver &solver, int64_t states);

}  // namespace jam::inside
