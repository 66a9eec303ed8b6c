// Soft spheres: positions to twice the digits of a double, and the energy, forces and contacts that follow from them.
//
// In plain doubles the overlap of a pair is known to 1e-16 of a diameter, so that forces balance to 1e-16 / overlap at
// best. Here a sphere is at base + displacement. Each pair keeps sigma^2 - r^2 of the base positions, taken in
// double-double, and small displacements change it without cancellation:
//     sigma^2 - r^2 = reference - du . (2 r0 + du),     overlap = (sigma^2 - r^2) / (sigma + r).
// A wall is a contact at distance r = sigma = radius; its reference is the overlap itself, which the container changes.
// In a free cell du also holds E r0 (FreeCell). Amplitudes of strain stand behind the displacements, as lengths:
// amplitude = length / (mean diameter sqrt(n)), so that all unknowns are about as stiff.
#pragma once
#include "core/double_double.hpp"
#include "core/pair_energy.hpp"
#include "core/pairs.hpp"

namespace jam::inside {

// A cell that minimisers of soft spheres may deform. Sphere vectors become r = (1 + E) r0 + du, with E upper-triangular
// and few amplitudes, so that r is linear in the displacements, and at fixed pressure in the amplitudes too.

// What may change. With a pressure P the enthalpy U + P V is minimised; without, U at fixed volume. A target tensor D
// beyond P adds V0 D_ab E_ab, E from the cell of volume V0 where the pairs were last listed. Such work of fixed loads
// has a potential, which that of a given Cauchy stress has not. Where E = 0 both agree: there the stress is P + D.
struct FreeCell {
  int dim = 0;
  uint32_t axes = 0;  // that may strain (bits): those without walls
  bool volume = false;
  double pressure = 0.0;
  std::vector<double> beyond;    // D, (dim, dim), 0 for components that are not free; empty: none
  std::vector<double> matrices;  // (count, dim, dim): strain of amplitude 1
  int count() const { return dim ? static_cast<int>(matrices.size()) / (dim * dim) : 0; }
  bool open(int c) const { return (axes >> c & 1) != 0; }
  int open_axes() const;
  double open_part(const double *n) const;  // of n^2 = 1, that along these axes; 1 where all are open
};

// strain: bits of jam_free_strain; components: bit c dim + k allows component (c, k), c <= k, of two axes without
// walls.
FreeCell free_cell_of(int dim, int32_t strain, int64_t components, double pressure, uint32_t axes = ~0u);

// The free components are to hold this stress (dim, dim): sets pressure and beyond. JAM_E_ARGUMENT where repulsion
// cannot.
void hold_stress(FreeCell &cell, int32_t strain, const double *stress);

// E with (1 + E) from = to, vector by vector, (dim, dim).
std::vector<double> strain_between(const Cell &from, const Cell &to);

struct CellStrain {
  std::vector<double> e;      // E, (dim, dim)
  std::vector<double> slope;  // dE / d amplitude, (count, dim, dim)
  double log_volume = 0.0;    // ln det(1 + E)
};

// E = lambda (1 + sum_k a_k M_k) - 1, where lambda = 1 with a free volume, else that which keeps the volume.
CellStrain strain_of(const FreeCell &cell, const double *amplitude);
// Second derivatives of V(E) at fixed pressure, and of U through lambda at fixed volume, at E = 0: both are
// (tr M_k tr M_l - sum_c M_kcc M_lcc) pressure V. (count, count)
std::vector<double> volume_curvature(const FreeCell &cell);

// Sums over all overlapping pairs, in units of epsilon; lengths in the unit of the box.
struct SoftSums {
  double energy = 0.0;   // U
  double virial = 0.0;   // sum of f r
  double force = 0.0;    // sum of f
  double overlap = 0.0;  // sum of sigma - r
  double work = 0.0;     // of the pressure and other loads of a free cell since the start
  double stress = 0.0;   // largest stress that a free cell leaves, less the target, over the pressure
  double enthalpy() const { return energy + work; }
  int64_t contacts = 0;
  int64_t coincident = 0;  // of them between spheres at one centre: no minimum, whatever the forces are
  double mean_force() const { return contacts > 0 ? force / static_cast<double>(contacts) : 0.0; }
  // Typical d2v / dr2 of a contact.
  double stiffness(double alpha) const { return overlap > 0.0 ? (alpha - 1.0) * force / overlap : 0.0; }
  // ln(R / R_J) of a minimum whose energy falls as (ln R - ln R_J)^alpha, from dU / d ln R = W (virial sum).
  double distance(double alpha) const { return virial > 0.0 ? alpha * energy / virial : 0.0; }
};

// Overlapping pairs one by one: their place in pairs(), overlap, force, r_ij, and force / r_ij; of walls minus force
// times curvature.
struct SoftContacts {
  std::vector<size_t> pair;
  std::vector<double> overlap, force, distance, transverse;
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
  int32_t precision() const { return precision_; }
  const Packing &base() const { return base_; }
  const PairList &pairs() const { return pairs_; }
  // Positions rounded to doubles, inside the box.
  Packing packing() const;
  double diameter_mean() const { return diameter_mean_; }

  // Frees the cell: amplitudes join the displacements, in blocks of dim.
  void free_cell(const FreeCell &cell);
  const FreeCell &cell() const { return at_.free; }
  size_t strains() const { return static_cast<size_t>(at_.free.count()); }
  // Displacements of spheres, and blocks of dim with the strains.
  size_t spheres() const { return base_.position.size(); }
  size_t blocks() const { return displacement_.size() / static_cast<size_t>(base_.dim); }
  // At the present amplitudes; slopes are by the lengths behind the displacements.
  CellStrain strain() const;
  double amplitude_unit() const { return at_.unit; }
  const double *base_vector(size_t pair) const { return &vector_[pair * static_cast<size_t>(base_.dim)]; }

  // Forces on all spheres and on the strains (blocks, dim), and the sums.
  SoftSums evaluate(std::vector<double> &force) const;
  SoftContacts contacts() const;
  // Displacements since the last rebase; call moved() after a change.
  std::vector<double> &displacement() { return displacement_; }
  const std::vector<double> &displacement() const { return displacement_; }
  // Makes the neighbour list and its references again where spheres have gone farther than the list allows. True then:
  // displacements have got another origin.
  bool moved();
  // The same in any case. Left by Cancelled, the state is where the list before was made.
  void rebase();
  void scale_diameters(double factor);

 private:
  template <int D>
  SoftSums evaluate_in(std::vector<double> &force, const CellStrain *strain) const;
  void add_cell(SoftSums &sums, const CellStrain &strain, const std::vector<double> &stress,
                std::vector<double> &force) const;
  double load_work(const CellStrain &strain) const;
  // Takes the strain into the cell, and returns it (dim, dim); the spheres follow in wrap_sphere.
  std::vector<double> fold_strain();
  void strain_sphere(const std::vector<double> &strain, const double *base, DoubleDouble *x) const;
  void deform_base(Packing &p) const;
  void wrap_sphere(size_t at, const std::vector<double> *strain);
  void take_references();
  // The energy has a cusp where two spheres share a centre. r of such a pair becomes a short vector, along itself where
  // it is not 0, else along a direction drawn by the seed: then they push each other apart. Returns its square.
  double part_coincident(size_t pair, double *r) const;
  // The overlap with the wall of a pair, and its normal.
  double wall_overlap(size_t pair, double *normal) const;
  void add_wall(size_t pair, SoftSums &sums, std::vector<double> &force) const;
  void add_wall_contact(size_t pair, SoftContacts &out) const;

  Packing base_;
  PairEnergy energy_;
  int32_t precision_;
  double diameter_mean_, skin_;
  int64_t uses_ = 0;                  // evaluations since the list was made
  std::vector<double> displacement_;  // (n, dim)
  // What is free of the cell, 1 / (diameter sqrt(n)), the rounding of its vectors as a strain (dim, dim), and the work
  // up to now.
  struct CellState {
    FreeCell free;
    double unit = 0.0;
    std::vector<double> low;
    double work = 0.0;
  };
  CellState at_;
  // Where the list was made.
  std::vector<double> listed_base_, listed_displacement_;
  Cell listed_cell_;
  CellState listed_at_;
  PairList pairs_;
  std::vector<double> vector_, reference_, sigma_, inverse_;  // r0 (pairs, dim), sigma^2 - r0^2, sigma, 1 / sigma
  bool walls_ = false;                                        // whether the list holds any
};

// One flag a contact: whether it is between stable spheres, those that d + 1 or more contacts hold.
std::vector<char> stable_contacts(const SoftState &state, const SoftContacts &contacts);

}  // namespace jam::inside
