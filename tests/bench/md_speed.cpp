// Collisions a second of NVE dynamics against the number of spheres and the packing fraction, and the cost of a compression.
// md_speed [SECONDS [N...]]: JSON to stdout. Baseline of the ratio: the smallest system of the same packing fraction.
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "jam/jam.h"

static jam_system *fluid(int64_t n, double fraction) {
  jam_create_options o;
  jam_create_options_init(&o, sizeof o);
  o.n = n;
  o.packing_fraction = 0.25;
  jam_system *sys = nullptr;
  if (jam_create(&o, nullptr, 0, nullptr, 0, &sys) < 0) std::fprintf(stderr, "%s\n", jam_last_error()), std::exit(1);
  jam_compress_options c;
  jam_compress_options_init(&c, sizeof c);
  c.growth_rate = 0.1;
  c.pressure = 1e9;
  c.packing_fraction = fraction;
  if (jam_compress(sys, &c, nullptr) < 0) std::fprintf(stderr, "%s\n", jam_last_error()), std::exit(1);
  return sys;
}

int main(int argc, char **argv) {
  const double seconds = argc > 1 ? std::atof(argv[1]) : 1.0;
  std::vector<int64_t> sizes;
  for (int k = 2; k < argc; ++k) sizes.push_back(std::atoll(argv[k]));
  if (sizes.empty()) sizes = {1024, 16384, 100000};
  std::printf("{\"nve\": [");
  const char *comma = "";
  for (double fraction : {0.5, 0.6}) {
    double base = 0.0;
    for (int64_t n : sizes) {
      jam_system *sys = fluid(n, fraction);
      jam_run_options r;
      jam_run_options_init(&r, sizeof r);
      r.collisions_per_particle = 1e9;
      r.wall_time = seconds / 5;
      std::vector<double> rates;
      jam_md_report report;
      for (int k = 0; k < 5; ++k) {
        report.struct_size = sizeof report;
        if (jam_run(sys, &r, &report) < 0) std::fprintf(stderr, "%s\n", jam_last_error());
        rates.push_back(report.collisions_per_second);
      }
      std::sort(rates.begin(), rates.end());
      if (base == 0.0) base = rates[2];
      std::printf("%s\n  {\"n\": %lld, \"packing_fraction\": %g, \"collisions_per_second\": %.0f, \"spread\": [%.0f, %.0f], \"ratio\": %.3f, "
                  "\"events_per_collision\": %.3f, \"pressure\": %.4f}",
                  comma, static_cast<long long>(n), fraction, rates[2], rates[0], rates[4], rates[2] / base,
                  static_cast<double>(report.events) / static_cast<double>(report.collisions), report.pressure);
      comma = ",";
      std::fflush(stdout);
      jam_destroy(sys);
    }
  }
  std::printf("],\n \"compression\": [");
  comma = "";
  for (double target : {500.0, 1e4}) {
    std::vector<double> times;
    jam_md_report report;
    for (int k = 0; k < 3; ++k) {
      jam_create_options o;
      jam_create_options_init(&o, sizeof o);
      o.n = 1024;
      jam_system *sys = nullptr;
      jam_create(&o, nullptr, 0, nullptr, 0, &sys);
      jam_compress_options c;
      jam_compress_options_init(&c, sizeof c);
      c.pressure = target;
      report.struct_size = sizeof report;
      jam_compress(sys, &c, &report);
      times.push_back(report.seconds);
      jam_destroy(sys);
    }
    std::sort(times.begin(), times.end());
    std::printf("%s\n  {\"n\": 1024, \"growth_rate\": 0.01, \"pressure\": %g, \"seconds\": %.3f, \"collisions\": %lld, \"packing_fraction\": %.6f}", comma,
                report.pressure, times[1], static_cast<long long>(report.collisions), report.packing_fraction);
    comma = ",";
  }
  std::printf("]}\n");
  return 0;
}
