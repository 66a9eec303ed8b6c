// Time and growth: the present, the rate at which radii grow, and when something special happens. Times count from an
// origin that moves forward; radii are R (1 + rate t) with the R of the origin.
#pragma once
#include <algorithm>
#include <cmath>
#include <vector>

#include "dynamics/event_driven/calendar.hpp"
#include "dynamics/event_driven/spheres.hpp"

namespace jam::inside {

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

}  // namespace jam::inside
