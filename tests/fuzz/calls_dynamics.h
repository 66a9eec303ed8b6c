/* Calls of the fuzz target `calls` that move spheres. Each damages the options of one verb. */
#ifndef JAM_FUZZ_CALLS_DYNAMICS_H
#define JAM_FUZZ_CALLS_DYNAMICS_H
#include "input.h"

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
  jam_estimate e;
  jam_crunch_options_init(&o, sizeof o);
  o.strain = byte(in) % 8 == 0 ? JAM_STRAIN_FREE : JAM_STRAIN_NONE;
  damage(in, &o, sizeof o);
  memset(&e, 0, sizeof e);
  e.struct_size = sizeof e;
  if (byte(in) % 4 == 0) check_status(jam_crunch_estimate(sys, &o, &e));
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
  check_status(jam_isoconfigurational(sys, &o, byte(in) % 2 ? &m : NULL, instant, 3, &kept, 1, NULL));
  memset(&report, 0, sizeof report);
  report.struct_size = sizeof report;
  check_status(jam_isoconf_report_get(sys, &report));
  check_status(jam_isoconf_series(sys, byte(in) % 4 - 1, byte(in) % 16, value, 3, &needed));
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
  check_status(jam_observed_series(sys, NULL, 0, &rows));
  check_status(jam_observed_pairs(sys, NULL, 0, NULL, 0, NULL, 0, NULL, &rows));
  check_status(jam_observed_gaps(sys, NULL, 0, NULL, 0, NULL, 0, &rows));
  if (byte(in) % 2) check_status(jam_observe_stop(sys));
}

static void call_set_positions(input *in, jam_system *sys) {
  double x[48];
  const double *view;
  size_t len, k;
  jam_positions_view(sys, &view, &len);
  for (k = 0; k < len && k < 48; ++k) x[k] = byte(in) / 16.0;
  if (byte(in) % 16 == 0) x[0] = number(in);
  check_status(jam_set_positions(sys, x, len < 48 ? len : 48));
}

static void call_set_velocities(input *in, jam_system *sys) {
  double v[48];
  const double *view;
  size_t len, k;
  jam_velocities_view(sys, &view, &len);
  for (k = 0; k < len && k < 48; ++k) v[k] = byte(in) % 16 == 0 ? number(in) : byte(in) / 64.0 - 2.0;
  check_status(jam_set_velocities(sys, v, len < 48 ? len : 48));
}

static void call_scale(input *in, jam_system *sys) { check_status(jam_scale_diameters(sys, number(in))); }

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
  check_status(jam_cell_set(sys, a, (size_t)(dim * dim), NULL, 0, NULL, 0, NULL));
}
#endif
