// Small crunches for the tests of their parts.
#pragma once
#include <string>
#include <vector>

#include "core/create.hpp"
#include "crunch/crunch.hpp"

namespace jam::inside {

// What runs under this monitor has to say, one line after the other in `log`.
inline void listen(Monitor &monitor, std::string &log, int level = JAM_LOG_WARNING) {
  monitor.log_fn = [](int32_t, const char *line, void *user) { *static_cast<std::string *>(user) += line; };
  monitor.log_user = &log;
  monitor.log_level = level;
  monitor.begin();
}

// Every other sphere is `ratio` times as wide. cell: its vectors, or NULL for the unit cube.
inline Packing start(int n, int dim, double phi, int64_t seed, double ratio = 1.0, const double *cell = nullptr) {
  jam_create_options o = default_create_options();
  o.n = n, o.dim = dim, o.packing_fraction = phi, o.seed = seed;
  std::vector<double> sizes(n);
  for (int k = 0; k < n; ++k) sizes[k] = k % 2 ? 1.0 : ratio;
  return make_packing(o, nullptr, 0, sizes.data(), sizes.size(), cell);
}

inline CrunchResult run(const Packing &p, const jam_crunch_options &o, const CrunchHooks *hooks = nullptr,
                        History *history = nullptr) {
  Monitor monitor;
  monitor.begin();
  return crunch(p, o, monitor, history, hooks);
}

// Near enough to jamming that the path begins where it does in a crunch.
inline Packing near_jamming(const Packing &p) {
  jam_crunch_options o = default_crunch_options();
  o.method = JAM_CRUNCH_SEQUENTIAL_LP, o.max_lps = 4;
  return run(p, o).packing;
}

}  // namespace jam::inside
