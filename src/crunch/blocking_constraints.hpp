// Forces that keep a few rows from cutting a step of the path short: each is sized by how far its row gave way to the
// last change, as if no other were pushed (a secant for each row). Where a row does not give way nothing is lost: the
// search along the line stops before it.
#pragma once
#include <vector>

#include "crunch/barrier.hpp"

namespace jam {

class BlockingConstraints {
 public:
  // For the direction x that solves the Newton system with these weights y/c.
  void begin(const Barrier &b, const std::vector<double> &weight, const BarrierStep &x);
  // Changes of the products y c that also push the rows which x closes up to alpha = aim. x: the last direction that
  // `b.search` saw. False where it closes none.
  bool push(const Barrier &b, const BarrierStep &x, double aim, std::vector<double> &target);
  // How far the rows gave way between the directions before and after a push.
  void learn(const BarrierStep &before, const BarrierStep &after);

 private:
  std::vector<double> base_, force_, change_, compliance_, weight_;
};

}  // namespace jam
