// Pairs of spheres within a cutoff, with the image (and in the MK model the quenched shift) of each.
#pragma once
#include "core/packing.hpp"

namespace jam::inside {

// Structure of arrays; r_ij = position_i - position_j + offset_ij. i < j, or i == j for a sphere and its own image
// (then r_ij = offset_ij). Two spheres can be listed several times, once for each image. j < 0: the wall -1 - j of the
// container, a partner that does not move (core/container.hpp); r_ij comes from its nearest point, the offset is 0.
struct PairList {
  std::vector<int32_t> i, j;
  std::vector<double> offset;  // (count, dim)
  size_t size() const { return i.size(); }
  // A sphere and its own image: only strains change their distance.
  bool own_image(size_t k) const { return i[k] == j[k]; }
  bool wall(size_t k) const { return j[k] < 0; }
  void clear() {
    i.clear();
    j.clear();
    offset.clear();
  }
  // Pair k of another list of the same packing.
  void append(const PairList &from, size_t k) {
    const size_t dim = from.offset.size() / from.size();
    i.push_back(from.i[k]);
    j.push_back(from.j[k]);
    offset.insert(offset.end(), &from.offset[k * dim], &from.offset[k * dim] + dim);
  }
};

// Calls f with the spheres of a pair: both, or the one at a wall.
template <class F>
void for_spheres(int32_t i, int32_t j, F &&f) {
  f(i);
  if (j >= 0) f(j);
}

// All pairs with |r_ij| < reach + slope * sigma_ij, every image, and walls; sorted by (i, j) and then image.
// O(n) by cells when the box holds at least three of them, else all images by brute force. MK: brute force.
// JAM_E_MEMORY-like failures surface as std::bad_alloc.
PairList find_pairs(const Packing &p, double reach, double slope);
// The same with a reach for each sphere. A pair uses the longer one.
PairList find_pairs(const Packing &p, const std::vector<double> &reach, double slope);
// Of these, the pairs with at least one of some spheres, which are flagged.
PairList find_pairs_of(const Packing &p, const std::vector<char> &some, const std::vector<double> &reach, double slope);
// The same by brute force over all pairs and images: the reference for tests.
PairList find_pairs_brute(const Packing &p, double reach, double slope);
PairList find_pairs_brute(const Packing &p, const std::vector<double> &reach, double slope);

// The list with the pairs of some spheres replaced by those of another.
PairList replace_pairs(const PairList &list, const std::vector<char> &some, const PairList &theirs);

// Carries values from one list to another: 0 for pairs that the first does not hold. Images of one pair keep their
// order.
std::vector<double> carry_over(const PairList &from, const std::vector<double> &values, const PairList &to);

// Smallest h = |r_ij| / sigma_ij - 1 over all pairs of spheres and its pair; h = +inf with no pair closer than 2
// sigma_max.
struct ClosestPair {
  double gap;
  int32_t i, j;
};
ClosestPair closest_pair(const Packing &p);
// The same over pairs and walls.
ClosestPair closest_contact(const Packing &p);

// Puts every sphere back into the brick of the cell and changes the offsets so that every r_ij stays as it is.
void wrap_positions(Packing &p, PairList &pairs);

// Squared length of r_ij of pair k.
inline double pair_vector(const Packing &p, const PairList &pairs, size_t k, double *r) {
  const int d = p.dim;
  if (pairs.wall(k))
    return p.container[wall_partner(pairs.j[k])].vector(&p.position[static_cast<size_t>(pairs.i[k]) * d], r);
  const double *a = &p.position[static_cast<size_t>(pairs.i[k]) * d],
               *b = &p.position[static_cast<size_t>(pairs.j[k]) * d];
  double r2 = 0.0;
  for (int c = 0; c < d; ++c) {
    r[c] = (a[c] - b[c]) + pairs.offset[k * d + c];
    r2 += r[c] * r[c];
  }
  return r2;
}

}  // namespace jam::inside
