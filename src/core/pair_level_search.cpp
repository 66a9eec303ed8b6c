// Finds pairs by cells of levels of reach, along a curve where spheres are many.
#include <algorithm>
#include <utility>

#include "core/pair_levels.hpp"
#include "core/tuning.hpp"

namespace jam::inside {
namespace {

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

}  // namespace

PairList search_by_levels(const Cutoff &cutoff, const TakePairs *take) {
  const Packing &p = cutoff.p;
  const auto search = [&](const Cutoff &c, const int32_t *number) {
    std::vector<double> reach(p.n(), c.reach);
    if (c.own) reach.assign(c.own, c.own + p.n());
    return LevelSearch(c, pair_levels(c.p, reach, c.slope), number, take).run(cutoff);
  };
  if (p.n() < PairListTuning::along_curve_from) return search(cutoff, nullptr);
  const Reordered near(cutoff);
  return search(near.cutoff(cutoff), near.number.data());
}

}  // namespace jam::inside
