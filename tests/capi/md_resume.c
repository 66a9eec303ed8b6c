/* Stages that stop early, by any reason, and go on, in the same process or from a file: the same bits as one that ran
 * through. */
#include <math.h>
#include <time.h>

#include "steps.h"

/* cell: its vectors (dim, dim), or NULL for the cube. */
static jam_system *make_in(const double *cell, int32_t model, int32_t dim, int64_t n, double fraction) {
  jam_system *sys = NULL;
  DEFAULTS(create, o);
  o.n = n;
  o.dim = dim;
  o.model = model;
  o.packing_fraction = fraction;
  o.masses = dim == 2 ? JAM_MASSES_VOLUME : JAM_MASSES_EQUAL;
  if (cell) {
    assert_int_equal(create_in_cell(&o, cell, (size_t)(dim * dim), NULL, 0, NULL, 0, &sys), JAM_OK);
  } else if (dim == 2) {
    double diameters[200];
    for (int64_t k = 0; k < n; ++k) diameters[k] = k % 2 ? 1.0 : 1.4;
    assert_int_equal(create_from(&o, NULL, 0, diameters, (size_t)n, &sys), JAM_OK);
  } else {
    assert_int_equal(jam_create(&o, NULL, &sys), JAM_OK);
  }
  return sys;
}

static jam_system *make(int32_t model, int32_t dim, int64_t n, double fraction) {
  return make_in(NULL, model, dim, n, fraction);
}

/* The stage is that of a file, or of a copy. */
static void move(jam_system **sys, int with_file) {
  jam_system *const again = with_file ? from_checkpoint(*sys) : copy_of(*sys);
  jam_destroy(*sys);
  assert_true(info_of(again).paused != 0);
  *sys = again;
}

static const double monoclinic[9] = {1.0, 0.0, 0.0, 0.0, 1.3, 0.0, 0.4, 0.0, 0.8};

/* Euclidean with lists, with images (few spheres), Mari-Kurchan, mixture with masses; diameter and density rates;
 * slowing down; a cell that is no cube, with cells of neighbours, with few spheres, Mari-Kurchan. */
static const struct {
  int32_t model, dim;
  int64_t n;
  double fraction, growth, end, pressure;
  int32_t law;
  const double *cell;
} cases[] = {{JAM_MODEL_EUCLID, 3, 150, 0.05, 1e-2, 0, 1e4, JAM_GROWTH_DIAMETER, NULL},
             {JAM_MODEL_EUCLID, 3, 6, 0.1, 2e-2, 0, 1e3, JAM_GROWTH_DIAMETER, NULL},
             {JAM_MODEL_MK, 3, 100, 1.5, 1e-2, 0, 1e3, JAM_GROWTH_DIAMETER, NULL},
             {JAM_MODEL_EUCLID, 2, 120, 0.4, 2e-2, 2e-3, 1e4, JAM_GROWTH_DENSITY, NULL},
             {JAM_MODEL_EUCLID, 3, 150, 0.05, 1e-2, 0, 1e4, JAM_GROWTH_DIAMETER, monoclinic},
             {JAM_MODEL_EUCLID, 3, 10, 0.1, 2e-2, 0, 1e3, JAM_GROWTH_DENSITY, monoclinic},
             {JAM_MODEL_MK, 3, 60, 1.5, 1e-2, 0, 1e3, JAM_GROWTH_DIAMETER, monoclinic}};
enum { CASES = sizeof cases / sizeof cases[0] };

static jam_compress_options options_of(int k) {
  DEFAULTS(compress, c);
  c.growth_rate = cases[k].growth;
  c.growth_rate_end = cases[k].end;
  c.pressure = cases[k].pressure;
  c.growth_law = cases[k].law;
  return c;
}

CASE(growth_goes_on_to_the_same_bits) {
  for (int k = 0; k < CASES; ++k) {
    OWNED jam_system *whole = make_in(cases[k].cell, cases[k].model, cases[k].dim, cases[k].n, cases[k].fraction);
    jam_compress_options c = options_of(k);
    jam_md_report report, part;
    report.struct_size = part.struct_size = sizeof report;
    assert_int_equal(jam_compress(whole, &c, &report), JAM_OK);
    for (int with_file = 0; with_file < 2; ++with_file) {
      OWNED jam_system *sys = make_in(cases[k].cell, cases[k].model, cases[k].dim, cases[k].n, cases[k].fraction);
      jam_status status;
      int64_t collisions = 0;
      int stops = 0, left = 12;
      c = options_of(k);
      do { /* at first a limit on collisions that grows, not by whole windows, or on time; then none */
        if (--left > 0 && left % 3)
          c.collisions_per_particle = 0.7 + 7.3 * stops * stops;
        else if (left > 0)
          c.collisions_per_particle = INFINITY, c.time = report.time * 0.08 * (stops + 1);
        else
          c.collisions_per_particle = c.time = INFINITY;
        status = jam_compress(sys, &c, &part);
        collisions += part.collisions;
        c.resume = 1;
        if (status == JAM_LIMIT) move(&sys, with_file);
        ++stops;
        if (left > 0 && left % 3 == 0) c.time = INFINITY;
      } while (status == JAM_LIMIT);
      assert_int_equal(status, JAM_OK);
      assert_true(stops > 5);
      print_message("case %d, file %d: %d stops, %lld collisions of %lld\n", k, with_file, stops, (long long)collisions,
                    (long long)report.collisions);
      same(whole, sys);
      assert_true(part.pressure == report.pressure && part.packing_fraction == report.packing_fraction);
      assert_int_equal(collisions, report.collisions);
    }
  }
}

struct writer {
  const jam_system *sys;
  double fraction, pressure; /* beyond which it makes a checkpoint, once */
  jam_system *made;
};

static int32_t make_once(const jam_progress *p, void *user) {
  struct writer *w = user;
  if ((p->fraction > w->fraction || p->pressure > w->pressure) && !w->made) w->made = from_checkpoint(w->sys);
  return 0;
}

/* A checkpoint that the callback writes, while the call goes on, leads to the same end: also while the spheres grow,
 * where the callback comes at the end of a window of the pressure too. */
CASE(checkpoints_of_the_callback_go_on) {
  for (int growth = 0; growth < 2; ++growth) {
    OWNED jam_system *sys = make(JAM_MODEL_EUCLID, 3, 500, 0.3);
    struct writer w = {sys, growth ? INFINITY : 0.2, growth ? 20.0 : INFINITY, NULL};
    SIZED(jam_md_report, one);
    SIZED(jam_md_report, two);
    DEFAULTS(run, r);
    DEFAULTS(compress, c);
    r.collisions_per_particle = 1500.0;
    c.growth_rate = 1e-2, c.pressure = 1e4;
    jam_set_progress(sys, make_once, &w);
    assert_int_equal(growth ? jam_compress(sys, &c, &one) : jam_run(sys, &r, &one), JAM_OK);
    assert_non_null(w.made);
    r.resume = c.resume = 1;
    c.collisions_per_particle = 1e6; /* a run that never ends its windows ends here */
    assert_int_equal(growth ? jam_compress(w.made, &c, &two) : jam_run(w.made, &r, &two), JAM_OK);
    same(sys, w.made);
    assert_true(two.pressure == one.pressure);
    jam_destroy(w.made);
  }
}

struct copies {
  const jam_system *sys;
  int count;
  jam_system *made[12];
};

/* It waits, so that the next look of the library calls it, wherever that is. */
static int32_t copy_and_wait(const jam_progress *p, void *user) {
  struct copies *c = user;
  const struct timespec silence = {0, 110000000};
  (void)p;
  if (c->count == 12) return 0;
  c->made[c->count++] = from_checkpoint(c->sys);
  nanosleep(&silence, NULL);
  return 0;
}

/* Wherever the callback comes, the checkpoint that it writes leads to the same end: also where lists are made again,
 * and where few spheres grow until an engine with images takes over. */
CASE(checkpoints_of_every_look_go_on) {
  for (int kind = 0; kind < 3; ++kind) {
    OWNED jam_system *sys = make(JAM_MODEL_EUCLID, 3, kind == 2 ? 10 : 1000, kind == 2 ? 0.05 : 0.3);
    struct copies c = {sys, 0, {NULL}};
    DEFAULTS(run, r);
    DEFAULTS(compress, o);
    r.collisions_per_particle = 300.0;
    o.growth_rate = 1e-1, o.pressure = kind == 2 ? 1e3 : 100.0;
    jam_set_progress(sys, copy_and_wait, &c);
    assert_int_equal(kind ? jam_compress(sys, &o, NULL) : jam_run(sys, &r, NULL), JAM_OK);
    assert_true(c.count > 0);
    r.resume = o.resume = 1;
    for (int k = 0; k < c.count; ++k) {
      assert_int_equal(kind ? jam_compress(c.made[k], &o, NULL) : jam_run(c.made[k], &r, NULL), JAM_OK);
      same(sys, c.made[k]);
      jam_destroy(c.made[k]);
    }
  }
}

/* A simple cubic lattice of touching spheres, or a fluid. */
static jam_system *lattice_or_fluid(int touching) {
  double x[3 * 216];
  const double one = 1.0;
  if (!touching) return random_spheres(3, 64, 0.2, 3);
  for (int k = 0; k < 216; ++k) x[3 * k] = k % 6, x[3 * k + 1] = k / 6 % 6, x[3 * k + 2] = k / 36;
  DEFAULTS(create, o);
  o.n = 216, o.box = 6.0;
  return created_from(&o, x, 648, &one, 1);
}

/* What a stage came to does not depend on how many calls it took: spheres that touch at the start do so in every part,
 * and growth that ends soon after a pause did not begin at contact. */
CASE(parts_have_the_verdict_of_the_whole) {
  for (int touching = 0; touching < 2; ++touching)
    for (int with_file = 0; with_file < 2; ++with_file) {
      OWNED jam_system *whole = lattice_or_fluid(touching), *sys = lattice_or_fluid(touching);
      const double n = (double)info_of(sys).n;
      SIZED(jam_md_report, report);
      DEFAULTS(compress, c);
      c.growth_rate = 1e-2, c.pressure = 1e5;
      const jam_status expected = jam_compress(whole, &c, &report);
      assert_true((expected == JAM_OK) == !touching);
      if (touching) assert_non_null(strstr(jam_last_error(), "touch at the start"));
      if (touching)
        c.wall_time = 1e-9;
      else
        c.collisions_per_particle = 2.0 * (double)report.collisions / n - 8.0;
      assert_int_equal(jam_compress(sys, &c, NULL), JAM_LIMIT);
      move(&sys, with_file);
      c.collisions_per_particle = c.wall_time = INFINITY, c.resume = 1;
      assert_int_equal(jam_compress(sys, &c, NULL), expected);
      if (touching) assert_non_null(strstr(jam_last_error(), "touch at the start"));
      same(whole, sys);
    }
}

static int32_t stop_late(const jam_progress *p, void *user) { return p->collisions > *(const int64_t *)user; }

/* Windows are planned for the first call, which here is a short one. */
CASE(long_runs_can_be_kept) {
  const double x[4] = {0.2, 0.2, 0.7, 0.7}, size = 0.25;
  int64_t enough = 4500000;
  DEFAULTS(create, o);
  o.dim = 2, o.n = 2;
  OWNED jam_system *sys = created_from(&o, x, 4, &size, 1);
  SIZED(jam_md_report, report);
  DEFAULTS(run, r);
  r.collisions_per_particle = 80.0, r.wall_time = 1e-9;
  assert_int_equal(jam_run(sys, &r, NULL), JAM_LIMIT);
  r.resume = 1, r.collisions_per_particle = 1e9, r.wall_time = INFINITY;
  jam_set_progress(sys, stop_late, &enough);
  assert_int_equal(jam_run(sys, &r, &report), JAM_CANCELLED);
  assert_true(report.pressure_error > 0.0 && report.pressure_error < 0.01 * report.pressure);
  jam_set_progress(sys, NULL, NULL);
  OWNED jam_system *back = from_checkpoint(sys);
  r.collisions_per_particle = (double)report.collisions + 1000.0;
  assert_int_equal(jam_run(sys, &r, NULL), JAM_OK);
  assert_int_equal(jam_run(back, &r, NULL), JAM_OK);
  same(sys, back);
}

CASE(finished_stages_cannot_be_resumed) {
  OWNED jam_system *sys = make(JAM_MODEL_EUCLID, 3, 100, 0.3);
  DEFAULTS(run, r);
  DEFAULTS(compress, c);
  r.resume = c.resume = 1;
  assert_int_equal(jam_run(sys, &r, NULL), JAM_E_STATE);
  assert_int_equal(jam_compress(sys, &c, NULL), JAM_E_STATE);
  c.resume = 0;
  c.collisions_per_particle = 3;
  assert_int_equal(jam_compress(sys, &c, NULL), JAM_LIMIT);
  assert_int_equal(info_of(sys).paused, JAM_PHASE_COMPRESS);
  assert_int_equal(jam_run(sys, &r, NULL), JAM_E_STATE); /* the other verb */
  assert_int_equal(info_of(sys).paused, JAM_PHASE_COMPRESS);
  assert_int_equal(jam_set_velocities(sys, view_of(sys, JAM_VIEW_VELOCITIES), 300),
                   JAM_OK); /* re-aimed: another future */
  assert_int_equal(info_of(sys).paused, 0);
  assert_int_equal(jam_compress(sys, &c, NULL), JAM_LIMIT);
  assert_int_equal(jam_scale_diameters(sys, 0.9), JAM_OK);
  assert_int_equal(info_of(sys).paused, 0);
  assert_int_equal(jam_compress(sys, &c, NULL), JAM_LIMIT);
  r.resume = 0;
  assert_int_equal(jam_run(sys, &r, NULL), JAM_OK);
  assert_int_equal(info_of(sys).paused, 0);
  r.resume = 2;
  assert_int_equal(jam_run(sys, &r, NULL), JAM_E_ARGUMENT);
}

/* What a stage has been begun with cannot be changed by a call that resumes it. */
CASE(other_growth_is_not_resumed) {
  OWNED jam_system *sys = make(JAM_MODEL_EUCLID, 3, 100, 0.3);
  jam_compress_options c, o[5];
  const char *name[5] = {"growth_rate", "growth_rate_end", "growth_law", "pressure", "packing_fraction"};
  jam_compress_options_init(&c, sizeof c);
  c.growth_rate = 1e-2, c.growth_rate_end = 1e-3, c.pressure = 1e3;
  c.collisions_per_particle = 3;
  assert_int_equal(jam_compress(sys, &c, NULL), JAM_LIMIT);
  c.resume = 1, c.collisions_per_particle = 6;
  for (int k = 0; k < 5; ++k) o[k] = c;
  o[0].growth_rate = 0.1, o[1].growth_rate_end = 2e-3, o[2].growth_law = JAM_GROWTH_DENSITY;
  o[3].pressure = 1e4, o[4].packing_fraction = 0.6;
  for (int k = 0; k < 5; ++k) {
    SAYS(jam_compress(sys, &o[k], NULL), JAM_E_ARGUMENT, name[k]);
    assert_int_equal(info_of(sys).paused, JAM_PHASE_COMPRESS);
  }
  assert_int_equal(jam_compress(sys, &c, NULL), JAM_LIMIT);
  jam_compress_options_init(&c, sizeof c);
  c.resume = 1, c.collisions_per_particle = 9;
  assert_int_equal(jam_compress(sys, &c, NULL), JAM_LIMIT);
  c.resume = 0; /* the protocol: its pressure is that of the last stage */
  c.pressure = 1e4;
  assert_int_equal(jam_compress(sys, &c, NULL), JAM_LIMIT);
  c.resume = 1, c.collisions_per_particle = 12;
  assert_int_equal(jam_compress(sys, &c, NULL), JAM_LIMIT);
  c.pressure = 1e5;
  assert_int_equal(jam_compress(sys, &c, NULL), JAM_E_ARGUMENT);
}
