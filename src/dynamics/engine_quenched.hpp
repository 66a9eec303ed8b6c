// The engine in the Mari-Kurchan model: partners lie anywhere in the box, so cells do not help. Each sphere has an
// outer list of all spheres that its neighbour list can need while both stay within outer_safe_ of the places where the
// outer lists were made. Only making an outer list looks at all spheres. It stores the attempt of each pair's shift,
// not the shift.
#pragma once
#include <algorithm>

#include "core/call_scope.hpp"
#include "dynamics/engine.hpp"

namespace jam {

// Partners with shifts drawn again, sphere by sphere and both ways round, so that a walk over all partners meets them
// in order.
template <int D, bool Shift>
void Engine<D, Shift>::take_redrawn() {
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
}

template <int D, bool Shift>
std::array<int64_t, D> Engine<D, Shift>::shift_of(int32_t i, const Outer &partner) const {
  const int32_t a = user_[i], b = user_[partner.k];
  const uint64_t pair = quenched_->pair_key(std::min(a, b), std::max(a, b));
  const double sign = a < b ? scale : -scale;
  std::array<int64_t, D> shift;
  double s[D], x[D];
  for (int c = 0; c < D; ++c) s[c] = quenched_->component(pair, partner.attempt, c);
  lattice_.combine(s, x);
  for (int c = 0; c < D; ++c) shift[c] = std::llrint(sign * x[c]);
  return shift;
}

// f(partner) for every sphere k whose outer centre is within the sum of both outer reaches of that of i.
template <int D, bool Shift>
template <class F>
void Engine<D, Shift>::each_outer_partner(int32_t i, F &&f) const {
  constexpr int64_t box = int64_t{1} << 61;
  const int32_t a = user_[i];
  size_t next = redrawn_first_[a];
  const size_t end = redrawn_first_[a + 1];
  for (int32_t b = 0; b < n_; ++b) {
    if (b == a) continue;
    const Outer partner{internal_[b], next < end && redrawn_[next].k == b ? redrawn_[next++].attempt : 0};
    const double cutoff = outer_reach_[i] + outer_reach_[partner.k] + 2.0 * outer_safe_, cutoff2 = cutoff * cutoff;
    if (!lattice_.cube()) {
      std::array<int64_t, D> distance = shift_of(i, partner);
      for (int c = 0; c < D; ++c)
        distance[c] =
            wrapping_sum(distance[c], static_cast<int64_t>(outer_centre_[i][c] - outer_centre_[partner.k][c]));
      if (lattice_.reaches(distance, cutoff)) f(partner);
      continue;
    }
    const uint64_t pair = quenched_->pair_key(std::min(a, b), std::max(a, b));
    const double sign = a < b ? scale : -scale;
    double r2 = 0.0;
    for (int c = 0; c < D && r2 < cutoff2; ++c) {
      int64_t x = wrapping_sum(static_cast<int64_t>(outer_centre_[i][c] - outer_centre_[partner.k][c]),
                               std::llrint(sign * quenched_->component(pair, partner.attempt, c)));
      x = wrapping_sum(x, box / 2) & (box - 1);  // nearest image, from -box/2
      const double r = static_cast<double>(x - box / 2);
      r2 += r * r;
    }
    if (r2 < cutoff2) f(partner);
  }
}

template <int D, bool Shift>
void Engine<D, Shift>::build_outer() {
  double largest = 0.0;
  for (const Body<D> &b : body_) largest = std::max(largest, static_cast<double>(b.radius));
  outer_safe_ = outer_width_ * largest;  // the 1.1 below allows for growth and wider shells
  outer_.resize(body_.size());
  outer_centre_.resize(body_.size());
  outer_reach_.resize(body_.size());
  for (int32_t i = 0; i < n_; ++i) {
    outer_centre_[i] = centre_[i];
    outer_reach_[i] = 1.1 * rho_[i];
    outer_[i].clear();
  }
  renewals_ = 0;
  outer_exits_ = exits_;
  double partners = 0.0;
  for (int32_t i = 0; i < n_; ++i) {
    if (i % 64 == 0) CallScope::look();
    each_outer_partner(i, [&](const Outer &partner) {
      if (partner.k > i) {
        outer_[i].push_back(partner);
        outer_[partner.k].push_back({i, partner.attempt});
        partners += 2.0;
      }
    });
    CallScope::need_memory(partners * sizeof(Outer), "lists of partners");
  }
}

// After the lists' places and reaches have changed: outer lists that no longer hold them are made anew.
template <int D, bool Shift>
void Engine<D, Shift>::check_outer() {
  if (outer_.empty() || outer_safe_ == 0.0) return build_outer();
  for (int32_t i = 0; i < n_; ++i)
    if (rho_[i] > outer_reach_[i]) return build_outer();
  for (int32_t i = 0; i < n_; ++i)
    if (left_outer(i)) renew_outer(i);
}

template <int D, bool Shift>
bool Engine<D, Shift>::left_outer(int32_t i) const {
  constexpr int64_t box = int64_t{1} << 61;
  if (!lattice_.cube()) {
    std::array<int64_t, D> way;
    for (int c = 0; c < D; ++c) way[c] = static_cast<int64_t>(centre_[i][c] - outer_centre_[i][c]);
    return !lattice_.reaches(way, outer_safe_);
  }
  double r2 = 0.0;
  for (int c = 0; c < D; ++c) {
    const int64_t x = (static_cast<int64_t>(centre_[i][c] - outer_centre_[i][c]) + box / 2) & (box - 1);
    const double r = static_cast<double>(x - box / 2);
    r2 += r * r;
  }
  return r2 > outer_safe_ * outer_safe_;
}

// Chooses how far a sphere may go before its outer list is made anew. Each of the exits looks at the K partners of a
// list, K ~ (reach + width)^D. A renewal looks at all spheres; diffusion makes width^-2 of them. The cost is that of
// tune_shell. Returns true when the exits since the last change would have been cheaper by more than new lists for all.
template <int D, bool Shift>
bool Engine<D, Shift>::tune_outer() {
  constexpr double step = 1.5, narrowest = 0.1, widest = 3.0, look = 3.0;  // look: at a sphere that may be a partner
  const auto exits = static_cast<double>(exits_ - outer_exits_);
  if (outer_safe_ == 0.0 || exits < 4.0 * n_) return false;
  double partners = 0.0;
  for (const auto &list : outer_) partners += static_cast<double>(list.size()) / n_;
  const auto cost = [&](double width) {
    const double now = 1.1 * rho_max_ + outer_safe_, then = now + outer_safe_ * (width / outer_width_ - 1.0);
    const double more = std::pow(then / now, D), renewals = static_cast<double>(renewals_);
    return exits * 2.0 * more * partners + renewals * std::pow(outer_width_ / width, 2) * look * n_;
  };
  const double saved = cost(outer_width_) - 0.5 * look * n_ * n_;
  for (const double width : {outer_width_ / step, outer_width_ * step}) {
    if (width < narrowest || width > widest || cost(width) > saved) continue;
    outer_width_ = width;
    outer_safe_ = 0.0;
    return true;
  }
  return false;
}

template <int D, bool Shift>
void Engine<D, Shift>::renew_outer(int32_t i) {
  ++renewals_;
  for (const Outer &partner : outer_[i]) {
    std::vector<Outer> &list = outer_[partner.k];
    const auto entry = std::find_if(list.begin(), list.end(), [i](const Outer &o) { return o.k == i; });
    *entry = list.back();
    list.pop_back();
  }
  outer_[i].clear();
  outer_centre_[i] = centre_[i];
  each_outer_partner(i, [&](const Outer &partner) {
    outer_[i].push_back(partner);
    outer_[partner.k].push_back({i, partner.attempt});
  });
}

}  // namespace jam
