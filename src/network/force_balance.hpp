// Linear algebra on a contact network: which motion changes its gaps in a given way, which forces on it balance. One
// row a_k a contact; of a motion it gives a_k . (s_i - s_j) - g.
#pragma once
#include "linalg/newton_system.hpp"
#include "network/contact_network.hpp"

namespace jam::inside {

// Change of positions (in mean diameters) and of the common factor of the diameters.
struct Motion {
  std::vector<double> s;
  double g = 0.0;
};

// Rows of the relative gaps h = |r| / sigma - 1.
std::vector<double> relative_rows(const Packing &p, const ContactNetwork &net);

// Forces in units of their mean size, as a network has them.
void scale_to_mean(ContactNetwork &net);

bool pushes_only(const ContactNetwork &net);

class GapRows {
 public:
  // system: holds the graph of the contacts. ground: diagonal that fixes translations; on rattlers it is 1. Iterative
  // refinement restores the accuracy. net and a are kept by reference.
  GapRows(const ContactNetwork &net, int dim, const std::vector<double> &a, double ground, NewtonSystem &system);
  // Weights of the rows in the norms below, instead of 1; before factorise().
  void weigh(const std::vector<double> &weight) { weight_ = weight; }
  bool factorise() { return system_.factorise(a_.data(), weight_.data(), diagonal_.data()); }
  // The motion whose rows come nearest to `wanted`, in least squares; `rows` is what they are. Refined in the rows,
  // where a motion of 1e-6 shows digits down to 1e-22.
  Motion towards(const std::vector<double> &wanted, std::vector<double> &rows);
  // y - W A (A^T W A)^-1 A^T y with weights W, repeated, with sums in extended precision: the nearest forces that
  // balance on every sphere. W = y^2 makes relative changes small.
  void balance(std::vector<double> &y);

 private:
  NewtonSystem &system_;
  const PairList &pairs_;
  const int d_;
  const std::vector<double> &a_;
  std::vector<double> diagonal_, weight_, row_, rhs_;
};

}  // namespace jam::inside
