// How often spheres collide, leave their safe spheres and have events; chooses the shell of the lists and the width of
// a bucket of the calendar by it.
#pragma once
#include <algorithm>

#include "core/math.hpp"
#include "dynamics/event_driven/engine.hpp"
#include "dynamics/event_driven/lists.hpp"

namespace jam::inside {

struct Pace {
  int64_t exits = 0, exits_before = 0, collisions_before = 0, events_before = 0;
  int64_t rebase_at = 0;     // events at which the origin of time moves
  double search_cost = 0.0;  // of the candidates of one list
  double widest_shell = ListTuning::widest_shell;
  double tuned_time = 0.0, time_before = 0.0, bucket_width = 0.0;
  double collision_time = 0.0;  // between two collisions of a sphere

  // Chooses the shell: wide shells cost long lists, narrow ones remake lists often (ListTuning). Returns true when it
  // has changed.
  template <int D, Offsets O>
  bool choose_shell(const MdSums &sums, bool cell_mode, Lists<D, O> &lists) {
    using Tuning = ListTuning;
    const auto n = static_cast<int64_t>(lists.count.size());
    const int64_t made = sums.collisions - collisions_before, left = exits - exits_before;
    if (made < Tuning::collisions_between * n && left < Tuning::exits_between * n) return false;
    if (made > 0) collision_time = (sums.time - tuned_time) * static_cast<double>(n) / static_cast<double>(made);
    const double x = static_cast<double>(left) / static_cast<double>(std::max<int64_t>(made, 1));
    collisions_before = sums.collisions;
    exits_before = exits;
    tuned_time = sums.time;
    if (cell_mode) return false;
    const double length = lists.mean_length(), before = lists.shell;
    const auto cost = [&](double shell) {
      const double more = math::pow((1.0 + 2.0 * shell) / (1.0 + 2.0 * before), D);
      return 2.0 * (Tuning::collision + more * length) +
             x * math::pow(before / shell, Tuning::exits_by_shell) *
                 (Tuning::exit + Tuning::exit_per_neighbour * more * length +
                  (O == Offsets::listed ? 1.0 : more) * search_cost);
    };
    double best = Tuning::least_gain * cost(before);
    for (double shell = std::max(Tuning::smallest_shell, before / Tuning::most_change);
         shell <= std::min(widest_shell, before * Tuning::most_change); shell *= Tuning::step)
      if (cost(shell) < best) best = cost(shell), lists.shell = shell;
    return lists.shell != before;
  }

  // Sorts all events into buckets of about one event each.
  void sort(Calendar &calendar, const MdSums &sums, int32_t n) {
    using Tuning = CalendarTuning;
    const double elapsed = sums.time - time_before;
    const int64_t events = sums.events - events_before;
    if (events > Tuning::events_measured * n && elapsed > 0.0) {
      bucket_width = elapsed / static_cast<double>(events);
      time_before = sums.time;
      events_before = sums.events;
    } else if (bucket_width == 0.0) {
      guess_width(calendar, n);
    }
    double earliest = never;
    for (int32_t i = 0; i < n; ++i) earliest = std::min(earliest, calendar.time(i));
    const double least = Tuning::earliest_events * earliest / static_cast<double>(calendar.buckets());
    const double width = bucket_width < never ? std::max(bucket_width, least) : least;
    rebase_at = sums.events + Tuning::events_between * static_cast<int64_t>(n) + Tuning::more_events;
    calendar.rebuild(0.0, earliest < never ? width : 0.0);
  }
  // In the order of checkpoints.
  void archive(Archive &a) {
    for (int64_t *k : {&exits, &exits_before, &collisions_before, &events_before, &rebase_at}) a(*k);
    for (double *x : {&search_cost, &widest_shell, &tuned_time, &time_before, &bucket_width, &collision_time}) a(*x);
  }
  void check() const {
    for (const int64_t count : {exits, exits_before, collisions_before, events_before, rebase_at})
      Archive::check(count >= 0 && count < int64_t{1} << 60);  // differences are taken of them
  }

 private:
  // The median of the times to come. On a lattice most spheres may be at an edge of their cell and leave it now:
  // then a part of the mean, which costs at most a longer heap.
  void guess_width(const Calendar &calendar, int32_t n) {
    std::vector<double> times;
    double mean = 0.0;
    for (int32_t i = 0; i < n; ++i)
      if (const double t = calendar.time(i); t < never) times.push_back(t), mean += t / n;
    if (times.empty()) return;
    const auto median = times.begin() + static_cast<std::ptrdiff_t>(times.size() / 2);
    std::nth_element(times.begin(), median, times.end());
    bucket_width = std::max(*median, CalendarTuning::least_part_of_mean * mean) / n;
  }
};

}  // namespace jam::inside
