/* Options out of range: the call that takes them refuses each by its name, and moves nothing. */
#include <math.h>

#include "steps.h"

static jam_system *fluid, *before, *soft, *jammed;
static double out[2000];
static size_t needed;
static const double one = 1.0;

static jam_status call_create(const jam_create_options *o) {
  jam_system *made = NULL;
  const jam_status status = jam_create(o, NULL, &made);
  assert_null(made);
  return status;
}
static jam_status call_run(const jam_run_options *o) { return jam_run(fluid, o, NULL); }
static jam_status call_compress(const jam_compress_options *o) { return jam_compress(fluid, o, NULL); }
static jam_status call_observe(const jam_observe_options *o) { return jam_observe(fluid, o); }
static jam_status call_monte_carlo(const jam_monte_carlo_options *o) { return jam_monte_carlo(soft, o, NULL); }
static jam_status call_isoconf(const jam_isoconf_options *o) {
  return jam_isoconf(fluid, o, NULL, &one, 1, NULL, 0, NULL);
}
static jam_status call_crunch(const jam_crunch_options *o) { /* its estimate refuses the same */
  SIZED(jam_estimate_report, e);
  const jam_status status = jam_estimate_crunch(fluid, o, &e);
  assert_int_equal(jam_crunch(fluid, o, NULL), status);
  return status;
}
static jam_status call_radii(const jam_radii_options *o) { return jam_maximise_radii(fluid, o, NULL, 0, NULL); }
static jam_status call_relax(const jam_relax_options *o) { return jam_relax(soft, o, NULL); }
static jam_status call_decompress(const jam_decompress_options *o) { return jam_decompress(soft, o, NULL); }
static jam_status call_shear(const jam_shear_options *o) { return jam_shear(soft, o, &one, 1, NULL, 0, NULL); }
static jam_status call_check(const jam_check_options *o) { return jam_check_packing(fluid, o, NULL); }
static jam_status call_geometry(const jam_geometry_options *o) { return jam_contacts_from_geometry(fluid, o, NULL); }
/* Calls that are asked for the size alone refuse the same. */
static jam_status call_correlation(const jam_correlation_options *o) {
  const jam_status status = jam_pair_correlation(fluid, o, NULL, 0, NULL, 0, &needed);
  assert_int_equal(jam_pair_correlation(fluid, o, NULL, 0, out, 2000, &needed), status);
  return status;
}
static jam_status call_hessian(const jam_hessian_options *o) {
  return jam_hessian(jammed, o, NULL, 0, NULL, 0, NULL, 0, &needed);
}
static jam_status call_modes(const jam_modes_options *o) {
  const jam_status status = jam_modes(jammed, NULL, o, JAM_MODE_COLUMNS, NULL, 0, NULL, 0, &needed);
  assert_int_equal(jam_modes(jammed, NULL, o, JAM_MODE_COLUMNS, out, 2000, NULL, 0, &needed), status);
  return status;
}
static jam_status call_dos(const jam_dos_options *o) {
  const jam_status status = jam_density_of_states(jammed, NULL, o, JAM_DOS_COLUMNS, NULL, 0, &needed);
  assert_int_equal(jam_density_of_states(jammed, NULL, o, JAM_DOS_COLUMNS, out, 2000, &needed), status);
  return status;
}
static jam_status call_diameters(const jam_diameters_options *o) {
  const jam_status status = jam_diameters(o, NULL, 0, NULL, 0, &needed);
  assert_int_equal(jam_diameters(o, NULL, 0, out, 2000, &needed), status);
  return status;
}

static int start(void **state) {
  (void)state;
  fluid = random_spheres(2, 32, 0.3, 1);
  before = copy_of(fluid);
  soft = soft_start(40, 1.0, 1);
  jammed = random_spheres(3, 40, 0.0, 1);
  assert_int_equal(jam_crunch(jammed, NULL, NULL), JAM_OK);
  return 0;
}
static int end(void **state) {
  (void)state;
  jam_destroy(fluid), jam_destroy(before), jam_destroy(soft), jam_destroy(jammed);
  return 0;
}

/* Each of the numbers that follow is refused as this member, with the others that `set` sets, by these words. */
#define REFUSED_SAYING(words, set, kind, member, ...)       \
  do {                                                      \
    const double bad[] = {__VA_ARGS__};                     \
    for (size_t k = 0; k < sizeof bad / sizeof *bad; ++k) { \
      DEFAULTS(kind, o);                                    \
      set;                                                  \
      o.member = (__typeof__(o.member))bad[k];              \
      SAYS(call_##kind(&o), JAM_E_ARGUMENT, words);         \
    }                                                       \
  } while (0)
#define REFUSED_WITH(set, kind, member, ...) REFUSED_SAYING(#member, set, kind, member, __VA_ARGS__)
#define REFUSED(...) REFUSED_WITH((void)o, __VA_ARGS__)

CASE(sizes_of_options_are_checked) {
#define SIZES(kind)                                                                       \
  do {                                                                                    \
    DEFAULTS(kind, o);                                                                    \
    assert_int_equal(jam_##kind##_options_init(NULL, sizeof o), JAM_E_NULL);              \
    assert_int_equal(jam_##kind##_options_init(&o, 2), JAM_E_STRUCT_SIZE);                \
    assert_int_equal(jam_##kind##_options_init(&o, sizeof o + 520), JAM_E_STRUCT_SIZE);   \
    SAYS(jam_##kind##_options_init(&o, sizeof o + 1), JAM_E_STRUCT_SIZE, "cuts a field"); \
    o.struct_size = 4000;                                                                 \
    SAYS(call_##kind(&o), JAM_E_STRUCT_SIZE, "struct_size is 4000");                      \
    o.struct_size = 0;                                                                    \
    SAYS(call_##kind(&o), JAM_E_STRUCT_SIZE, "struct_size is 0");                         \
  } while (0)
  SIZES(create);
  SIZES(run);
  SIZES(compress);
  SIZES(observe);
  SIZES(monte_carlo);
  SIZES(isoconf);
  SIZES(crunch);
  SIZES(radii);
  SIZES(relax);
  SIZES(decompress);
  SIZES(shear);
  SIZES(check);
  SIZES(geometry);
  SIZES(correlation);
  SIZES(hessian);
  SIZES(modes);
  SIZES(dos);
  SIZES(diameters);
}

CASE(sizes_of_reports_are_checked) {
#define REPORTS(type, call)                    \
  do {                                         \
    type r = {.struct_size = 3};               \
    assert_int_equal(call, JAM_E_STRUCT_SIZE); \
    r.struct_size = 0;                         \
    assert_int_equal(call, JAM_E_STRUCT_SIZE); \
  } while (0)
  REPORTS(jam_md_report, jam_run(fluid, NULL, &r));
  REPORTS(jam_md_report, jam_compress(fluid, NULL, &r));
  REPORTS(jam_estimate_report, jam_estimate_crunch(fluid, NULL, &r));
  REPORTS(jam_check_report, jam_check_packing(fluid, NULL, &r));
  REPORTS(jam_rigidity_report, jam_rigidity(fluid, JAM_RIGIDITY_COLLECTIVE, &r));
  REPORTS(jam_proof_report, jam_prove(jammed, JAM_RIGIDITY_COLLECTIVE, NULL, 0, &r));
}

CASE(making) {
#define SPHERES o.n = 10
  REFUSED(create, n, 0, -5, 2147483648.0);
  REFUSED_WITH(SPHERES, create, box, 0, INFINITY);
  REFUSED_WITH(SPHERES, create, packing_fraction, -0.1, NAN);
  REFUSED_WITH(SPHERES, create, non_additivity, -1, -3, 1.5, NAN, INFINITY);
  REFUSED_WITH(SPHERES, create, overlap, 7);
  REFUSED_WITH(SPHERES, create, model, 5);
  REFUSED_WITH((SPHERES, o.model = JAM_MODEL_MK), create, mk_zeta, -1.0, 1.1e15, NAN);
  REFUSED_WITH(SPHERES, create, container, 4, 7, -1);
  REFUSED_SAYING("a cone has flat walls on axis z", SPHERES, create, container, JAM_CONTAINER_CONE);
  REFUSED_WITH(SPHERES, create, walls, 8, -1);
  REFUSED_WITH(SPHERES, create, wall_time, 0);
  REFUSED_WITH(SPHERES, create, memory_limit, -1);
  REFUSED_WITH((o.n = 20, o.law = JAM_SIZES_POWER, o.low = 1.0, o.high = 2.0), diameters, exponent, 1e4);
  REFUSED_WITH((o.n = 20, o.law = JAM_SIZES_POWER, o.exponent = 2.0, o.high = 2.0), diameters, low, 1e-60);
}

CASE(dynamics) {
  REFUSED(run, collisions_per_particle, 0, -1, NAN, INFINITY); /* the last would never end */
  REFUSED(run, wall_time, 0, -1, NAN);
  REFUSED(run, resume, 2);
  REFUSED(compress, growth_rate, 1e-16, 1e4, -1, NAN, INFINITY); /* 0 is the protocol; 1e-16 had no end */
  REFUSED(compress, growth_rate_end, 1e-3);
  REFUSED_WITH(o.growth_rate = 1e-2, compress, growth_rate_end, 2e-2, 1e-300, -1, NAN);
  REFUSED_WITH((o.growth_rate = 1e-2, o.pressure = INFINITY), compress, growth_rate_end, 1e-3);
  REFUSED(compress, growth_law, 7);
  REFUSED(compress, pressure, 0, -1, NAN);
  REFUSED(compress, packing_fraction, 0, -1, NAN);
  REFUSED(observe, collisions, 2);
  REFUSED(observe, gap_bins, 1);
  REFUSED(observe, r_bins, -1);
  REFUSED(observe, sample_every, 0);
  REFUSED(observe, gap_min, 0, 1e-320, 11);
  REFUSED(observe, gap_max, NAN, 11, 1e-9);
  REFUSED(observe, r_max, -1, 1e-320, 1e4);
  REFUSED(observe, snapshot_every, -1);
  REFUSED(observe, snapshot_factor, 0.5);
  REFUSED(isoconf, temperature, 0, -1, INFINITY, 1e-40);
  REFUSED(isoconf, density_ratio, 0, 1.5, 1e-20);
  REFUSED(isoconf, runs, 0, 9.2e18);
  REFUSED_SAYING("numbers go from 0", (void)o, isoconf, first_run, -1, 9.2e18); /* its last run has no number */
  REFUSED(isoconf, block, 0);
  REFUSED(isoconf, threads, 0, 65);
  REFUSED(isoconf, clock, 7);
  REFUSED(isoconf, wave_number, 0, 1e17);
  REFUSED(isoconf, wall_time, NAN);
}

CASE(monte_carlo) {
  REFUSED_WITH((o.alpha = 2.5, o.energy_scale = 1024.0), monte_carlo, temperature, 1e-310);
  REFUSED_WITH((o.alpha = 2.5, o.energy_scale = 1e60), monte_carlo, temperature, 1e-60);
  REFUSED_WITH(o.alpha = 2.5, monte_carlo, energy_scale, 1e300);
  REFUSED_WITH(o.alpha = 300.0, monte_carlo, energy_scale, 1.0); /* 0.17^300 */
  REFUSED(monte_carlo, alpha, 1e300, 1, -2);
#define SOFTLY (o.alpha = 2.0, o.step = 0.01)
  REFUSED_WITH(SOFTLY, monte_carlo, step, 1e-20, -1, 3);
  REFUSED_WITH(SOFTLY, monte_carlo, temperature, 0, -1);
  REFUSED_WITH(SOFTLY, monte_carlo, energy_scale, 0);
  REFUSED_WITH(SOFTLY, monte_carlo, energy_unit, 2);
  REFUSED_WITH(SOFTLY, monte_carlo, acceptance, 1);
  REFUSED_WITH(SOFTLY, monte_carlo, swap_share, 1);
  REFUSED_WITH(SOFTLY, monte_carlo, sweeps, 0);
  REFUSED_WITH(SOFTLY, monte_carlo, run, -1);
  /* the last sweep has no number */
  REFUSED_SAYING("numbers go from 0", (SOFTLY, o.sweeps = 2000), monte_carlo, first_sweep, -2, 0x1p63 - 1024);
  REFUSED_WITH(SOFTLY, monte_carlo, wall_time, 0);
}

CASE(jamming) {
  REFUSED(crunch, duality_gap, -1e-8, 1e-13, 0.1, NAN, INFINITY);
  REFUSED_WITH(o.method = JAM_CRUNCH_SEQUENTIAL_LP, crunch, duality_gap, 1e-6);
  REFUSED_WITH(o.strain = JAM_STRAIN_FREE, crunch, duality_gap, 1e-6);
  REFUSED(crunch, keep_steps, -1, 1001);
  REFUSED(crunch, steps, 2);
  REFUSED(crunch, max_lps, 0, -1);
  REFUSED(crunch, lp_solver, 9);
  REFUSED(crunch, gain_tolerance, NAN);
  REFUSED(crunch, step_bound, -1, 1e-16, 1001, NAN);
  REFUSED_SAYING("gain_tolerance", o.gain_tolerance = 1e-6, crunch, step_bound, 1e-15, 9e-7); /* no LP gains enough */
  REFUSED(crunch, prove, 2);
  REFUSED(radii, moments, -1, 5);
  REFUSED_WITH(o.moments = 2, radii, exponent_2, 1.0);
  REFUSED(radii, strain, JAM_STRAIN_ALL);
  REFUSED(radii, radius_min, 1e300); /* once a search for pairs without an end */
  REFUSED(radii, radius_max, 1e-300);
  REFUSED(check, crunch, 2);
  REFUSED(check, wall_time, 0);
}

CASE(soft_spheres) {
#define SOFT(member, ...)              \
  REFUSED(relax, member, __VA_ARGS__); \
  REFUSED(decompress, member, __VA_ARGS__)
  SOFT(alpha, 1, NAN, INFINITY,
       20); /* of 20 squares of forces underflow, and forces balance, where overlaps are 1e-9 */
  SOFT(minimiser, 3);
  SOFT(scale, -1);
  SOFT(precision, 2);
  SOFT(force_tolerance, 0);
  SOFT(max_evaluations, 0);
  SOFT(wall_time, -1);
  REFUSED_WITH(o.strain = JAM_STRAIN_VOLUME, relax, pressure, 1e300, 0, -0.1, NAN);
  REFUSED_WITH(o.strain = JAM_STRAIN_FREE, relax, pressure, 0.1);
  REFUSED(relax, pressure, 0.1);
  REFUSED(relax, strain, 8);
  REFUSED_WITH(o.strain = JAM_STRAIN_TILTS, relax, components, 1); /* an edge */
  REFUSED(decompress, energy_factor, 0, 1);
  REFUSED(decompress, pressure, -1);
  REFUSED(decompress, distance, NAN);
  REFUSED(decompress, isostatic, 2);
  REFUSED(decompress, crunch, -1);
  REFUSED(decompress, max_steps, 0);
  REFUSED(decompress, reserved, 1);
  REFUSED(shear, resolution, 1e-300);            /* bisection had no end */
  REFUSED(shear, step, 1e-20, 0, NAN, INFINITY); /* of 1e-20 no sphere moved, without end */
}

CASE(analysis) {
  REFUSED(geometry, tolerance, -1, NAN);
  REFUSED(correlation, r_max, 1e9, 1e-320);
  REFUSED(correlation, bins, 0);
  REFUSED(hessian, stiffness, 7);
  REFUSED_WITH(o.stiffness = JAM_STIFFNESS_POWER, hessian, alpha, 1.0, 1.0 + 1e-8);
  REFUSED(hessian, prestress, NAN, 1.5);
  REFUSED(modes, which, 9);
  REFUSED(modes, count, 0);
  REFUSED(dos, moments, 2);
  REFUSED(dos, points, 0);
  REFUSED_WITH(o.high = 1, dos, low, 1, INFINITY);
}

CASE(nothing_has_moved) { same(fluid, before); }

FIXTURE(start, end)
