/* jam_crunch at its edges: every kind of start, and a certificate recomputed here, independently of the library. */
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "start.h"
#include "test.h"

#include "jam/jam.h"

static jam_crunch_report crunch(jam_system *sys, const jam_crunch_options *o, jam_status expected) {
  jam_crunch_report r;
  jam_status status;
  memset(&r, 0, sizeof r);
  r.struct_size = sizeof r;
  status = jam_crunch(sys, o, &r);
  if (status != expected)
    fail_msg("status %d (%s, %s)", status, jam_stop_string(r.stop_reason), status < 0 ? jam_last_error() : "");
  return r;
}

/* From positions, diameters, contacts and forces alone: no overlap over all images, forces balanced and positive,
 * contacts closed, rattlers without contacts, counts as reported. */
static void certify(const jam_system *sys, const jam_crunch_report *r, double tolerance) {
  const double *x, *s;
  size_t len, m = 0, k, i, j;
  int32_t *pairs, *z;
  double *n, *f, *total, worst_overlap = 0.0, mean = 0.0;
  int c, d;
  SIZED(jam_info, info);
  jam_get_info(sys, &info);
  d = info.dim;
  jam_view(sys, JAM_VIEW_POSITIONS, &x, &len), jam_view(sys, JAM_VIEW_DIAMETERS, &s, &len);
  assert_int_equal(jam_contacts(sys, NULL, 0, &m), JAM_OK);
  assert_int_equal(m, 2 * r->contacts);
  pairs = malloc((m + 1) * sizeof *pairs), z = malloc(info.n * sizeof *z);
  n = malloc((m * d + 1) * sizeof *n), f = malloc((m + 1) * sizeof *f), total = calloc(info.n * d, sizeof *total);
  assert_int_equal(jam_contacts(sys, pairs, m, NULL), JAM_OK);
  m /= 2;
  assert_int_equal(jam_contact_vectors(sys, n, m * d, NULL), JAM_OK);
  assert_int_equal(jam_forces(sys, f, m, NULL), JAM_OK);
  assert_int_equal(jam_coordination(sys, z, info.n, NULL), JAM_OK);
  for (k = 0; k < m; ++k) {
    assert_true(f[k] > 0.0);
    mean += f[k] / (double)m;
    for (c = 0; c < d; ++c) {
      total[pairs[2 * k] * d + c] += f[k] * n[k * d + c];
      total[pairs[2 * k + 1] * d + c] -= f[k] * n[k * d + c];
    }
    z[pairs[2 * k]]--, z[pairs[2 * k + 1]]--;
  }
  assert_true(m == 0 || fabs(mean - 1.0) < 1e-12);
  for (k = 0; k < (size_t)info.n; ++k) {
    double f2 = 0.0;
    for (c = 0; c < d; ++c) f2 += total[k * d + c] * total[k * d + c];
    assert_true(sqrt(f2) <= tolerance);
    assert_int_equal(z[k], 0);
  }
  for (i = 0; i < (size_t)info.n; ++i)
    for (j = 0; j < i; ++j) {
      double r2 = 0.0;
      for (c = 0; c < d; ++c) {
        double dx = x[i * d + c] - x[j * d + c];
        dx -= info.box * nearbyint(dx / info.box);
        r2 += dx * dx;
      }
      worst_overlap = fmax(worst_overlap, 1.0 - sqrt(r2) / (0.5 * (s[i] + s[j])));
    }
  assert_true(worst_overlap < 1e-12);
  assert_true(r->max_contact_gap < 1e-9);
  assert_int_equal(r->excess_contacts, r->contacts - (d * (r->stable - 1) + 1));
  free(pairs), free(z), free(n), free(f), free(total);
}

static jam_system *random_start(int64_t n, int dim, double phi, const double *diameters, size_t len, int64_t seed) {
  jam_system *sys;
  DEFAULTS(create, o);
  o.n = n, o.dim = dim, o.packing_fraction = phi, o.seed = seed;
  assert_int_equal(create_from(&o, NULL, 0, diameters, len, &sys), JAM_OK);
  return sys;
}

/* The real input: two independent programs give phi 0.643971236633, 3010 contacts, 20 rattlers, exactly 1SS. */
CASE(shared_file) {
  const char *path = JAM_TEST_SHARED "/ls-n1024-d3.dat";
  FILE *file = fopen(path, "r");
  jam_crunch_options o;
  jam_system *sys;
  jam_crunch_report r;
  int method;
  if (!file) {
    print_message("skipped: %s is not there\n", path);
    skip();
  }
  fclose(file);
  for (method = 0; method < 2; ++method) {
    assert_int_equal(jam_read(path, NULL, NULL, NULL, &sys), JAM_OK);
    jam_crunch_options_init(&o, sizeof o);
    o.method = method;
    r = crunch(sys, &o, JAM_OK);
    assert_true(r.jammed && r.excess_contacts == 0 && r.contacts == 3010 && r.rattlers == 20);
    assert_true(fabs(r.packing_fraction - 0.643971236633) < 1e-11);
    assert_true(r.force_residual < 1e-13 && r.max_overlap < 1e-14);
    certify(sys, &r, 1e-12);
    /* jammed input: nothing moves any more */
    r = crunch(sys, &o, JAM_OK);
    assert_true(r.contacts == 3010 && fabs(r.packing_fraction - 0.643971236633) < 1e-11);
    jam_destroy(sys);
  }
}

CASE(random_starts) {
  const struct {
    int n, dim;
    double phi, ratio;
  } cases[] = {{64, 3, 0.05, 1.0}, {128, 3, 0.2, 1.0}, {128, 2, 0.4, 1.4}, {64, 4, 0.1, 1.0},
               {64, 3, 0.2, 4.0},  {48, 5, 0.05, 1.0}, {100, 3, 0.1, 10.0}};
  size_t k;
  for (k = 0; k < sizeof cases / sizeof *cases; ++k) {
    double diameters[256];
    int i;
    jam_system *sys;
    jam_crunch_report r;
    for (i = 0; i < cases[k].n; ++i) diameters[i] = i % 2 ? 1.0 : cases[k].ratio;
    sys = random_start(cases[k].n, cases[k].dim, cases[k].phi, diameters, cases[k].n, 3);
    r = crunch(sys, NULL, JAM_OK);
    print_message("n %d d %d ratio %g: phi %.6f contacts %d rattlers %d excess %d LPs %d factorisations %d\n",
                  cases[k].n, cases[k].dim, cases[k].ratio, r.packing_fraction, (int)r.contacts, (int)r.rattlers,
                  (int)r.excess_contacts, (int)r.lp_solves, (int)r.factorisations);
    assert_true(r.jammed && r.excess_contacts >= 0);
    certify(sys, &r, 1e-10);
    jam_destroy(sys);
  }
}

/* cells^dim copies of a basis in the unit cube, diameters a little below contact. */
static jam_system *lattice(int dim, int cells, const double *basis, int basis_len, double contact, double shrink,
                           int vacancy) {
  const int total = basis_len * (dim == 2 ? cells * cells : cells * cells * cells);
  double *x = malloc(sizeof(double) * total * dim), sigma = contact / cells * shrink;
  jam_system *sys;
  int k, c, n = 0;
  for (k = 0; k < total; ++k) {
    int cell = k / basis_len, at[3];
    if (vacancy && k == total / 2) continue;
    at[0] = cell % cells, at[1] = cell / cells % cells, at[2] = cell / cells / cells;
    for (c = 0; c < dim; ++c) x[n * dim + c] = (at[c] + basis[k % basis_len * dim + c]) / cells;
    ++n;
  }
  {
    DEFAULTS(create, o);
    o.dim = dim;
    assert_int_equal(create_from(&o, x, (size_t)n * dim, &sigma, 1, &sys), JAM_OK);
  }
  free(x);
  return sys;
}

/* Crystals have more contacts than one state of self-stress needs: they are certified, and the excess is reported. */
CASE(crystals_are_certified_hyperstatic) {
  const double fcc[12] = {0, 0, 0, 0, .5, .5, .5, 0, .5, .5, .5, 0}, bcc[6] = {0, 0, 0, .5, .5, .5}, square[2] = {0, 0};
  int vacancy;
  for (vacancy = 0; vacancy < 2; ++vacancy) {
    jam_system *sys = lattice(3, 3, fcc, 4, sqrt(0.5), 0.98, vacancy);
    jam_crunch_report r = crunch(sys, NULL, JAM_OK);
    print_message("FCC vacancy %d: phi %.12f contacts %d excess %d\n", vacancy, r.packing_fraction, (int)r.contacts,
                  (int)r.excess_contacts);
    assert_true(r.jammed && r.excess_contacts > 0);
    if (!vacancy) assert_true(fabs(r.packing_fraction - 0.74048048969306) < 1e-12 && r.contacts == 6 * 108);
    certify(sys, &r, 1e-9);
    jam_destroy(sys);
  }
  {
    jam_system *sys = lattice(3, 3, bcc, 2, sqrt(0.75), 0.98, 0);
    jam_crunch_report r;
    memset(&r, 0, sizeof r);
    r.struct_size = sizeof r;
    /* BCC is a saddle: either held by symmetry at 0.6802 or left for something denser; never worse, never an error */
    assert_true(jam_crunch(sys, NULL, &r) >= 0);
    assert_true(r.packing_fraction > 0.6801747615 - 1e-9);
    jam_destroy(sys);
    sys = lattice(2, 6, square, 1, 1.0, 0.98, 0);
    memset(&r, 0, sizeof r);
    r.struct_size = sizeof r;
    assert_true(jam_crunch(sys, NULL, &r) >= 0);
    assert_true(r.packing_fraction > 0.7853981633974 - 1e-9);
    jam_destroy(sys);
  }
}

/* Forces of a hyperstatic packing are not unique: a vertex of the simplex leaves contacts without any, the analytic
 * centre none. Either way all that touch are contacts, and the forces are those of least norm: equal ones in FCC, where
 * all sum to zero. */
CASE(degenerate_forces) {
  const double fcc[12] = {0, 0, 0, 0, .5, .5, .5, 0, .5, .5, .5, 0};
  int solver;
  for (solver = JAM_LP_IPM; solver <= JAM_LP_CLP; ++solver) {
    jam_system *sys = lattice(3, 3, fcc, 4, sqrt(0.5), 0.98, 0);
    jam_crunch_report r;
    double f[648];
    int k;
    DEFAULTS(crunch, o);
    o.lp_solver = solver;
    r = crunch(sys, &o, JAM_OK);
    assert_true(r.jammed && r.contacts == 648 && r.rattlers == 0);
    assert_int_equal(jam_forces(sys, f, 648, NULL), JAM_OK);
    for (k = 0; k < 648; ++k) assert_true(fabs(f[k] - 1.0) < 1e-10); /* the lattice itself holds to about 1e-12 */
    jam_destroy(sys);
    sys = random_start(64, 3, 0.2, NULL, 0,
                       1); /* grown slowly enough to order: more contacts than one state of self-stress */
    assert_true(jam_compress(sys, NULL, NULL) >= 0);
    r = crunch(sys, &o, JAM_OK);
    assert_true(r.jammed && r.excess_contacts >= 0);
    certify(sys, &r, 1e-9);
    jam_destroy(sys);
  }
}

/* Boxes of one or two diameters: pairs meet through several images. */
CASE(small_boxes_with_several_images) {
  int n, d;
  for (d = 2; d <= 3; ++d)
    for (n = 2; n <= d + 2; ++n) {
      jam_system *sys = random_start(n, d, 0.1, NULL, 0, n);
      jam_crunch_report r;
      jam_status status;
      memset(&r, 0, sizeof r);
      r.struct_size = sizeof r;
      status = jam_crunch(sys, NULL, &r);
      print_message("n %d d %d: status %d %s phi %.9f contacts %d excess %d overlap %.1e\n", n, d, status,
                    jam_stop_string(r.stop_reason), r.packing_fraction, (int)r.contacts, (int)r.excess_contacts,
                    r.max_overlap);
      assert_true(status >= 0);
      assert_true(r.max_overlap < 1e-12);
      if (r.jammed) assert_true(r.excess_contacts >= 0 && r.force_residual < 1e-9);
      jam_destroy(sys);
    }
  {
    jam_system *one = random_start(1, 3, 0.1, NULL, 0, 1);
    crunch(one, NULL, JAM_E_TOO_FEW);
    jam_destroy(one);
  }
}

static int32_t stop_at(const jam_progress *p, void *user) {
  int *left = user;
  assert_true(p->struct_size == sizeof *p);
  return --*left <= 0;
}

/* A crunch cancelled at any moment leaves a valid state, and the next call continues from it. */
CASE(cancel_and_resume) {
  int calls, lps;
  jam_system *whole = random_start(100, 3, 0.3, NULL, 0, 5);
  DEFAULTS(crunch, lp_only);
  lp_only.method = JAM_CRUNCH_SEQUENTIAL_LP;
  lps = (int)crunch(whole, &lp_only, JAM_OK).lp_solves;
  jam_destroy(whole);
  assert_true(lps > 3);
  for (calls = 1; calls < lps; calls += 6) {
    jam_system *sys = random_start(100, 3, 0.3, NULL, 0, 5);
    int left = calls;
    jam_crunch_report r;
    const double *s;
    size_t len;
    DEFAULTS(crunch, o);
    o.method = JAM_CRUNCH_SEQUENTIAL_LP; /* it reports every LP */
    jam_set_progress(sys, stop_at, &left);
    r = crunch(sys, &o, JAM_CANCELLED);
    assert_true(!r.jammed && r.stop_reason == JAM_STOP_CANCELLED && r.max_overlap < 1e-12);
    if (r.contacts > 0)
      assert_int_equal(r.rattlers + r.stable, 100);
    else /* before the end of an LP they are unknown */
      assert_true(r.contacts == -1 && r.rattlers == -1 && r.stable == 0);
    jam_view(sys, JAM_VIEW_DIAMETERS, &s, &len);
    assert_true(s[0] > 0.0);
    jam_set_progress(sys, NULL, NULL);
    if (calls < 10) {
      r = crunch(sys, NULL, JAM_OK);
      certify(sys, &r, 1e-10);
    }
    jam_destroy(sys);
  }
}

/* A cancel with no call running stops the next verb, and only that one. */
CASE(a_cancel_stops_the_next_verb) {
  jam_system *sys = random_start(60, 3, 0.3, NULL, 0, 5);
  assert_int_equal(jam_cancel(sys), JAM_OK);
  assert_int_equal(jam_set_progress(sys, NULL, NULL), JAM_OK);
  assert_int_equal(jam_scale_diameters(sys, 0.99), JAM_OK);
  crunch(sys, NULL, JAM_CANCELLED);
  crunch(sys, NULL, JAM_OK);
  jam_destroy(sys);
}

CASE(limits_and_options) {
  jam_system *sys = random_start(100, 3, 0.3, NULL, 0, 5);
  jam_crunch_report r;
  size_t needed;
  assert_int_equal(jam_forces(sys, NULL, 0, &needed), JAM_E_STATE);
  DEFAULTS(crunch, o);
  o.max_lps = 0;
  crunch(sys, &o, JAM_E_ARGUMENT);
  assert_non_null(strstr(jam_last_error(), "max_lps is 0"));
  o.max_lps = 2, o.method = JAM_CRUNCH_SEQUENTIAL_LP;
  r = crunch(sys, &o, JAM_LIMIT);
  assert_true(r.lp_solves == 2 && r.stop_reason == JAM_STOP_LP_LIMIT && !r.jammed);
  o.lp_solver = 9;
  crunch(sys, &o, JAM_E_ARGUMENT);
  o.lp_solver = 0, o.gain_tolerance = NAN;
  crunch(sys, &o, JAM_E_ARGUMENT);
  o.gain_tolerance = 1e-12, o.wall_time = 1e-9, o.max_lps = 100;
  r = crunch(sys, &o, JAM_LIMIT);
  assert_int_equal(r.stop_reason, JAM_STOP_WALL_TIME);
  jam_destroy(sys);
}

static void *crunch_thread(void *user) {
  jam_crunch_report r;
  memset(&r, 0, sizeof r);
  r.struct_size = sizeof r;
  return (void *)(intptr_t)(jam_crunch((jam_system *)user, NULL, &r) == JAM_OK);
}

/* Two handles on two threads and one alone: the same bits. */
CASE(threads_and_determinism) {
  jam_system *sys[3];
  pthread_t thread[2];
  const double *x[3];
  size_t len;
  int k;
  void *ok;
  for (k = 0; k < 3; ++k) sys[k] = random_start(150, 3, 0.3, NULL, 0, 8);
  for (k = 0; k < 2; ++k) pthread_create(&thread[k], NULL, crunch_thread, sys[k]);
  for (k = 0; k < 2; ++k) {
    pthread_join(thread[k], &ok);
    assert_true(ok != NULL);
  }
  assert_non_null(crunch_thread(sys[2]));
  for (k = 0; k < 3; ++k) jam_view(sys[k], JAM_VIEW_POSITIONS, &x[k], &len);
  assert_memory_equal(x[0], x[2], len * sizeof(double));
  assert_memory_equal(x[1], x[2], len * sizeof(double));
  for (k = 0; k < 3; ++k) jam_destroy(sys[k]);
}

/* Tolerances are in diameters: the same packing in a box a thousand times larger gives the same numbers. */
CASE(box_does_not_matter) {
  jam_system *small = random_start(100, 3, 0.3, NULL, 0, 4), *large;
  jam_crunch_report a, b;
  const double *x, *s;
  double y[300], t[100];
  size_t len, k;
  jam_view(small, JAM_VIEW_POSITIONS, &x, &len);
  for (k = 0; k < 300; ++k) y[k] = x[k] * 1024.0;
  jam_view(small, JAM_VIEW_DIAMETERS, &s, &len);
  for (k = 0; k < 100; ++k) t[k] = s[k] * 1024.0;
  DEFAULTS(create, o);
  o.box = 1024.0;
  assert_int_equal(create_from(&o, y, 300, t, 100, &large), JAM_OK);
  a = crunch(small, NULL, JAM_OK);
  b = crunch(large, NULL, JAM_OK);
  assert_int_equal(a.contacts, b.contacts);
  assert_true(fabs(a.packing_fraction - b.packing_fraction) < 1e-12);
  jam_destroy(small);
  jam_destroy(large);
}
