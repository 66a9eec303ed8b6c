// The walls of a container in the integers of the engine; what a wall is says core/surface.hpp.
#pragma once
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "core/archive.hpp"
#include "core/container.hpp"
#include "dynamics/event_driven/clock.hpp"
#include "dynamics/event_driven/kernel/pair_kernel.hpp"
#include "dynamics/event_driven/lattice.hpp"

namespace jam::inside {

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
