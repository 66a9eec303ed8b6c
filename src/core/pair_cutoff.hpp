// What a search of pairs gathers: candidates within the cutoff of a pair, sphere by sphere. Shared by the search by
// brute force (pair_search.cpp) and that by levels (pair_level_search.cpp).
#pragma once
#include <algorithm>
#include <vector>

#include "core/call_scope.hpp"
#include "core/pair_rule.hpp"
#include "core/pair_visit.hpp"
#include "core/pairs.hpp"

namespace jam::inside {

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
