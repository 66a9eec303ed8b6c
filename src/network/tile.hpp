// Supercells: copies of a packing side by side, with its contacts and forces.
//
// Copy k = (k_0, k_1, ...) is at sum k_c a_c. A contact of i and j whose partner is shifted by -sum s_c a_c joins
// copy k of i and copy (k - s) mod count of j; what the modulus takes off is a vector of the new lattice.
#pragma once
#include <array>

#include "network/contact_network.hpp"

namespace jam::inside {

// Numbers of copies along the cell vectors. Copy k is number k_0 + count[0] (k_1 + count[1] ...).
class Copies {
 public:
  // JAM_E_ARGUMENT for a count below 1 or more spheres than a packing may have; JAM_E_UNSUPPORTED for what cannot
  // repeat: a walled axis, Mari-Kurchan shifts.
  Copies(const Packing &p, const int32_t *count);
  int64_t number() const { return number_; }
  int32_t along(int c) const { return count_[c]; }
  std::array<int32_t, JAM_MAX_DIM> place(int64_t copy) const;

 private:
  int dim_;
  int64_t number_ = 1;
  std::array<int32_t, JAM_MAX_DIM> count_{};
};

// s of the lattice vector sum s_c a_c.
std::array<int32_t, JAM_MAX_DIM> lattice_steps(const Cell &cell, const double *vector);

// Of contacts of spheres with their own images, those between different copies.
ContactNetwork between_copies(const Packing &p, const ContactNetwork &own, const Copies &copies);

// The copies of p. `net`, the contacts of p, becomes theirs; NULL where there are none. JAM_E_OVERLAP where coordinates
// of the large cell no longer resolve the gaps, JAM_E_MEMORY before any work.
[[gnu::cold]] Packing tile(const Packing &p, const Copies &copies, ContactNetwork *net);

}  // namespace jam::inside
