// Molecular dynamics of two builds of libjam, taking turns in one process: md_race OLD.so NEW.so [SECONDS [SCENE...]].
// For each scene: collisions a second of processor time of both (medians of rounds), the median of the ratios, reduced
// pressures, and whether the final positions are the same bits or how far they differ. JSON to stdout. Both libraries
// must have the structs of this build's jam.h, or shorter ones.
#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <string>
#include <vector>

#include "jam/jam.h"

namespace {

double cpu() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Library {
  decltype(&jam_create_options_init) create_options_init;
  decltype(&jam_run_options_init) run_options_init;
  decltype(&jam_compress_options_init) compress_options_init;
  decltype(&jam_create) create;
  decltype(&jam_destroy) destroy;
  decltype(&jam_run) run;
  decltype(&jam_compress) compress;
  decltype(&jam_view) view;

  explicit Library(const char *path) {
    void *handle = dlopen(path, RTLD_NOW | RTLD_LOCAL);
    if (!handle) {
      std::fprintf(stderr, "%s\n", dlerror());
      std::exit(1);
    }
    const auto find = [&](auto &function, const char *name) {
      void *symbol = dlsym(handle, name);
      if (!symbol) {
        std::fprintf(stderr, "%s has no %s\n", path, name);
        std::exit(1);
      }
      std::memcpy(&function, &symbol, sizeof symbol);
    };
    find(create_options_init, "jam_create_options_init");
    find(run_options_init, "jam_run_options_init");
    find(compress_options_init, "jam_compress_options_init");
    find(create, "jam_create");
    find(destroy, "jam_destroy");
    find(run, "jam_run");
    find(compress, "jam_compress");
    find(view, "jam_view");
  }
};

// Sets defaults in the longest form of the struct that the library knows.
template <class Options, class Init>
void set_defaults(Init init, Options &o) {
  for (size_t size = sizeof o; size >= 8; size -= 8)
    if (init(&o, size) == JAM_OK) return;
  std::fprintf(stderr, "a library does not know the options of jam.h\n");
  std::exit(1);
}

struct Scene {
  const char *name;
  int32_t dim;
  int64_t n;
  double start, fraction;  // made at `start`, compressed quickly to `fraction`
  double ratio;            // of two diameters, half of the spheres each
  int32_t model;
  double growth, pressure;  // growth > 0: each round compresses from `fraction` to `pressure`
};

const Scene scenes[] = {
    {"d3_1024", 3, 1024, 0.25, 0.48, 1.0, JAM_MODEL_EUCLID, 0.0, 0.0},
    {"d3_16384", 3, 16384, 0.25, 0.48, 1.0, JAM_MODEL_EUCLID, 0.0, 0.0},
    {"d3_100000", 3, 100000, 0.25, 0.48, 1.0, JAM_MODEL_EUCLID, 0.0, 0.0},
    {"d3_1000000", 3, 1000000, 0.25, 0.48, 1.0, JAM_MODEL_EUCLID, 0.0, 0.0},
    {"d2_1024", 2, 1024, 0.35, 0.68, 1.0, JAM_MODEL_EUCLID, 0.0, 0.0},
    {"d2_16384", 2, 16384, 0.35, 0.68, 1.0, JAM_MODEL_EUCLID, 0.0, 0.0},
    {"d4_2048", 4, 2048, 0.1, 0.28, 1.0, JAM_MODEL_EUCLID, 0.0, 0.0},
    {"d4_16384", 4, 16384, 0.1, 0.28, 1.0, JAM_MODEL_EUCLID, 0.0, 0.0},
    {"d5_4096", 5, 4096, 0.05, 0.15, 1.0, JAM_MODEL_EUCLID, 0.0, 0.0},
    {"d8_512", 8, 512, 0.004, 0.01, 1.0, JAM_MODEL_EUCLID, 0.0, 0.0},
    {"dilute_16384", 3, 16384, 0.05, 0.1, 1.0, JAM_MODEL_EUCLID, 0.0, 0.0},
    {"changeover_1024", 3, 1024, 0.1, 0.225, 1.0, JAM_MODEL_EUCLID, 0.0, 0.0},
    {"changeover_16384", 3, 16384, 0.1, 0.225, 1.0, JAM_MODEL_EUCLID, 0.0, 0.0},
    {"mixture_4096", 3, 4096, 0.25, 0.5, 1.4, JAM_MODEL_EUCLID, 0.0, 0.0},
    {"mixture10_2000", 3, 2000, 0.2, 0.5, 10.0, JAM_MODEL_EUCLID, 0.0, 0.0},
    {"mk_1024", 3, 1024, 0.1, 1.6, 1.0, JAM_MODEL_MK, 0.0, 0.0},
    {"mk_4096", 3, 4096, 0.1, 1.6, 1.0, JAM_MODEL_MK, 0.0, 0.0},
    {"mk_planted_1024", 3, 1024, 1.6, 1.6, 1.0, JAM_MODEL_MK, 0.0, 0.0},
    {"mk_planted_4096", 3, 4096, 1.6, 1.6, 1.0, JAM_MODEL_MK, 0.0, 0.0},
    {"small_box_24", 3, 24, 0.2, 0.4, 1.0, JAM_MODEL_EUCLID, 0.0, 0.0},
    {"grown_1024", 3, 1024, 0.2, 0.2, 1.0, JAM_MODEL_EUCLID, 1e-2, 500.0},
    {"grown_16384", 3, 16384, 0.2, 0.2, 1.0, JAM_MODEL_EUCLID, 1e-2, 500.0},
    {"grown_d2_1024", 2, 1024, 0.3, 0.3, 1.4, JAM_MODEL_EUCLID, 1e-2, 500.0},
    {"grown_1024_1e7", 3, 1024, 0.25, 0.5, 1.0, JAM_MODEL_EUCLID, 3e-3, 1e7},
};

jam_system *make(const Library &jam, const Scene &s) {
  jam_create_options o;
  set_defaults(jam.create_options_init, o);
  o.n = s.n;
  o.dim = s.dim;
  o.packing_fraction = s.start;
  o.model = s.model;
  std::vector<double> diameters;
  if (s.ratio != 1.0)
    for (int64_t i = 0; i < s.n; ++i) diameters.push_back(i % 2 ? s.ratio : 1.0);
  jam_start start{};
  start.struct_size = sizeof start, start.diameters = diameters.data(), start.diameters_len = diameters.size();
  jam_system *sys = nullptr;
  jam_status status = jam.create(&o, &start, &sys);
  if (status == JAM_OK && s.fraction > s.start) {
    jam_compress_options c;
    set_defaults(jam.compress_options_init, c);
    c.growth_rate = 0.1;
    c.pressure = 1e12;
    c.packing_fraction = s.fraction;
    status = jam.compress(sys, &c, nullptr);
  }
  if (status != JAM_OK) {
    std::fprintf(stderr, "%s: status %d\n", s.name, status);
    std::exit(1);
  }
  return sys;
}

struct Round {
  double rate, pressure;
};

Round go(const Library &jam, jam_system *sys, const Scene &s, double collisions) {
  jam_md_report report;
  std::memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  const double begin = cpu();
  if (s.growth > 0.0) {
    jam_compress_options c;
    set_defaults(jam.compress_options_init, c);
    c.growth_rate = s.growth;
    c.pressure = s.pressure;
    jam.compress(sys, &c, &report);
  } else {
    jam_run_options r;
    set_defaults(jam.run_options_init, r);
    r.collisions_per_particle = collisions;
    jam.run(sys, &r, &report);
  }
  return {static_cast<double>(report.collisions) / (cpu() - begin), report.pressure};
}

double median(std::vector<double> x) {
  std::sort(x.begin(), x.end());
  return x[x.size() / 2];
}

void race(const Library (&jam)[2], const Scene &s, double seconds, const char *comma) {
  jam_system *sys[2] = {make(jam[0], s), make(jam[1], s)};
  const size_t words = static_cast<size_t>(s.n * s.dim);
  std::vector<double> rates[2], ratios;
  double pressure[2] = {0.0, 0.0}, collisions = 20.0;
  const double begin = cpu();
  for (int round = 0; round < (s.growth > 0.0 ? 3 : 7); ++round) {
    double rate[2];
    for (int turn = 0; turn < 2; ++turn) {
      const int k = (turn + round) % 2;
      if (s.growth > 0.0 && round > 0) jam[k].destroy(sys[k]), sys[k] = make(jam[k], s);
      const Round r = go(jam[k], sys[k], s, collisions);
      rate[k] = r.rate;
      pressure[k] = r.pressure;
    }
    if (round == 0) {  // how long a round is
      const double spent = std::max(1e-3, cpu() - begin);
      collisions = std::min(1e5, std::max(5.0, std::floor(collisions * seconds / 6.0 / spent)));
      if (s.growth == 0.0) continue;
    }
    for (int k = 0; k < 2; ++k) rates[k].push_back(rate[k]);
    ratios.push_back(rate[1] / rate[0]);
  }
  double distance = 0.0;
  const double *x[2] = {nullptr, nullptr};
  for (int k = 0; k < 2; ++k) {
    size_t length = 0;
    jam[k].view(sys[k], JAM_VIEW_POSITIONS, &x[k], &length);
  }
  for (size_t c = 0; c < words; ++c) {
    const double d = x[0][c] - x[1][c];
    distance = std::max(distance, std::fabs(d - std::round(d)));
  }
  std::printf(
      "%s\n {\"scene\": \"%s\", \"old\": %.0f, \"new\": %.0f, \"ratio\": %.3f, \"pressures\": [%.6g, %.6g], "
      "\"same_bits\": %s, \"distance\": %.3g}",
      comma, s.name, median(rates[0]), median(rates[1]), median(ratios), pressure[0], pressure[1],
      std::memcmp(x[0], x[1], words * sizeof(double)) == 0 ? "true" : "false", distance);
  std::fflush(stdout);
  for (int k = 0; k < 2; ++k) jam[k].destroy(sys[k]);
}

}  // namespace

int main(int argc, char **argv) {
  if (argc < 3) {
    std::fprintf(stderr, "md_race OLD.so NEW.so [SECONDS [SCENE...]]\n");
    return 2;
  }
  const Library jam[2] = {Library(argv[1]), Library(argv[2])};
  const double seconds = argc > 3 ? std::atof(argv[3]) : 6.0;
  const char *comma = "";
  std::printf("[");
  for (const Scene &s : scenes) {
    bool wanted = argc <= 4;
    for (int k = 4; k < argc; ++k) wanted = wanted || s.name == std::string(argv[k]);
    if (!wanted) continue;
    race(jam, s, seconds, comma);
    comma = ",";
  }
  std::printf("]\n");
  return 0;
}
