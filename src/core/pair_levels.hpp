// Spheres by the reach of their pairs, with cells for each level, from which pair lists are made: a small sphere meets
// those of its own size in small cells and large ones in large cells.
#pragma once
#include <algorithm>
#include <array>
#include <functional>
#include <memory>

#include "core/call_scope.hpp"
#include "core/pair_rule.hpp"
#include "core/pairs.hpp"

namespace jam::inside {

// The level of a reach: how often it is halved from the widest one, except for less than a factor of two.
constexpr size_t most_halvings = 30;  // 1e9 between the widest and the narrowest
inline size_t halvings(double reach, double widest) {
  size_t count = 0;
  for (double r = 2.0 * reach; r < widest && count < most_halvings; r *= 2.0) ++count;
  return count;
}

// Spheres sorted by cell; a cell's members are members[start[cell] .. start[cell + 1]).
class PairCells {
 public:
  PairCells(const Packing &p, const std::vector<int32_t> &spheres, int64_t side);
  // Calls f(j) for every member of the 3^d cells around the place of i, a member or not.
  template <class F>
  void around(const Packing &p, int32_t i, F &&f) const {
    std::array<int64_t, JAM_MAX_DIM> at{};
    place(p, i, at.data());
    visit(dim_ - 1, 0, at, f);
  }

 private:
  void place(const Packing &p, int32_t i, int64_t *at) const;
  template <class F>
  void visit(int c, int64_t cell, const std::array<int64_t, JAM_MAX_DIM> &at, F &&f) const {
    if (c < 0) {
      for (int32_t k = start_[cell]; k < start_[cell + 1]; ++k) f(members_[k]);
      return;
    }
    for (int64_t step = -1; step <= 1; ++step) {
      const int64_t to = at[c] + step, k = to < 0 ? to + side_ : to < side_ ? to : to - side_;
      visit(c - 1, cell * side_ + k, at, f);
    }
  }
  int dim_;
  int64_t side_;
  Cell basis_;
  std::vector<int32_t> start_, members_;
};

struct PairLevel {
  std::vector<int32_t> member;       // ascending
  std::unique_ptr<PairCells> cells;  // null: fewer than four along an axis
};

// Levels of a factor of two in reach[i] + slope * diameter, coarsest first. The cells of each are no narrower than the
// cutoff of any of its spheres with one of its own level or a finer one.
std::vector<PairLevel> pair_levels(const Packing &p, const std::vector<double> &reach, double slope);

// Pairs of spheres for what needs no list of them.

// Takes the pairs of spheres that find_pairs lists, without walls, in parts and in no order.
using TakePairs = std::function<void(const PairList &part)>;
void visit_pairs(const Packing &p, double reach, double slope, const TakePairs &take);

// What a search of pairs gathers: candidates within the cutoff of a pair, sphere by sphere. Shared by the search by
// brute force (pair_search.cpp) and that by levels (pair_level_search.cpp).
struct Candidate {
  int32_t j;
  Cell::Vector offset;
};

// Fails where a list would take too large a part of the memory limit.
void check_list_size(double pairs, int dim);

// One sphere may have most of the pairs: the limits hold while its own gather too.
inline void keep(std::vector<Candidate> &found, const Candidate &candidate, int dim) {
  if (found.size() == found.capacity()) {
    CallScope::look();
    check_list_size(2.0 * static_cast<double>(found.size()), dim);
  }
  found.push_back(candidate);
}

// All images of one pair within a cutoff. Of the images of a sphere with itself one of each pair +-r is kept.
class ImageScan {
 public:
  explicit ImageScan(const Packing &p) : p_(p), quenched_(p) {}

  void scan(int32_t i, int32_t j, double cutoff, std::vector<Candidate> &found) const {
    const int d = p_.dim;
    Cell::Vector shift{}, dx{};
    if (p_.model == JAM_MODEL_MK && i != j) {
      quenched_.get(i, j, shift.data());
      p_.cell.combine(shift.data(), shift.data());
    }
    for (int c = 0; c < d; ++c) dx[c] = difference(i, j, c) + shift[c];
    p_.cell.images(dx.data(), cutoff, [&](const double *image) {
      Candidate now{j, {}};
      for (int c = 0; c < d; ++c) now.offset[c] = shift[c] + image[c];
      const double *first = std::find_if(image, image + d, [](double x) { return x != 0.0; });
      if (i != j || (first != image + d && *first > 0.0)) keep(found, now, d);
    });
  }
  // The one image within a cutoff that is shorter than half of every edge; false where there is none.
  bool nearest(int32_t i, int32_t j, double cutoff, Candidate &found) const {
    Cell::Vector dx;
    for (int c = 0; c < p_.dim; ++c) dx[c] = difference(i, j, c);
    p_.cell.nearest_shift(dx.data(), found.offset.data());
    double r2 = 0.0;
    for (int c = 0; c < p_.dim; ++c) r2 += (dx[c] + found.offset[c]) * (dx[c] + found.offset[c]);
    return r2 < cutoff * cutoff;
  }

 private:
  double difference(int32_t i, int32_t j, int c) const {
    const size_t d = static_cast<size_t>(p_.dim);
    return p_.position[i * d + c] - p_.position[j * d + c];
  }

  const Packing &p_;
  const MkShifts quenched_;
};

// Pairs farther apart are left out. `own`: NULL, or a reach for each sphere, of which `reach` is the longest. `only`:
// NULL, or flags of spheres, of which a pair must have one.
struct Cutoff {
  const Packing &p;
  double reach, slope;
  const double *own = nullptr;
  const char *only = nullptr;
  bool walls = true;

  bool wants(int32_t i, int32_t j) const { return !only || only[i] || (j >= 0 && only[j]); }

  double most() const { return reach + slope * contact_distance_max(p); }
  double of(int32_t i, int32_t j) const {
    return (own ? std::max(own[i], own[j < 0 ? i : j]) : reach) + slope * contact_distance(p, i, j);
  }
};

// Appends the pairs of sphere i, its walls among them, in the order of the list.
void append_sorted(PairList &list, int32_t i, const Cutoff &cutoff, std::vector<Candidate> &found);

// take: NULL, or takes parts of the list, which is then empty in the end.
inline void give_part(PairList &list, const TakePairs *take, size_t least) {
  if (!take || list.size() < least) return;
  (*take)(list);
  list.clear();
}

// By cells of levels of reach (core/pair_levels.hpp); model JAM_MODEL_EUCLID.
PairList search_by_levels(const Cutoff &cutoff, const TakePairs *take);

}  // namespace jam::inside
