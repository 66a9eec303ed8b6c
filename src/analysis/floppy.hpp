// Floppy modes: displacements when one contact opens, in a packing with a single state of self-stress.
#pragma once
#include <vector>
#include "network/self_stress.hpp"

namespace jam::inside {

struct FloppyModes {
  std::vector<double> median;     // b: median |dr_i| over |dr|
  std::vector<double> weight;     // W: f over the median |dr_i| of the field for s = 1
  std::vector<double> s_plus;     // opening at which, to first order, the next contact forms
  std::vector<double> s_star;     // opening of least diameter: f / sum_k f_k |dr_perp,k|^2 / r_k
  std::vector<double> stability;  // s_star / s_plus
  std::vector<double> s_return;   // opening at which the diameters are back: 2 s_star
  void resize(size_t m);
};

// To first order in the opening s of contact l all other contacts stay closed when the diameters change by a common
// factor 1 + gamma s: S dr = s (e_l + gamma sigma), which has a solution since f is orthogonal to the right side for
// gamma = -f_l / sum f sigma. dr has no net translation and is given for s = 1.
class FloppySolver {
 public:
  // JAM_E_STATE unless there is exactly one state of self-stress and translations are the only zero modes.
  FloppySolver(const Packing &p, const ContactNetwork &network, const RigidityMatrix &g);
  // dr (count, nodes, dim) of contacts first .. first + count - 1.
  void fields(size_t first, int count, std::vector<double> &dr) const;
  double inflation(size_t contact) const { return -force_[contact] / force_sigma_; }
  // Entry `at` of all figures, from the field dr of contact l.
  void measure(size_t l, const double *dr, FloppyModes &out, size_t at) const;

 private:
  const RigidityMatrix &g_;
  NullSpace space_;
  std::vector<double> force_;
  double force_sigma_ = 0.0;
  std::vector<double> uniform_;  // H^+ S^T sigma
  // pairs of stable spheres that are no contacts, h < 1
  std::vector<int32_t> i_, j_;
  std::vector<double> normal_, open_, sigma_;
};

// Of these contacts, which are solved in blocks of consecutive ones. vector: (contacts, nodes, dim), or NULL.
FloppyModes floppy_modes(const Packing &p, const ContactNetwork &network, const RigidityMatrix &g,
                         const std::vector<size_t> &contacts, std::vector<double> *vector);

}  // namespace jam::inside
