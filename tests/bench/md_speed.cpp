// Collisions a second of NVE dynamics against the number of spheres and the packing fraction, and the cost of a
// compression. Then lists against cells alone by packing fraction, the calendar against one heap, and a run that is
// observed against one that is not, interleaved, as ratios of rates. md_speed [SECONDS [N...]]: JSON to stdout. Seconds
// are of processor time, so that a busy machine disturbs less. The ratio is to the smallest system of the same packing
// fraction in the same run.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "core/create.hpp"
#include "dynamics/event_driven/engine.hpp"
#include "dynamics/event_driven/options.hpp"

using namespace jam::inside;

static double cpu() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

static Packing fluid(int64_t n, int dim, double start, double fraction, Monitor &monitor) {
  jam_create_options o = default_create_options();
  o.n = n;
  o.dim = dim;
  o.packing_fraction = start;
  Packing p = make_packing(o, nullptr, 0, nullptr, 0);
  jam_md_report report{};
  run_stage(p, {0.1, 1e12, fraction, never, never}, monitor, report);
  return p;
}

// Median over rounds of rate(b) / rate(a), the two taking turns; pressures of both as the figure of accuracy.
struct Race {
  double ratio, pressure_a, pressure_b, rate_a, rate_b;
};
static Race race(Engine &a, Engine &b, double seconds, const Monitor &monitor) {
  std::vector<double> ratios, rates[2];
  Engine *engine[2] = {&a, &b};
  MdSums before[2] = {a.sums, b.sums};
  for (int round = 0; round < 7; ++round) {
    double rate[2];
    for (int k = 0; k < 2; ++k) {
      const double t = cpu();
      const int64_t c = engine[k]->sums.collisions;
      while (cpu() - t < seconds / 7) engine[k]->advance(20000, monitor);
      rate[k] = static_cast<double>(engine[k]->sums.collisions - c) / (cpu() - t);
      rates[k].push_back(rate[k]);
    }
    ratios.push_back(rate[1] / rate[0]);
  }
  std::sort(ratios.begin(), ratios.end());
  for (auto &r : rates) std::sort(r.begin(), r.end());
  const auto pressure = [&](int k) {
    return 1.0 + (engine[k]->sums.of_pressure.virial - before[k].of_pressure.virial) /
                     (engine[k]->sums.of_pressure.kinetic_integral - before[k].of_pressure.kinetic_integral);
  };
  return {ratios[3], pressure(0), pressure(1), rates[0][3], rates[1][3]};
}

// Lists and cells alone, taking turns, and which of the two the engine takes by itself.
static void engines(const std::vector<int64_t> &sizes, double seconds, Monitor &monitor) {
  const char *comma = "";
  for (int64_t n : sizes)
    for (double fraction : {0.01, 0.03, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.4, 0.5, 0.6}) {
      const Packing p = fluid(n, 3, std::min(0.25, 0.9 * fraction), fraction, monitor);
      EngineOptions lists, cells;
      lists.cells = -1;
      cells.cells = 1;
      auto a = make_engine(p, lists), b = make_engine(p, cells);
      for (Engine *e : {a.get(), b.get()}) e->advance(10 * n, monitor);
      const Race found = race(*a, *b, seconds, monitor);
      std::printf(
          "%s\n  {\"n\": %lld, \"packing_fraction\": %g, \"lists\": %.0f, \"cells\": %.0f, \"ratio\": %.3f, "
          "\"choice\": \"%s\", \"pressures\": [%.4f, %.4f]}",
          comma, static_cast<long long>(n), fraction, found.rate_a, found.rate_b, found.ratio,
          make_engine(p, EngineOptions{})->cells_alone() ? "cells" : "lists", found.pressure_a, found.pressure_b);
      comma = ",";
      std::fflush(stdout);
    }
}

static void races(const std::vector<int64_t> &sizes, double seconds, Monitor &monitor) {
  const char *comma = "";
  for (int64_t n : sizes) {
    const Packing p = fluid(n, 3, 0.25, 0.5, monitor);
    jam_observe_options all = default_observe_options();
    all.collisions = 1;
    Observer series(p, default_observe_options()), pairs(p, all);
    EngineOptions with_heap;
    with_heap.heap_only = 1;
    auto plain = make_engine(p, EngineOptions{}), heap = make_engine(p, with_heap),
         seen = make_engine(p, EngineOptions{}), counted = make_engine(p, EngineOptions{});
    seen->observe(&series);
    counted->observe(&pairs);
    for (Engine *e : {plain.get(), heap.get(), seen.get(), counted.get()}) e->advance(3 * n, monitor);
    struct {
      const char *name;
      Engine *engine;
    } const rivals[] = {
        {"one heap", heap.get()}, {"observed: series", seen.get()}, {"observed: collisions of pairs", counted.get()}};
    for (const auto &r : rivals) {
      const Race found = race(*plain, *r.engine, seconds, monitor);
      std::printf(
          "%s\n  {\"n\": %lld, \"packing_fraction\": 0.5, \"rival\": \"%s\", \"rate_ratio\": %.3f, \"pressures\": "
          "[%.3f, %.3f]}",
          comma, static_cast<long long>(n), r.name, found.ratio, found.pressure_a, found.pressure_b);
      comma = ",";
      std::fflush(stdout);
    }
    seen->observe(nullptr);
    counted->observe(nullptr);
  }
}

int main(int argc, char **argv) {
  const double seconds = argc > 1 ? std::atof(argv[1]) : 2.0;
  std::vector<int64_t> sizes;
  for (int k = 2; k < argc; ++k) sizes.push_back(std::atoll(argv[k]));
  if (sizes.empty()) sizes = {1024, 16384, 100000};
  Monitor monitor;
  monitor.begin();
  std::printf("{\"nve\": [");
  const char *comma = "";
  for (double fraction : {0.3, 0.5, 0.6}) {
    double base = 0.0;
    for (int64_t n : sizes) {
      const Packing p = fluid(n, 3, 0.25, fraction, monitor);
      auto engine = make_engine(p, EngineOptions{});
      engine->advance(3 * n, monitor);  // shells and buckets adapt
      std::vector<double> rates;
      const MdSums before = engine->sums;
      for (int k = 0; k < 5; ++k) {
        const double t = cpu();
        const int64_t c = engine->sums.collisions;
        while (cpu() - t < seconds / 5) engine->advance(20000, monitor);
        rates.push_back(static_cast<double>(engine->sums.collisions - c) / (cpu() - t));
      }
      std::sort(rates.begin(), rates.end());
      if (base == 0.0) base = rates[2];
      const MdSums &now = engine->sums;
      std::printf(
          "%s\n  {\"n\": %lld, \"packing_fraction\": %g, \"collisions_per_second\": %.0f, \"spread\": [%.0f, %.0f], "
          "\"ratio\": %.3f, "
          "\"events_per_collision\": %.3f, \"pressure\": %.3f}",
          comma, static_cast<long long>(n), fraction, rates[2], rates[0], rates[4], rates[2] / base,
          static_cast<double>(now.events - before.events) / static_cast<double>(now.collisions - before.collisions),
          1.0 + (now.of_pressure.virial - before.of_pressure.virial) /
                    (now.of_pressure.kinetic_integral - before.of_pressure.kinetic_integral));
      comma = ",";
      std::fflush(stdout);
    }
  }
  std::printf("],\n \"engines\": [");
  engines({sizes.front(), sizes[sizes.size() / 2]}, seconds, monitor);
  std::printf("],\n \"against\": [");
  races(sizes, seconds, monitor);
  std::printf("],\n \"compression\": [");
  comma = "";
  for (double target : {500.0, 1e4}) {
    std::vector<double> times;
    jam_md_report report{};
    for (int k = 0; k < 3; ++k) {
      Packing p = fluid(1024, 3, 0.2, 0.2, monitor);
      report = jam_md_report{};
      const double t = cpu();
      run_stage(p, {1e-2, target, never, never, never}, monitor, report);
      times.push_back(cpu() - t);
    }
    std::sort(times.begin(), times.end());
    std::printf(
        "%s\n  {\"n\": 1024, \"growth_rate\": 0.01, \"pressure\": %g, \"seconds\": %.3f, \"collisions\": %lld, "
        "\"packing_fraction\": %.6f}",
        comma, report.pressure, times[1], static_cast<long long>(report.collisions), report.packing_fraction);
    comma = ",";
  }
  std::printf("]}\n");
  return 0;
}
