// The engine: prediction, collision and the main loop, the hot path.
#pragma once
#include <cstdlib>

#include "core/call_scope.hpp"
#include "core/math.hpp"
#include "dynamics/event_driven/engine_of.hpp"

namespace jam::inside {

// r^2 - sigma^2 from integers; a and b need not be at clock_.now.
template <int D, Offsets O>
double EngineOf<D, O>::exact_gap(const Body<D> &a, const Body<D> &b, const int64_t *offset) const {
  const double da = clock_.now - a.time, db = clock_.now - b.time;
  unsigned __int128 r2 = 0;
  for (int c = 0; c < D; ++c) {
    int64_t r = wrapping_sum(difference(a, b, c, offset), std::llrint(-b.v[c] * db));
    if (da != 0.0) r = wrapping_sum(r, std::llrint(a.v[c] * da));
    const uint64_t m = r < 0 ? -static_cast<uint64_t>(r) : static_cast<uint64_t>(r);
    r2 += static_cast<unsigned __int128>(m) * m;
  }
  int64_t sum = spheres_.contact_sum(a, b);
  sum = wrapping_sum(sum, std::llrint(static_cast<double>(sum) * (clock_.rate * clock_.now)));
  const __int128 gap = static_cast<__int128>(r2 - static_cast<unsigned __int128>(sum) * static_cast<uint64_t>(sum));
  return static_cast<double>(static_cast<int64_t>(gap >> 64)) * 0x1p64 +
         2.0 * static_cast<double>(static_cast<int64_t>(static_cast<uint64_t>(gap) >> 1));
}

// Every overlap of a pair in the lists is seen here: a pair is deepest when an event turns one of its spheres round.
template <int D, Offsets O>
void EngineOf<D, O>::note_overlap(const Body<D> &a, const Body<D> &b, const int64_t *offset) {
  const double sigma = static_cast<double>(spheres_.contact_sum(a, b)) * clock_.grown();
  const double gap = std::max(-1.0, exact_gap(a, b, offset) / (sigma * sigma));
  max_overlap = std::max(max_overlap, -gap / (1.0 + std::sqrt(1.0 + gap)));
}

// When sphere i, which is at clock_.now, leaves its safe sphere.
template <int D, Offsets O>
double EngineOf<D, O>::exit_time(int32_t i) const {
  const Body<D> &b = spheres_.body[i];
  if constexpr (!listed)
    if (cell_mode_.on) return clock_.now + cell_mode_.crossing_time(i, b, scale, nullptr);
  double rv = 0.0, vv = 0.0, rr = 0.0;
  for (int c = 0; c < D; ++c) {
    const double r = static_cast<double>(static_cast<int64_t>(b.x[c] - lists_.centre[i][c]));
    rv += r * b.v[c];
    vv += b.v[c] * b.v[c];
    rr += r * r;
  }
  if (vv <= 0.0) return never;
  const double room = lists_.safe[i] * lists_.safe[i] - rr;
  if (room <= 0.0) return rv < 0.0 ? clock_.now - 2.0 * rv / vv : clock_.now;
  const double root = std::sqrt(rv * rv + vv * room);
  return clock_.now + (rv > 0.0 ? room / (rv + root) : (root - rv) / vv);
}

// When sphere `self`, which is at clock_.now, meets `other`: time from now, infinity if never. The kernel computes
// this for nearly all pairs; here are all cases.
template <int D, Offsets O>
double EngineOf<D, O>::collision_time(const Body<D> &self, const Body<D> &other, const int64_t *offset) {
  const double dt = clock_.now - other.time;
  double rv = 0.0, vv = 0.0, rr = 0.0;
  for (int c = 0; c < D; ++c) {
    const double r = static_cast<double>(difference(self, other, c, offset)) - other.v[c] * dt;
    const double v = self.v[c] - other.v[c];
    rv += r * v;
    vv += v * v;
    rr += r * r;
  }
  const double sum = static_cast<double>(spheres_.contact_sum(self, other)), sigma = sum * clock_.grown();
  const double growth = sum * clock_.rate, sigma2 = sigma * sigma;
  const double b = rv - sigma * growth, a = vv - growth * growth;
  double gap = rr - sigma2;
  if (gap < CollisionTuning::overlap * sigma2) note_overlap(self, other, offset);
  if (b >= 0.0 && a >= 0.0) return never;
  if (gap < CollisionTuning::near_contact * sigma2) gap = exact_gap(self, other, offset);
  const double disc = b * b - a * gap;
  // The surfaces recede now but growth outruns the spheres: the later root, or the time of least overlap.
  if (b >= 0.0) return disc > 0.0 ? -(b + std::sqrt(disc)) / a : -b / a;
  if (gap <= 0.0) return 0.0;  // in contact or overlapping, and approaching
  return disc < 0.0 ? never : gap / (std::sqrt(disc) - b);
}

// Not a part of predict, which is slower with this code in it.
template <int D, Offsets O>
[[gnu::noinline]] void EngineOf<D, O>::first_wall(const Body<D> &self, double &time, int32_t &partner) {
  max_overlap = std::max(max_overlap, walls_->first(self, clock_, time, partner));
}

// Earliest event of sphere i, which is at clock_.now. Of collisions at one time the first of the list counts.
template <int D, Offsets O>
void EngineOf<D, O>::predict(int32_t i) {
  const Body<D> &self = spheres_.body[i];
  const int32_t count = in_cell_mode() ? gather(i) : lists_.count[i],
                *list = in_cell_mode() ? found_.data() : lists_.of(i);
  PairBatch<D> pairs{
      spheres_.body.data(),   &self, list, 0, nullptr, lists_.capacity, calendar_.times(), clock_.now, clock_.rate,
      spheres_.non_additivity};
  Earliest earliest{exit_time(i) - clock_.now, -1};
  int32_t partner = -1;
  // Walls come first: where two spheres would meet across a wall at the time at which one of them meets it, it counts.
  if (walls_ && walls_->near[i]) first_wall(self, earliest.time, partner);
  for (int32_t first = 0; first < count; first += PairKernel<D>::batch) {
    pairs.list = list + first;
    pairs.count = std::min(PairKernel<D>::batch, count - first);
    pairs.offset = lists_.offset_of(i, first);
    earliest.entry = -1;
    for (uint64_t left_out = kernel_.collisions(pairs, earliest); left_out; left_out &= left_out - 1) {
      const int32_t entry = __builtin_ctzll(left_out), k = pairs.list[entry];
      const double t = collision_time(self, spheres_.body[k], lists_.offset_of(i, first + entry));
      const bool sooner = t < earliest.time || (t == earliest.time && entry < earliest.entry);
      if (sooner && clock_.now + t < calendar_.time(k)) earliest = {t, entry};
    }
    if (earliest.entry >= 0) partner = pairs.list[earliest.entry];
  }
  Event &event = calendar_[i];
  calendar_.time(i) = clock_.now + earliest.time;
  event.partner = partner;
  if (partner >= 0) event.partner_count = calendar_[partner].count;
}

// r_i - r_k of two spheres that are both at clock_.now; of several images the nearest that approaches. (In a box of
// less than two diameters a pair can be in contact through two images at once, and the one that recedes may be nearer
// by rounding.)
template <int D, Offsets O>
void EngineOf<D, O>::separation(int32_t i, int32_t k, double *r) const {
  if (!lists_.offset_of(i, 0)) {
    for (int c = 0; c < D; ++c) r[c] = static_cast<double>(difference(spheres_.body[i], spheres_.body[k], c, nullptr));
  } else {
    if (const int32_t entry = only_entry(lists_.of(i), lists_.count[i], k); entry >= 0) {
      const int64_t *offset = lists_.offset_of(i, entry);
      for (int c = 0; c < D; ++c) r[c] = static_cast<double>(difference(spheres_.body[i], spheres_.body[k], c, offset));
      return;
    }
    double nearest = never;
    const double growth = static_cast<double>(spheres_.contact_sum(spheres_.body[i], spheres_.body[k])) * clock_.rate;
    for (int32_t e = 0; e < lists_.count[i]; ++e) {
      if (lists_.of(i)[e] != k) continue;
      double r2 = 0.0, rv = 0.0, trial[D];
      for (int c = 0; c < D; ++c) {
        trial[c] = static_cast<double>(difference(spheres_.body[i], spheres_.body[k], c, lists_.offset_of(i, e)));
        r2 += trial[c] * trial[c];
        rv += trial[c] * (spheres_.body[i].v[c] - spheres_.body[k].v[c]);
      }
      const double rank = rv < growth * std::sqrt(r2) ? r2 : CollisionTuning::receding_image * r2;
      if (rank >= nearest) continue;
      nearest = rank;
      for (int c = 0; c < D; ++c) r[c] = trial[c];
    }
  }
}

// What a sphere carries leaves the observer's sum at a collision, and comes back with another velocity.
template <int D, Offsets O>
void EngineOf<D, O>::count_momentum(const Body<D> &b, int32_t i, double sign) {
  observer_->stress.template add<D>(sign * spheres_.mass_of(i) * unit * unit, b.v);
}

// Elastic collision of surfaces that move apart with the growth speed: the pair separates with at least that speed.
template <int D, Offsets O>
void EngineOf<D, O>::collide(int32_t i, int32_t k) {
  Body<D> &a = spheres_.body[i], &b = spheres_.body[k];
  double r[D], r2 = 0.0, rv = 0.0;
  separation(i, k, r);
  for (int c = 0; c < D; ++c) {
    r2 += r[c] * r[c];
    rv += r[c] * (a.v[c] - b.v[c]);
  }
  const double inverse = 1.0 / std::sqrt(r2), vn = rv * inverse;
  const double growth = static_cast<double>(spheres_.contact_sum(a, b)) * clock_.rate;
  double push = growth - vn;
  if (push <= 0.0) return;  // a grazing pair that rounding has let go
  push = std::max(push, CollisionTuning::least_push *
                            scale);  // never so little that the sum is lost: the pair would collide without end
  if (observer_) {
    observer_->stress.template advance<D>(clock_.now, clock_.now);
    count_momentum(a, i, -1.0), count_momentum(b, k, -1.0);
  }
  double twice_reduced = 1.0;  // mass of the pair
  if (spheres_.mass.empty()) {
    for (int c = 0; c < D; ++c) {
      const double dv = push * r[c] * inverse;
      a.v[c] += dv;
      b.v[c] -= dv;
    }
  } else {
    const double share_a = 2.0 * spheres_.mass[k] / (spheres_.mass[i] + spheres_.mass[k]), share_b = 2.0 - share_a;
    twice_reduced = spheres_.mass[i] * share_a;
    for (int c = 0; c < D; ++c) {
      const double dv = push * r[c] * inverse;
      a.v[c] += share_a * dv;
      b.v[c] -= share_b * dv;
    }
  }
  ++calendar_[i].count;
  ++calendar_[k].count;
  sums.of_pressure.virial -= twice_reduced * rv * unit * unit;
  sums.of_pressure.kinetic_integral += kinetic_.integral_to(clock_.now);
  kinetic_.since = clock_.now;
  kinetic_.twice += twice_reduced * 2.0 * push * growth * unit * unit;
  ++sums.collisions;
  if (!observer_) return;
  for (double &x : r) x *= inverse;
  observer_->stress.template collide<D>(-twice_reduced * rv * unit * unit, r);
  count_momentum(a, i, 1.0), count_momentum(b, k, 1.0);
  observer_->collision(spheres_.user[i], spheres_.user[k], -twice_reduced * vn * unit);
}

// The same with a wall: a fixed partner of endless mass, at the distance of one radius. The sphere leaves it with twice
// the speed of its growing surface less its own.
template <int D, Offsets O>
[[gnu::noinline]] void EngineOf<D, O>::hit_wall(int32_t i, int w) {
  Body<D> &b = spheres_.body[i];
  double n[D], vn = 0.0;
  walls_->container[w].template normal<D>(b.x, walls_->edge, n);
  for (int c = 0; c < D; ++c) vn += b.v[c] * n[c];
  const double radius = static_cast<double>(b.radius), growth = radius * clock_.rate;
  double push = growth - vn;
  if (push <= 0.0) return;
  push = std::max(push, CollisionTuning::least_push * scale);
  if (observer_) {
    observer_->stress.template advance<D>(clock_.now, clock_.now);
    count_momentum(b, i, -1.0);
  }
  for (int c = 0; c < D; ++c) b.v[c] += 2.0 * push * n[c];
  ++calendar_[i].count;
  const double momentum = -2.0 * spheres_.mass_of(i) * vn * unit;
  walls_->momentum[static_cast<size_t>(w)] += momentum;
  sums.of_pressure.virial += momentum * radius * clock_.grown() * unit;
  sums.of_pressure.kinetic_integral += kinetic_.integral_to(clock_.now);
  kinetic_.since = clock_.now;
  kinetic_.twice += 4.0 * spheres_.mass_of(i) * push * growth * unit * unit;
  ++sums.collisions;
  if (!observer_) return;
  observer_->stress.template collide<D>(momentum * radius * clock_.grown() * unit, n);
  count_momentum(b, i, 1.0);
  observer_->wall_collision(spheres_.user[i]);
}

template <int D, Offsets O>
void EngineOf<D, O>::next_event(int32_t i) {
  Event &event = calendar_[i];
#ifdef JAM_CHECK_PAIRS
  if (calendar_.time(i) < clock_.now - 1e-6 * pace_.bucket_width)
    fail(check_code_, "the event of sphere %d is %g buckets late after %lld collisions", spheres_.user[i],
         (clock_.now - calendar_.time(i)) / pace_.bucket_width, static_cast<long long>(sums.collisions));
#endif
  clock_.now = std::max(clock_.now, calendar_.time(i));
  move(spheres_.body[i]);
  const int32_t k = event.partner;
  const bool exit = k < 0;
  if (exit || calendar_[k].count != event.partner_count) {  // it leaves its safe sphere or meets a wall, or is stale
    if (k < -1) {
      hit_wall(i, -2 - k);
    } else if (exit) {
      ++pace_.exits;
      recentre(i);
    }
    calendar_.time(i) = never;
    predict(i);
    calendar_.update(i);
    return;
  }
  move(spheres_.body[k]);
  collide(i, k);
  calendar_.take_out(i);
  calendar_.take_out(k);
  calendar_.time(i) = calendar_.time(k) = never;
  predict(i);
  predict(k);
  calendar_.put_in(i);
  calendar_.put_in(k);
}

// Some (CollisionTuning::chances) times the mean time between two collisions of an ideal gas of this density and
// temperature: so many chances are not missed. 0 where no sphere moves against another.
template <int D, Offsets O>
double EngineOf<D, O>::longest_wait() const {
  const double n = static_cast<double>(spheres_.n), speed = spheres_.relative_speed(unit);
  if (walls_)
    if (const double to_walls = spheres_.speed_to_walls(unit); to_walls > 0.0)
      return CollisionTuning::chances * walls_->widest / to_walls;
  if (speed == 0.0) return 0.0;
  const double cross_section = unit_sphere_volume(D - 1) * math::pow(2.0 * mean_diameter(), D - 1);
  return CollisionTuning::chances / (0.5 * n * (n - 1.0) * cross_section * speed);
}

template <int D, Offsets O>
Halt EngineOf<D, O>::advance(int64_t collisions, const Monitor &monitor) {
  const int64_t goal = sums.collisions + collisions;
  // Without a collision in so many events and so long a time none will come: the spheres move as one, or their paths
  // never meet. Nor will one come where no time passes: a sphere fills its container.
  const int64_t max_stalled_events =
      CollisionTuning::stalled_events + CollisionTuning::stalled_events_per_sphere * spheres_.n;
  int64_t last_progress = sums.events, last_collisions = sums.collisions;
  double last_time = elapsed();
  if (wants_images_) return Halt::needs_images;
  while (sums.collisions < goal) {
    if (static_cast<uint64_t>(sums.events) % CollisionTuning::events_between_looks == 0) {
      CallScope::look();
      if (monitor.interrupted()) return Halt::interrupted;
      if (sums.collisions != last_collisions)
        last_collisions = sums.collisions, last_progress = sums.events, last_time = elapsed();
      else if (sums.events - last_progress > max_stalled_events)
        if (const double waited = elapsed() - last_time; waited == 0.0 || waited > longest_wait()) return Halt::stalled;
    }
    ++sums.events;
    const int32_t i = calendar_.top([this] { look_ahead(); });
    const double t = i < 0 ? never : calendar_.time(i);
    const double special = clock_.special();
    // Also after many events: when they come faster and faster, times must stay small to be sharp.
    if ((i < 0 && !(special < calendar_.horizon())) || sums.events > pace_.rebase_at) {
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
    if (special == clock_.time_end) {  // a pause must leave no trace: clock_.now stays at the last event
      --sums.events;
      return Halt::time;
    }
    clock_.now = std::max(clock_.now, special);
    if (special == clock_.fraction_time) return Halt::packing_fraction;
    if (special == clock_.full_time) return Halt::box_full;
    if (special == clock_.step_end)
      set_growth(clock_.relative_rate * 2.0 * spheres_.mean_radius() * unit * clock_.grown());
    else
      renew(1.0, true);
    if (wants_images_) return Halt::needs_images;
  }
  return Halt::window;
}

}  // namespace jam::inside
