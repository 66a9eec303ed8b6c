/* Runs from one configuration: the same bits however they are split, stopped or resumed; clear errors; nothing lost. */
#include <math.h>

#include "steps.h"

enum { N = 60, D = 3, M = 3, RUNS = 12, BLOCK = 4 };
static const double instants[M] = {1.0, 3.0, 9.0};

static jam_system *packing(void) {
  jam_system *sys = random_spheres(D, N, 0.0, 1);
  DEFAULTS(compress, c);
  c.packing_fraction = 0.5;
  assert_int_equal(jam_compress(sys, &c, NULL), JAM_OK);
  return sys;
}

static jam_isoconf_options options(void) {
  DEFAULTS(isoconf, o);
  o.runs = RUNS;
  o.block = BLOCK;
  o.density_ratio = 0.95;
  return o;
}

static jam_status runs_of(jam_system *sys, const jam_isoconf_options *o, jam_isoconf_report *r) {
  if (r) r->struct_size = sizeof *r;
  return jam_isoconf(sys, o, NULL, instants, M, NULL, 0, r);
}

typedef struct sums {
  double displacement[M * N * D], square[M * N * D], distance2[M * N], distance4[M * N];
  int64_t runs;
} sums;

enum { COLUMNS = JAM_ISOCONF_RUNS + 1 };

static void get(const jam_system *sys, int64_t block, sums *s) {
  double table[M * COLUMNS];
  memset(s, 0, sizeof *s);
  assert_int_equal(jam_isoconf_displacements(sys, block, s->displacement, M * N * D, s->square, M * N * D, NULL),
                   JAM_OK);
  assert_int_equal(jam_isoconf_distances(sys, block, s->distance2, M * N, s->distance4, M * N, NULL), JAM_OK);
  assert_int_equal(jam_isoconf_series(sys, block, JAM_ISOCONF_COLUMNS, table, M * COLUMNS, NULL), JAM_OK);
  s->runs = (int64_t)table[JAM_ISOCONF_RUNS];
}

static void same_sums(const jam_system *sys, int64_t block, const sums *expected) {
  static sums s;
  get(sys, block, &s);
  assert_memory_equal(&s, expected, sizeof s);
}

CASE(bits_do_not_depend_on_threads_or_handles) {
  enum { MANY = 4000 }; /* so many that threads overtake each other */
  OWNED jam_system *one = packing(), *two = packing();
  jam_isoconf_options o = options();
  static sums a, b;
  o.runs = o.block = MANY;
  assert_int_equal(runs_of(one, &o, NULL), JAM_OK);
  o.threads = 2;
  assert_int_equal(runs_of(two, &o, NULL), JAM_OK);
  get(one, -1, &a);
  assert_int_equal(a.runs, MANY);
  same_sums(two, -1, &a);
  o = options();
  assert_int_equal(runs_of(one, &o, NULL), JAM_OK);
  /* Each block alone, by another handle. */
  for (int64_t k = 0; k < RUNS / BLOCK; ++k) {
    o.threads = 1;
    o.first_run = k * BLOCK;
    o.runs = BLOCK;
    assert_int_equal(runs_of(two, &o, NULL), JAM_OK);
    get(one, k, &a);
    same_sums(two, 0, &a);
  }
  /* One run alone: what distinguishes the blocks of one run from each other. */
  o.first_run = 5;
  o.runs = o.block = 1;
  assert_int_equal(runs_of(two, &o, NULL), JAM_OK);
  get(two, -1, &a);
  o.first_run = 6;
  assert_int_equal(runs_of(two, &o, NULL), JAM_OK);
  get(two, -1, &b);
  assert_memory_not_equal(a.displacement, b.displacement, sizeof a.displacement);
}

static int32_t stop(const jam_progress *p, void *user) {
  (void)user;
  assert_int_equal(p->phase, JAM_PHASE_ISOCONF);
  return 1;
}

CASE(stopped_runs_are_kept_and_resume) {
  OWNED jam_system *whole = packing(), *cut = packing(), *again = NULL;
  jam_isoconf_options o = options();
  jam_isoconf_report r;
  static sums a, b;
  assert_int_equal(runs_of(whole, &o, NULL), JAM_OK);
  get(whole, -1, &a);
  o.runs = 6; /* amid a block */
  assert_int_equal(runs_of(cut, &o, &r), JAM_OK);
  o.runs = RUNS;
  o.resume = 1;
  assert_int_equal(jam_set_progress(cut, stop, NULL), JAM_OK);
  assert_int_equal(runs_of(cut, &o, &r), JAM_CANCELLED);
  assert_int_equal(jam_set_progress(cut, NULL, NULL), JAM_OK);
  o.wall_time = 1e-9;
  assert_int_equal(runs_of(cut, &o, &r), JAM_LIMIT);
  o.wall_time = 1e9;
  assert_in_range(r.runs, 6, RUNS - 1);
  again = from_checkpoint(cut);
  assert_int_equal(runs_of(again, &o, &r), JAM_OK);
  same_sums(again, -1, &a);
  assert_int_equal(runs_of(cut, &o, &r), JAM_OK);
  same_sums(cut, -1, &a);
  /* More runs than were asked for first. */
  o.runs = RUNS + 3;
  assert_int_equal(runs_of(cut, &o, &r), JAM_OK);
  assert_int_equal(r.runs, RUNS + 3);
  assert_int_equal(r.blocks, 4);
  /* Not the same runs any more. */
  o.density_ratio = 0.94;
  assert_int_equal(runs_of(cut, &o, &r), JAM_E_STATE);
  o.density_ratio = 0.95;
  assert_int_equal(jam_scale_diameters(cut, 0.999), JAM_OK);
  assert_int_equal(runs_of(cut, &o, &r), JAM_E_STATE);
  get(cut, -1, &b);
  assert_int_equal(b.runs, RUNS + 3);
}

/* The packing has moved on since: the file has the runs as the handle has them, and the place where they began. */
CASE(a_checkpoint_has_what_the_runs_began_from) {
  static const double strain[D * D] = {0.5, 0, 0, 0, 0.5, 0, 0, 0, 0.5};
  OWNED jam_system *whole = packing(), *cut = packing(), *moved = NULL, *strained = NULL, *scaled = NULL, *back = NULL;
  jam_isoconf_options o = options();
  jam_isoconf_report r;
  static sums a, b;
  double start[N * D];
  memcpy(start, view_of(cut, JAM_VIEW_POSITIONS), sizeof start);
  assert_int_equal(runs_of(whole, &o, NULL), JAM_OK);
  get(whole, -1, &a);
  o.runs = 6;
  assert_int_equal(runs_of(cut, &o, NULL), JAM_OK);
  run(cut, 20);
  moved = from_checkpoint(cut);
  o.runs = RUNS, o.resume = 1;
  assert_int_equal(runs_of(moved, &o, &r), JAM_E_STATE);
  assert_int_equal(jam_set_positions(moved, start, N * D), JAM_OK);
  assert_int_equal(runs_of(moved, &o, &r), JAM_OK);
  same_sums(moved, -1, &a);
  /* Distances have the unit of the box of then. */
  assert_int_equal(jam_copy(whole, &strained), JAM_OK);
  assert_int_equal(jam_strain(strained, strain, D * D), JAM_OK);
  same_sums(strained, -1, &a);
  back = from_checkpoint(strained);
  same_sums(back, -1, &a);
  assert_int_equal(jam_set_positions(back, start, N * D), JAM_OK); /* in another cell */
  assert_int_equal(runs_of(back, &o, &r), JAM_E_STATE);
  /* Hard spheres of then overlap now. */
  DEFAULTS(create, soft);
  soft.n = N, soft.overlap = JAM_OVERLAP_ALLOW;
  scaled = created_from(&soft, start, N * D, view_of(whole, JAM_VIEW_DIAMETERS), N);
  DEFAULTS(monte_carlo, m);
  m.step = 0.05, o.resume = 0;
  assert_int_equal(jam_isoconf(scaled, &o, &m, instants, M, NULL, 0, NULL), JAM_OK);
  get(scaled, -1, &b);
  assert_int_equal(jam_scale_diameters(scaled, 1.5), JAM_OK);
  jam_system *overlapping = from_checkpoint(scaled);
  same_sums(overlapping, -1, &b);
  jam_destroy(overlapping);
}

CASE(sums_are_those_of_whole_sets) {
  static double set[RUNS * N * D];
  static const int32_t kept[1] = {1};
  OWNED jam_system *sys = packing();
  jam_isoconf_options o = options();
  double series[M * COLUMNS], msd_sum = 0.0;
  static sums a;
  size_t needed = 0;
  assert_int_equal(jam_isoconf(sys, &o, NULL, instants, M, kept, 1, NULL), JAM_OK);
  get(sys, -1, &a);
  assert_int_equal(jam_isoconf_kept(sys, 1, NULL, 0, &needed), JAM_OK);
  assert_int_equal(needed, RUNS * N * D);
  assert_int_equal(jam_isoconf_kept(sys, 1, set, needed, &needed), JAM_OK);
  assert_int_equal(jam_isoconf_kept(sys, 0, set, needed, &needed), JAM_E_STATE);
  for (size_t i = 0; i < N; ++i) {
    double r2 = 0.0, r4 = 0.0, x[D] = {0.0, 0.0, 0.0};
    for (size_t k = 0; k < RUNS; ++k) {
      double one = 0.0;
      for (size_t c = 0; c < D; ++c) {
        const double v = set[(k * N + i) * D + c];
        x[c] += v;
        one += v * v;
      }
      r2 += one;
      r4 += one * one;
    }
    for (size_t c = 0; c < D; ++c) assert_true(fabs(x[c] - a.displacement[(N + i) * D + c]) < 1e-13);
    assert_true(fabs(r2 - a.distance2[N + i]) < 1e-12 * r2);
    assert_true(fabs(r4 - a.distance4[N + i]) < 1e-12 * r4);
    msd_sum += r2 / N;
  }
  assert_int_equal(jam_isoconf_series(sys, -1, JAM_ISOCONF_COLUMNS, series, M * COLUMNS, NULL), JAM_OK);
  assert_true(fabs(series[COLUMNS + JAM_ISOCONF_MSD] / msd_sum - 1.0) < 1e-12);
  /* No net momentum: the spheres' displacements of each run add up to zero. */
  for (size_t k = 0; k < RUNS; ++k)
    for (size_t c = 0; c < D; ++c) {
      double sum = 0.0;
      for (size_t i = 0; i < N; ++i) sum += set[(k * N + i) * D + c];
      assert_true(fabs(sum) < 1e-12);
    }
}

/* In free flight, dr = v t: at short times |dr|^2 = d T t^2 and the velocities still agree with the first ones. */
CASE(time_and_temperature_are_those_asked_for) {
  static const double times[2] = {1e-7, 2e-7};
  OWNED jam_system *sys = packing();
  jam_isoconf_options o = options();
  double first[2 * COLUMNS], *const second = first + COLUMNS;
  o.clock = JAM_CLOCK_TIME;
  o.temperature = 0.1;
  assert_int_equal(jam_isoconf(sys, &o, NULL, times, 2, NULL, 0, NULL), JAM_OK);
  assert_int_equal(jam_isoconf_series(sys, -1, JAM_ISOCONF_COLUMNS, first, 2 * COLUMNS, NULL), JAM_OK);
  assert_true(fabs(second[JAM_ISOCONF_TIME] / RUNS / 2e-7 - 1.0) < 1e-12);
  assert_true(fabs(first[JAM_ISOCONF_MSD] / RUNS / (D * 0.1 * 1e-14) - 1.0) < 1e-3);
  assert_true(fabs(second[JAM_ISOCONF_MSD] / first[JAM_ISOCONF_MSD] - 4.0) < 1e-2);
  assert_true(fabs(first[JAM_ISOCONF_VELOCITY] / RUNS - 1.0) < 1e-3);
}

/* Instants that no run comes to: the time ends first, and no run counts. */
CASE(far_instants_are_not_reached) {
  static const double far[2] = {1.0, 1e300};
  OWNED jam_system *sys = packing();
  jam_isoconf_options o = options();
  DEFAULTS(monte_carlo, m);
  SIZED(jam_isoconf_report, r);
  o.wall_time = 0.02, m.step = 0.1;
  for (int metropolis = 0; metropolis < 2; ++metropolis) {
    assert_int_equal(jam_isoconf(sys, &o, metropolis ? &m : NULL, far, 2, NULL, 0, &r), JAM_LIMIT);
    assert_int_equal(r.runs, 0);
  }
}

CASE(bad_input_is_named) {
  static const double falling[2] = {2.0, 1.0}, none[1] = {0.0};
  static const int32_t twice[2] = {1, 1}, beyond[1] = {3};
  OWNED jam_system *sys = packing();
  jam_isoconf_options o = options();
  double x;
  SIZED(jam_isoconf_report, r);
  o.resume = 1;
  assert_int_equal(runs_of(sys, &o, NULL), JAM_E_STATE);
  o.resume = 0;
  SAYS(jam_isoconf(sys, &o, NULL, falling, 2, NULL, 0, NULL), JAM_E_ARGUMENT, "ascending");
  assert_int_equal(jam_isoconf(sys, &o, NULL, none, 1, NULL, 0, NULL), JAM_E_ARGUMENT);
  assert_int_equal(jam_isoconf(sys, &o, NULL, NULL, 0, NULL, 0, NULL), JAM_E_ARGUMENT);
  assert_int_equal(jam_isoconf(sys, &o, NULL, NULL, 3, NULL, 0, NULL), JAM_E_NULL);
  assert_int_equal(jam_isoconf(sys, &o, NULL, instants, M, twice, 2, NULL), JAM_E_ARGUMENT);
  assert_int_equal(jam_isoconf(sys, &o, NULL, instants, M, beyond, 1, NULL), JAM_E_ARGUMENT);
  assert_int_equal(runs_of(sys, &o, &r), JAM_OK);
  assert_true(r.energy_drift < 1e-12 && r.max_overlap < 1e-13);
  o.density_ratio = 1.0 - 1e-12;
  SAYS(runs_of(sys, &o, NULL), JAM_E_ARGUMENT, "rounded");
  o = options(), o.memory_limit = 1e4;
  SAYS(runs_of(sys, &o, NULL), JAM_E_MEMORY, "are needed");
  o = options();
  assert_int_equal(jam_set_memory_limit(sys, 1e4), JAM_OK);
  SAYS(runs_of(sys, &o, NULL), JAM_E_MEMORY, "are needed");
  assert_int_equal(jam_set_memory_limit(sys, 1e9), JAM_OK);
  o = options();
  assert_int_equal(jam_isoconf(sys, &o, NULL, falling, 2, NULL, 0, NULL), JAM_E_ARGUMENT);
  DEFAULTS(monte_carlo, m);
  m.alpha = 2.0;
  m.temperature = 0.0;
  assert_int_equal(jam_isoconf(sys, &o, &m, instants, M, NULL, 0, NULL), JAM_E_ARGUMENT);
  assert_int_equal(jam_get_isoconf_report(sys, &r), JAM_OK); /* what was there is still there */
  assert_int_equal(r.runs, RUNS);
  assert_int_equal(jam_isoconf_series(sys, 3, JAM_ISOCONF_COLUMNS, &x, 1, NULL), JAM_E_ARGUMENT);
  assert_int_equal(jam_isoconf_series(sys, 0, JAM_ISOCONF_COLUMNS, &x, 1, NULL), JAM_E_BUFFER);
}

/* Options that these runs do not use, and others than those that the runs began with. */
CASE(no_option_is_ignored) {
  OWNED jam_system *sys = packing();
  jam_isoconf_options o = options();
  jam_monte_carlo_options m;
#define MONTE_CARLO(member, value, code)                                \
  assert_int_equal(jam_monte_carlo_options_init(&m, sizeof m), JAM_OK); \
  m.alpha = 2.0;                                                        \
  m.member = value;                                                     \
  assert_int_equal(jam_isoconf(sys, &o, &m, instants, M, NULL, 0, NULL), code)
#define UNUSED(member, value)                 \
  MONTE_CARLO(member, value, JAM_E_ARGUMENT); \
  assert_non_null(strstr(jam_last_error(), #member))
  UNUSED(sweeps, 7);
  UNUSED(run, 3);
  UNUSED(first_sweep, 0);
  UNUSED(resume, 1);
  UNUSED(wall_time, 100.0);
  MONTE_CARLO(acceptance, 0.6, JAM_OK);
  o.resume = 1, o.runs += 2;
  MONTE_CARLO(acceptance, 0.3, JAM_E_STATE);
  MONTE_CARLO(acceptance, 0.6, JAM_OK);
}

CASE(a_jammed_packing_needs_room) {
  OWNED jam_system *sys = packing();
  jam_isoconf_options o = options();
  jam_isoconf_report r;
  DEFAULTS(compress, c);
  c.pressure = 1e6;
  assert_int_equal(jam_compress(sys, &c, NULL), JAM_OK);
  assert_int_equal(jam_crunch(sys, NULL, NULL), JAM_OK);
  o.density_ratio = 1.0;
  assert_int_equal(runs_of(sys, &o, NULL), JAM_E_ARGUMENT);
  o.density_ratio = 1.0 - 1e-13; /* 1 - 1e-12 is just resolved for so large spheres, not for 200 and more */
  assert_int_equal(runs_of(sys, &o, NULL), JAM_E_ARGUMENT);
  o.density_ratio = 1.0 - 1e-10; /* the nearest decade that positions can resolve */
  assert_int_equal(runs_of(sys, &o, &r), JAM_OK);
  assert_true(r.energy_drift < 1e-10 && r.max_overlap < 1e-13);
}

CASE(one_sphere_cannot_run) {
  const double x[3] = {0.1, 0.2, 0.3}, sigma = 0.3;
  jam_isoconf_options i = options();
  jam_isoconf_report r;
  DEFAULTS(create, o);
  o.n = 1;
  OWNED jam_system *sys = created_from(&o, x, 3, &sigma, 1);
  assert_int_equal(runs_of(sys, &i, &r), JAM_NOT_CONVERGED);
  assert_int_equal(r.stop_reason, JAM_STOP_STALLED);
  assert_int_equal(r.runs, 0);
}
