// The engine in the Mari-Kurchan model: partners lie anywhere in the box, so cells do not help. A list is made from all
// spheres, whose shifts a loop in vectors draws (pair_kernel.hpp).
#pragma once
#include <algorithm>

#include "dynamics/event_driven/engine.hpp"

namespace jam {

// Partners with shifts drawn again, sphere by sphere and both ways round, so that a walk over all partners meets them
// in order. The table of places is empty after it.
template <int D, bool Shift>
void Engine<D, Shift>::prepare_partners() {
  const size_t n = static_cast<size_t>(n_);
  internal_.resize(n);
  for (int32_t i = 0; i < n_; ++i) internal_[user_[i]] = i;
  redrawn_first_.assign(n + 1, 0);
  for (const MkRedrawn &r : quenched_->redrawn()) ++redrawn_first_[r.i + 1], ++redrawn_first_[r.j + 1];
  for (size_t k = 0; k < n; ++k) redrawn_first_[k + 1] += redrawn_first_[k];
  redrawn_.resize(redrawn_first_[n]);
  std::vector<size_t> at(redrawn_first_.begin(), redrawn_first_.end() - 1);
  // Sorted by (i, j): for each sphere the partners below it come first, in order, then those above.
  for (const MkRedrawn &r : quenched_->redrawn()) redrawn_[at[r.j]++] = {r.i, r.attempt};
  for (const MkRedrawn &r : quenched_->redrawn()) redrawn_[at[r.i]++] = {r.j, r.attempt};
  found_.resize(n);
  partner_table_ = std::make_unique<PartnerTable<D>>(*quenched_, lattice_, n_);
}

// The search looks for partners of i where its list is.
template <int D, bool Shift>
void Engine<D, Shift>::note_centre(int32_t i) {
  partner_table_->set(user_[i], centre_[i], rho_[i] * unit);
}

template <int D, bool Shift>
std::array<int64_t, D> Engine<D, Shift>::shift_of(int32_t a, const Redrawn &partner) const {
  const int32_t b = partner.number;
  const uint64_t pair = quenched_->pair_key(std::min(a, b), std::max(a, b));
  const double sign = a < b ? scale : -scale;
  std::array<int64_t, D> shift;
  double s[D], x[D];
  for (int c = 0; c < D; ++c) s[c] = quenched_->component(pair, partner.attempt, c);
  lattice_.combine(s, x);
  for (int c = 0; c < D; ++c) shift[c] = std::llrint(sign * x[c]);
  return shift;
}

// f(k, shift) for every sphere k that may be a partner of i, in the order of the user's numbers.
template <int D, bool Shift>
template <class F>
void Engine<D, Shift>::each_partner(int32_t i, F &&f) const {
  const int32_t a = user_[i], found = kernel_.partners(partner_table_->spheres(), a, found_.data());
  size_t next = redrawn_first_[a];
  const size_t end = redrawn_first_[a + 1];
  const auto give = [&](const Redrawn &partner) { f(internal_[partner.number], shift_of(a, partner)); };
  for (int32_t e = 0; e < found; ++e) {
    const int32_t b = found_[e];
    while (next < end && redrawn_[next].number < b) give(redrawn_[next++]);
    const bool drawn_again = next < end && redrawn_[next].number == b;
    give(drawn_again ? redrawn_[next++] : Redrawn{b, 0});
  }
  while (next < end) give(redrawn_[next++]);
}

}  // namespace jam
