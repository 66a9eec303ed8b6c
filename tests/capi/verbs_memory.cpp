// Out of memory at any allocation of any call: JAM_E_MEMORY with a valid state, no leak, no file left behind, and a
// handle that works. Calls come from tests/calls.def; the cases beside them take other options.
extern "C" {
#include <glob.h>
#include <jam/jam.h>
#include <string.h>
#include <unistd.h>

#include "calls.h"
#include "start.h"
#include "test.h"
}
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "failing_new.hpp"

namespace {

using Verb = std::function<jam_status(jam_system *)>;
struct Case {
  const char *name;
  const jam_system *start;
  Verb verb;
  bool may_need_none = false;  // no memory of its own
};

template <class Options>
Options defaults(jam_status (*init)(Options *, size_t)) {
  Options o;
  assert_int_equal(init(&o, sizeof o), JAM_OK);
  return o;
}

jam_system *create(int dim, int64_t n, double fraction, int32_t overlap, int32_t model = JAM_MODEL_EUCLID) {
  auto o = defaults(jam_create_options_init);
  jam_system *sys = nullptr;
  o.dim = dim, o.n = n, o.packing_fraction = fraction, o.overlap = overlap, o.model = model, o.seed = 3;
  std::vector<double> diameter(static_cast<size_t>(n), 1.0);
  for (size_t i = 0; i < diameter.size(); i += 2) diameter[i] = 1.4;
  assert_int_equal(create_from(&o, nullptr, 0, diameter.data(), diameter.size(), &sys), JAM_OK);
  return sys;
}

jam_system *copy_of(const jam_system *start) {
  jam_system *sys = nullptr;
  if (start) assert_int_equal(jam_copy(start, &sys), JAM_OK);
  return sys;
}

void assert_valid(const jam_system *sys) {
  if (!sys) return;
  SIZED(jam_info, info);
  assert_int_equal(jam_get_info(sys, &info), JAM_OK);
  const double *x = nullptr;
  size_t len = 0;
  jam_view(sys, JAM_VIEW_POSITIONS, &x, &len);
  for (size_t k = 0; k < len; ++k) assert_true(x[k] >= 0.0 && x[k] < info.box);
  jam_view(sys, JAM_VIEW_DIAMETERS, &x, &len);
  for (size_t k = 0; k < len; ++k) assert_true(x[k] > 0.0 && std::isfinite(x[k]));
  jam_system *copy = copy_of(sys);
  assert_int_equal(jam_scale_diameters(copy, 1.0 + 1e-13), JAM_OK);  // looks for overlaps of hard spheres
  jam_destroy(copy);
}

// libc++ before version 16 loses the memory of a vector whose element throws while the vector is made.
bool library_loses_memory() {
  const std::vector<double> element(3, 1.0);
  const long clean = alive;
  until_failure = 1;
  try {
    const std::vector<std::vector<double>> two(2, element);
  } catch (const std::bad_alloc &) {
  }
  until_failure = -1;
  return alive != clean;
}

#ifdef JAM_SANITIZED  // ten times slower: the release build has tried the others
constexpr long dense = 100;
#else
constexpr long dense = 2000;
#endif

// The k-th allocation fails, alone or with all that follow, for every k of the first `dense` and then for some.
void fail_each(const Case &c, bool single) {
  jam_system *plain = copy_of(c.start);
  const jam_status usual = c.verb(plain);
  jam_destroy(plain);
  assert_true(usual >= 0);
  once = false;
  const bool leaky = library_loses_memory();
  if (leaky) print_message("the C++ library loses memory itself: what JAM_E_MEMORY leaves is not counted\n");
  once = single;
  long failed = 0, k = 0;
  for (;; k += 1 + k / dense * (k / 10)) {
    const long clean = alive;
    jam_system *sys = copy_of(c.start);
    until_failure = k;
    const jam_status status = c.verb(sys);
    const bool hit = has_failed();
    until_failure = -1;
    assert_valid(sys);
    if (!hit) assert_int_equal(status, usual);
    if (status == JAM_E_MEMORY) {
      ++failed;
      assert_true(strlen(jam_last_error()) > 0);
    } else {
      assert_int_equal(status, usual);  // a temporary that the standard library does without
    }
    if (k % 50 == 0) assert_true(c.verb(sys) >= 0);  // the handle works
    jam_destroy(sys);
    if (status != JAM_E_MEMORY || !leaky) assert_int_equal(alive, clean);
    if (!hit) break;
  }
  print_message("%s: %ld allocations, %ld failures%s\n", c.name, k, failed, single ? ", one at a time" : "");
  assert_true(failed > 0 || c.may_need_none);
}

// ---- the verbs, which allocate nothing themselves

jam_status run(jam_system *sys) {
  auto o = defaults(jam_run_options_init);
  auto seen = defaults(jam_observe_options_init);
  o.collisions_per_particle = 20.0, seen.collisions = 1, seen.gap_bins = seen.r_bins = 8, seen.sample_every = 2.0;
  const jam_status status = jam_observe(sys, &seen);
  return status < 0 ? status : jam_run(sys, &o, nullptr);
}
jam_status isoconfigurational(jam_system *sys) {
  auto o = defaults(jam_isoconf_options_init);
  auto m = defaults(jam_monte_carlo_options_init);
  o.runs = 4, o.block = 2, m.step = 0.1;
  const double instant[] = {1.0, 3.0};
  const int32_t kept = 1;
  const jam_status status = jam_isoconf(sys, &o, nullptr, instant, 2, &kept, 1, nullptr);
  return status < 0 ? status : jam_isoconf(sys, &o, &m, instant, 2, &kept, 1, nullptr);
}
jam_status crunch_by_lps(jam_system *sys) {
  auto o = defaults(jam_crunch_options_init);
  o.method = JAM_CRUNCH_SEQUENTIAL_LP, o.steps = 1;
  return jam_crunch(sys, &o, nullptr);
}
jam_status relax(jam_system *sys) {
  auto o = defaults(jam_relax_options_init);
  o.force_tolerance = 1e-6;
  for (int minimiser = 0; minimiser < 3; ++minimiser) {
    o.minimiser = minimiser;
    const jam_status status = jam_relax(sys, &o, nullptr);
    if (status < 0) return status;
  }
  return JAM_OK;
}
jam_status modes(jam_system *sys) {
  static double table[2000];
  size_t rows = 0;
  auto o = defaults(jam_modes_options_init);
  for (const int32_t which : {JAM_MODES_LOWEST, JAM_MODES_HIGHEST, JAM_MODES_NEAR, JAM_MODES_ALL}) {
    o.which = which, o.count = 4, o.frequency = 0.5;
    const jam_status status = jam_modes(sys, nullptr, &o, JAM_MODE_COLUMNS, table, 2000, nullptr, 0, &rows);
    if (status < 0) return status;
  }
  return JAM_OK;
}

CASE(every_allocation) {
  jam_system *fluid = create(2, 12, 0.3, JAM_OVERLAP_REFUSE), *shifted = create(2, 8, 0.5, 0, JAM_MODEL_MK),
             *soft = create(2, 12, 0.95, JAM_OVERLAP_ALLOW), *jammed = copy_of(fluid),
             *spheres = create(3, 24, 0.3, JAM_OVERLAP_REFUSE);
  assert_int_equal(jam_crunch(jammed, nullptr, nullptr), JAM_OK);
  const Case cases[] = {{"run, observed", fluid, run},
                        {"run, Mari-Kurchan", shifted, run},
                        {"isoconfigurational", fluid, isoconfigurational},
                        {"crunch by LPs, with steps", spheres, crunch_by_lps},
                        {"relax", soft, relax},
                        {"modes", jammed, modes}};
  for (const Case &c : cases)
    for (const bool single : {false, true}) fail_each(c, single);
  for (jam_system *sys : {fluid, shifted, soft, jammed, spheres}) jam_destroy(sys);
}

// The table of calls, each on the system that it needs, but for what voro++ does: it loses memory of its own then.
CASE(every_allocation_of_every_call) {
  for (const call_start start : {NONE, ANY, SOFT, NETWORK, SHEARED, MINIMUM, OBSERVED, RUNS}) {
    jam_system *sys = system_for(start);
    assert_true(sys || start == NONE);
    for (const call_entry &entry : every_call)
      if (entry.start == start)
        for (const bool single : {false, true})
          fail_each({entry.name, sys, [&](jam_system *on) { return entry.call(nullptr, on); }, true}, single);
    jam_destroy(sys);
  }
  remove(call_file()), remove(call_image());
  glob_t left;  // a part of a file
  assert_int_equal(glob((std::string(call_file()) + "*").c_str(), 0, nullptr, &left), GLOB_NOMATCH);
}

}  // namespace
