/* What jam_observe records: consistent with itself, with the run, and without a trace in the dynamics. */
#include <math.h>
#include <stdlib.h>

#include "steps.h"

enum { N = 500 };

static jam_system *fluid_of(int64_t n, double fraction) {
  DEFAULTS(create, o);
  o.n = n;
  o.box = 2.0;
  jam_system *sys = created(&o);
  DEFAULTS(compress, c);
  c.growth_rate = 0.05;
  c.pressure = 1e12;
  c.packing_fraction = fraction;
  assert_int_equal(jam_compress(sys, &c, NULL), JAM_OK);
  return sys;
}
static jam_system *fluid(double fraction) { return fluid_of(N, fraction); }

static void copy_positions(const jam_system *sys, double *out) {
  memcpy(out, view_of(sys, JAM_VIEW_POSITIONS), 3 * N * sizeof *out);
}

CASE(series_pairs_and_displacements_agree) {
  OWNED jam_system *sys = fluid(0.25), *bare = NULL;
  static double start[3 * N], end[3 * N], way[3 * N], table[480];
  static int64_t collisions[N];
  double mean = 0, total_time, virial = 0, square = 0, furthest = 0, twice_kinetic = 0;
  int64_t sum = 0, sum_pairs = 0, *pair_collisions;
  int32_t *pair;
  double *momentum;
  size_t needed;
  assert_int_equal(jam_copy(sys, &bare), JAM_OK);
  DEFAULTS(observe, o);
  o.collisions = 1;
  copy_positions(sys, start);
  assert_int_equal(jam_observe(sys, &o), JAM_OK);
  jam_md_report report = run(sys, 400);
  jam_md_report second = run(sys, 400); /* observations go on over calls */
  assert_int_equal(jam_observed_series(sys, JAM_SERIES_COLUMNS, NULL, 0, &needed), JAM_OK);
  assert_int_equal(needed, 80 * 6);
  assert_int_equal(jam_observed_series(sys, JAM_SERIES_COLUMNS, table, 479, &needed), JAM_E_BUFFER);
  assert_int_equal(jam_observed_series(sys, JAM_SERIES_COLUMNS, table, 480, &needed), JAM_OK);
  for (size_t k = 0; k < 80; ++k) {
    const double *row = table + 6 * k;
    assert_true(fabs(row[JAM_SERIES_COLLISIONS] - 10.0 * (double)(k + 1)) < 1e-9);
    assert_true(row[JAM_SERIES_TIME] > (k ? row[JAM_SERIES_TIME - 6] : 0.0) && row[JAM_SERIES_ERROR] > 0.0);
    mean += row[JAM_SERIES_PRESSURE] / 80.0;
  }
  /* Samples of equal collisions, not equal time: the mean is the run's within the noise, 0.2 per cent. */
  assert_true(fabs(mean / report.pressure - 1.0) < 0.02);
  assert_int_equal(jam_observed_spheres(sys, collisions, N, way, 3 * N, &needed), JAM_OK);
  assert_int_equal(needed, N);
  copy_positions(sys, end);
  for (size_t k = 0; k < 3 * N; ++k) { /* the unwrapped way leads from start to end */
    const double boxes = (end[k] - start[k] - way[k]) / 2.0;
    assert_true(fabs(boxes - round(boxes)) < 1e-9);
    square += way[k] * way[k] / N;
    furthest = fmax(furthest, fabs(way[k]));
  }
  assert_true(furthest > 1.5); /* more than half the box: the sum over images matters */
  assert_true(fabs(table[6 * 79 + JAM_SERIES_MSD] / square - 1.0) < 1e-9);
  for (size_t k = 0; k < N; ++k) sum += collisions[k];
  assert_int_equal(sum, 800 * N);
  assert_int_equal(jam_observed_pairs(sys, NULL, 0, NULL, 0, NULL, 0, &total_time, &needed), JAM_OK);
  pair = malloc(2 * needed * sizeof *pair), momentum = malloc(needed * sizeof *momentum),
  pair_collisions = malloc(needed * sizeof *pair_collisions);
  assert_int_equal(
      jam_observed_pairs(sys, pair, 2 * needed, pair_collisions, needed, momentum, needed, &total_time, &needed),
      JAM_OK);
  const double *d = view_of(sys, JAM_VIEW_DIAMETERS);
  for (size_t k = 0; k < needed; ++k) {
    assert_true(pair[2 * k] >= 0 && pair[2 * k] < pair[2 * k + 1] && pair[2 * k + 1] < N && momentum[k] > 0.0);
    if (k) assert_true(pair[2 * k] > pair[2 * k - 2] || pair[2 * k + 1] > pair[2 * k - 1]);
    virial += momentum[k] * d[0] / 2.0; /* in units of the box */
    sum_pairs += pair_collisions[k];
  }
  assert_int_equal(sum_pairs, 400 * N);
  /* p = 1 + (N - 1) / N sum sigma |dp| / (2 K t), for d (N - 1) degrees of freedom: what the two reports say. */
  const double *const v = view_of(sys, JAM_VIEW_VELOCITIES);
  for (size_t k = 0; k < 3 * N; ++k) twice_kinetic += v[k] * v[k];
  mean = (report.pressure * report.time + second.pressure * second.time) / (report.time + second.time);
  assert_true(fabs((1.0 + (N - 1.0) / N * virial / (twice_kinetic * total_time)) / mean - 1.0) < 1e-9);
  assert_true(fabs(table[6 * 79 + JAM_SERIES_TIME] / total_time - 1.0) < 1e-6);
  free(pair), free(momentum), free(pair_collisions);
  run(bare, 400), run(bare, 400);
  same(sys, bare);
  assert_int_equal(jam_stop_observing(sys), JAM_OK);
  run(sys, 100);
  assert_int_equal(jam_observed_series(sys, JAM_SERIES_COLUMNS, NULL, 0, &needed), JAM_OK);
  assert_int_equal(needed, 80 * 6); /* stopped, and still there */
}

CASE(histograms_of_gaps_and_distances) {
  OWNED jam_system *sys = fluid(0.3);
  double gap[21][4], pair[50][2], contact;
  size_t needed;
  DEFAULTS(observe, o);
  o.gap_bins = 21;
  o.gap_min = 0.01;
  o.gap_max = 0.3;
  o.r_bins = 50;
  o.r_max = 5.0;
  o.sample_every = 5.0;
  run(sys, 50);
  assert_int_equal(jam_observe(sys, &o), JAM_OK);
  /* p - 1 = 4 phi g(sigma) (N - 1) / N: a sphere has N - 1 others. */
  contact = (run(sys, 1000).pressure - 1.0) / (4.0 * 0.3) * N / (N - 1.0);
  assert_int_equal(jam_observed_gaps(sys, JAM_GAP_COLUMNS, gap[0], 21 * 4, &needed), JAM_OK);
  assert_int_equal(needed, 21 * 4);
  assert_true(gap[0][JAM_GAP_LOW] == 0.0 && fabs(gap[0][JAM_GAP_HIGH] - 0.01) < 1e-15);
  assert_true(gap[1][JAM_GAP_LOW] == gap[0][JAM_GAP_HIGH] && fabs(gap[20][JAM_GAP_HIGH] - 0.3) < 1e-12);
  print_message("g(sigma) by pressure %.3f, in [0, 0.01] %.3f(%.3f), at 0.3 %.3f\n", contact, gap[0][JAM_GAP_DENSITY],
                gap[0][JAM_GAP_ERROR], gap[20][JAM_GAP_DENSITY]);
  /* g falls by about 2 per cent over the first bin. */
  assert_true(fabs(gap[0][JAM_GAP_DENSITY] / contact - 0.98) < 0.02 + 3.0 * gap[0][JAM_GAP_ERROR] / contact);
  assert_true(gap[20][JAM_GAP_DENSITY] < 0.75 * gap[0][JAM_GAP_DENSITY]);
  assert_int_equal(jam_observed_correlation(sys, JAM_CORRELATION_COLUMNS, pair[0], 50 * 2, &needed), JAM_OK);
  assert_int_equal(needed, 50 * 2);
  for (size_t k = 0; k < 50; ++k) {
    const double r = pair[k][JAM_CORRELATION_R], g = pair[k][JAM_CORRELATION_G];
    assert_true(fabs(r - 0.1 * ((double)k + 0.5)) < 1e-12);
    if (r < 0.9) assert_true(g == 0.0);
    if (r > 3.0) assert_true(fabs(g - 1.0) < 0.05);
  }
  /* Both histograms of the same pairs: g of the first full bin beyond contact between the values of its ends. */
  assert_true(pair[10][JAM_CORRELATION_G] > gap[10][JAM_GAP_DENSITY] * 0.9 &&
              pair[10][JAM_CORRELATION_G] < gap[0][JAM_GAP_DENSITY]);
}

/* Of 20 spheres, a histogram taken at collisions would hold one pair in contact more than on average: in a first bin of
 * 1 / 50 that is 1 / (4 N phi (1.02^3 - 1)), a third of g. The pressure says what g is: p - 1 = 4 phi g (N - 1) / N. */
CASE(histograms_are_not_taken_at_collisions) {
  const double n = 20.0, fraction = 0.3;
  OWNED jam_system *sys = fluid_of(20, fraction);
  double gap[3][4], contact;
  size_t needed;
  DEFAULTS(observe, o);
  o.gap_bins = 3;
  o.gap_min = 0.02;
  o.gap_max = 0.3;
  o.sample_every = 2.0;
  run(sys, 50);
  assert_int_equal(jam_observe(sys, &o), JAM_OK);
  contact = (run(sys, 10000).pressure - 1.0) / (4.0 * fraction) * n / (n - 1.0);
  assert_int_equal(jam_observed_gaps(sys, JAM_GAP_COLUMNS, gap[0], 3 * 4, &needed), JAM_OK);
  print_message("g(sigma) by pressure %.3f, in [0, 0.02] %.3f(%.3f)\n", contact, gap[0][JAM_GAP_DENSITY],
                gap[0][JAM_GAP_ERROR]);
  assert_true(gap[0][JAM_GAP_ERROR] < 0.03 * contact);
  assert_true(fabs(gap[0][JAM_GAP_DENSITY] / contact - 0.96) < 0.02 + 4.0 * gap[0][JAM_GAP_ERROR] / contact);
}

struct seen {
  const jam_system *sys;
  int64_t count, at[40];
  double first[3 * N];
};

static int32_t look(const jam_progress *p, void *user) {
  struct seen *s = user;
  size_t needed;
  double g[20];
  if (!p->snapshot) return 0;
  assert_int_equal(p->snapshot, s->count + 1);
  s->at[s->count++] = p->collisions;
  const double *x = view_of(s->sys, JAM_VIEW_POSITIONS);
  DEFAULTS(correlation, o);
  o.r_max = 2.0, o.bins = 20;
  assert_int_equal(jam_pair_correlation(s->sys, &o, NULL, 0, g, 20, &needed), JAM_OK);
  assert_true(g[3] == 0.0 && g[11] > 1.0); /* no overlap in the state shown */
  if (s->count > 1) assert_memory_not_equal(x, s->first, sizeof s->first);
  memcpy(s->first, x, sizeof s->first);
  return s->count == 20;
}

CASE(snapshots_show_the_present_state) {
  OWNED jam_system *sys = fluid(0.45), *bare = NULL;
  struct seen s;
  jam_copy(sys, &bare);
  DEFAULTS(observe, o);
  o.sample_every = INFINITY;
  o.snapshot_every = 1.0;
  o.snapshot_factor = 2.0;
  memset(&s, 0, sizeof s);
  s.sys = sys;
  assert_int_equal(jam_observe(sys, &o), JAM_OK);
  jam_set_progress(sys, look, &s);
  run(sys, 100);
  run(bare, 100);
  assert_int_equal(s.count, 6); /* 1, 3, 7, 15, 31, 63 */
  for (int64_t k = 0; k < 6; ++k) assert_int_equal(s.at[k], ((2 << k) - 1) * N / 2);
  same(sys, bare);
  o.snapshot_factor = 1.0;
  s.count = 0;
  assert_int_equal(jam_observe(sys, &o), JAM_OK);
  {
    DEFAULTS(run, r);
    assert_int_equal(jam_run(sys, &r, NULL), JAM_CANCELLED); /* by the 20th */
    assert_int_equal(s.count, 20);
    assert_memory_equal(view_of(sys, JAM_VIEW_POSITIONS), s.first, sizeof s.first);
    r.resume = 1;
    jam_set_progress(sys, NULL, NULL);
    assert_int_equal(jam_run(sys, &r, NULL), JAM_OK);
    run(bare, 100);
    same(sys, bare);
  }
}

/* One call is one change: what a call saw before it failed is no part of the observations. */
CASE(a_failed_call_is_not_observed) {
  enum { MANY = 2000 };
  static int64_t before[MANY], after[MANY];
  static double way[3 * MANY], way_after[3 * MANY];
  OWNED jam_system *sys = random_spheres(3, MANY, 0.1, 1);
  DEFAULTS(observe, o);
  DEFAULTS(compress, c);
  o.collisions = 1, o.sample_every = 2.0;
  c.growth_rate = 0.1, c.pressure = 1e4;
  assert_int_equal(jam_observe(sys, &o), JAM_OK);
  run(sys, 10.0);
  assert_int_equal(jam_observed_spheres(sys, before, MANY, way, 3 * MANY, NULL), JAM_OK);
  assert_int_equal(jam_set_memory_limit(sys, 1.3e5), JAM_OK); /* too little for the lists of a dense fluid */
  assert_int_equal(jam_compress(sys, &c, NULL), JAM_E_MEMORY);
  assert_int_equal(jam_observed_spheres(sys, after, MANY, way_after, 3 * MANY, NULL), JAM_OK);
  assert_memory_equal(after, before, sizeof before);
  assert_memory_equal(way_after, way, sizeof way);
}

CASE(what_was_not_observed_is_told) {
  int64_t collisions[8];
  double x[8];
  size_t needed = 77;
  OWNED jam_system *sys = random_spheres(3, 8, 0.0, 1);
  assert_int_equal(jam_observe(sys, NULL), JAM_OK); /* the series alone */
  assert_int_equal(jam_observed_spheres(sys, collisions, 8, NULL, 0, &needed), JAM_E_STATE);
  assert_int_equal(jam_observed_pairs(sys, NULL, 0, NULL, 0, NULL, 0, x, &needed), JAM_E_STATE);
  assert_int_equal(jam_observed_gaps(sys, JAM_GAP_COLUMNS, NULL, 0, &needed), JAM_OK);
  assert_int_equal(needed, 0);
  assert_int_equal(jam_observed_series(sys, JAM_SERIES_COLUMNS, NULL, 4, &needed), JAM_E_NULL);
}
