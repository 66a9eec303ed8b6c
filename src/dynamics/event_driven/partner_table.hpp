// Places and reaches of all spheres in the Mari-Kurchan model, as the search for partners takes them (pair_kernel.hpp).
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/pair_rule.hpp"
#include "dynamics/event_driven/kernel/pair_kernel.hpp"
#include "dynamics/event_driven/lattice.hpp"

namespace jam::inside {

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

}  // namespace jam::inside
