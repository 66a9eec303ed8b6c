/* jam_crunch from every kind of start, each result certified here from positions, sizes, pairs and forces alone:
 * densities and pressures, few spheres in small boxes, lattices with a vacancy, jammed input, a packing of another
 * program. What a crunch does not depend on: another thread, the unit of length. */
#include <math.h>
#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>

#include "systems.h"

/* Smallest gap over all pairs and images out to `reach` boxes, own images too. */
static double smallest_gap(const jam_system *sys, int reach) {
  const double *x, *s;
  size_t n;
  double least = INFINITY;
  const jam_info info = info_of(sys);
  x = view_of(sys, JAM_VIEW_POSITIONS), jam_view(sys, JAM_VIEW_DIAMETERS, &s, &n);
  for (size_t i = 0; i < n; ++i)
    for (size_t j = 0; j <= i; ++j) {
      int code, count = 1, k;
      for (k = 0; k < info.dim; ++k) count *= 2 * reach + 1;
      for (code = 0; code < count; ++code) {
        double r2 = 0.0;
        int rest = code, own = i == j;
        for (k = 0; k < info.dim; ++k, rest /= 2 * reach + 1) {
          const int shift = rest % (2 * reach + 1) - reach;
          double dx = x[i * info.dim + k] - x[j * info.dim + k];
          dx += (shift - nearbyint(dx / info.box)) * info.box;
          own = own && shift == 0;
          r2 += dx * dx;
        }
        if (!own) least = fmin(least, sqrt(r2) / (0.5 * (s[i] + s[j])) - 1.0);
      }
    }
  return least;
}

/* Every claim of the report that follows from the packing: no overlap; when jammed, closed contacts, positive balanced
 * forces, at least one state of self-stress, every stable sphere with d + 1 contacts or more. */
static void certify(const jam_system *sys, const jam_crunch_report *r, int reach) {
  const double *x, *s;
  size_t m = 0, k;
  int32_t *pair, *z;
  double *v, *f, *total, mean = 0.0;
  int c, d, stable = 0;
  assert_true(smallest_gap(sys, reach) > -1e-12);
  if (!r->jammed) return;
  SIZED(jam_info, info);
  jam_get_info(sys, &info), d = info.dim;
  x = view_of(sys, JAM_VIEW_POSITIONS), s = view_of(sys, JAM_VIEW_DIAMETERS);
  jam_contacts(sys, NULL, 0, &m);
  pair = malloc(m * sizeof *pair), z = calloc(info.n, sizeof *z), m /= 2;
  v = malloc(m * d * sizeof *v), f = malloc(m * sizeof *f), total = calloc(info.n * d, sizeof *total);
  assert_int_equal(jam_contacts(sys, pair, 2 * m, NULL), JAM_OK);
  assert_int_equal(jam_contact_vectors(sys, v, m * d, NULL), JAM_OK);
  assert_int_equal(jam_forces(sys, f, m, NULL), JAM_OK);
  for (k = 0; k < m; ++k) {
    const int32_t i = pair[2 * k], j = pair[2 * k + 1];
    const double sigma = 0.5 * (s[i] + s[j]);
    assert_true(f[k] > 0.0);
    mean += f[k] / (double)m;
    ++z[i], ++z[j];
    for (c = 0; c < d; ++c) { /* the contact is where the vector says, up to whole boxes */
      double rest = (x[i * d + c] - x[j * d + c] - sigma * v[k * d + c]) / info.box;
      assert_true(fabs(rest - nearbyint(rest)) < 1e-9);
      total[i * d + c] += f[k] * v[k * d + c], total[j * d + c] -= f[k] * v[k * d + c];
    }
  }
  assert_true(fabs(mean - 1.0) < 1e-12);
  for (k = 0; k < (size_t)(info.n * d); ++k) assert_true(fabs(total[k]) < 1e-10);
  for (k = 0; k < (size_t)info.n; ++k) {
    stable += z[k] > 0;
    assert_true(z[k] == 0 || z[k] > d);
  }
  assert_int_equal(r->excess_contacts, (int64_t)m - (d * (stable - 1) + 1));
  assert_true(r->excess_contacts >= 0);
  free(pair), free(z), free(v), free(f), free(total);
}

static jam_system *random_start(int n, int dim, double phi, const double *sizes, int64_t seed) {
  DEFAULTS(create, o);
  o.n = n, o.dim = dim, o.packing_fraction = phi, o.seed = seed;
  return created_from(&o, NULL, 0, sizes, sizes ? n : 0);
}

static jam_crunch_report crunched(jam_system *sys, const jam_crunch_options *o, const char *what, double value,
                                  int must_jam) {
  SIZED(jam_crunch_report, r);
  jam_status status;
  status = jam_crunch(sys, o, &r);
  print_message("%s %g: status %d, phi %.6f, contacts %d, excess %d, rattlers %d, LPs %d, factorisations %d\n", what,
                value, status, r.packing_fraction, (int)r.contacts, (int)r.excess_contacts, (int)r.rattlers,
                (int)r.lp_solves, (int)r.factorisations);
  if (status < 0 || (must_jam && !r.jammed))
    fail_msg("status %d (%s) %s", status, jam_stop_string(r.stop_reason), status < 0 ? jam_last_error() : "");
  certify(sys, &r, 1);
  return r;
}

/* From a hundredth of the jammed volume to nearly all of it, d = 2..5; denser than random placement goes by growth. */
CASE(densities) {
  const struct {
    int dim, n;
    double phi[5];
  } starts[] = {{2, 60, {0.05, 0.3, 0.5, 0.7, 0.8}},
                {3, 60, {0.05, 0.2, 0.35, 0.5, 0.6}},
                {4, 50, {0.02, 0.05, 0.15, 0.3, 0.4}},
                {5, 50, {0.01, 0.05, 0.1, 0.2, 0.25}}};
  double sizes[64];
  for (int k = 0; k < 64; ++k) sizes[k] = k % 2 ? 1.0 : 1.4; /* in d = 2 equal disks would order */
  for (int k = 0; k < 4; ++k)
    for (int q = 0; q < 5; ++q) {
      const double phi = starts[k].phi[q], random_phi = phi > 0.5 / (1 << (starts[k].dim - 2)) ? starts[k].phi[1] : phi;
      OWNED jam_system *sys =
          random_start(starts[k].n, starts[k].dim, random_phi, starts[k].dim == 2 ? sizes : NULL, 3 + q);
      if (random_phi < phi) {
        DEFAULTS(compress, c);
        c.growth_rate = 0.1, c.packing_fraction = phi, c.pressure = 1e12;
        assert_int_equal(jam_compress(sys, &c, NULL), JAM_OK);
      }
      assert_true(crunched(sys, NULL, "density", phi, 1).packing_fraction > phi);
    }
}

/* A fluid, and a packing that has grown until doubles hold no smaller gaps. */
CASE(pressures) {
  for (int k = 0; k < 2; ++k) {
    OWNED jam_system *sys = random_start(60, 3, 0.3, NULL, 2);
    DEFAULTS(compress, c);
    c.growth_rate = k ? 1e-3 : 1e-2, c.pressure = k ? 1e12 : 10.0;
    assert_true(jam_compress(sys, &c, NULL) >= 0);
    crunched(sys, NULL, "pressure", c.pressure, 1);
  }
}

/* A fast-grown state has gaps of 1e-7 although spheres must still move by 1e-3. The gaps look jammed, but LPs would
 * gain little per step, so the barrier path takes over. From a slowly grown state LPs finish alone. */
CASE(fast_grown_states_take_the_path) {
  const double growth[] = {3e-3, 1e-3};
  for (int k = 0; k < 2; ++k) {
    OWNED jam_system *sys = random_start(256, 3, 0.2, NULL, 5); /* of other seeds half are too far for LPs alone */
    jam_crunch_report r;
    DEFAULTS(compress, c);
    c.growth_rate = 1e-2, c.pressure = 500.0;
    assert_true(jam_compress(sys, &c, NULL) >= 0);
    c.growth_rate = growth[k], c.pressure = 1e7;
    assert_true(jam_compress(sys, &c, NULL) >= 0);
    r = crunched(sys, NULL, "growth rate", growth[k], 1);
    assert_int_equal(r.method, k == 0 ? JAM_CRUNCH_BARRIER_PATH : JAM_CRUNCH_SEQUENTIAL_LP);
    assert_int_equal(r.excess_contacts, 0);
  }
}

/* Two spheres and a few more: boxes of one to three diameters, several images of a pair. Checked over all images. */
CASE(small_boxes) {
  for (int dim = 2; dim <= 4; ++dim)
    for (int n = dim < 4 ? 2 : dim + 1; n <= 3 * dim + 4; n += n <= dim ? 1 : dim + 1) {
      OWNED jam_system *sys = random_start(n, dim, dim == 2 ? 0.3 : dim == 3 ? 0.15 : 0.06, NULL, n);
      jam_crunch_report r = crunched(sys, NULL, "spheres", n, 0);
      assert_true(smallest_gap(sys, 2) > -1e-12);
      assert_true(r.packing_fraction > 0.06);
    }
}

/* cells^dim copies of a basis, spheres a little below contact, one missing if asked. */
static jam_system *lattice(int dim, int cells, const double *basis, int basis_len, double contact, int vacancy) {
  const double sigma = 0.98 * contact / cells;
  const int total = basis_len * (dim == 2 ? cells * cells : cells * cells * cells);
  double x[3 * 300];
  int k, c, n = 0;
  for (k = 0; k < total; ++k) {
    int cell = k / basis_len;
    if (vacancy && k == total / 2) continue;
    for (c = 0; c < dim; ++c, cell /= cells) x[n * dim + c] = (cell % cells + basis[k % basis_len * dim + c]) / cells;
    ++n;
  }
  DEFAULTS(create, o);
  o.dim = dim;
  return created_from(&o, x, (size_t)n * dim, &sigma, 1);
}

static const double fcc[12] = {0, 0, 0, 0, .5, .5, .5, 0, .5, .5, .5, 0};

/* Degenerate LPs with and without a vacancy: a certified state that is no less dense than the lattice, and its excess.
 */
CASE(lattices) {
  const double square[2] = {0, 0}, bcc[6] = {0, 0, 0, .5, .5, .5};
  for (int vacancy = 0; vacancy < 2; ++vacancy) {
    jam_system *sys = lattice(2, 6, square, 1, 1.0, vacancy);
    jam_crunch_report r = crunched(sys, NULL, "square", vacancy, 0);
    assert_true(r.packing_fraction > 0.785398163397 * (36 - vacancy) / 36.0 - 1e-9);
    jam_destroy(sys);
    sys = lattice(3, 3, bcc, 2, sqrt(0.75), vacancy);
    r = crunched(sys, NULL, "BCC", vacancy, 0);
    assert_true(r.packing_fraction > 0.680174761 * (54 - vacancy) / 54.0 - 1e-9);
    jam_destroy(sys);
    sys = lattice(3, 3, fcc, 4, sqrt(0.5), vacancy);
    r = crunched(sys, NULL, "FCC", vacancy, 1);
    assert_true(r.excess_contacts > 0 && r.packing_fraction > 0.7404804896 * (108 - vacancy) / 108.0 - 1e-9);
    if (!vacancy) assert_true(fabs(r.packing_fraction - 0.74048048969306) < 1e-12 && r.contacts == 6 * 108);
    jam_destroy(sys);
  }
}

/* Forces of a hyperstatic packing are not unique: a vertex of the simplex leaves contacts without any, the analytic
 * centre none. Either way all that touch are contacts, and the forces are those of least norm: equal ones in FCC, where
 * all sum to zero. */
CASE(degenerate_forces) {
  for (int solver = JAM_LP_IPM; solver <= JAM_LP_CLP; ++solver) {
    jam_system *sys = lattice(3, 3, fcc, 4, sqrt(0.5), 0);
    jam_crunch_report r;
    double f[648];
    DEFAULTS(crunch, o);
    o.lp_solver = solver;
    r = crunched(sys, &o, "FCC, solver", solver, 1);
    assert_true(r.contacts == 648 && r.rattlers == 0);
    assert_int_equal(jam_forces(sys, f, 648, NULL), JAM_OK);
    for (int k = 0; k < 648; ++k) assert_true(fabs(f[k] - 1.0) < 1e-10); /* the lattice itself holds to about 1e-12 */
    jam_destroy(sys);
    sys = random_start(64, 3, 0.2, NULL, 1); /* grown slowly enough to order: more contacts than one state needs */
    assert_true(jam_compress(sys, NULL, NULL) >= 0);
    crunched(sys, &o, "slow growth, solver", solver, 1);
    jam_destroy(sys);
  }
}

/* A jammed packing again: one LP, nothing moves, the same contacts and forces, whatever the method. */
CASE(jammed_input) {
  for (int method = 0; method < 2; ++method) {
    OWNED jam_system *sys = random_start(80, 3, 0.3, NULL, 6);
    jam_crunch_report first, again;
    double f[400], g[400];
    size_t m;
    DEFAULTS(crunch, o);
    o.method = method;
    first = crunched(sys, &o, "method", method, 1);
    assert_int_equal(first.excess_contacts, 0);
    assert_int_equal(jam_forces(sys, f, 400, &m), JAM_OK);
    again = crunched(sys, &o, "again, method", method, 1);
    assert_int_equal(again.lp_solves, 1);
    assert_int_equal(again.method, JAM_CRUNCH_SEQUENTIAL_LP); /* LPs alone, whatever was asked for */
    assert_true(again.gain < 1e-12 && again.max_step < 1e-9 && again.contacts == first.contacts);
    assert_true(fabs(again.packing_fraction - first.packing_fraction) < 1e-13);
    assert_int_equal(jam_forces(sys, g, 400, &m), JAM_OK);
    for (size_t k = 0; k < m; ++k)
      assert_true(fabs(f[k] - g[k]) < 1e-6); /* the condition of the contact matrix times rounding */
  }
}

/* The real input: two independent programs give phi 0.643971236633, 3010 contacts, 20 rattlers, exactly 1SS. */
CASE(shared_file) {
  const char *path = JAM_TEST_SHARED "/ls-n1024-d3.dat";
  FILE *file = fopen(path, "r");
  jam_system *sys;
  jam_crunch_report r;
  if (!file) {
    print_message("skipped: %s is not there\n", path);
    skip();
  }
  fclose(file);
  for (int method = 0; method < 2; ++method) {
    assert_int_equal(jam_read(path, NULL, NULL, NULL, &sys), JAM_OK);
    DEFAULTS(crunch, o);
    o.method = method;
    r = crunched(sys, &o, "file, method", method, 1);
    assert_true(r.excess_contacts == 0 && r.contacts == 3010 && r.rattlers == 20);
    assert_true(fabs(r.packing_fraction - 0.643971236633) < 1e-11);
    assert_true(r.force_residual < 1e-13 && r.max_overlap < 1e-14);
    jam_destroy(sys);
  }
}

static void *crunch_thread(void *user) { return (void *)(intptr_t)(jam_crunch(user, NULL, NULL) == JAM_OK); }

/* Two handles on two threads and one alone: the same bits. */
CASE(threads_and_determinism) {
  jam_system *sys[3];
  pthread_t thread[2];
  void *ok;
  for (int k = 0; k < 3; ++k) sys[k] = random_start(150, 3, 0.3, NULL, 8);
  for (int k = 0; k < 2; ++k) pthread_create(&thread[k], NULL, crunch_thread, sys[k]);
  for (int k = 0; k < 2; ++k) {
    pthread_join(thread[k], &ok);
    assert_true(ok != NULL);
  }
  assert_non_null(crunch_thread(sys[2]));
  for (int k = 0; k < 2; ++k) same_view(sys[k], sys[2], JAM_VIEW_POSITIONS);
  for (int k = 0; k < 3; ++k) jam_destroy(sys[k]);
}

/* Tolerances are in diameters: the same packing in a box a thousand times larger gives the same numbers. */
CASE(box_does_not_matter) {
  jam_crunch_report r[2];
  for (int k = 0; k < 2; ++k) {
    DEFAULTS(create, o);
    o.n = 100, o.packing_fraction = 0.3, o.seed = 4, o.box = k ? 1024.0 : 1.0;
    OWNED jam_system *sys = created(&o);
    r[k].struct_size = sizeof r[k];
    assert_int_equal(jam_crunch(sys, NULL, &r[k]), JAM_OK);
  }
  assert_int_equal(r[0].contacts, r[1].contacts);
  assert_true(fabs(r[0].packing_fraction - r[1].packing_fraction) < 1e-12);
}
