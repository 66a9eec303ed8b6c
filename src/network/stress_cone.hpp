// The cone of non-negative self-stresses {f >= 0, A^T f = 0}: its largest support, the state in its middle, and a
// motion that opens all other contacts.
#pragma once
#include "network/constraint_rows.hpp"
#include "network/contact_network.hpp"

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

// The last digits of a packing whose flexes the curvature of a round wall stabilises, with fewer contacts than one
// state of self-stress has otherwise: two disks in a circle, a zigzag in a tube. There forces balance at one place of a
// flex alone, and closing the contacts does not find it.

// Newton's method for all conditions of a maximum at once: forces balance, and contacts are closed. Small systems only,
// as the matrix is dense. False where it does not converge; p and net are as before then.
bool converge_at_curved_maximum(Packing &p, ContactNetwork &net);

// The central path of a jamming test: forces and motions of the self-dual problem A^T f = mu x, w = A x + mu, f w = mu,
// f > 0, w > 0. As mu falls, f stays finite on contacts that carry force in some state of self-stress, and falls as mu
// on all others, where x opens them (Goldman and Tucker 1956; path following with Mehrotra's corrector as in S. J.
// Wright, Primal-Dual Interior-Point Methods, SIAM 1997).
class CentralPath {
 public:
  explicit CentralPath(const ConstraintRows &rows);
  // One step towards a smaller mu. False where steps have become too short to continue.
  bool step();

  double mu() const { return mu_; }
  int steps() const { return steps_; }
  const std::vector<double> &f() const { return f_; }
  const std::vector<double> &w() const { return w_; }
  const std::vector<double> &x() const { return x_; }

 private:
  double worst_product(double t, const std::vector<double> &df, const std::vector<double> &dw) const;
  void direction(double mu, const std::vector<double> &correction, std::vector<double> &df, std::vector<double> &dw,
                 std::vector<double> &dx) const;

  const ConstraintRows &rows_;
  NormalSolver solver_;
  std::vector<double> x_, f_, w_;
  double mu_ = 1.0;
  int steps_ = 0;
};

}  // namespace jam::inside
