// Two sides of a graph and the nodes that separate them.
#pragma once
#include "core/rng.hpp"
#include "linalg/graph.hpp"

namespace jam::inside {

struct Bisection {
  enum Side : char { left = 0, right = 1, separator = 2 };
  std::vector<char> side;  // of every node; no edge joins left and right
  int64_t weight[3] = {0, 0, 0};
  // Weight of the separator, larger where the sides are uneven.
  double cost() const;
};

// A light separator of two sides of similar weight, by multilevel bisection.
Bisection bisect(const WeightedGraph &graph, Rng &rng);

// Makes the separator lighter by moves of Fiduccia and Mattheyses: a separator node goes to one side, and its
// neighbours on the other side enter the separator.
void refine_separator(const WeightedGraph &graph, Bisection &b, int passes);

}  // namespace jam::inside
