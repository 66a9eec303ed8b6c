// What the path maximises, and the equations that radii keep meanwhile.
//
//     sum      sum w_i R_i
//     moments  L ln lambda, while P_q = sum R_i^q is lambda^q M_q for each exponent q; M_q: at the start
//
// With g_q = ln(P_q / M_q) / q, ln lambda is g of the first exponent. The others give one equation each,
// g_q - g_first = 0. Their gradients on the radii are dense columns, which border the matrix of a step.
#pragma once
#include "core/double_double.hpp"
#include "core/packing.hpp"

namespace jam::inside {

class RadiiGoal {
 public:
  explicit RadiiGoal(const std::vector<double> &weight);           // of mean 1
  RadiiGoal(const Packing &start, std::vector<double> exponents);  // JAM_E_ARGUMENT where they fix the radii
  bool moments() const { return !exponent_.empty(); }
  size_t equations() const { return moments() ? exponent_.size() - 1 : 0; }
  // Gradients at these radii: of what is maximised, of mean 1; and of the equations, (equations, n), orthonormal.
  void linearise(const Packing &p);
  const std::vector<double> &weight() const { return weight_; }
  const std::vector<double> &columns() const { return column_; }
  // What the forces on each sphere add up to when the columns have these multipliers.
  std::vector<double> carried(const std::vector<double> &multiplier) const;
  // The equations in the basis of the columns: lengths.
  std::vector<double> wrong(const Packing &p) const;
  // What the step, of the unknowns of RadiiRows, gains in this part, from where the goal is linear to the radii of
  // `to`.
  double gain(const std::vector<double> &step, double part, const Packing &to) const;
  // Of each radius the second derivative of the same, negative; 0 where it is positive. Empty for sums.
  std::vector<double> stiffness(const Packing &p, const std::vector<double> &multiplier) const;
  // Second derivative along x, such a step, of what is maximised less the multipliers times the equations.
  double curvature(const Packing &p, const std::vector<double> &multiplier, const std::vector<double> &x) const;

  double lambda(const Packing &p) const;    // moments
  double residual(const Packing &p) const;  // largest |P_q / (lambda^q M_q) - 1|
  // lambda_q for each exponent: in units of lambda the forces on sphere i add up to sum_q lambda_q q R_i^(q - 1).
  std::vector<double> multipliers(const Packing &p, const std::vector<double> &of_columns) const;
  double scale() const { return scale_; }  // L

 private:
  DoubleDouble moment(const Packing &p, double exponent) const;
  double growth(const Packing &p, size_t q) const;  // g_q
  std::vector<double> of_moments(const std::vector<double> &multiplier) const;
  std::vector<double> weight_, column_, exponent_;
  std::vector<double> triangle_;     // (equations, equations), upper: gradients of the equations = columns times this
  std::vector<DoubleDouble> start_;  // M_q, of radii over length_
  DoubleDouble here_;                // P of the first exponent, where the goal is linear
  double length_ = 1.0, scale_ = 1.0;
};

}  // namespace jam::inside
