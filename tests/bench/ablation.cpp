// What each mechanism of a crunch is worth: named sets of starts, with one mechanism switched off at a time. JSON lines
// to stdout: set, mechanism, start, factorisations, LPs, processor seconds, phi, jammed, force residual.
//   ablation [off=MECHANISM] [SET ...] [FILE ...]    sets: n200 n1000 mixtures random disks; default: all of them. A
//   FILE in any format
//                                    that jam_read takes is a set of its own (grown states of 4096 spheres and more).
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <limits>
#include <string>
#include <vector>

#include "core/create.hpp"
#include "crunch/crunch.hpp"
#include "jam/jam.h"
#include "packing_of.hpp"

using namespace jam;

namespace {

struct Start {
  std::string set, name;
  Packing packing;
};

// Grown by molecular dynamics at G = 1e-2 to reduced pressure 500.
Packing grown(int n, int dim, int64_t seed) {
  jam_create_options o;
  jam_create_options_init(&o, sizeof o);
  o.n = n, o.dim = dim, o.seed = seed;
  jam_system *sys = nullptr;
  jam_compress_options md;
  jam_compress_options_init(&md, sizeof md);
  md.growth_rate = 1e-2, md.pressure = 500.0;
  if (jam_create(&o, nullptr, &sys) < 0 || jam_compress(sys, &md, nullptr) < 0)
    std::fprintf(stderr, "%s\n", jam_last_error());
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

void add_set(const std::string &set, std::vector<Start> &starts) {
  for (int seed = 1; seed <= 8; ++seed) {
    const std::string name = "seed " + std::to_string(seed);
    if (set == "n200") starts.push_back({set, name, grown(200, 3, seed)});
    if (set == "n1000") starts.push_back({set, name, grown(1000, 3, seed)});
    if (set == "random") starts.push_back({set, name, random_start(512, 3, 1.0, 0.2, seed)});
    if (set == "disks") starts.push_back({set, name, grown(300, 2, seed)});
    if (set == "mixtures" && seed <= 4) {
      starts.push_back({set, "1:4 " + name, random_start(128, 3, 4.0, 0.19, seed)});
      starts.push_back({set, "1:10 " + name, random_start(128, 3, 10.0, 0.19, seed)});
      starts.push_back({set, "1:10 d 2 " + name, random_start(128, 2, 10.0, 0.25, seed)});
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
    {"LPs alone for crystals", [](Tuning &t, jam_crunch_options &) { t.crystal_rows = never; }},
    {"single precision", [](Tuning &t, jam_crunch_options &) { t.single.work = never; }},
    {"correctors", [](Tuning &t, jam_crunch_options &) { t.max_correctors = 0; }},
    {"leaving saddles of the path", [](Tuning &t, jam_crunch_options &) { t.increase = 1.0; }},
    {"nearly centred", [](Tuning &t, jam_crunch_options &) { t.nearly_centred = 0.0; }},
    {"narrower first bound", [](Tuning &t, jam_crunch_options &) { t.bound_per_root_gap = never; }},
    {"neighbours of uncovered spheres", [](Tuning &t, jam_crunch_options &) { t.farthest_reach = 0.0; }},
    {"end of the path near rounding", [](Tuning &t, jam_crunch_options &) { t.end_roundings = 33.0; }},  // 1e-12
    {"dropped contacts", [](Tuning &t, jam_crunch_options &) { t.max_excess = 0; }},
    {"narrow LPs", [](Tuning &t, jam_crunch_options &) { t.max_narrow_lps = 0; }},
    {"kicks along flexes", [](Tuning &t, jam_crunch_options &) { t.max_kicks = 0; }},
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
  std::string only;
  if (argc < 2)
    for (const char *set : {"n200", "n1000", "mixtures", "random", "disks"}) add_set(set, starts);
  for (int k = 1; k < argc; ++k) {
    const size_t before = starts.size();
    if (std::strncmp(argv[k], "off=", 4) == 0) {
      only = argv[k] + 4;
      continue;
    }
    add_set(argv[k], starts);
    if (starts.size() > before) continue;
    const char *slash = std::strrchr(argv[k], '/');
    starts.push_back({slash ? slash + 1 : argv[k], "", packing_of(argv[k])});
  }
  for (const Mechanism &mechanism : mechanisms)
    if (only.empty() || only == mechanism.name)
      for (const Start &start : starts) run(start, mechanism);
}
