// What each mechanism of a crunch is worth: named sets of five starts each (disks300, disks1000: of 50), with one
// mechanism switched off at a time. JSON lines to stdout: set, mechanism, start, factorisations, LPs, processor
// seconds, phi, jammed, force residual.
//   ablation [off=MECHANISM ...] [SET ...] [FILE ...]
// sets: table below; default: all of them. A FILE in any format that jam_read takes is a set of its own.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <limits>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "core/create.hpp"
#include "core/pair_rule.hpp"
#include "crunch/crunch.hpp"
#include "jam/jam.h"

using namespace jam::inside;

namespace {

struct Start {
  std::string set, name;
  Packing packing;
};

// The spheres of a handle, which is destroyed.
Packing packing_of(jam_system *sys) {
  Packing p;
  const double *x = nullptr, *s = nullptr;
  size_t nx = 0, ns = 0;
  jam_info info;
  info.struct_size = sizeof info;
  jam_get_info(sys, &info);
  jam_view(sys, JAM_VIEW_POSITIONS, &x, &nx);
  jam_view(sys, JAM_VIEW_DIAMETERS, &s, &ns);
  p.set_cube(info.dim, info.box);
  p.position.assign(x, x + nx);
  p.diameter.assign(s, s + ns);
  p.velocity.assign(nx, 0.0);
  jam_destroy(sys);
  return p;
}

// From a file in any format that jam_read takes. Ends the program where that fails.
Packing packing_of(const char *path) {
  jam_system *sys = nullptr;
  if (jam_read(path, nullptr, nullptr, nullptr, &sys) < 0) {
    std::fprintf(stderr, "%s\n", jam_last_error());
    std::exit(1);
  }
  return packing_of(sys);
}

// Grown by molecular dynamics at G = 1e-2 to reduced pressure 500, and on at `rate` to `pressure`.
Packing grown(int n, int dim, int64_t seed, double rate = 0.0, double pressure = 0.0) {
  jam_create_options o;
  jam_create_options_init(&o, sizeof o);
  o.n = n, o.dim = dim, o.seed = seed;
  jam_system *sys = nullptr;
  jam_compress_options md;
  jam_compress_options_init(&md, sizeof md);
  md.growth_rate = 1e-2, md.pressure = 500.0;
  bool good = jam_create(&o, nullptr, &sys) >= 0 && jam_compress(sys, &md, nullptr) >= 0;
  md.growth_rate = rate, md.pressure = pressure;
  if (rate > 0.0) good = good && jam_compress(sys, &md, nullptr) >= 0;
  if (!good) std::fprintf(stderr, "%s\n", jam_last_error());
  return packing_of(sys);
}

// Half of the spheres are `ratio` times as large.
Packing random_start(int n, int dim, double ratio, double fraction, int64_t seed) {
  jam_create_options o = default_create_options();
  o.n = n, o.dim = dim, o.packing_fraction = fraction, o.seed = seed;
  std::vector<double> diameter(n, 1.0);
  for (int i = 0; i < n; i += 2) diameter[i] = ratio;
  return make_packing(o, nullptr, 0, diameter.data(), diameter.size());
}

// `side` cells a side, each with a sphere at its corner; with `faces` also on its faces (centred square, fcc). Spheres
// are moved by up to `noise` cells, and as large as that allows.
Packing lattice(int side, int dim, bool faces, double noise, uint64_t seed) {
  Packing p;
  p.set_cube(dim, 1.0);
  std::mt19937_64 random(seed);
  const auto add = [&](std::vector<double> x) {
    for (double &c : x) c = (c + noise * (std::ldexp(static_cast<double>(random() >> 11), -52) - 1.0)) / side;
    p.position.insert(p.position.end(), x.begin(), x.end());
  };
  for (int k = 0; k < (dim == 2 ? side * side : side * side * side); ++k) {
    std::vector<double> x = {static_cast<double>(k % side), static_cast<double>(k / side % side)};
    if (dim == 3) x.push_back(static_cast<double>(k / side / side));
    add(x);
    for (int a = 0; a < dim && faces; ++a)
      for (int b = a + 1; b < dim; ++b) {
        std::vector<double> y = x;
        y[a] += 0.5, y[b] += 0.5;
        add(y);
      }
  }
  p.velocity.assign(p.position.size(), 0.0);
  p.diameter.assign(p.position.size() / dim, 0.5 / side);
  const double grows = 1.0 + closest_pair(p).gap;
  for (double &s : p.diameter) s *= grows * (1.0 - 1e-12);
  wrap_positions(p);
  return p;
}

const char *const sets[] = {"n200",     "n1000",  "fast1024", "fast2048", "fast4096", "slow1024",
                            "slow4096", "random", "mixtures", "disks",    "lattices"};
constexpr int hard_disks = 50;  // of the sets disks300 and disks1000, which run only where they are named

void add_set(const std::string &set, std::vector<Start> &starts) {
  for (int seed = 1; seed <= (set == "disks300" || set == "disks1000" ? hard_disks : 5); ++seed) {
    const std::string name = "seed " + std::to_string(seed);
    const auto add = [&](const std::string &of, Packing p) { starts.push_back({set, of + name, std::move(p)}); };
    if (set == "n200") add("", grown(200, 3, seed));
    if (set == "n1000") add("", grown(1000, 3, seed));
    if (set == "fast1024") add("", grown(1024, 3, seed, 1e-2, 1e6));
    if (set == "fast2048") add("", grown(2048, 3, seed, 1e-2, 1e6));
    if (set == "fast4096") add("", grown(4096, 3, seed, 1e-2, 1e6));
    if (set == "slow1024") add("", grown(1024, 3, seed, 1e-3, 1e7));
    if (set == "slow4096") add("", grown(4096, 3, seed, 1e-3, 1e7));
    if (set == "random") add("", random_start(512, 3, 1.0, 0.2, seed));
    if (set == "disks") add("", grown(300, 2, seed)), add("p = 1e7, ", grown(300, 2, seed, 1e-2, 1e7));
    if (set == "disks300") add("", grown(300, 2, seed, 3e-3, 1e7));
    if (set == "disks1000") add("", grown(1000, 2, seed, 3e-3, 1e7));
    if (set == "mixtures") {
      add("1:4 ", random_start(128, 3, 4.0, 0.19, seed));
      add("1:10 ", random_start(128, 3, 10.0, 0.19, seed));
      add("1:10 d 2 ", random_start(128, 2, 10.0, 0.25, seed));
    }
    if (set == "lattices") {
      const double noise = seed == 1 ? 0.0 : std::ldexp(1.0, -5 * seed);
      add("square ", lattice(10, 2, false, noise, seed));
      add("cubic ", lattice(5, 3, false, noise, seed));
      add("fcc ", lattice(4, 3, true, noise, seed));
    }
  }
}

struct Mechanism {
  const char *name;
  void (*off)(Tuning &, jam_crunch_options &);
};

const double never = std::numeric_limits<double>::infinity();
const Mechanism mechanisms[] = {
    {"none", [](Tuning &, jam_crunch_options &) {}},
    {"early LPs", [](Tuning &t, jam_crunch_options &) { t.early_gap = 0.0; }},
    {"warm LPs", [](Tuning &t, jam_crunch_options &) { t.warm_step = -1.0; }},
    {"wide bound", [](Tuning &t, jam_crunch_options &) { t.min_bound = 1e-6; }},
    {"barrier path", [](Tuning &, jam_crunch_options &o) { o.method = JAM_CRUNCH_SEQUENTIAL_LP; }},
    {"LPs alone for crystals", [](Tuning &t, jam_crunch_options &) { t.crystal_force = never; }},
    {"single precision", [](Tuning &t, jam_crunch_options &) { t.single.work = never; }},
    {"correctors", [](Tuning &t, jam_crunch_options &) { t.max_correctors = 0; }},
    {"leaving saddles of the path", [](Tuning &t, jam_crunch_options &) { t.increase = 1.0; }},
    {"neighbours of uncovered spheres", [](Tuning &t, jam_crunch_options &) { t.farthest_reach = 0.0; }},
    {"end of the path near rounding", [](Tuning &t, jam_crunch_options &) { t.end_roundings = 33.0; }},  // 1e-12
    {"dropped contacts", [](Tuning &t, jam_crunch_options &) { t.max_excess = 0; }},
    {"narrow LPs but the first", [](Tuning &t, jam_crunch_options &) { t.max_narrow_lps = 1; }},
    {"decompressions", [](Tuning &t, jam_crunch_options &) { t.decompression.fill(0.0); }},
};

void run(const Start &start, const Mechanism &mechanism) {
  jam_crunch_options o = default_crunch_options();
  CrunchHooks hooks;
  mechanism.off(hooks.tuning, o);
  Monitor monitor;
  monitor.begin();
  if (std::getenv("ABLATION_LOG")) {  // a jam_log_level
    monitor.log_level = std::atoi(std::getenv("ABLATION_LOG"));
    monitor.log_fn = [](int32_t, const char *line, void *) { std::fprintf(stderr, "%s\n", line); };
  }
  const std::clock_t before = std::clock();
  const CrunchResult r = crunch(start.packing, o, monitor, nullptr, &hooks);
  std::printf(
      "{\"set\": \"%s\", \"off\": \"%s\", \"start\": \"%s\", \"factorisations\": %lld, \"lps\": %lld, \"seconds\": "
      "%.3f, "
      "\"phi\": %.12f, \"status\": %d, \"stop\": \"%s\", \"jammed\": %d, \"excess\": %lld, \"force_residual\": %.2g}\n",
      start.set.c_str(), mechanism.name, start.name.c_str(), static_cast<long long>(r.report.factorisations),
      static_cast<long long>(r.report.lp_solves), static_cast<double>(std::clock() - before) / CLOCKS_PER_SEC,
      r.report.packing_fraction, r.status, jam_stop_string(r.report.stop_reason), r.report.jammed,
      static_cast<long long>(r.report.excess_contacts), r.report.force_residual);
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char **argv) {
  std::vector<Start> starts;
  std::vector<std::string> only;
  for (int k = 1; k < argc; ++k) {
    if (std::strncmp(argv[k], "off=", 4) == 0) {
      only.push_back(argv[k] + 4);
      continue;
    }
    const size_t before = starts.size();
    add_set(argv[k], starts);
    if (starts.size() > before) continue;
    const char *slash = std::strrchr(argv[k], '/');
    starts.push_back({slash ? slash + 1 : argv[k], "", packing_of(argv[k])});
  }
  if (starts.empty())
    for (const char *set : sets) add_set(set, starts);
  for (const Mechanism &mechanism : mechanisms)
    if (only.empty() || std::find(only.begin(), only.end(), mechanism.name) != only.end())
      for (const Start &start : starts) run(start, mechanism);
}
