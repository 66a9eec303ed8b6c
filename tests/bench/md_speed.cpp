// Collisions a second of NVE dynamics against the number of spheres and the packing fraction, and the cost of a compression.
// md_speed [SECONDS [N...]]: JSON to stdout. Seconds are of processor time, so that a busy machine disturbs less. The ratio
// is to the smallest system of the same packing fraction in the same run.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "core/create.hpp"
#include "edmd/engine.hpp"
#include "edmd/md.hpp"

using namespace jam;

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
      engine->advance(3 * n, monitor, 1e300);  // shells and buckets adapt
      std::vector<double> rates;
      const MdSums before = engine->sums;
      for (int k = 0; k < 5; ++k) {
        const double t = cpu();
        const int64_t c = engine->sums.collisions;
        while (cpu() - t < seconds / 5) engine->advance(20000, monitor, 1e300);
        rates.push_back(static_cast<double>(engine->sums.collisions - c) / (cpu() - t));
      }
      std::sort(rates.begin(), rates.end());
      if (base == 0.0) base = rates[2];
      const MdSums &now = engine->sums;
      std::printf("%s\n  {\"n\": %lld, \"packing_fraction\": %g, \"collisions_per_second\": %.0f, \"spread\": [%.0f, %.0f], \"ratio\": %.3f, "
                  "\"events_per_collision\": %.3f, \"pressure\": %.3f}",
                  comma, static_cast<long long>(n), fraction, rates[2], rates[0], rates[4], rates[2] / base,
                  static_cast<double>(now.events - before.events) / static_cast<double>(now.collisions - before.collisions),
                  1.0 + (now.virial - before.virial) / (now.action - before.action));
      comma = ",";
      std::fflush(stdout);
    }
  }
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
    std::printf("%s\n  {\"n\": 1024, \"growth_rate\": 0.01, \"pressure\": %g, \"seconds\": %.3f, \"collisions\": %lld, \"packing_fraction\": %.6f}", comma,
                report.pressure, times[1], static_cast<long long>(report.collisions), report.packing_fraction);
    comma = ",";
  }
  std::printf("]}\n");
  return 0;
}
