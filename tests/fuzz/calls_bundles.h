/* Calls of the fuzz target `calls` that make sense in one order. Each damages the options of one verb. Single calls
 * come from tests/calls.def. */
#ifndef JAM_FUZZ_CALLS_BUNDLES_H
#define JAM_FUZZ_CALLS_BUNDLES_H
#include "input.h"

enum { many = 4096 };
static __thread double values[3][many];
static __thread int32_t integers[2][many];

static void call_network(input *in, jam_system *sys) {
  jam_geometry_options o;
  size_t needed;
  jam_geometry_options_init(&o, sizeof o);
  damage(in, &o, sizeof o);
  check_status(jam_contacts_from_geometry(sys, &o, NULL));
  check_status(jam_contacts(sys, integers[0], many, &needed));
  check_status(jam_forces(sys, values[0], many, &needed));
  check_status(jam_stress_states(sys, values[0], many, values[1], many, values[2], &needed));
}

static void call_rigidity(input *in, jam_system *sys) {
  const int32_t kind = byte(in) % 3;
  size_t needed;
  check_status(jam_rigidity(sys, kind, NULL));
  check_status(jam_flex(sys, kind, values[0], many, values[1], 64, &needed));
  jam_check_report check = {.struct_size = sizeof check};
  jam_check_options o;
  jam_check_options_init(&o, sizeof o);
  damage(in, &o, sizeof o);
  o.wall_time = at_most(o.wall_time, 0.1);
  check_status(jam_check_packing(sys, &o, &check));
  jam_check_text(&check);
  check_status(jam_prove(sys, kind, NULL, 0, NULL));
  check_status(jam_refined_positions(sys, NULL, 0, values[0], many, values[1], many, &needed));
}

static void call_modes(input *in, jam_system *sys) {
  jam_hessian_options h;
  jam_modes_options o;
  jam_moduli_report moduli;
  size_t rows;
  jam_hessian_options_init(&h, sizeof h);
  jam_modes_options_init(&o, sizeof o);
  h.stiffness = byte(in) % 4, o.which = byte(in) % 4;
  damage(in, &h, sizeof h);
  damage(in, &o, sizeof o);
  o.memory_limit = at_most(o.memory_limit, 1e8);
  check_status(jam_modes(sys, &h, &o, JAM_MODE_COLUMNS, values[0], many, values[1], many, &rows));
  check_status(jam_hessian(sys, &h, NULL, 0, NULL, 0, NULL, 0, &rows));
  memset(&moduli, 0, sizeof moduli);
  moduli.struct_size = sizeof moduli;
  check_status(jam_moduli(sys, &h, &moduli));
}

static void call_spectrum(input *in, jam_system *sys) {
  jam_dos_options o;
  size_t needed;
  jam_dos_options_init(&o, sizeof o);
  o.moments = 16, o.vectors = 2, o.points = 10;
  damage(in, &o, sizeof o);
  check_status(jam_density_of_states(sys, NULL, &o, JAM_DOS_COLUMNS, values[0], many, &needed));
}

/* A copy is as good as the packing, and the two compare. */
static void call_compared(input *in, jam_system *sys) {
  jam_system *copy = NULL;
  jam_comparison_report c;
  size_t needed;
  (void)in;
  check_status(jam_copy(sys, &copy));
  if (!copy) return;
  check_state(copy);
  memset(&c, 0, sizeof c);
  c.struct_size = sizeof c;
  check_status(jam_compare(sys, copy, &c, values[0], many, &needed));
  jam_destroy(copy);
}

static void call_run(input *in, jam_system *sys) {
  jam_run_options o;
  jam_run_options_init(&o, sizeof o);
  o.collisions_per_particle = 5.0, o.wall_time = 0.02, o.resume = byte(in) % 4 == 0;
  damage(in, &o, sizeof o);
  check_status(jam_run(sys, &o, NULL));
}

static void call_compress(input *in, jam_system *sys) {
  jam_compress_options o;
  jam_compress_options_init(&o, sizeof o);
  o.wall_time = 0.02, o.resume = byte(in) % 4 == 0;
  damage(in, &o, sizeof o);
  check_status(jam_compress(sys, &o, NULL));
}

static void call_crunch(input *in, jam_system *sys) {
  jam_crunch_options o;
  jam_estimate_report e;
  jam_crunch_options_init(&o, sizeof o);
  o.strain = byte(in) % 8 == 0 ? JAM_STRAIN_FREE : JAM_STRAIN_NONE;
  damage(in, &o, sizeof o);
  memset(&e, 0, sizeof e);
  e.struct_size = sizeof e;
  if (byte(in) % 4 == 0) check_status(jam_estimate_crunch(sys, &o, &e));
  check_status(jam_crunch(sys, &o, NULL));
}

static void call_monte_carlo(input *in, jam_system *sys) {
  jam_monte_carlo_options o;
  jam_monte_carlo_options_init(&o, sizeof o);
  o.sweeps = 5, o.wall_time = 0.02, o.resume = byte(in) % 4 == 0;
  if (byte(in) % 2) o.alpha = 2.0, o.temperature = 1e-3;
  damage(in, &o, sizeof o);
  check_status(jam_monte_carlo(sys, &o, NULL));
}

static void call_isoconfigurational(input *in, jam_system *sys) {
  const int32_t kept = byte(in) % 4;
  jam_isoconf_options o;
  jam_monte_carlo_options m;
  jam_isoconf_report report;
  double instant[3] = {0.5, 1.0, 2.0}, value[3];
  size_t needed;
  jam_isoconf_options_init(&o, sizeof o);
  jam_monte_carlo_options_init(&m, sizeof m);
  o.runs = 3, o.block = 2, o.resume = byte(in) % 4 == 0, o.density_ratio = byte(in) % 2 ? 1.0 : 0.9;
  m.step = 0.05;
  damage(in, &o, sizeof o);
  damage(in, &m, sizeof m);
  if (byte(in) % 8 == 0) instant[byte(in) % 3] = number(in);
  o.memory_limit = at_most(o.memory_limit, 1e8);
  check_status(jam_isoconf(sys, &o, byte(in) % 2 ? &m : NULL, instant, 3, &kept, 1, NULL));
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  check_status(jam_get_isoconf_report(sys, &report));
  check_status(jam_isoconf_series(sys, byte(in) % 4 - 1, JAM_ISOCONF_COLUMNS, value, 3, &needed));
  check_status(jam_isoconf_kept(sys, kept, NULL, 0, &needed));
}

static void call_relax(input *in, jam_system *sys) {
  jam_relax_options o;
  jam_relax_options_init(&o, sizeof o);
  o.minimiser = byte(in) % 3;
  damage(in, &o, sizeof o);
  check_status(jam_relax(sys, &o, NULL));
}

static void call_decompress(input *in, jam_system *sys) {
  jam_decompress_options o;
  jam_decompress_options_init(&o, sizeof o);
  o.crunch = byte(in) % 2;
  damage(in, &o, sizeof o);
  check_status(jam_decompress(sys, &o, NULL));
}

static void call_observe(input *in, jam_system *sys) {
  jam_observe_options o;
  size_t rows;
  jam_observe_options_init(&o, sizeof o);
  o.collisions = 1, o.gap_bins = byte(in) % 16, o.r_bins = byte(in) % 16, o.sample_every = 1.0;
  damage(in, &o, sizeof o);
  check_status(jam_observe(sys, &o));
  call_run(in, sys);
  check_status(jam_observed_series(sys, JAM_SERIES_COLUMNS, NULL, 0, &rows));
  check_status(jam_observed_pairs(sys, NULL, 0, NULL, 0, NULL, 0, NULL, &rows));
  check_status(jam_observed_gaps(sys, JAM_GAP_COLUMNS, NULL, 0, &rows));
  if (byte(in) % 2) check_status(jam_stop_observing(sys));
}

static void call_cell(input *in, jam_system *sys) {
  double a[64];
  const int dim = 2 + byte(in) % 7, strain = byte(in) % 2;
  int k;
  for (k = 0; k < 64; ++k) a[k] = byte(in) % 32 == 0 ? number(in) : (byte(in) - 128) / 256.0;
  if (strain) {
    for (k = 0; k < 64; ++k) a[k] *= 0.05;
    check_status(jam_strain(sys, a, (size_t)(dim * dim)));
    return;
  }
  for (k = 0; k < dim; ++k) a[k * (dim + 1)] = 1.0 + byte(in) / 64.0;
  check_status(jam_set_cell(sys, a, (size_t)(dim * dim), NULL, 0, NULL, 0, NULL));
}
#endif
