/* Packings crunched from a random start have one state of self-stress; all results of the analysis agree: forces from
 * positions alone are the multipliers, floppy modes keep all other contacts closed, moduli follow from forces. */
#include <math.h>
#include <stdlib.h>

#include "columns.h"
#include "physics/network.h"
#include "systems.h"

enum { MODES = 400, COLUMNS = JAM_FLOPPY_S_RETURN + 1 };

static double apply_compatibility(const struct network *w, int64_t k, const double *u) {
  const double *a = u + (int64_t)w->node[w->pair[2 * k]] * w->d, *b = u + (int64_t)w->node[w->pair[2 * k + 1]] * w->d;
  double s = 0.0;
  for (int c = 0; c < w->d; ++c) s += w->normal[k * w->d + c] * (a[c] - b[c]);
  return s;
}

/* Forces three ways: multipliers of the LP, null vector on the same network, network and null vector from positions
 * alone. */
static void forces_from_positions(const struct network *w) {
  double *f = malloc(ROOM * sizeof *f), residual = 1.0;
  size_t m = 0, got = 0;
  int32_t *pair = malloc(ROOM * sizeof *pair);
  OWNED jam_system *copy = NULL;
  jam_geometry_report g = {.struct_size = sizeof(jam_geometry_report)};
  assert_int_equal(jam_stress_states(w->sys, f, ROOM, NULL, 0, &residual, &m), JAM_OK);
  assert_int_equal(m, 1);
  assert_true(residual < 1e-12);
  for (int64_t k = 0; k < w->contacts; ++k) assert_true(fabs(f[k] - w->force[k]) < 1e-9);
  assert_int_equal(jam_copy(w->sys, &copy), JAM_OK);
  assert_int_equal(jam_contacts_from_geometry(copy, NULL, &g), JAM_OK);
  assert_int_equal(g.excess_contacts, 0);
  assert_int_equal(g.self_stresses, 1);
  assert_int_equal(g.zero_modes, w->d);
  assert_true(g.jump > 1e3);
  assert_int_equal(jam_contacts(copy, pair, ROOM, &got), JAM_OK);
  assert_int_equal(got, 2 * w->contacts);
  for (int64_t k = 0; k < 2 * w->contacts; ++k) assert_int_equal(pair[k], w->pair[k]);
  assert_int_equal(jam_forces(copy, f, ROOM, &got), JAM_OK);
  for (int64_t k = 0; k < w->contacts; ++k) assert_true(fabs(f[k] - w->force[k]) < 1e-9);
  free(f), free(pair);
}

/* Opening at which, to first order, a pair that is no contact closes: every image of every pair of stable spheres. */
static double next_contact(const struct network *w, const double *u, double gamma) {
  double best = INFINITY;
  int c, image, images = 1;
  for (c = 0; c < w->d; ++c) images *= 3;
  const double *x = view_of(w->sys, JAM_VIEW_POSITIONS);
  for (int64_t i = 0; i < w->stable; ++i)
    for (int64_t j = 0; j < i; ++j)
      for (image = 0; image < images; ++image) {
        const int64_t a = w->map[i], b = w->map[j];
        const double touch = 0.5 * (w->diameter[a] + w->diameter[b]);
        double r2 = 0.0, along = 0.0, r, closing;
        int code = image;
        for (c = 0; c < w->d; ++c, code /= 3) {
          const double e = x[a * w->d + c] - x[b * w->d + c] + (code % 3 - 1); /* the box is 1 */
          r2 += e * e;
          along += e * (u[i * w->d + c] - u[j * w->d + c]);
        }
        r = sqrt(r2);
        if (r > 2.0 * touch || r < (1.0 + 1e-9) * touch) continue;
        closing = gamma * touch - along / r;
        if (closing > 0.0) best = fmin(best, (r - touch) / closing);
      }
  return best;
}

/* Twice the second-order term of sum_k f_k |r_k + s dr_k|, by differences: contacts have length sigma. First-order
 * displacements are enough, because forces in balance do no work on those of second order. */
static double bend(const struct network *w, const double *u, double s) {
  double sum = 0.0;
  for (int64_t k = 0; k < w->contacts; ++k)
    for (int sign = -1; sign <= 1; sign += 2) {
      const int64_t a = w->node[w->pair[2 * k]], b = w->node[w->pair[2 * k + 1]];
      double r2 = 0.0;
      for (int c = 0; c < w->d; ++c) {
        const double e = sigma(w, k) * w->normal[k * w->d + c] + sign * s * (u[a * w->d + c] - u[b * w->d + c]);
        r2 += e * e;
      }
      sum += w->force[k] * (sqrt(r2) - sigma(w, k));
    }
  return sum / (s * s);
}

/* S dr = e_l + gamma sigma, exactly, for the stated gamma; no net translation. */
static void floppy_keeps_contacts(const struct network *w, int check_next) {
  double *u = malloc(ROOM * sizeof *u), *b = malloc(ROOM * sizeof *b), *sp = malloc(ROOM * sizeof *sp),
         *ss = malloc(ROOM * sizeof *ss);
  double *wt = malloc(ROOM * sizeof *wt), *st = malloc(ROOM * sizeof *st),
         *table = malloc(COLUMNS * ROOM * sizeof *table);
  double fs = 0.0;
  size_t m;
  for (int64_t k = 0; k < w->contacts; ++k) fs += w->force[k] * sigma(w, k);
  for (int64_t l = 0; l < w->contacts; l += w->contacts / 7 + 1) {
    const double gamma = -w->force[l] / fs;
    double mean = 0.0, size = 0.0;
    assert_int_equal(jam_floppy_modes(w->sys, &l, 1, JAM_FLOPPY_COLUMNS, NULL, 0, u, ROOM, &m), JAM_OK);
    assert_int_equal(m, 1);
    for (int64_t k = 0; k < w->stable * w->d; ++k) size = fmax(size, fabs(u[k]));
    for (int64_t k = 0; k < w->contacts; ++k)
      assert_true(fabs(apply_compatibility(w, k, u) - gamma * sigma(w, k) - (k == l)) < 1e-9 * (1.0 + size));
    for (int64_t k = 0; k < w->stable; ++k) mean += u[k * w->d];
    assert_true(fabs(mean) < 1e-9 * size * (double)w->stable);
  }
  assert_int_equal(jam_floppy_modes(w->sys, NULL, 0, JAM_FLOPPY_COLUMNS, table, COLUMNS * ROOM, NULL, 0, &m), JAM_OK);
  assert_int_equal(m, w->contacts);
  for (int64_t k = 0; k < w->contacts; ++k) {
    const double *row = table + COLUMNS * k;
    b[k] = row[JAM_FLOPPY_MEDIAN], wt[k] = row[JAM_FLOPPY_WEIGHT], sp[k] = row[JAM_FLOPPY_S_PLUS];
    ss[k] = row[JAM_FLOPPY_S_STAR], st[k] = row[JAM_FLOPPY_STABILITY];
  }
  for (int64_t k = 0; k < w->contacts; ++k) {
    assert_true(b[k] > 0.0 && b[k] < 1.5 / sqrt((double)w->stable));
    assert_true(sp[k] > 0.0 && ss[k] > 0.0);
    assert_true(fabs(st[k] * sp[k] / ss[k] - 1.0) < 1e-12);
    assert_true(table[COLUMNS * k + JAM_FLOPPY_S_RETURN] == 2.0 * ss[k]);
  }
  for (int64_t l = 0; l < w->contacts;
       l += w->contacts / 5 + 1) { /* f = W times the displacement in the middle of the ranking */
    double all = 0.0;
    int below = 0;
    assert_int_equal(jam_floppy_modes(w->sys, &l, 1, JAM_FLOPPY_COLUMNS, NULL, 0, u, ROOM, &m), JAM_OK);
    for (int64_t k = 0; k < w->stable * w->d; ++k) all += u[k] * u[k];
    assert_true(fabs(wt[l] * b[l] * sqrt(all) / w->force[l] - 1.0) < 1e-8);
    for (int64_t k = 0; k < w->stable; ++k) {
      double s = 0.0;
      for (int c = 0; c < w->d; ++c) s += u[k * w->d + c] * u[k * w->d + c];
      below += sqrt(s) < b[l] * sqrt(all) * (1.0 - 1e-8);
    }
    assert_int_equal(below, w->stable / 2);
    assert_true(fabs(ss[l] * bend(w, u, 1e-4 / sqrt(all)) / w->force[l] - 1.0) <
                1e-4); /* the least diameter is at s_star */
    if (check_next) assert_true(fabs(sp[l] / next_contact(w, u, -w->force[l] / fs) - 1.0) < 1e-6);
  }
  free(u), free(b), free(sp), free(ss), free(wt), free(st), free(table);
}

/* In a state with one self-stress f, a harmonic network of elongations e keeps only its part along f: the modulus is
 * (f . e)^2 / (|f|^2 V). */
static void moduli_follow_from_forces(const struct network *w) {
  jam_moduli_report m = {.struct_size = sizeof(jam_moduli_report)};
  double ff = 0.0, fe = 0.0, shear = 0.0;
  assert_int_equal(jam_moduli(w->sys, NULL, &m), JAM_OK);
  for (int64_t k = 0; k < w->contacts; ++k) {
    ff += w->force[k] * w->force[k];
    fe += w->force[k] * sigma(w, k) / w->d; /* at contact |r| = sigma */
  }
  assert_true(fabs(m.bulk / (fe * fe / ff) - 1.0) < 1e-8);
  for (int a = 0; a < w->d; ++a)
    for (int b = a + 1; b < w->d; ++b) {
      fe = 0.0;
      for (int64_t k = 0; k < w->contacts; ++k)
        fe += w->force[k] * sigma(w, k) * w->normal[k * w->d + a] * w->normal[k * w->d + b];
      shear += fe * fe / ff / (w->d * (w->d - 1) / 2);
    }
  assert_true(fabs(m.shear - shear) < 1e-9 * m.shear_affine);
  assert_true(m.bulk < m.bulk_affine && m.shear < m.shear_affine);
}

/* u . H . u of the harmonic Hessian. */
static double curvature(const struct network *w, const double *u) {
  const size_t rows = (size_t)(w->stable * w->d);
  int32_t *start = malloc((rows + 1) * sizeof *start), *column;
  double *value, sum = 0.0;
  size_t entries;
  assert_int_equal(jam_hessian(w->sys, NULL, NULL, 0, NULL, 0, NULL, 0, &entries), JAM_OK);
  column = malloc(entries * sizeof *column), value = malloc(entries * sizeof *value);
  assert_int_equal(jam_hessian(w->sys, NULL, start, rows + 1, column, entries, value, entries, NULL), JAM_OK);
  for (size_t k = 0; k < rows; ++k)
    for (int32_t e = start[k]; e < start[k + 1]; ++e) sum += u[k] * value[e] * u[column[e]];
  free(start), free(column), free(value);
  return sum;
}

static void spectrum_identities(const struct network *w) {
  const size_t rows = (size_t)(w->stable * w->d);
  double *l = malloc(rows * sizeof *l), *v = malloc(rows * rows * sizeof *v), *y = malloc(rows * sizeof *y),
         trace = 0.0;
  double low[8];
  size_t m;
  DEFAULTS(modes, o);
  o.which = JAM_MODES_ALL;
  assert_int_equal(eigenvalues(w->sys, &o, l, y, rows, &m), JAM_OK);
  assert_int_equal(jam_modes(w->sys, NULL, &o, JAM_MODE_COLUMNS, NULL, 0, v, rows * rows, &m), JAM_OK);
  assert_int_equal(m, rows);
  for (size_t k = 0; k < m; ++k) {
    trace += l[k];
    assert_true(y[k] >= 1.0 / (double)w->stable - 1e-12 && y[k] <= 1.0 + 1e-12);
    assert_int_equal(fabs(l[k]) < 1e-11, k < (size_t)w->d);
  }
  assert_true(fabs(trace - 2.0 * (double)w->contacts) < 1e-9 * trace); /* each contact adds 1 to each of its spheres */
  assert_true(fabs(curvature(w, v + rows * (rows / 2)) - l[rows / 2]) < 1e-10);
  { /* projections on a complete basis: Parseval, and the curvature as their sum */
    double *u = malloc(rows * sizeof *u), uu = 0.0, cc = 0.0, uhu = 0.0;
    for (size_t k = 0; k < rows; ++k) u[k] = sin(1.0 + (double)(k * k)), uu += u[k] * u[k];
    for (size_t k = 0; k < rows; ++k) {
      double c = 0.0;
      for (size_t j = 0; j < rows; ++j) c += v[k * rows + j] * u[j];
      cc += c * c, uhu += l[k] * c * c;
    }
    assert_true(fabs(cc / uu - 1.0) < 1e-11);
    assert_true(fabs(uhu / curvature(w, u) - 1.0) < 1e-10);
    free(u);
  }
  o.which = JAM_MODES_LOWEST;
  o.count = 8;
  assert_int_equal(eigenvalues(w->sys, &o, low, NULL, 8, &m), JAM_OK);
  for (size_t k = 0; k < 8; ++k) assert_true(fabs(low[k] - l[k + (size_t)w->d]) < 1e-11);
  { /* the density of states integrates to one, and its second moment is the trace */
    enum { POINTS = 400, COLUMNS = JAM_DOS_CUMULATIVE_ERROR + 1 };
    double *table = malloc(POINTS * COLUMNS * sizeof *table), zero = 0.0, two = 0.0, error = 0.0, step;
    DEFAULTS(dos, q);
    q.points = POINTS;
    q.vectors = 32;
    q.moments = 256;
    assert_int_equal(jam_density_of_states(w->sys, NULL, &q, JAM_DOS_COLUMNS, table, POINTS * COLUMNS, &m), JAM_OK);
    assert_int_equal(m, POINTS * COLUMNS);
    step = table[COLUMNS + JAM_DOS_OMEGA] - table[JAM_DOS_OMEGA];
    for (size_t k = 0; k < POINTS; ++k) {
      const double *row = table + k * COLUMNS, edge = row[JAM_DOS_EDGE];
      size_t below = (size_t)w->d;
      zero += row[JAM_DOS_DENSITY] * step;
      two += row[JAM_DOS_DENSITY] * row[JAM_DOS_OMEGA] * row[JAM_DOS_OMEGA] * step;
      error += row[JAM_DOS_ERROR] * step;
      assert_true(fabs(edge - row[JAM_DOS_OMEGA] - 0.5 * step) < 1e-12); /* upper ends of the bins */
      while (below < rows && l[below] <= edge * edge) ++below;           /* against the modes one by one */
      assert_true(fabs(row[JAM_DOS_CUMULATIVE] - (double)(below - (size_t)w->d) / (double)(rows - (size_t)w->d)) <
                  0.03);
    }
    assert_true(fabs(zero - 1.0) < 0.02);
    assert_true(error > 0.0 && fabs(two - trace / (double)(rows - (size_t)w->d)) < 0.05 * two);
    free(table);
  }
  free(l), free(v), free(y);
}

CASE(all_analyses_agree_on_small_packings) {
  for (int dim = 2; dim <= 4; ++dim) {
    jam_crunch_report report;
    struct network w = open_network(crunched(dim, dim == 4 ? 150 : 80,
                                             dim == 2   ? 0.4
                                             : dim == 3 ? 0.2
                                                        : 0.1,
                                             dim == 2, &report));
    assert_int_equal(report.excess_contacts, 0);
    forces_from_positions(&w);
    floppy_keeps_contacts(&w, 1);
    moduli_follow_from_forces(&w);
    spectrum_identities(&w);
    close_network(&w);
  }
}

/* The same with quenched random shifts of every pair: networks without geometry in space. */
CASE(all_analyses_agree_on_mari_kurchan_networks) {
  jam_crunch_report report;
  struct network w = open_network(crunched_model(JAM_MODEL_MK, 3, 100, 0.5, 0, &report));
  assert_int_equal(report.excess_contacts, 0);
  forces_from_positions(&w);
  floppy_keeps_contacts(&w, 0); /* shifted pairs: no images to go through */
  spectrum_identities(&w);
  close_network(&w);
}
