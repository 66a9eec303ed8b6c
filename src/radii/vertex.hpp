// The end of the path: contacts closed to rounding, forces that balance and add up to the weights, and the tests that
// make the point a maximum.
#pragma once
#include "core/monitor.hpp"
#include "core/notes.hpp"
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

// The last digits of a vertex: contacts that close, forces that balance, and Newton's method on both where moments
// curve.

// Newton steps on c = 0 and the goal's equations, the shortest ones where there are more unknowns than contacts.
bool close_contacts(Packing &p, RadiiRows &contacts, RadiiGoal &goal, RadiiMatrix &matrix, double unit);
// The balanced forces nearest to those of closed contacts, and the multipliers of the goal's equations.
void balance_contacts(RadiiVertex &at, RadiiGoal &goal, RadiiMatrix &matrix);
// The part of x, of the unknowns, that keeps the contacts closed and the equations. matrix: of balance_contacts.
void keep_closed(const RadiiRows &contacts, const RadiiMatrix &matrix, std::vector<double> &x);
// Where moments or walls curve, a maximum may have fewer contacts than a vertex. Newton's method along the motions that
// keep the contacts closed, on the force that is left along them. False where that is no maximum.
bool settle_curved(RadiiVertex &at, RadiiGoal &goal, double unit, RadiiMatrix &matrix);

// Of the motions that keep contacts closed, but for rigid ones, that along which the second derivative is largest;
// empty without one.
std::vector<double> least_held(const RadiiVertex &at, const RadiiGoal &goal, const RadiiMatrix &matrix);

double longest_edge(const Packing &p);

// The barrier path of the radii: maximises the goal (sum w_i R_i) + mu sum_k log c_k on true gaps by Newton's method,
// for a mu that falls. Steps keep the goal's equations to first order, and radii are then corrected. Each row counts as
// linear, so that the matrix is that of a linear program and the step an ascent; gaps curve upwards, so that true ones
// are wider.

class RadiiPath {
 public:
  // p: without overlaps, radii between the bounds; both are kept by reference.
  RadiiPath(Packing &p, RadiiGoal &goal, const RadiiBounds &bounds, int threads);
  // Where the forces of the rows add up to the weights.
  double first_mu() const;
  // Newton steps to the maximum of this mu. False when the monitor or max_steps ended them.
  bool centre(double mu, int64_t max_steps, Monitor &monitor);
  // The forces mu / c of the rows, after one more step to first order: they balance.
  const std::vector<double> &forces() const { return force_; }
  const RadiiRows &rows() const { return rows_; }
  double unit() const { return unit_; }
  // After a change of the packing from outside.
  void renew();

  int64_t steps = 0;
  RadiiMatrix matrix;
  Notes notes;  // on cell vectors that were replaced

 private:
  void direction(double mu);
  double longest_feasible() const;
  double longest_of(const std::vector<double> &x) const;
  double ascent(double part, double mu);
  bool place(double part);
  void move(double part);
  Packing &p_;
  RadiiGoal &goal_;
  const RadiiBounds bounds_;
  const int threads_;
  const double unit_;
  RadiiRows rows_;
  Packing trial_;
  double moved_ = 0.0;              // bound on the change of an unlisted gap since the list was made
  std::vector<double> multiplier_;  // of the goal's equations, of the last step
  double corrected_ = 0.0;          // what kept the equations moved, of the trial
  double decrement_ = 0.0, slope_ = 0.0, largest_ = 0.0;
  std::vector<double> weights_, gradient_, step_, change_, force_, trial_gap_;
};

// (V / n)^(1/d).
double radii_unit(const Packing &p);
// p + part * x, x the unknowns of RadiiRows: strained, then displaced. In a fixed cell `to` keeps its own.
void move_radii(const Packing &from, const std::vector<double> &x, double part, const RadiiBounds &bounds, Packing &to);
// The strain of x, (dim, dim); empty in a fixed cell.
std::vector<double> strain_of(const RadiiBounds &bounds, const std::vector<double> &x, double part);

}  // namespace jam::inside
