// Out of memory at any allocation of any verb or analysis: JAM_E_MEMORY with a valid state, no leak, and a handle that
// works. Crunch, files and creation have tests of their own.
extern "C" {
#include <jam/jam.h>
#include <string.h>
#include <unistd.h>

#include "test.h"
}
#include <cmath>
#include <cstdio>
#include <functional>
#include <vector>

#include "failing_new.hpp"

namespace {

using Verb = std::function<jam_status(jam_system *)>;
struct Case {
  const char *name;
  const jam_system *start;
  Verb verb;
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
  assert_int_equal(jam_create(&o, nullptr, 0, diameter.data(), diameter.size(), &sys), JAM_OK);
  return sys;
}

void assert_valid(const jam_system *sys) {
  jam_info info;
  info.struct_size = sizeof info;
  assert_int_equal(jam_info_get(sys, &info), JAM_OK);
  const double *x = nullptr;
  size_t len = 0;
  jam_positions_view(sys, &x, &len);
  for (size_t k = 0; k < len; ++k) assert_true(x[k] >= 0.0 && x[k] < info.box);
  jam_diameters_view(sys, &x, &len);
  for (size_t k = 0; k < len; ++k) assert_true(x[k] > 0.0 && std::isfinite(x[k]));
}

jam_system *copy_of(const jam_system *start) {
  jam_system *sys = nullptr;
  assert_int_equal(jam_copy(start, &sys), JAM_OK);
  return sys;
}

#ifdef __SANITIZE_ADDRESS__  // ten times slower: the release build has tried the others
constexpr long dense = 100;
#else
constexpr long dense = 10000;
#endif

// The k-th allocation fails, alone or with all that follow, for every k of the first `dense` and then for some.
void fail_each(const Case &c, bool single) {
  jam_system *plain = copy_of(c.start);
  const jam_status usual = c.verb(plain);
  jam_destroy(plain);
  assert_true(usual >= 0);
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
    assert_int_equal(alive, clean);
    if (!hit) break;
  }
  print_message("%s: %ld allocations, %ld failures%s\n", c.name, k, failed, single ? ", one at a time" : "");
  assert_true(failed > 0);
}

// ---- the verbs, which allocate nothing themselves

jam_status first_error(std::initializer_list<jam_status> all) {
  for (const jam_status status : all)
    if (status < 0) return status;
  return JAM_OK;
}

jam_status run(jam_system *sys) {
  auto o = defaults(jam_run_options_init);
  auto seen = defaults(jam_observe_options_init);
  o.collisions_per_particle = 20.0, seen.collisions = 1, seen.gap_bins = seen.r_bins = 8, seen.sample_every = 2.0;
  const jam_status status = jam_observe(sys, &seen);
  return status < 0 ? status : jam_run(sys, &o, nullptr);
}
jam_status compress(jam_system *sys) {
  auto o = defaults(jam_compress_options_init);
  o.growth_rate = 0.1, o.pressure = 30.0;
  return jam_compress(sys, &o, nullptr);
}
jam_status monte_carlo(jam_system *sys) {
  auto o = defaults(jam_monte_carlo_options_init);
  o.sweeps = 50, o.alpha = 2.0, o.temperature = 1e-4;
  return jam_monte_carlo(sys, &o, nullptr);
}
jam_status isoconfigurational(jam_system *sys) {
  auto o = defaults(jam_isoconf_options_init);
  auto m = defaults(jam_monte_carlo_options_init);
  o.runs = 4, o.block = 2, m.step = 0.1;
  const double instant[] = {1.0, 3.0};
  const int32_t kept = 1;
  const jam_status status = jam_isoconfigurational(sys, &o, nullptr, instant, 2, &kept, 1, nullptr);
  return status < 0 ? status : jam_isoconfigurational(sys, &o, &m, instant, 2, &kept, 1, nullptr);
}
jam_status checkpoint(jam_system *sys) {
  auto o = defaults(jam_run_options_init);
  o.collisions_per_particle = 1e9, o.wall_time = 1e-4;
  const jam_status status = jam_run(sys, &o, nullptr);  // is left, so that a stage is saved
  if (status < 0) return status;
  char path[256];
  const char *folder = getenv("TMPDIR");
  snprintf(path, sizeof path, "%s/jam-verbs-memory-%ld.jam", folder ? folder : "/tmp", static_cast<long>(getpid()));
  const jam_status written = jam_checkpoint_write(sys, path);
  if (written < 0) return written;
  jam_system *back = nullptr;
  const jam_status read = jam_checkpoint_read(path, &back);
  assert_true((read == JAM_OK) == (back != nullptr));
  jam_destroy(back);
  remove(path);
  return read < 0 ? read : JAM_OK;
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
jam_status decompress(jam_system *sys) {
  auto o = defaults(jam_decompress_options_init);
  o.energy_factor = 1e-3, o.force_tolerance = 1e-8;
  const jam_status status = jam_decompress(sys, &o, nullptr);
  return status < 0 ? status : JAM_OK;
}
jam_status cell(jam_system *sys) {
  const double same[] = {1.0, 0.0, 7.0, 1.0};  // reduced to the square
  return jam_cell_set(sys, same, 4, nullptr, 0, nullptr, 0, nullptr);
}
jam_status strain(jam_system *sys) {
  const double wider[] = {0.3, 0.1, 0.0, 0.3};
  return jam_strain(sys, wider, 4);
}
jam_status network(jam_system *sys) {
  const jam_status status = jam_contacts_from_geometry(sys, nullptr, nullptr);
  if (status < 0) return status;
  size_t rows = 0;
  const jam_status stress = jam_stress_states(sys, nullptr, 0, nullptr, 0, nullptr, &rows);
  return stress < 0 ? stress : JAM_OK;
}
jam_status rigidity(jam_system *sys) {
  for (const int32_t kind : {JAM_RIGIDITY_COLLECTIVE, JAM_RIGIDITY_STRICT}) {
    const jam_status status = jam_rigidity(sys, kind, nullptr);
    if (status < 0) return status;
  }
  return JAM_OK;
}
jam_status proof(jam_system *sys) {
  static double high[24], low[24];
  size_t needed = 0;
  const jam_status status = jam_prove(sys, nullptr, 0, nullptr);
  return status < 0 ? status : jam_refined_positions(sys, nullptr, 0, high, 24, low, 24, &needed);
}
jam_status modes(jam_system *sys) {
  static double lambda[1000];
  size_t rows = 0;
  auto o = defaults(jam_modes_options_init);
  for (const int32_t which : {JAM_MODES_LOWEST, JAM_MODES_HIGHEST, JAM_MODES_NEAR, JAM_MODES_ALL}) {
    o.which = which, o.count = 4, o.frequency = 0.5;
    const jam_status status = jam_modes(sys, nullptr, &o, lambda, 1000, nullptr, 0, nullptr, 0, &rows);
    if (status < 0) return status;
  }
  return JAM_OK;
}
jam_status spectrum(jam_system *sys) {
  static double table[6 * 200];
  auto o = defaults(jam_dos_options_init);
  o.moments = 16, o.vectors = 2;
  size_t rows = 0;
  const jam_status status = jam_density_of_states(sys, nullptr, &o, table, 6 * 200, &rows);
  if (status < 0) return status;
  jam_moduli moduli;
  moduli.struct_size = sizeof moduli;
  const jam_status elastic = jam_moduli_get(sys, nullptr, &moduli);
  return elastic < 0 ? elastic : JAM_OK;
}
jam_status floppy(jam_system *sys) {
  size_t needed = 0;
  static double table[5 * 400];
  const jam_status status = jam_floppy_modes(sys, table, 5 * 400, &needed);
  return status < 0 && status != JAM_E_STATE ? status : JAM_OK;
}
jam_status structure(jam_system *sys) {
  static double out[4000], more[4000];
  static int32_t pair[8000];
  size_t rows = 0;
  double score = 0.0;
  return first_error({
      jam_gaps(sys, 0.5, 0, out, 4000, pair, 8000, &rows),
      jam_pair_correlation(sys, nullptr, 0, -1, -1, 2.0, 20, out, 4000, &rows),
      jam_structure_factor(sys, 10.0, out, 4000, more, 4000, &rows),
      jam_bond_order(sys, 6, 1.2, out, 4000, &rows),
      jam_crystal_score(sys, &score),
      jam_contact_classes(sys, pair, 8000, &rows),
      jam_sphere_structure(sys, 1, out, 4000, more, 4000, &rows),
      jam_contact_dots(sys, 1, out, 4000, pair, 8000, &rows),
      jam_histogram(sys, JAM_QUANTITY_FORCE, JAM_CLASS_ALL, 0.0, 4.0, 20, out, 4000, &rows),
      jam_hessian(sys, nullptr, pair, 4000, pair + 4000, 4000, out, 4000, &rows),
      jam_compare(sys, sys, nullptr, out, 4000, &rows),
  });
}

void every_allocation(void **) {
  jam_system *fluid = create(2, 12, 0.3, JAM_OVERLAP_REFUSE), *shifted = create(2, 8, 0.5, 0, JAM_MODEL_MK),
             *soft = create(2, 12, 0.95, JAM_OVERLAP_ALLOW), *jammed = copy_of(fluid);
  assert_int_equal(jam_crunch(jammed, nullptr, nullptr), JAM_OK);
  const Case cases[] = {{"run", fluid, run},
                        {"run, Mari-Kurchan", shifted, run},
                        {"compress", fluid, compress},
                        {"monte_carlo", soft, monte_carlo},
                        {"isoconfigurational", fluid, isoconfigurational},
                        {"checkpoint", fluid, checkpoint},
                        {"relax", soft, relax},
                        {"decompress", soft, decompress},
                        {"cell", fluid, cell},
                        {"strain", fluid, strain},
                        {"network", jammed, network},
                        {"rigidity", jammed, rigidity},
                        {"proof", jammed, proof},
                        {"modes", jammed, modes},
                        {"spectrum", jammed, spectrum},
                        {"floppy", jammed, floppy},
                        {"structure", jammed, structure}};
  for (const Case &c : cases)
    for (const bool single : {false, true}) fail_each(c, single);
  for (jam_system *sys : {fluid, shifted, soft, jammed}) jam_destroy(sys);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(every_allocation)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
