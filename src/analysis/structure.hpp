// Structure of a packing: gaps, classes of contacts, vectors of a sphere's contacts, correlations, bond order.
#pragma once
#include <array>
#include <complex>
#include <string>
#include <vector>

#include "network/contact_network.hpp"

namespace jam::inside {

// All pairs (every image, a sphere's own too) with h < h_max but the contacts of `network` (which may be NULL);
// stable_only leaves out pairs with a rattler of the network.
PairList pairs_without_contacts(const Packing &p, const ContactNetwork *network, double h_max, bool stable_only);

struct Gaps {
  std::vector<double> gap;    // ascending
  std::vector<int32_t> pair;  // (gaps, 2)
};
// Their gaps, and how many there are.
size_t count_gaps(const Packing &p, const ContactNetwork *network, double h_max, bool stable_only);
Gaps find_gaps(const Packing &p, const ContactNetwork *network, double h_max, bool stable_only);

// Spheres within a gap h < h_max of each one, every image.
void check_near_coordination(double h_max);  // before the work: JAM_E_ARGUMENT unless 0 < h_max <= 1
std::vector<int32_t> near_coordination(const Packing &p, double h_max);

// Flags of jam_contact_class for every contact.
std::vector<int32_t> classify_contacts(const Packing &p, const ContactNetwork &network);

struct SphereStructure {
  std::vector<double> c;  // (n, d) sum of n_ij, or of f_ij n_ij
  std::vector<double> s;  // n: sum over pairs of contacts of n_ij . n_ik, or of f_ij f_ik n_ij . n_ik
};
SphereStructure sphere_structure(const Packing &p, const ContactNetwork &network, bool weighted);
struct ContactDots {
  std::vector<double> dot;
  std::vector<int32_t> sphere;
};
// Of every sphere, without computing them.
std::vector<size_t> count_contact_dots(const Packing &p, const ContactNetwork &network, bool weighted);
ContactDots contact_dots(const Packing &p, const ContactNetwork &network, bool weighted);

// Mean of n_a n_b over the contacts, (d, d); NaN without contacts.
std::vector<double> fabric_tensor(const ContactNetwork &network, int dim);

// Values of a jam_local_quantity that belong to a jam_population; JAM_E_ARGUMENT for an unknown combination.
size_t count_local_values(const Packing &p, const ContactNetwork &network, int32_t quantity, int32_t which);
std::vector<double> local_values(const Packing &p, const ContactNetwork &network, int32_t quantity, int32_t which);

void check_pair_correlation(const Packing &p, size_t kind_len, double r_max, int64_t bins);
// g_ab(r) in `bins` bins up to r_max mean diameters. kind: one label a sphere or empty; a, b < 0: any.
std::vector<double> pair_correlation(const Packing &p, const int32_t *kind, size_t kind_len, int32_t a, int32_t b,
                                     double r_max, size_t bins);

struct StructureFactor {
  std::vector<double> q, s;  // one value for each length of a wave vector of the cell, ascending
};
// lengths_only: q is right, s is not.
StructureFactor structure_factor(const Packing &p, double q_max, bool lengths_only = false);

// Before the work: throws JAM_E_ARGUMENT.
void check_bond_order(int l, double cutoff);
// Q_l of every sphere from all neighbours with |r| < cutoff sigma_ij.
std::vector<double> bond_order(const Packing &p, int l, double cutoff);
// Volume of a sphere over that of its radical Voronoi cell; d = 3, needs voro++ at build time (JAM_E_UNSUPPORTED).
std::vector<double> local_fractions(const Packing &p);
void check_local_fractions(const Packing &p);  // before the work

// Comparison of two packings, sphere by sphere.
struct Comparison {
  jam_comparison_report numbers{};
  std::vector<double> displacement;  // (n, d) from a to b without its mean over spheres stable in both
  std::string doubts;                // what differs and makes an answer one of several; empty when nothing does
};
// Networks may be NULL. JAM_E_ARGUMENT when n, dim, cell or model differ.
Comparison compare_packings(const Packing &a, const ContactNetwork *na, const Packing &b, const ContactNetwork *nb);

// Sums of exp(2 pi i m . s) over points s, for all whole m up to a bound: spread on a grid, and transformed there.

// For m[0] in 0..most[0], other m[c] in -most[c]..most[c]; the sum at -m is the conjugate one. Of unused axes `most` is
// 0. The kernel is that of A. H. Barnett, J. Magland and L. af Klinteberg, SIAM J. Sci. Comput. 41, C479 (2019).
class FourierSums {
 public:
  using Bounds = std::array<int, 3>;
  // s: (points, axes), in cell vectors. Relative to the number of points, sums are exact to 1e-12.
  FourierSums(const std::vector<double> &s, size_t axes, const Bounds &most);
  std::complex<double> at(const int *m) const { return sum_[index(m)]; }
  // Of the grid and the sums, and about the seconds that they take.
  static double bytes(const Bounds &most);
  static double seconds(size_t points, const Bounds &most);

 private:
  size_t index(const int *m) const {
    size_t at = static_cast<size_t>(m[0]);
    for (size_t c = 1; c < axes_; ++c) at = at * width(c) + static_cast<size_t>(m[c] + most_[c]);
    return at;
  }
  size_t width(size_t c) const { return (c == 0 ? 1 : 2) * static_cast<size_t>(most_[c]) + 1; }
  std::vector<double> spread(const std::vector<double> &s) const;
  void transform(const std::vector<double> &grid);

  size_t axes_;
  Bounds most_;
  std::array<size_t, 3> side_{1, 1, 1};  // of the grid
  std::vector<std::complex<double>> sum_;
};

}  // namespace jam::inside
