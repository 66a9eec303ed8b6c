// The barrier path of the radii: maximises the goal (sum w_i R_i) + mu sum_k log c_k on true gaps by Newton's method,
// for a mu that falls. Steps keep the goal's equations to first order, and radii are then corrected. Each row counts as
// linear, so that the matrix is that of a linear program and the step an ascent; gaps curve upwards, so that true ones
// are wider.
#pragma once
#include "core/monitor.hpp"
#include "core/notes.hpp"
#include "radii/goal.hpp"
#include "radii/rows.hpp"

namespace jam::inside {

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
