// The walls of a container in the integers of the engine; what a wall is says core/surface.hpp.
#pragma once
#include <algorithm>
#include <cmath>

#include "core/container.hpp"
#include "dynamics/event_driven/calendar.hpp"
#include "dynamics/event_driven/spheres.hpp"

namespace jam::inside {

// Time and growth: the present, the rate at which radii grow, and when something special happens. Times count from an
// origin that moves forward; radii are R (1 + rate t) with the R of the origin.
struct Clock {
  double now = 0.0;
  double rate = 0.0;
  double relative_rate = 0.0;     // rate at each step of a constant relative rate; 0: the diameters grow linearly
  std::vector<double> left_over;  // of radii, less than one unit
  double lists_end = never, fraction_time = never, full_time = never, time_end = never, step_end = never;
  double target_radius = 0.0;  // of sphere 0 at the target packing fraction

  explicit Clock(size_t n) : left_over(n, 0.0) {}
  double grown() const { return 1.0 + rate * now; }
  // The first of the special times.
  double special() const {
    return std::min(std::min(lists_end, step_end), std::min(std::min(fraction_time, full_time), time_end));
  }
  // At an origin of time.
  void start_rate(double new_rate, bool relative) {
    rate = new_rate;
    if (!relative) return;
    relative_rate = new_rate;
    step_end = CollisionTuning::growth_step / new_rate;
  }
  // The spheres grow by 1 / slower times the rate: special times that follow from growth move.
  void slow(double slower) {
    lists_end *= slower;
    full_time *= slower;
    if (fraction_time < never) fraction_time *= slower;
  }
  // Sets the origin of time to the present, and returns it; what is too small for the integer radii is carried over.
  template <int D>
  double move_origin(Spheres<D> &spheres, Calendar &calendar) {
    const double t = now, factor = rate * t;
    for (int32_t i = 0; i < spheres.n; ++i) {
      Body<D> &b = spheres.body[i];
      b.time -= t;
      calendar.time(i) -= t;
      if (factor == 0.0) continue;
      const double add = static_cast<double>(b.radius) * factor + left_over[i];
      const int64_t whole = std::llrint(add);
      b.radius = wrapping_sum(b.radius, whole);
      left_over[i] = add - static_cast<double>(whole);
    }
    for (double *special : {&lists_end, &full_time, &time_end, &step_end}) *special -= t;
    rate /= 1.0 + factor;
    // Recomputed from the radii, as differences of times would pile up errors.
    if (target_radius > 0.0) {
      const double first = static_cast<double>(spheres.body[0].radius), left = target_radius - first - left_over[0];
      fraction_time = std::max(0.0, left / first / rate);
    }
    now = 0.0;
    return t;
  }
};

// Sum of m v^2 about the centre of mass, and since when its integral over time has not been taken.
struct Kinetic {
  double since = 0.0, twice = 0.0;
  double integral_to(double now) const { return twice * (now - since); }
};

template <int D>
struct Walls {
  Container container;
  std::array<uint64_t, D> edge;  // of the cell, in integers; 2^64 is 0
  double share_of_cell;          // V of the cell over that of the container
  double widest;                 // edge with walls, V^(1/d)
  std::vector<double> momentum;  // that each wall received, V^(1/d) and masses of 1; without the growth part
  std::vector<char> near;        // of each sphere: whether it can meet a wall before its list is rebuilt

  Walls(const Packing &p, const Lattice<D> &lattice, bool listed)
      : container(p.container),
        share_of_cell(p.cell.volume() / p.container.volume()),
        widest(0.0),
        momentum(static_cast<size_t>(p.container.count()), 0.0),
        near(p.n(), 1) {
    for (int c = 0; c < D; ++c) {
      edge[c] = listed ? lattice.edge_units(c) : 0;
      if (!p.cell.repeats(c)) widest = std::max(widest, p.cell.edge(c) / p.cell.side());
    }
  }

  int64_t radius(const Body<D> &b, const Clock &clock) const {
    return wrapping_sum(b.radius, std::llrint(static_cast<double>(b.radius) * (clock.rate * clock.now)));
  }
  Approach approach(int w, const Body<D> &b, const Clock &clock) const {
    return container[w].approach<D>(b.x, b.v, radius(b, clock), static_cast<double>(b.radius) * clock.rate, edge);
  }
  // The list of sphere i was made here: it reaches rho, which covers growth and the way to the exit.
  void note_centre(int32_t i, const std::array<uint64_t, D> &centre, double rho) {
    const int64_t reach = std::llrint(std::min(rho, 0x1p62));
    bool any = false;
    for (const Surface &wall : container) any = any || wall.reached<D>(centre.data(), reach, edge);
    near[static_cast<size_t>(i)] = any;
  }
  // Where sphere b, which is at the present, meets a wall before `time` from now: lowers it and sets the partner of
  // the event. Returns the largest overlap, -h.
  double first(const Body<D> &b, const Clock &clock, double &time, int32_t &partner) const {
    double worst = 0.0;
    for (int w = 0; w < container.count(); ++w) {
      const Approach a = approach(w, b, clock);
      if (a.gap < 0.0) worst = std::max(worst, a.overlap(static_cast<double>(radius(b, clock))));
      const double t = a.time();
      if (t < time) time = t, partner = -2 - w;
    }
    return worst;
  }
  double overlap(const Body<D> &b, const Clock &clock) const {
    double none = 0.0;  // no event comes before now
    int32_t partner = -1;
    return first(b, clock, none, partner);
  }
  void archive(Archive &a) {
    const size_t count = momentum.size();
    a(momentum);
    Archive::check(momentum.size() == count);
    for (const double m : momentum) Archive::check(std::isfinite(m));
  }
};

}  // namespace jam::inside
