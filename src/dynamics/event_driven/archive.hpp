// The engine to bytes and back: all that the coming events depend on, in one list. What follows from the packing (the
// shifts of the Mari-Kurchan model) is rebuilt.
#pragma once
#include <algorithm>
#include <cmath>

#include "core/limits.hpp"
#include "dynamics/event_driven/engine_of.hpp"

namespace jam::inside {

template <int D, Offsets O>
void EngineOf<D, O>::archive(Archive &a) {
  a(sums);
  a(max_overlap);
  a(options_);
  a(spheres_.user);
  a(spheres_.body);
  calendar_.archive(a, walls_ ? walls_->container.count() : 0);
  a(clock_.now);
  a(clock_.rate);
  a(clock_.relative_rate);
  a(clock_.left_over);
  a(spheres_.mass);
  for (double *t : {&clock_.lists_end, &clock_.fraction_time, &clock_.full_time, &clock_.time_end, &clock_.step_end})
    a(*t);
  a(clock_.target_radius);
  a(kinetic_.since);
  a(kinetic_.twice);
  lists_.archive(a);
  levels_.archive(a, lattice_);
  cell_mode_.archive(a, lattice_);
  pace_.archive(a);
  if (walls_) walls_->archive(a);
  if (a.reading()) {
    options_.instruction_set = InstructionSet::best;  // of this processor, not of the one that wrote
    check_archive();
    if (walls_ && !in_cell_mode())
      for (int32_t i = 0; i < spheres_.n; ++i) walls_->note_centre(i, lists_.centre[i], lists_.rho[i]);
    if (mari_kurchan_) {
      mari_kurchan_->prepare(spheres_.user);
      for (int32_t i = 0; i < spheres_.n; ++i) note_centre(i);
    }
  }
}

// Every index must be in its range, or a damaged file would send the engine astray.
template <int D, Offsets O>
void EngineOf<D, O>::check_archive() {
  const size_t n = static_cast<size_t>(spheres_.n);
  Archive::check(spheres_.user.size() == n && spheres_.body.size() == n && clock_.left_over.size() == n &&
                 (spheres_.mass.empty() || spheres_.mass.size() == n));
  lists_.check(n, scale);
  pace_.check();
  std::vector<char> seen(n, 0);
  for (int32_t u : spheres_.user) {
    Archive::check(u >= 0 && static_cast<size_t>(u) < n && !seen[u]);
    seen[u] = 1;
  }
  for (const double m : spheres_.mass) Archive::check(m > 0.0 && std::isfinite(m));
  for (int32_t i = 0; i < spheres_.n; ++i) {
    const Body<D> &b = spheres_.body[i];
    Archive::check(b.radius > 0 && b.radius <= int64_t{1} << 62 && std::isfinite(b.time));
    // One sphere may hold all the energy, and growth heats.
    const double fastest = 10.0 * limits::velocity_max * std::sqrt(D * spheres_.n / spheres_.mass_of(i));
    for (const double v : b.v) Archive::check(std::fabs(v) <= fastest * scale);
  }
  for (const double part : clock_.left_over) Archive::check(std::isfinite(part));
  for (const double x : {clock_.now, clock_.rate, clock_.relative_rate, kinetic_.twice, sums.time, max_overlap})
    Archive::check(std::isfinite(x));
  for (const int64_t count : {sums.events, sums.collisions})
    Archive::check(count >= 0 && count < int64_t{1} << 60);  // differences are taken of them
  Archive::check(cell_mode_.on == 0 || (!listed && cell_mode_.on == 1));
  if (in_cell_mode()) return cell_mode_.check(spheres_.n, lattice_);
  Archive::check(levels_.all().empty() == (mari_kurchan_ != nullptr));
  levels_.check(lists_.rho, lists_.centre, lattice_);
}

}  // namespace jam::inside
