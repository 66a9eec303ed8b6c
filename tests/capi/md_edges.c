/* Growth and dynamics at the edges of what is supported: size ratio, masses, cells like rods, a sphere as wide as its
 * cell. Work is never lost at the end of a call. */
#include <math.h>
#include "steps.h"

static double volume_of_sphere(int d, double sigma) {
  return pow(M_PI, 0.5 * d) / tgamma(0.5 * d + 1.0) * pow(0.5 * sigma, d);
}

/* The largest ratio of diameters, 1e4, at every seed: rounding of the library's own takes it over no limit. */
CASE(the_largest_ratio_stays_supported) {
  double sizes[20];
  for (int k = 0; k < 20; ++k) sizes[k] = k < 4 ? 1e4 : 1.0;
  for (int64_t seed = 1; seed <= 20; ++seed) {
    DEFAULTS(create, o);
    DEFAULTS(compress, c);
    o.dim = 2, o.n = 20, o.seed = seed, o.packing_fraction = 0.1;
    OWNED jam_system *sys = created_from(&o, NULL, 0, sizes, 20);
    c.growth_rate = 1.0, c.packing_fraction = 0.11, c.collisions_per_particle = 20.0;
    assert_true(jam_compress(sys, &c, NULL) >= 0);
    for (int k = 0; k < 20; ++k) assert_int_equal(jam_scale_diameters(sys, 0.99), JAM_OK);
  }
}

/* Masses as volumes: light spheres are as fast as kT says, and the energy stays. */
CASE(light_spheres_may_be_fast) {
  const struct {
    int32_t dim;
    double ratio, fraction;
  } cases[] = {{2, 1e4, 0.05}, {3, 9e3, 0.05}, {4, 1e3, 0.02}, {5, 300.0, 0.005}, {8, 30.0, 1e-4}};
  for (size_t q = 0; q < sizeof cases / sizeof *cases; ++q) {
    double sizes[20], kinetic = 0.0, mean = 0.0;
    const double *v = NULL;
    size_t len = 0;
    const size_t d = (size_t)cases[q].dim;
    DEFAULTS(create, o);
    DEFAULTS(run, r);
    SIZED(jam_md_report, report);
    for (size_t k = 0; k < 20; ++k) sizes[k] = k < 4 ? cases[q].ratio : 1.0;
    o.dim = cases[q].dim, o.n = 20, o.packing_fraction = cases[q].fraction, o.masses = JAM_MASSES_VOLUME;
    OWNED jam_system *sys = created_from(&o, NULL, 0, sizes, 20);
    r.collisions_per_particle = 1.0;
    if (jam_run(sys, &r, &report) != JAM_OK) fail_msg("d = %zu: %s", d, jam_last_error());
    assert_true(report.energy_drift < 1e-9);
    assert_int_equal(jam_view(sys, JAM_VIEW_VELOCITIES, &v, &len), JAM_OK);
    for (size_t k = 0; k < 20; ++k) mean += pow(sizes[k] / cases[q].ratio, (double)d) / 20.0;
    for (size_t k = 0; k < len; ++k) kinetic += pow(sizes[k / d] / cases[q].ratio, (double)d) / mean * v[k] * v[k];
    assert_true(fabs(kinetic / (20.0 * (double)d) - 1.0) < 1e-9);
    { /* what the library made may be given back, but not a hundred million times as fast */
      double w[20 * 8];
      memcpy(w, v, len * sizeof *w);
      assert_int_equal(jam_set_velocities(sys, w, len), JAM_OK);
      for (size_t k = 0; k < len; ++k) w[k] *= 1e8;
      SAYS(jam_set_velocities(sys, w, len), JAM_E_ARGUMENT, "sum m v^2");
    }
  }
}

/* Growth ends where a sphere touches its own image: a status, a sentence and the state. */
/* Growth needs motion of the spheres against each other: what all share is taken off, and rounding is no motion. */
CASE(a_common_motion_is_none) {
  static double v[150];
  for (int k = 0; k < 4; ++k) {
    const double noise = k ? pow(10.0, -3.0 * k) : 0.0;
    OWNED jam_system *sys = random_spheres(3, 50, 0.2, 1);
    for (int i = 0; i < 150; ++i) v[i] = 0.1 * (1.0 + i % 3) * (1.0 + noise * sin(1.7 * i));
    DEFAULTS(compress, c);
    SIZED(jam_md_report, report);
    c.growth_rate = 1e-2, c.pressure = 100.0, c.time = 1e3;
    assert_int_equal(jam_set_velocities(sys, v, 150), JAM_OK);
    assert_int_equal(jam_compress(sys, &c, &report), JAM_OK);
    assert_true(report.pressure > 100.0 && report.max_overlap < 1e-12);
  }
}

CASE(growth_ends_at_the_own_image) {
  int met = 0;
  for (int64_t seed = 0; seed < 60; ++seed) {
    const int d = 2 + (int)(seed % 5), n = 2 + (int)(seed % 3);
    const double h = pow(10.0, -0.2 - 0.03 * (double)(seed % 40));
    double cell[64] = {0};
    OWNED jam_system *sys = NULL;
    DEFAULTS(create, o);
    DEFAULTS(compress, g);
    SIZED(jam_md_report, r);
    for (int c = 0; c < d; ++c) cell[c * d + c] = c == d - 1 ? pow(h, 1.0 - d) : h;
    o.dim = d, o.n = n, o.seed = seed, o.packing_fraction = n * volume_of_sphere(d, 0.25 * h);
    jam_status status = create_in_cell(&o, cell, (size_t)d * (size_t)d, NULL, 0, NULL, 0, &sys);
    if (status != JAM_OK) { /* a rod too long for its spheres is refused before anything runs */
      SAYS(status, JAM_E_ARGUMENT, "longest edge");
      continue;
    }
    g.growth_rate = pow(10.0, -1.0 + (double)(seed % 4)), g.pressure = 1e5;
    status = jam_compress(sys, &g, &r);
    if (status < 0) fail_msg("d = %d, h = %g: %s", d, h, jam_last_error());
    const double *const sigma = view_of(sys, JAM_VIEW_DIAMETERS);
    assert_true(sigma[0] <= h * (1.0 + 1e-12));
    if (status == JAM_NOT_CONVERGED && sigma[0] > 0.999 * h) {
      ++met;
      assert_int_equal(r.stop_reason, JAM_STOP_STALLED);
      assert_non_null(strstr(jam_last_error(), "own image"));
      assert_int_equal(jam_compress(sys, &g, &r), JAM_NOT_CONVERGED); /* there from the beginning */
      assert_non_null(strstr(jam_last_error(), "sphere 0 touches its own image, nothing can grow here"));
    }
  }
  print_message("%d of 60 met their own images\n", met);
  assert_true(met > 10);
}

/* A crunch from there says the same; a free cell gives way. */
CASE(a_sphere_fills_the_cell) {
  for (int n = 2; n < 5; ++n) {
    double x[12] = {0, 0, 0, 0.5, 0.5, 0.5, 0.54, 0.54, 0.54, 0.46, 0.5, 0.54}, sizes[4] = {1.0, 0.01, 0.01, 0.01};
    DEFAULTS(create, o);
    DEFAULTS(crunch, c);
    SIZED(jam_crunch_report, r);
    OWNED jam_system *sys = created_from(&o, x, 3 * (size_t)n, sizes, (size_t)n);
    SAYS(jam_compress(sys, NULL, NULL), JAM_NOT_CONVERGED, "sphere 0 touches its own image, nothing can grow here");
    assert_int_equal(jam_crunch(sys, &c, &r), JAM_NOT_JAMMED);
    assert_int_equal(r.lp_solves, 0);
    assert_non_null(strstr(jam_last_error(), "sphere 0 touches its own image, nothing can grow here"));
    c.strain = JAM_STRAIN_FREE;
    assert_true(jam_crunch(sys, &c, &r) >= 0);
    assert_true(r.packing_fraction > 0.523); /* it can, and never loses density */
  }
}

/* A gas whose cell is 2e4 diameters wide: spheres that meet from across the cell touch to eps (L / sigma)^2 of a
 * contact distance. The next call must not take that for an error, nor a file of it. */
CASE(a_very_dilute_gas_runs_on) {
  for (int64_t seed = 1; seed <= 10; ++seed) {
    DEFAULTS(create, o);
    DEFAULTS(run, r);
    SIZED(jam_md_report, report);
    o.dim = 2, o.n = 5, o.seed = seed, o.packing_fraction = 5 * volume_of_sphere(2, 5e-5);
    OWNED jam_system *sys = created(&o), *again = NULL;
    r.collisions_per_particle = 20.0;
    for (int k = 0; k < 3; ++k) {
      if (jam_run(sys, &r, &report) != JAM_OK) fail_msg("seed %d: %s", (int)seed, jam_last_error());
      assert_true(report.max_overlap < 1e-8); /* 3e-9 were seen; eps (L / sigma)^2 is 9e-8 */
    }
    again = created_from(&o, view_of(sys, JAM_VIEW_POSITIONS), 10, view_of(sys, JAM_VIEW_DIAMETERS), 5);
  }
}
