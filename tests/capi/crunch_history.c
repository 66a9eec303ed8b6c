/* jam_crunch_history and jam_crunch_step: every column against what the state and the report tell, and the physics of
 * a step: displacements add up to the whole move, the linear network of every LP is in balance. */
#include <math.h>
#include <stdlib.h>

#include "columns.h"
#include "systems.h"

enum { N = 80, MAX_STEPS = 2000 };

static jam_system *start(int dim, int64_t seed) {
  double diameters[N];
  for (int k = 0; k < N; ++k) diameters[k] = k % 2 ? 1.4 : 1.0;
  DEFAULTS(create, o);
  o.n = N, o.dim = dim, o.seed = seed, o.packing_fraction = dim == 2 ? 0.4 : 0.25;
  return created_from(&o, NULL, 0, diameters, N);
}

enum { COLUMNS = JAM_HISTORY_TOTAL_MSD_STABLE + 1 };

static size_t column(const jam_system *sys, size_t which, double *out) {
  size_t rows = 0;
  assert_int_equal(column_of(jam_crunch_history, sys, COLUMNS, which, out, MAX_STEPS, &rows), JAM_OK);
  assert_in_range(rows, 1, MAX_STEPS);
  return rows;
}

/* What the callback gathers. */
typedef struct watch {
  jam_system *sys;
  int dim, steps, lps;
  double phi, sigma0[N], sum[3 * N];
  double phi0, worst_gamma;
  double balance[MAX_STEPS],
      balance_free[MAX_STEPS]; /* of each LP: over all spheres, over those below the largest displacement */
} watch;

static void look_at_network(watch *w, const double *displacement) {
  int32_t *pair;
  double *vector, *dual, force[3 * N], most = 0.0, total = 0.0, gamma = 0.0, growth;
  size_t m;
  assert_int_equal(jam_crunch_step(w->sys, NULL, 0, NULL, 0, NULL, 0, NULL, 0, &m), JAM_OK);
  if (m == 0) return;
  pair = malloc(2 * m * sizeof *pair);
  vector = malloc(m * w->dim * sizeof *vector), dual = malloc(m * sizeof *dual);
  assert_int_equal(jam_crunch_step(w->sys, NULL, 0, pair, 2 * m, vector, m * w->dim, dual, m, NULL), JAM_OK);
  assert_int_equal(jam_crunch_step(w->sys, NULL, 0, NULL, 0, NULL, 0, dual, m - 1, NULL), JAM_E_BUFFER);
  memset(force, 0, sizeof force);
  growth = pow(w->phi / w->phi0, 1.0 / w->dim); /* of the diameters, up to the step before */
  for (size_t k = 0; k < m; ++k) {
    const double sigma = 0.5 * (w->sigma0[pair[2 * k]] + w->sigma0[pair[2 * k + 1]]) * growth;
    double r2 = 0.0;
    assert_true(dual[k] > 0.0);
    for (int c = 0; c < w->dim; ++c) {
      force[pair[2 * k] * w->dim + c] += dual[k] * vector[k * w->dim + c];
      force[pair[2 * k + 1] * w->dim + c] -= dual[k] * vector[k * w->dim + c];
      r2 += vector[k * w->dim + c] * vector[k * w->dim + c];
    }
    assert_true(r2 > sigma * sigma * (1.0 - 1e-9)); /* no overlap */
    total += dual[k] * sqrt(r2) / (double)m, gamma += dual[k] * sigma * sigma;
  }
  for (size_t k = 0; k < (size_t)(N * w->dim); ++k) most = fmax(most, fabs(displacement[k]));
  for (size_t k = 0; k < N; ++k) {
    double f2 = 0.0, s = 0.0;
    for (int c = 0; c < w->dim; ++c)
      s = fmax(s, fabs(displacement[k * w->dim + c])), f2 += pow(force[k * w->dim + c], 2);
    w->balance[w->lps] = fmax(w->balance[w->lps], sqrt(f2) / total);
    if (s < 0.99 * most) w->balance_free[w->lps] = fmax(w->balance_free[w->lps], sqrt(f2) / total);
  }
  w->worst_gamma = fmax(w->worst_gamma, fabs(gamma - 1.0));
  ++w->lps;
  free(pair), free(vector), free(dual);
}

static int32_t each_step(const jam_progress *p, void *user) {
  watch *w = user;
  double displacement[3 * N];
  const jam_status status = jam_crunch_step(w->sys, displacement, N * w->dim, NULL, 0, NULL, 0, NULL, 0, NULL);
  if (status == JAM_E_STATE) return 0; /* called amid a step */
  assert_int_equal(status, JAM_OK);
  for (size_t k = 0; k < (size_t)(N * w->dim); ++k) w->sum[k] += displacement[k];
  look_at_network(w, displacement);
  w->phi = p->packing_fraction;
  ++w->steps;
  return 0;
}

/* Of the spheres with a contact, their mean taken out. */
static double msd_of_stable(const watch *w) {
  int32_t z[N];
  double mean[3] = {0, 0, 0}, sum = 0.0, stable = 0.0;
  size_t needed;
  assert_int_equal(jam_coordination(w->sys, z, N, &needed), JAM_OK);
  for (size_t k = 0; k < N; ++k) stable += z[k] > 0;
  for (size_t k = 0; k < (size_t)(N * w->dim); ++k)
    if (z[k / w->dim] > 0) mean[k % w->dim] += w->sum[k] / stable;
  for (size_t k = 0; k < (size_t)(N * w->dim); ++k)
    if (z[k / w->dim] > 0) sum += pow(w->sum[k] - mean[k % w->dim], 2) / stable;
  return sum;
}

static void steps_add_up(int dim, int32_t method) {
  OWNED jam_system *sys = start(dim, 5 + dim);
  jam_crunch_report r;
  jam_info info;
  watch w;
  const double *x, *s;
  double x0[3 * N], mean[3] = {0, 0, 0}, most = 0.0, msd = 0.0, balance = 0.0, v[MAX_STEPS], phase[MAX_STEPS],
                    growth = 1.0, sum = 0.0, phi = 0.0;
  size_t len, k, lp = 0, lps = 0, paths = 0;
  memset(&w, 0, sizeof w), memset(&r, 0, sizeof r);
  r.struct_size = sizeof r, info.struct_size = sizeof info;
  jam_get_info(sys, &info);
  jam_view(sys, JAM_VIEW_POSITIONS, &x, &len), memcpy(x0, x, len * sizeof *x);
  jam_view(sys, JAM_VIEW_DIAMETERS, &s, &len), memcpy(w.sigma0, s, len * sizeof *s);
  w.sys = sys, w.dim = dim, w.phi = w.phi0 = info.packing_fraction;
  DEFAULTS(crunch, o);
  o.method = method, o.steps = 1, o.full_lps = 1;
  assert_int_equal(jam_set_progress(sys, each_step, &w), JAM_OK);
  assert_int_equal(jam_crunch(sys, &o, &r), JAM_OK);

  /* The whole move, modulo the box; max and mean square of it as the last row has them. */
  jam_get_info(sys, &info);
  for (k = 0; k < (size_t)(N * dim); ++k) {
    double rest = x0[k] + w.sum[k] - x[k];
    rest -= nearbyint(rest);
    if (!(fabs(rest) < 1e-13 * w.steps)) fail_msg("coordinate %zu is off by %g", k, rest);
    mean[k % dim] += w.sum[k] / N;
  }
  for (k = 0; k < N; ++k) {
    double r2 = 0.0;
    for (int c = 0; c < dim; ++c) r2 += pow(w.sum[k * dim + c] - mean[c], 2);
    most = fmax(most, r2), msd += r2 / N;
  }
  size_t rows = column(sys, JAM_HISTORY_TOTAL_MAX, v);
  assert_int_equal(rows, w.steps);
  assert_true(fabs(v[rows - 1] * info.diameter_mean - sqrt(most)) < 1e-12);
  column(sys, JAM_HISTORY_TOTAL_MSD, v);
  assert_true(fabs(v[rows - 1] * info.diameter_mean * info.diameter_mean - msd) < 1e-12);
  column(sys, JAM_HISTORY_TOTAL_MSD_STABLE, v);
  assert_true(fabs(v[rows - 1] * info.diameter_mean * info.diameter_mean - msd_of_stable(&w)) < 1e-12);

  /* Growth: the product of the gains; phi never falls but in the opening of the path. */
  column(sys, JAM_HISTORY_GAIN, v);
  for (k = 0; k < rows; ++k) growth *= 1.0 + v[k];
  assert_true(fabs(growth * w.sigma0[0] / s[0] - 1.0) < 1e-13 * (double)rows);
  column(sys, JAM_HISTORY_PHASE, phase), column(sys, JAM_HISTORY_PHI, v);
  for (k = 0; k < rows; ++k) {
    if (phase[k] == JAM_STEP_LP) lp = k, ++lps;
    if (k > 0 && phase[k] == JAM_STEP_LP) assert_true(v[k] >= phi * (1.0 - 1e-13));
    phi = v[k];
  }
  assert_true(fabs(phi - r.packing_fraction) < 1e-14);
  /* The phases: LPs from the dilute start, the path if that is the method, LPs again, polish. */
  for (k = 0; k < rows; ++k) paths += phase[k] == JAM_STEP_PATH;
  assert_true(phase[0] == JAM_STEP_LP && (paths > 0) == (method == JAM_CRUNCH_BARRIER_PATH) &&
              phase[rows - 1] == JAM_STEP_POLISH);
  assert_int_equal(r.method, method); /* the quench that was used */
  assert_int_equal(lps, r.lp_solves);
  assert_int_equal(lps, w.lps);

  /* The last LP is the fixed point that the report tells of. */
  column(sys, JAM_HISTORY_CONTACTS, v), assert_true(v[lp] == (double)r.contacts);
  column(sys, JAM_HISTORY_EXCESS, v), assert_true(v[lp] == (double)r.excess_contacts);
  column(sys, JAM_HISTORY_RATTLERS, v), assert_true(v[lp] == (double)r.rattlers);
  for (k = 0; k < rows; ++k) assert_true((phase[k] == JAM_STEP_PATH) == (isnan(v[k]) != 0));
  column(sys, JAM_HISTORY_GAIN, v), assert_true(fabs(v[lp] - r.gain) < 1e-15);
  column(sys, JAM_HISTORY_STEP_MAX, v), assert_true(v[lp] <= 10.0); /* rattlers may go anywhere */
  column(sys, JAM_HISTORY_FACTORISATIONS, v);
  for (k = 0, sum = 0.0; k < rows; ++k) sum += v[k];
  assert_true(sum == (double)r.factorisations);
  column(sys, JAM_HISTORY_SECONDS, v);
  for (k = 0, sum = 0.0; k < rows; ++k) assert_true(v[k] >= 0.0), sum += v[k];
  assert_true(sum <= r.seconds);

  /* Balance of the linear networks, but for spheres that lean on the step bound: what an LP's answer is let pass with,
   * which polish takes out at the end only. */
  column(sys, JAM_HISTORY_HELD, v);
  for (k = 0, lps = 0; k < rows; ++k)
    if (phase[k] == JAM_STEP_LP) balance = fmax(balance, v[k] > 0.0 ? w.balance_free[lps] : w.balance[lps]), ++lps;
  print_message("d %d method %d: %d steps, %d LPs, worst balance %.1e, worst |sum lambda sigma^2 - 1| %.1e\n", dim,
                method, w.steps, w.lps, balance, w.worst_gamma);
  assert_true(w.lps > 0 && balance > 0.0 && balance < 1e-3 && w.worst_gamma < 1e-6);
}

CASE(history_steps_add_up_to_the_packing) {
  for (int dim = 2; dim <= 3; ++dim)
    for (int method = 0; method < 2; ++method) steps_add_up(dim, method);
}

typedef struct total {
  jam_system *sys;
  double sum[24];
} total;

static int32_t add_step(const jam_progress *p, void *user) {
  total *t = user;
  double x[24];
  (void)p;
  if (jam_crunch_step(t->sys, x, 24, NULL, 0, NULL, 0, NULL, 0, NULL) == JAM_OK)
    for (int k = 0; k < 24; ++k) t->sum[k] += x[k];
  return 0;
}

/* The largest component, modulo the cell (2, 2), of what the steps of a crunch leave of the way from x0 to the end. */
static double left_by_steps(jam_system *sys, const total *t, const double *x0) {
  const double *x = view_of(sys, JAM_VIEW_POSITIONS);
  double cell[4], most = 0.0;
  assert_int_equal(jam_get_cell(sys, cell, 4, NULL), JAM_OK);
  for (int k = 0; k < 12; ++k) {
    double u = x[2 * k] - x0[2 * k] - t->sum[2 * k], v = x[2 * k + 1] - x0[2 * k + 1] - t->sum[2 * k + 1];
    const double rows = nearbyint(v / cell[3]);
    v -= rows * cell[3], u -= rows * cell[2];
    most = fmax(most, fmax(fabs(v), fabs(remainder(u, cell[0]))));
  }
  return most;
}

/* The same where the cell is free: strains move spheres too. A cell that gets other vectors may turn with its spheres,
 * and with them all that was counted. */
CASE(steps_of_a_free_cell_add_up) {
  const double cells[2][4] = {{2.0, 0.0, 0.0, 0.5}, {1.0, 0.0, 0.0, 1.0}};
  int straight = 0;
  for (int seed = 1; seed < 11; ++seed)
    for (int method = 0; method < 2; ++method) {
      double x0[24], most = 0.0, mean[2] = {0.0, 0.0};
      SIZED(jam_crunch_report, r);
      total t = {NULL, {0.0}};
      DEFAULTS(create, c);
      c.dim = 2, c.n = 12, c.seed = seed, c.packing_fraction = 0.3;
      OWNED jam_system *sys = created_in_cell(&c, cells[seed % 2], 4, NULL, 0, NULL, 0);
      memcpy(x0, view_of(sys, JAM_VIEW_POSITIONS), sizeof x0);
      t.sys = sys;
      DEFAULTS(crunch, o);
      o.strain = JAM_STRAIN_FREE, o.method = method, o.steps = 1;
      assert_int_equal(jam_set_progress(sys, add_step, &t), JAM_OK);
      assert_true(jam_crunch(sys, &o, &r) >= 0);
      if (strstr(jam_notes(sys), "rotated")) continue;
      ++straight;
      const double left = left_by_steps(sys, &t, x0);
      if (!(left < 1e-12)) fail_msg("seed %d, method %d: steps leave %g", seed, method, left);
      for (int k = 0; k < 24; ++k) mean[k % 2] += t.sum[k] / 12.0;
      for (int k = 0; k < 12; ++k) most = fmax(most, hypot(t.sum[2 * k] - mean[0], t.sum[2 * k + 1] - mean[1]));
      assert_true(fabs(r.displacement_max * r.diameter_mean - most) < 1e-12);
    }
  assert_true(straight > 10);
}

static int32_t asks_in_vain(const jam_progress *p, void *user) {
  jam_system *sys = *(jam_system **)user;
  size_t needed;
  (void)p;
  SAYS(jam_crunch_step(sys, NULL, 0, NULL, 0, NULL, 0, NULL, 0, &needed), JAM_E_STATE, "steps = 1");
  return 0;
}

/* Errors by name; the details are for the callback of a crunch with steps = 1 alone; what moves the spheres drops the
 * history. */
CASE(history_errors_are_named) {
  OWNED jam_system *sys = start(2, 1), *copy = NULL;
  double v[MAX_STEPS], u[MAX_STEPS];
  size_t needed;
  assert_int_equal(jam_crunch_history(sys, JAM_HISTORY_COLUMNS, NULL, 0, &needed), JAM_E_STATE);
  assert_int_equal(jam_crunch_step(sys, NULL, 0, NULL, 0, NULL, 0, NULL, 0, &needed), JAM_E_STATE);
  DEFAULTS(crunch, o);
  jam_set_progress(sys, asks_in_vain, &sys);
  assert_int_equal(jam_crunch(sys, NULL, NULL), JAM_OK);
  assert_int_equal(jam_crunch_step(sys, NULL, 0, NULL, 0, NULL, 0, NULL, 0, &needed), JAM_E_STATE);
  size_t rows = column(sys, JAM_HISTORY_PHI, v);
  assert_int_equal(jam_crunch_history(sys, JAM_HISTORY_COLUMNS, v, rows * COLUMNS - 1, &needed), JAM_E_BUFFER);
  assert_int_equal(needed, rows * COLUMNS);
  o.max_lps = -1; /* refused before anything is done: the history stays */
  assert_int_equal(jam_crunch(sys, &o, NULL), JAM_E_ARGUMENT);
  assert_int_equal(jam_copy(sys, &copy), JAM_OK);
  assert_int_equal(column(copy, JAM_HISTORY_PHI, u), rows);
  assert_memory_equal(u, v, rows * sizeof *v);
  assert_int_equal(jam_scale_diameters(sys, 0.99), JAM_OK);
  assert_int_equal(jam_crunch_history(sys, JAM_HISTORY_COLUMNS, NULL, 0, &needed), JAM_E_STATE);
}
