// The matrix of a Newton step on the path: which rows couple spheres in it, its numbers, and whether it is factored
// anew or solved with the factor of an earlier step.
#pragma once
#include <vector>

#include "core/packing.hpp"
#include "crunch/barrier.hpp"
#include "lp/newton_system.hpp"

namespace jam {

class PathMatrix {
 public:
  // solves_worth: how many triangular solves cost as much as a factorisation; 0: from the sizes of both.
  PathMatrix(NewtonSystem &system, int threads, int solves_worth)
      : system_(system), threads_(threads), worth_(solves_worth) {}

  // The pairs are others now.
  void forget(size_t rows, size_t unknowns);
  // The numbers of the matrix at the present rows, with `proximal` on its diagonal.
  void weigh(const Packing &p, const Barrier &b, double proximal);
  bool factorise();
  // True where this step goes with the factor at hand as preconditioner: after a step of which a small part was taken,
  // with forces near balance, if that is cheaper and the last such step was.
  bool follow(double part, double balance);
  // Changes ds, dg for the right-hand sides rhs, h. When following, from the guess in ds; false when it takes too long.
  bool solve(const double *rhs, double h, double *ds, double *dg);
  // The first direction of a step that follows is found: its price decides about the next step, and correctors may cost
  // as much again.
  void found();

  // y / c of every row.
  const std::vector<double> &weight() const { return weight_; }
  bool following() const { return following_; }
  int solves() const { return following_ ? system_.pcg_solves : 0; }
  size_t near() const { return near_.size(); }

 private:
  void choose_near(const Packing &p, const Barrier &b);

  NewtonSystem &system_;
  const int threads_, worth_;
  std::vector<size_t> near_;  // rows in the matrix, ascending
  PairList near_pairs_;
  std::vector<double> near_a_, near_weight_, weight_, diagonal_;
  bool following_ = false;
  int price_ = 0,
      most_ = 0;  // solves that the last step spent that followed since the factorisation; that this one may spend
};

}  // namespace jam
