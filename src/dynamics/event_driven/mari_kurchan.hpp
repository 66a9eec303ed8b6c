// The Mari-Kurchan model in the engine: partners lie anywhere in the box, so cells do not help. A list is made from all
// spheres, whose shifts a loop in vectors draws (kernel/pair_kernel.hpp).
#pragma once
#include <algorithm>
#include <cmath>
#include <memory>

#include "core/pair_rule.hpp"
#include "dynamics/event_driven/lattice.hpp"

namespace jam::inside {

// Places and reaches of all spheres in the Mari-Kurchan model, as the search for partners takes them (pair_kernel.hpp).
template <int D>
class PartnerTable {
 public:
  PartnerTable(const MkShifts &shifts, const Lattice<D> &lattice, int32_t n)
      : x_((static_cast<size_t>(n) + 7) / 8 * 8 * D), reach_(x_.size() / D), lattice_(lattice) {
    spheres_.cube = lattice.cube();
    for (int c = 0; c < D; ++c) spheres_.height[c] = static_cast<float>(lattice.height(c));
    tallest_ = std::max(1.0f, *std::max_element(spheres_.height, spheres_.height + D));
    spheres_.key = shifts.key();
    spheres_.zeta = shifts.zeta();
    spheres_.uniform = std::isinf(shifts.zeta());
    spheres_.n = n;
    spheres_.stride = reach_.size();
    spheres_.x = x_.data();
    spheres_.reach = reach_.data();
  }
  PartnerTable(const PartnerTable &) = delete;  // the loop's pointers point into this table
  PartnerTable &operator=(const PartnerTable &) = delete;

  // number: the user's; place: in integer units; reach: in V^(1/d). The factor covers the rounding of floats. Two
  // places and a shift lose less than 3 x 2^-32 of a cell vector; two spheres together add 4 x 2^-32 of the longest
  // height.
  void set(int32_t number, const std::array<uint64_t, D> &place, double reach) {
    const auto at = static_cast<size_t>(number);
    double s[D];
    lattice_.fraction(place, s);
    for (int c = 0; c < D; ++c)
      x_[c * reach_.size() + at] = static_cast<int32_t>(static_cast<int64_t>(std::floor(s[c] * 0x1p32)));
    reach_[at] = static_cast<float>(reach * 0x1p32 * (1.0 + 1e-6)) + 2.0f * tallest_;
  }
  const Partners<D> &spheres() const { return spheres_; }

 private:
  std::vector<int32_t> x_;
  std::vector<float> reach_;
  const Lattice<D> &lattice_;
  Partners<D> spheres_{};
  float tallest_;
};

template <int D>
class MariKurchan {
 public:
  using Offset = std::array<int64_t, D>;

  // user: the user's number of each sphere; scale: integer units to V^(1/d).
  MariKurchan(const Packing &p, const Lattice<D> &lattice, const std::vector<int32_t> &user, double scale)
      : shifts_(p), lattice_(lattice), scale_(scale) {
    prepare(user);
  }
  // Partners with shifts drawn again, sphere by sphere and both ways round, so that a walk over all partners meets them
  // in order. The table of places is empty after it.
  void prepare(const std::vector<int32_t> &user) {
    const size_t n = user.size();
    internal_.resize(n);
    for (size_t i = 0; i < n; ++i) internal_[user[i]] = static_cast<int32_t>(i);
    redrawn_first_.assign(n + 1, 0);
    for (const MkRedrawn &r : shifts_.redrawn()) ++redrawn_first_[r.i + 1], ++redrawn_first_[r.j + 1];
    for (size_t k = 0; k < n; ++k) redrawn_first_[k + 1] += redrawn_first_[k];
    redrawn_.resize(redrawn_first_[n]);
    std::vector<size_t> at(redrawn_first_.begin(), redrawn_first_.end() - 1);
    // Sorted by (i, j): for each sphere the partners below it come first, in order, then those above.
    for (const MkRedrawn &r : shifts_.redrawn()) redrawn_[at[r.j]++] = {r.i, r.attempt};
    for (const MkRedrawn &r : shifts_.redrawn()) redrawn_[at[r.i]++] = {r.j, r.attempt};
    table_ = std::make_unique<PartnerTable<D>>(shifts_, lattice_, static_cast<int32_t>(n));
  }
  // The search finds partners of the user's sphere `number` where its list is. reach: in V^(1/d).
  void note_centre(int32_t number, const std::array<uint64_t, D> &centre, double reach) {
    table_->set(number, centre, reach);
  }
  // f(k, shift) for every sphere k that may be a partner of the user's sphere a, in the order of the user's numbers.
  // found: scratch for n.
  template <class F>
  void each_partner(int32_t a, const PairKernel<D> &kernel, int32_t *found, F &&f) const {
    const int32_t count = kernel.partners(table_->spheres(), a, found);
    size_t next = redrawn_first_[a];
    const size_t end = redrawn_first_[a + 1];
    const auto give = [&](const Redrawn &partner) { f(internal_[partner.number], shift_of(a, partner)); };
    for (int32_t e = 0; e < count; ++e) {
      const int32_t b = found[e];
      while (next < end && redrawn_[next].number < b) give(redrawn_[next++]);
      const bool drawn_again = next < end && redrawn_[next].number == b;
      give(drawn_again ? redrawn_[next++] : Redrawn{b, 0});
    }
    while (next < end) give(redrawn_[next++]);
  }

 private:
  struct Redrawn {
    int32_t number, attempt;  // of the user, of the shift of this pair
  };
  Offset shift_of(int32_t a, const Redrawn &partner) const {
    const int32_t b = partner.number;
    const uint64_t pair = shifts_.pair_key(std::min(a, b), std::max(a, b));
    const double sign = a < b ? scale_ : -scale_;
    Offset shift;
    double s[D], x[D];
    for (int c = 0; c < D; ++c) s[c] = shifts_.component(pair, partner.attempt, c);
    lattice_.combine(s, x);
    for (int c = 0; c < D; ++c) shift[c] = std::llrint(sign * x[c]);
    return shift;
  }

  MkShifts shifts_;
  const Lattice<D> &lattice_;
  double scale_;
  std::vector<int32_t> internal_;  // number of a sphere in the engine, by the user's
  std::vector<Redrawn> redrawn_;   // partners of each sphere with a shift drawn again
  std::vector<size_t> redrawn_first_;
  std::unique_ptr<PartnerTable<D>> table_;
};

}  // namespace jam::inside
