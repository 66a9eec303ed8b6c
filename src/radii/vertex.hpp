// The end of the path: contacts closed to rounding, forces that balance and add up to the weights, and the tests that
// make the point a maximum.
#pragma once
#include "radii/goal.hpp"
#include "radii/rows.hpp"

namespace jam::inside {

struct RadiiVertex {
  bool closed = false;             // contacts closed, forces balance and are positive, no other gap is negative
  int32_t wide = -1;               // sphere at both sides of a round wall: its contact has no direction
  Packing packing;                 // no pair overlaps, in two doubles
  RadiiRows contacts;              // rows that carry force
  std::vector<double> force;       // in units of the mean weight
  std::vector<double> multiplier;  // of the goal's columns
  double balance = 0.0;          // largest residual of balance and of the sums of forces, over the weight of its sphere
  double gap = 0.0, open = 0.0;  // largest |c| of contacts; least of the other pairs
  // A motion, of the unknowns, that keeps contacts closed to first order and opens them to second: a saddle. Empty:
  // none.
  std::vector<double> escape;
  // Of contacts that closed where forces do not balance and no maximum is near: a motion along which the goal grows.
  std::vector<double> uphill;
};

// Along x of sum f c and of the goal: pairs and round walls turn, moments curve, and a strain keeps its volume.
double second_derivative(const RadiiVertex &at, const RadiiGoal &goal, const std::vector<double> &x);

// Takes units of the last digit from diameters until no pair overlaps: one, then twice as many each time. least: radii
// at this bound stay there if the partner can shrink.
void take_rounding_out(Packing &p, const PairList &pairs, double least);

// rows: near the vertex, with forces of the path. unit: radii_unit. The goal is left linear where contacts close.
RadiiVertex close_vertex(const Packing &p, const RadiiRows &rows, const std::vector<double> &forces, RadiiGoal &goal,
                         const RadiiBounds &bounds, double unit, RadiiMatrix &matrix);

}  // namespace jam::inside
