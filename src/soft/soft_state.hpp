// Soft spheres: positions to twice the digits of a double, and the energy, forces and contacts that follow from them.
//
// In plain doubles the overlap of a pair is known to 1e-16 of a diameter, so that forces balance to 1e-16 / overlap at
// best. Here a sphere stands at base + displacement. Each pair keeps sigma^2 - r^2 of the base positions, taken in
// double-double, and small displacements change it without cancellation:
//     sigma^2 - r^2 = reference - du . (2 r0 + du),     overlap = (sigma^2 - r^2) / (sigma + r).
#pragma once
#include <cstdint>
#include <vector>

#include "core/packing.hpp"
#include "core/pair_energy.hpp"
#include "core/pairs.hpp"

namespace jam {

// Sums over all overlapping pairs, in units of epsilon; lengths in the unit of the box.
struct SoftSums {
  double energy = 0.0;   // U
  double virial = 0.0;   // sum of f r
  double force = 0.0;    // sum of f
  double overlap = 0.0;  // sum of sigma - r
  int64_t contacts = 0;
  double mean_force() const { return contacts > 0 ? force / static_cast<double>(contacts) : 0.0; }
  // Typical d2v / dr2 of a contact.
  double stiffness(double alpha) const { return overlap > 0.0 ? (alpha - 1.0) * force / overlap : 0.0; }
  // ln(R / R_J) of a minimum whose energy falls as (ln R - ln R_J)^alpha, from dU / d ln R = W (virial sum).
  double distance(double alpha) const { return virial > 0.0 ? alpha * energy / virial : 0.0; }
};

// Overlapping pairs one by one: their place in pairs(), overlap, force and r_ij.
struct SoftContacts {
  std::vector<size_t> pair;
  std::vector<double> overlap, force, distance;
  std::vector<double> normal;  // (contacts, dim), n_ij from j to i
  size_t size() const { return pair.size(); }
};

class SoftState {
 public:
  // precision: a jam_soft_precision.
  SoftState(const Packing &p, const PairEnergy &energy, int32_t precision);

  int dim() const { return base_.dim; }
  size_t n() const { return base_.n(); }
  const PairEnergy &energy() const { return energy_; }
  const Packing &base() const { return base_; }
  const PairList &pairs() const { return pairs_; }
  // Positions rounded to doubles, inside the box.
  Packing packing() const;
  double diameter_mean() const { return diameter_mean_; }

  // Forces on all spheres (n, dim) and the sums.
  SoftSums evaluate(std::vector<double> &force) const;
  SoftContacts contacts() const;
  // Displacements since the last rebase; call moved() after a change.
  std::vector<double> &displacement() { return displacement_; }
  const std::vector<double> &displacement() const { return displacement_; }
  // Makes the neighbour list and its references anew where spheres have gone farther than the list allows. True then:
  // displacements have got another origin.
  bool moved();
  // The same in any case. Left by Cancelled, the state is where the list before was made.
  void rebase();
  void scale_diameters(double factor);

 private:
  template <int D>
  SoftSums evaluate_in(std::vector<double> &force) const;
  void wrap_sphere(size_t at);
  void take_references();

  Packing base_;
  PairEnergy energy_;
  int32_t precision_;
  double diameter_mean_, skin_;
  int64_t uses_ = 0;                                       // evaluations since the list was made
  std::vector<double> displacement_;                       // (n, dim)
  std::vector<double> listed_base_, listed_displacement_;  // where the list was made
  PairList pairs_;
  std::vector<double> vector_, reference_, sigma_, inverse_;  // r0 (pairs, dim), sigma^2 - r0^2, sigma, 1 / sigma
};

// One flag a contact: whether it is between stable spheres, those that d + 1 or more contacts hold.
std::vector<char> stable_contacts(const SoftState &state, const SoftContacts &contacts);

}  // namespace jam
