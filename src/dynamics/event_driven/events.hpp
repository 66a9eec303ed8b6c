// Hot path of the engine: prediction and collision.
#pragma once
#include <cstdlib>

#include "core/call_scope.hpp"
#include "core/error.hpp"
#include "core/math.hpp"
#include "dynamics/event_driven/engine.hpp"

namespace jam {

// r^2 - sigma^2 from integers; a and b need not stand at now_.
template <int D, bool Shift>
double Engine<D, Shift>::exact_gap(const Body<D> &a, const Body<D> &b, const int64_t *offset) const {
  const double da = now_ - a.time, db = now_ - b.time;
  unsigned __int128 r2 = 0;
  for (int c = 0; c < D; ++c) {
    int64_t r = wrapping_sum(difference(a, b, c, offset), std::llrint(-b.v[c] * db));
    if (da != 0.0) r = wrapping_sum(r, std::llrint(a.v[c] * da));
    const uint64_t m = r < 0 ? -static_cast<uint64_t>(r) : static_cast<uint64_t>(r);
    r2 += static_cast<unsigned __int128>(m) * m;
  }
  int64_t sum = contact_sum(a, b);
  sum = wrapping_sum(sum, std::llrint(static_cast<double>(sum) * (rate_ * now_)));
  const __int128 gap = static_cast<__int128>(r2 - static_cast<unsigned __int128>(sum) * static_cast<uint64_t>(sum));
  return static_cast<double>(static_cast<int64_t>(gap >> 64)) * 0x1p64 +
         2.0 * static_cast<double>(static_cast<int64_t>(static_cast<uint64_t>(gap) >> 1));
}

// Every overlap of a pair in the lists is seen here: a pair is deepest when an event turns one of its spheres round.
template <int D, bool Shift>
void Engine<D, Shift>::note_overlap(const Body<D> &a, const Body<D> &b, const int64_t *offset) {
  const double sigma = static_cast<double>(contact_sum(a, b)) * (1.0 + rate_ * now_);
  const double gap = std::max(-1.0, exact_gap(a, b, offset) / (sigma * sigma));
  max_overlap = std::max(max_overlap, -gap / (1.0 + std::sqrt(1.0 + gap)));
}

// When sphere i, which stands at now_, leaves its safe sphere.
template <int D, bool Shift>
double Engine<D, Shift>::exit_time(int32_t i) const {
  if (cells_alone_) return now_ + crossing_time(i, nullptr);
  const Body<D> &b = body_[i];
  double rv = 0.0, vv = 0.0, rr = 0.0;
  for (int c = 0; c < D; ++c) {
    const double r = static_cast<double>(static_cast<int64_t>(b.x[c] - centre_[i][c]));
    rv += r * b.v[c];
    vv += b.v[c] * b.v[c];
    rr += r * r;
  }
  if (vv <= 0.0) return never;
  const double room = safe_[i] * safe_[i] - rr;
  if (room <= 0.0) return rv < 0.0 ? now_ - 2.0 * rv / vv : now_;
  const double root = std::sqrt(rv * rv + vv * room);
  return now_ + (rv > 0.0 ? room / (rv + root) : (root - rv) / vv);
}

// When sphere `self`, which stands at now_, meets `other`: time from now, infinity if never. The kernel computes this
// for nearly all pairs; here are all cases.
template <int D, bool Shift>
double Engine<D, Shift>::collision_time(const Body<D> &self, const Body<D> &other, const int64_t *offset) {
  const double dt = now_ - other.time;
  double rv = 0.0, vv = 0.0, rr = 0.0;
  for (int c = 0; c < D; ++c) {
    const double r = static_cast<double>(difference(self, other, c, offset)) - other.v[c] * dt;
    const double v = self.v[c] - other.v[c];
    rv += r * v;
    vv += v * v;
    rr += r * r;
  }
  const double sum = static_cast<double>(contact_sum(self, other)), sigma = sum * (1.0 + rate_ * now_);
  const double growth = sum * rate_, sigma2 = sigma * sigma;
  const double b = rv - sigma * growth, a = vv - growth * growth;
  double gap = rr - sigma2;
  if (gap < -1e-14 * sigma2) note_overlap(self, other, offset);
  if (b >= 0.0 && a >= 0.0) return never;
  if (gap < 1e-3 * sigma2) gap = exact_gap(self, other, offset);
  const double disc = b * b - a * gap;
  // The surfaces recede now but growth outruns the spheres: the later root, or the time of least overlap.
  if (b >= 0.0) return disc > 0.0 ? -(b + std::sqrt(disc)) / a : -b / a;
  if (gap <= 0.0) return 0.0;  // in contact or overlapping, and approaching
  return disc < 0.0 ? never : gap / (std::sqrt(disc) - b);
}

// Earliest event of sphere i, which stands at now_. Of collisions at one time the first of the list counts.
template <int D, bool Shift>
void Engine<D, Shift>::predict(int32_t i) {
  const Body<D> &self = body_[i];
  const int32_t count = cells_alone_ ? gather(i) : neighbours_[i], *list = cells_alone_ ? found_.data() : list_of(i);
  PairBatch<D> pairs{body_.data(), &self, list, 0, nullptr, capacity_, calendar_.times(), now_, rate_, non_additivity_};
  Earliest earliest{exit_time(i) - now_, -1};
  int32_t partner = -1;
  for (int32_t first = 0; first < count; first += PairKernel<D>::batch) {
    pairs.list = list + first;
    pairs.count = std::min(PairKernel<D>::batch, count - first);
    pairs.offset = offset_of(i, first);
    earliest.entry = -1;
    for (uint64_t left_out = kernel_.collisions(pairs, earliest); left_out; left_out &= left_out - 1) {
      const int32_t entry = __builtin_ctzll(left_out), k = pairs.list[entry];
      const double t = collision_time(self, body_[k], offset_of(i, first + entry));
      const bool sooner = t < earliest.time || (t == earliest.time && entry < earliest.entry);
      if (sooner && now_ + t < calendar_.time(k)) earliest = {t, entry};
    }
    if (earliest.entry >= 0) partner = pairs.list[earliest.entry];
  }
  Event &event = calendar_[i];
  calendar_.time(i) = now_ + earliest.time;
  event.partner = partner;
  if (partner >= 0) event.partner_count = calendar_[partner].count;
}

// r_i - r_k of two spheres that both stand at now_; of several images the nearest that approaches. (In a box of less
// than two diameters a pair can be in contact through two images at once, and the one that recedes may be nearer by
// rounding.)
template <int D, bool Shift>
void Engine<D, Shift>::separation(int32_t i, int32_t k, double *r) const {
  if constexpr (!Shift) {
    for (int c = 0; c < D; ++c) r[c] = static_cast<double>(difference(body_[i], body_[k], c, nullptr));
  } else {
    double nearest = never;
    const double growth = static_cast<double>(contact_sum(body_[i], body_[k])) * rate_;
    for (int32_t e = 0; e < neighbours_[i]; ++e) {
      if (list_of(i)[e] != k) continue;
      double r2 = 0.0, rv = 0.0, trial[D];
      for (int c = 0; c < D; ++c) {
        trial[c] = static_cast<double>(difference(body_[i], body_[k], c, offset_of(i, e)));
        r2 += trial[c] * trial[c];
        rv += trial[c] * (body_[i].v[c] - body_[k].v[c]);
      }
      const double rank = rv < growth * std::sqrt(r2) ? r2 : 1e6 * r2;
      if (rank >= nearest) continue;
      nearest = rank;
      for (int c = 0; c < D; ++c) r[c] = trial[c];
    }
  }
}

// Elastic collision of surfaces that move apart with the growth speed: the pair separates with at least that speed.
template <int D, bool Shift>
void Engine<D, Shift>::collide(int32_t i, int32_t k) {
  Body<D> &a = body_[i], &b = body_[k];
  double r[D], r2 = 0.0, rv = 0.0;
  separation(i, k, r);
  for (int c = 0; c < D; ++c) {
    r2 += r[c] * r[c];
    rv += r[c] * (a.v[c] - b.v[c]);
  }
  const double inverse = 1.0 / std::sqrt(r2), vn = rv * inverse;
  const double growth = static_cast<double>(contact_sum(a, b)) * rate_;
  double push = growth - vn;
  if (push <= 0.0) return;               // a grazing pair that rounding has let go
  push = std::max(push, 1e-14 * scale);  // never so little that the sum is lost: the pair would collide for ever
  double twice_reduced = 1.0;            // mass of the pair
  if (mass_.empty()) {
    for (int c = 0; c < D; ++c) {
      const double dv = push * r[c] * inverse;
      a.v[c] += dv;
      b.v[c] -= dv;
    }
  } else {
    const double share_a = 2.0 * mass_[k] / (mass_[i] + mass_[k]), share_b = 2.0 - share_a;
    twice_reduced = mass_[i] * share_a;
    for (int c = 0; c < D; ++c) {
      const double dv = push * r[c] * inverse;
      a.v[c] += share_a * dv;
      b.v[c] -= share_b * dv;
    }
  }
  ++calendar_[i].count;
  ++calendar_[k].count;
  sums.virial -= twice_reduced * rv * unit * unit;
  sums.kinetic_integral += twice_kinetic_ * (now_ - kinetic_time_);
  kinetic_time_ = now_;
  twice_kinetic_ += twice_reduced * 2.0 * push * growth * unit * unit;
  ++sums.collisions;
  if (observer_) observer_->collision(user_[i], user_[k], -twice_reduced * vn * unit);
}

template <int D, bool Shift>
void Engine<D, Shift>::next_event(int32_t i) {
  Event &event = calendar_[i];
#ifdef JAM_CHECK_PAIRS
  if (calendar_.time(i) < now_ - 1e-6 * bucket_width_)
    fail(JAM_E_INTERNAL, "the event of sphere %d is %g buckets late after %lld collisions", user_[i],
         (now_ - calendar_.time(i)) / bucket_width_, static_cast<long long>(sums.collisions));
#endif
  now_ = std::max(now_, calendar_.time(i));
  move(body_[i]);
  const int32_t k = event.partner;
  const bool exit = k < 0;
  if (exit || calendar_[k].count != event.partner_count) {  // it leaves its safe sphere, or the event is stale
    if (exit) {
      ++exits_;
      recentre(i);
    }
    calendar_.time(i) = never;
    predict(i);
    calendar_.update(i);
    return;
  }
  move(body_[k]);
  collide(i, k);
  calendar_.take_out(i);
  calendar_.take_out(k);
  calendar_.time(i) = calendar_.time(k) = never;
  predict(i);
  predict(k);
  calendar_.put_in(i);
  calendar_.put_in(k);
}

// A hundred times the mean time between two collisions of an ideal gas of this density and temperature: so many chances
// are not missed. 0 where no sphere moves against another.
template <int D, bool Shift>
double Engine<D, Shift>::longest_wait() const {
  constexpr double chances = 100.0, rounding = 1e-28;
  // Of velocities against the mean one: a difference of sums would leave rounding where the spheres move as one.
  double mean[D] = {}, own = 0.0, all = 0.0;
  const auto mass = [this](int32_t i) { return mass_.empty() ? 1.0 : mass_[i]; };
  for (int32_t i = 0; i < n_; ++i)
    for (int c = 0; c < D; ++c) mean[c] += mass(i) * body_[i].v[c] / n_;  // masses have mean 1
  for (int32_t i = 0; i < n_; ++i)
    for (int c = 0; c < D; ++c) {
      const double v = body_[i].v[c], u = v - mean[c];
      own += mass(i) * (u * unit) * (u * unit);
      all += mass(i) * (v * unit) * (v * unit);
    }
  if (n_ < 2 || !(own > rounding * all)) return 0.0;
  const double n = static_cast<double>(n_), speed = std::sqrt(2.0 * own / n);
  const double cross_section = unit_sphere_volume(D - 1) * math::pow(2.0 * mean_diameter(), D - 1);
  return chances / (0.5 * n * (n - 1.0) * cross_section * speed);
}

template <int D, bool Shift>
Halt Engine<D, Shift>::advance(int64_t collisions, const Monitor &monitor, double wall_end) {
  const int64_t goal = sums.collisions + collisions;
  // Without a collision in so many events and so long a time none will come: the spheres move as one, or their paths
  // never meet.
  const int64_t max_stalled_events = 1000000 + 200 * static_cast<int64_t>(n_);
  int64_t last_progress = sums.events, last_collisions = sums.collisions;
  double last_time = elapsed();
  if (wants_images_) return Halt::needs_images;
  while (sums.collisions < goal) {
    if ((sums.events & 1023) == 0) {
      CallScope::look();
      if (monitor.cancelled()) return Halt::cancelled;
      if (now_seconds() > wall_end) return Halt::wall_time;
      if (sums.collisions != last_collisions)
        last_collisions = sums.collisions, last_progress = sums.events, last_time = elapsed();
      else if (sums.events - last_progress > max_stalled_events && elapsed() - last_time > longest_wait())
        return Halt::stalled;
    }
    ++sums.events;
    const int32_t i = calendar_.top([this] { look_ahead(); });
    const double t = i < 0 ? never : calendar_.time(i);
    const double special =
        std::min(std::min(lists_end_, step_end_), std::min(std::min(fraction_time_, full_time_), time_end_));
    // Also after many events: when they come faster and faster, times must stay small to be sharp.
    if ((i < 0 && !(special < calendar_.horizon())) || sums.events > rebase_at_) {
      if (i < 0 && calendar_.horizon() == never && special == never) return Halt::stalled;  // nothing will ever happen
      rebase();
      if (wants_images_) return Halt::needs_images;
      continue;
    }
    if (t < special) {
      next_event(i);
      continue;
    }
    if (special == never) return Halt::stalled;
    if (special == time_end_) {  // a pause must leave no trace: now_ stays at the last event
      --sums.events;
      return Halt::time;
    }
    now_ = std::max(now_, special);
    if (special == fraction_time_) return Halt::packing_fraction;
    if (special == full_time_) return Halt::box_full;
    if (special == step_end_)
      set_growth(relative_rate_ * 2.0 * mean_radius() * unit * (1.0 + rate_ * now_));
    else
      refresh(1.0, true);
    if (wants_images_) return Halt::needs_images;
  }
  return Halt::window;
}

}  // namespace jam
