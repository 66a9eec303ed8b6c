// Finds pairs by cells, and by brute force over all images for small boxes.
#include "core/pairs.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/call_scope.hpp"
#include "core/error.hpp"
#include "core/math.hpp"
#include "core/pair_levels.hpp"
#include "core/pair_rule.hpp"
#include "core/pair_visit.hpp"
#include "core/tuning.hpp"

namespace jam::inside {
namespace {

struct Candidate {
  int32_t j;
  Cell::Vector offset;
};

double list_bytes_max() { return PairListTuning::share_of_memory * CallScope::memory_limit(); }

void check_list_size(double pairs, int dim) {
  const double bytes = pairs * static_cast<double>(2 * sizeof(int32_t) + dim * sizeof(double));
  if (bytes > list_bytes_max())
    fail(JAM_E_MEMORY, "%.3g pairs of spheres within the cutoff need %s, a list may have %s", pairs,
         bytes_text(bytes).c_str(), bytes_text(list_bytes_max()).c_str());
}

// One sphere may have most of the pairs: the limits hold while its own gather too.
void keep(std::vector<Candidate> &found, const Candidate &candidate, int dim) {
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

Cutoff own_cutoff(const Packing &p, const std::vector<double> &reach, double slope) {
  return {p, *std::max_element(reach.begin(), reach.end()), slope, reach.data()};
}

void add_walls(const Cutoff &cutoff, int32_t i, std::vector<Candidate> &found) {
  const Packing &p = cutoff.p;
  for (int w = 0; w < p.container.count(); ++w)
    if (cutoff.wants(i, wall_partner(w)) &&
        p.container[w].distance(&p.position[static_cast<size_t>(i) * p.dim]) < cutoff.of(i, wall_partner(w)))
      keep(found, {wall_partner(w), {}}, p.dim);
}

// Pairs of sphere i, its walls among them.
void append_sorted(PairList &list, int32_t i, const Cutoff &cutoff, std::vector<Candidate> &found) {
  const int dim = cutoff.p.dim;
  if (cutoff.walls) add_walls(cutoff, i, found);
  std::sort(found.begin(), found.end(), [dim](const Candidate &a, const Candidate &b) {
    if (a.j != b.j) return a.j < b.j;
    return std::lexicographical_compare(a.offset.begin(), a.offset.begin() + dim, b.offset.begin(),
                                        b.offset.begin() + dim);
  });
  check_list_size(static_cast<double>(list.size() + found.size()), dim);
  for (const Candidate &c : found) {
    list.i.push_back(i);
    list.j.push_back(c.j);
    list.offset.insert(list.offset.end(), c.offset.begin(), c.offset.begin() + dim);
  }
  found.clear();
}

// Pairs of randomly placed spheres that a cutoff takes in: at least so many, as a mean power exceeds the power of a
// mean.
double expected_pairs(const Cutoff &cutoff) {
  const Packing &p = cutoff.p;
  const double n = static_cast<double>(p.n());
  double reach = cutoff.reach, diameter = 0.0;
  for (const double s : p.diameter) diameter += s / n;
  if (cutoff.own) reach = std::accumulate(cutoff.own, cutoff.own + p.n(), 0.0) / n;
  const double shrunk = 1.0 + std::min(0.0, p.non_additivity);  // a bound for every pair
  const double radius = reach + cutoff.slope * shrunk * diameter;
  return 0.5 * n * n * unit_sphere_volume(p.dim) * math::pow(2.0 * radius / p.cell.side(), p.dim);
}

// take: NULL, or takes parts of the list, which is then empty in the end.
void give_part(PairList &list, const TakePairs *take, size_t least) {
  if (!take || list.size() < least) return;
  (*take)(list);
  list.clear();
}

PairList by_brute_force(const Cutoff &cutoff, const TakePairs *take = nullptr) {
  const Packing &p = cutoff.p;
  if (!take) check_list_size(expected_pairs(cutoff), p.dim);
  PairList list;
  std::vector<Candidate> found;
  SparseLook sparse_look;
  const ImageScan images(p);
  const int32_t n = static_cast<int32_t>(p.n());
  for (int32_t i = 0; i < n; ++i) {
    CallScope::look();
    for (int32_t j = i; j < n; ++j) {
      sparse_look();
      if (cutoff.wants(i, j)) images.scan(i, j, cutoff.of(i, j), found);
    }
    append_sorted(list, i, cutoff, found);
    give_part(list, take, PairListTuning::part);
  }
  give_part(list, take, 1);
  return list;
}

// The place of each sphere along a space-filling curve (that of Z): spheres near each other stand near in memory.
std::vector<int32_t> along_curve(const Packing &p) {
  const int d = p.dim, bits = std::min(63 / d, 20);
  std::vector<std::pair<uint64_t, int32_t>> key(p.n());
  for (size_t i = 0; i < p.n(); ++i) {
    Cell::Vector s{};
    p.cell.fraction(&p.position[i * static_cast<size_t>(d)], s.data());
    uint64_t k = 0;
    for (int c = 0; c < d; ++c) {
      const double part = std::min(std::max(s[c], 0.0), 1.0);
      const auto step = static_cast<uint64_t>(part * static_cast<double>((1 << bits) - 1));
      for (int b = 0; b < bits; ++b) k |= (step >> b & 1u) << (b * d + c);
    }
    key[i] = {k, static_cast<int32_t>(i)};
  }
  std::sort(key.begin(), key.end());
  std::vector<int32_t> out(p.n());
  for (size_t k = 0; k < out.size(); ++k) out[k] = key[k].second;
  return out;
}

// What a search reads of the spheres, in another order. number: of each sphere in the packing.
struct Reordered {
  Packing p;
  std::vector<int32_t> number;
  std::vector<double> own;
  std::vector<char> only;

  explicit Reordered(const Cutoff &from) : number(along_curve(from.p)) {
    const size_t d = static_cast<size_t>(from.p.dim);
    p.dim = from.p.dim, p.cell = from.p.cell, p.non_additivity = from.p.non_additivity;
    for (const int32_t i : number) {
      const double *x = &from.p.position[static_cast<size_t>(i) * d];
      p.position.insert(p.position.end(), x, x + d);
      p.diameter.push_back(from.p.diameter[i]);
      if (from.own) own.push_back(from.own[i]);
      if (from.only) only.push_back(from.only[i]);
    }
  }
  Cutoff cutoff(const Cutoff &from) const {
    return {p, from.reach, from.slope, from.own ? own.data() : nullptr, from.only ? only.data() : nullptr, false};
  }
};

// The pairs of spheres with those of their own level and coarser ones: the finer sphere searches for the coarser one in
// the cells of the coarser level. A level whose cells would be too few is wide: its spheres examine all images of all
// spheres as fine.
class LevelSearch {
 public:
  // number: NULL, or of each sphere in the packing that the list is for. take: as of by_brute_force.
  LevelSearch(const Cutoff &cutoff, std::vector<PairLevel> levels, const int32_t *number, const TakePairs *take)
      : p_(cutoff.p),
        cutoff_(cutoff),
        levels_(std::move(levels)),
        number_(number),
        take_(take),
        in_order_(levels_.size() == 1 && !number && !take),
        images_(cutoff.p),
        half_edge_(0.5 * p_.cell.edge_min()) {
    const auto wants = [&](int32_t i) { return cutoff.wants(i, i); };
    for (const PairLevel &l : levels_) wanted_.push_back(std::any_of(l.member.begin(), l.member.end(), wants));
  }

  // whole: the cutoff in the packing that the list is for.
  PairList run(const Cutoff &whole) {
    uint64_t looked = 0;
    for (size_t k = 0; k < levels_.size(); ++k)
      for (const int32_t i : levels_[k].member) {
        if (looked++ % PairListTuning::spheres_between_looks == 0) CallScope::look();
        for (size_t coarse = 0; coarse <= k; ++coarse)
          if (levels_[coarse].cells && (wanted_[coarse] || cutoff_.wants(i, i)))
            levels_[coarse].cells->around(p_, i, [&](int32_t j) { near(i, j, coarse == k); });
        if (!levels_[k].cells) scan(i, k);
        if (in_order_) append_sorted(list_, i, cutoff_, own_);  // the first of all these pairs
        give_part(found_, take_, PairListTuning::part);
      }
    give_part(found_, take_, 1);
    if (!in_order_ && !take_) sort(whole);
    return std::move(list_);
  }

 private:
  int32_t number(int32_t i) const { return number_ ? number_[i] : i; }
  void near(int32_t a, int32_t b, bool own_level) {
    if ((own_level && b <= a) || !cutoff_.wants(a, b)) return;
    if (number(b) < number(a)) std::swap(a, b);
    nearest(a, b, cutoff_.of(a, b));
  }
  void nearest(int32_t i, int32_t j, double cutoff) {
    Candidate now{number(j), {}};
    if (images_.nearest(i, j, cutoff, now)) take(number(i), now);
  }
  void scan(int32_t i, size_t level) {
    for (size_t k = level; k < levels_.size(); ++k)
      for (const int32_t j : levels_[k].member) {
        if ((k == level && j < i) || !cutoff_.wants(i, j)) continue;
        look_();
        const int32_t first = number(i) < number(j) ? i : j, second = first == i ? j : i;
        const double cutoff = cutoff_.of(first, second);
        if (i != j && cutoff < half_edge_) {
          nearest(first, second, cutoff);
          continue;
        }
        images_.scan(first, second, cutoff, scanned_);
        for (Candidate &c : scanned_) c.j = number(second), take(number(first), c);
        scanned_.clear();
      }
  }
  void take(int32_t i, const Candidate &other) {
    if (in_order_) return keep(own_, other, p_.dim);
    if (found_.size() == found_.i.capacity()) {
      CallScope::look();
      check_list_size(2.0 * static_cast<double>(found_.size()), p_.dim);
    }
    found_.i.push_back(i), found_.j.push_back(other.j);
    found_.offset.insert(found_.offset.end(), other.offset.begin(), other.offset.begin() + p_.dim);
  }
  // By (i, j), then image.
  void sort(const Cutoff &whole) {
    const size_t n = p_.n(), d = static_cast<size_t>(p_.dim);
    std::vector<size_t> start(n + 1, 0);
    for (const int32_t i : found_.i) ++start[static_cast<size_t>(i) + 1];
    for (size_t i = 0; i < n; ++i) start[i + 1] += start[i];
    std::vector<size_t> at(start.begin(), start.end() - 1);
    std::vector<int32_t> j(found_.size());
    std::vector<double> offset(found_.offset.size());
    for (size_t k = 0; k < found_.size(); ++k) {
      const size_t to = at[static_cast<size_t>(found_.i[k])]++;
      j[to] = found_.j[k];
      std::copy_n(&found_.offset[k * d], d, &offset[to * d]);
    }
    found_ = PairList();
    for (size_t i = 0; i < n; ++i) {
      for (size_t k = start[i]; k < start[i + 1]; ++k) {
        own_.push_back({j[k], {}});
        std::copy_n(&offset[k * d], d, own_.back().offset.begin());
      }
      append_sorted(list_, static_cast<int32_t>(i), whole, own_);
    }
  }

  const Packing &p_;
  const Cutoff &cutoff_;
  const std::vector<PairLevel> levels_;
  const int32_t *number_;
  const TakePairs *take_;
  const bool in_order_;  // pairs are found in the order of the list
  const ImageScan images_;
  const double half_edge_;
  std::vector<char> wanted_;  // for each level: may its spheres have pairs with any others?
  PairList found_;
  std::vector<Candidate> own_, scanned_;
  SparseLook look_;
  PairList list_;
};

PairList by_cells(const Cutoff &cutoff, const TakePairs *take = nullptr) {
  const Packing &p = cutoff.p;
  if (p.model != JAM_MODEL_EUCLID) return by_brute_force(cutoff, take);
  if (!take) check_list_size(expected_pairs(cutoff), p.dim);
  const auto search = [&](const Cutoff &c, const int32_t *number) {
    std::vector<double> reach(p.n(), c.reach);
    if (c.own) reach.assign(c.own, c.own + p.n());
    return LevelSearch(c, pair_levels(c.p, reach, c.slope), number, take).run(cutoff);
  };
  if (p.n() < PairListTuning::along_curve_from) return search(cutoff, nullptr);
  const Reordered near(cutoff);
  return search(near.cutoff(cutoff), near.number.data());
}

}  // namespace

PairList find_pairs(const Packing &p, double reach, double slope) { return by_cells({p, reach, slope}); }
PairList find_pairs(const Packing &p, const std::vector<double> &reach, double slope) {
  return by_cells(own_cutoff(p, reach, slope));
}
PairList find_pairs_of(const Packing &p, const std::vector<char> &some, const std::vector<double> &reach,
                       double slope) {
  Cutoff cutoff = own_cutoff(p, reach, slope);
  cutoff.only = some.data();
  return by_cells(cutoff);
}
void visit_pairs(const Packing &p, double reach, double slope, const TakePairs &take) {
  by_cells({p, reach, slope, nullptr, nullptr, false}, &take);
}
PairList find_pairs_brute(const Packing &p, double reach, double slope) { return by_brute_force({p, reach, slope}); }
PairList find_pairs_brute(const Packing &p, const std::vector<double> &reach, double slope) {
  return by_brute_force(own_cutoff(p, reach, slope));
}

ClosestPair closest_pair(const Packing &p) {
  // Spheres that overlap massively have many pairs at their contact distance: the closest are found within a part of
  // it.
  const double many = PairListTuning::pairs_per_sphere * static_cast<double>(p.n()),
               expected = expected_pairs({p, 0.0, PairListTuning::first_slope});
  double slope = expected > many
                     ? std::max(1e-30, PairListTuning::first_slope * math::pow(many / expected, 1.0 / p.dim))
                     : PairListTuning::first_slope;
  for (bool last = false; !last; slope = std::min(2.0, 2.0 * slope)) {
    last = slope >= 2.0;
    ClosestPair best{std::numeric_limits<double>::infinity(), -1, -1};
    visit_pairs(p, 0.0, slope, [&](const PairList &pairs) {
      double r[JAM_MAX_DIM];
      for (size_t k = 0; k < pairs.size(); ++k) {
        const int32_t i = pairs.i[k], j = pairs.j[k];
        const double gap = std::sqrt(pair_vector(p, pairs, k, r)) / contact_distance(p, i, j) - 1.0;
        const bool first = gap == best.gap && std::make_pair(i, j) < std::make_pair(best.i, best.j);
        if (gap < best.gap || first) best = {gap, i, j};
      }
    });
    if (best.i >= 0) return best;
  }
  return {std::numeric_limits<double>::infinity(), -1, -1};
}

ClosestPair closest_contact(const Packing &p) {
  const ClosestPair pair = closest_pair(p);
  const ClosestWall wall = closest_wall(p);
  return wall.gap < pair.gap ? ClosestPair{wall.gap, wall.sphere, wall_partner(wall.w)} : pair;
}

}  // namespace jam::inside
