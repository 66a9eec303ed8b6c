/* Stages that stop early, by any reason, and go on, in the same process or from a file: the same bits as one that ran
 * through. */
#include <math.h>
#include <stdio.h>

#include "steps.h"

static const char *path = "md_resume_checkpoint.bin";

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
    int64_t k;
    for (k = 0; k < n; ++k) diameters[k] = k % 2 ? 1.0 : 1.4;
    assert_int_equal(create_from(&o, NULL, 0, diameters, (size_t)n, &sys), JAM_OK);
  } else {
    assert_int_equal(jam_create(&o, NULL, &sys), JAM_OK);
  }
  return sys;
}

static jam_system *make(int32_t model, int32_t dim, int64_t n, double fraction) {
  return make_in(NULL, model, dim, n, fraction);
}

static void from_file(jam_system **sys) {
  jam_system *again = NULL;
  assert_int_equal(jam_write_checkpoint(*sys, path), JAM_OK);
  jam_destroy(*sys);
  if (jam_read_checkpoint(path, NULL, NULL, &again) < 0) print_error("%s\n", jam_last_error());
  assert_non_null(again);
  const jam_info info = info_of(again);
  assert_true(info.paused != 0);
  *sys = again;
}

static int32_t after(const jam_progress *p, void *user) {
  int64_t *left = user;
  (void)p;
  return --*left < 0;
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
  int k, with_file;
  for (k = 0; k < CASES; ++k) {
    jam_system *whole = make_in(cases[k].cell, cases[k].model, cases[k].dim, cases[k].n, cases[k].fraction);
    jam_compress_options c = options_of(k);
    jam_md_report report, part;
    report.struct_size = part.struct_size = sizeof report;
    assert_int_equal(jam_compress(whole, &c, &report), JAM_OK);
    for (with_file = 0; with_file < 2; ++with_file) {
      jam_system *sys = make_in(cases[k].cell, cases[k].model, cases[k].dim, cases[k].n, cases[k].fraction);
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
        if (status == JAM_LIMIT && with_file) from_file(&sys);
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
      jam_destroy(sys);
    }
    jam_destroy(whole);
  }
  remove(path);
}

/* The callback comes every 0.05 s: wherever the run is then. The number of stops; 0 where the run was over before. */
static int stops_of(double collisions_per_particle) {
  jam_system *whole = make(JAM_MODEL_EUCLID, 3, 500, 0.3), *sys = make(JAM_MODEL_EUCLID, 3, 500, 0.3), *copy = NULL;
  jam_status status;
  int64_t left;
  int stops = 0;
  DEFAULTS(run, r);
  r.collisions_per_particle = collisions_per_particle;
  assert_int_equal(jam_run(whole, &r, NULL), JAM_OK);
  for (;;) {
    left = 0;
    jam_set_progress(sys, stops < 4 ? after : NULL, &left);
    status = jam_run(sys, &r, NULL);
    if (status != JAM_CANCELLED) break;
    r.resume = 1;
    if (stops++ == 2) { /* a copy has the stage too */
      assert_int_equal(jam_copy(sys, &copy), JAM_OK);
      jam_destroy(sys);
      sys = copy;
    }
    from_file(&sys);
  }
  assert_int_equal(status, JAM_OK);
  same(whole, sys);
  jam_destroy(whole);
  jam_destroy(sys);
  remove(path);
  return stops;
}

CASE(cancelled_runs_go_on_to_the_same_bits) {
  double collisions_per_particle = 300.0; /* more on a fast machine */
  while (stops_of(collisions_per_particle) < 3) assert_true((collisions_per_particle *= 4.0) < 1e7);
}

struct writer {
  const jam_system *sys;
  double fraction, pressure; /* beyond which it writes, once */
  int written;
};

static int32_t write_once(const jam_progress *p, void *user) {
  struct writer *w = user;
  if ((p->fraction > w->fraction || p->pressure > w->pressure) && !w->written) {
    assert_int_equal(jam_write_checkpoint(w->sys, path), JAM_OK);
    w->written = 1;
  }
  return 0;
}

/* A checkpoint written by the callback, while the run goes on, leads to the same end. */
CASE(checkpoint_from_the_callback) {
  jam_system *sys = make(JAM_MODEL_EUCLID, 3, 500, 0.3), *again = NULL;
  struct writer w = {sys, 0.2, INFINITY, 0};
  DEFAULTS(run, r);
  r.collisions_per_particle = 1500.0;
  jam_set_progress(sys, write_once, &w);
  assert_int_equal(jam_run(sys, &r, NULL), JAM_OK);
  assert_true(w.written);
  assert_int_equal(jam_read_checkpoint(path, NULL, NULL, &again), JAM_OK);
  r.resume = 1;
  assert_int_equal(jam_run(again, &r, NULL), JAM_OK);
  same(sys, again);
  jam_destroy(sys);
  jam_destroy(again);
  remove(path);
}

/* Also while the spheres grow, where the callback comes at the end of a window of the pressure too. */
CASE(checkpoint_from_the_callback_in_growth) {
  jam_system *sys = make(JAM_MODEL_EUCLID, 3, 500, 0.3), *again = NULL;
  struct writer w = {sys, INFINITY, 20.0, 0};
  jam_md_report one, two;
  one.struct_size = two.struct_size = sizeof one;
  DEFAULTS(compress, c);
  c.growth_rate = 1e-2;
  c.pressure = 1e4;
  jam_set_progress(sys, write_once, &w);
  assert_int_equal(jam_compress(sys, &c, &one), JAM_OK);
  assert_true(w.written);
  assert_int_equal(jam_read_checkpoint(path, NULL, NULL, &again), JAM_OK);
  c.resume = 1;
  c.collisions_per_particle = 1e6; /* a run that never ends its windows ends here */
  assert_int_equal(jam_compress(again, &c, &two), JAM_OK);
  same(sys, again);
  assert_true(two.pressure == one.pressure);
  jam_destroy(sys);
  jam_destroy(again);
  remove(path);
}

static int32_t paused(const jam_system *sys) {
  const jam_info info = info_of(sys);
  return info.paused;
}

CASE(finished_stages_cannot_be_resumed) {
  jam_system *sys = make(JAM_MODEL_EUCLID, 3, 100, 0.3);
  const double *v;
  size_t len;
  double other[300];
  DEFAULTS(run, r);
  DEFAULTS(compress, c);
  r.resume = c.resume = 1;
  assert_int_equal(jam_run(sys, &r, NULL), JAM_E_STATE);
  assert_int_equal(jam_compress(sys, &c, NULL), JAM_E_STATE);
  c.resume = 0;
  c.collisions_per_particle = 3;
  assert_int_equal(jam_compress(sys, &c, NULL), JAM_LIMIT);
  assert_int_equal(paused(sys), JAM_PHASE_COMPRESS);
  assert_int_equal(jam_run(sys, &r, NULL), JAM_E_STATE); /* the other verb */
  assert_int_equal(paused(sys), JAM_PHASE_COMPRESS);
  jam_view(sys, JAM_VIEW_VELOCITIES, &v, &len);
  memcpy(other, v, sizeof other);
  assert_int_equal(jam_set_velocities(sys, other, len), JAM_OK); /* re-aimed: another future */
  assert_int_equal(paused(sys), 0);
  assert_int_equal(jam_compress(sys, &c, NULL), JAM_LIMIT);
  assert_int_equal(jam_scale_diameters(sys, 0.9), JAM_OK);
  assert_int_equal(paused(sys), 0);
  assert_int_equal(jam_compress(sys, &c, NULL), JAM_LIMIT);
  r.resume = 0;
  assert_int_equal(jam_run(sys, &r, NULL), JAM_OK);
  assert_int_equal(paused(sys), 0);
  r.resume = 2;
  assert_int_equal(jam_run(sys, &r, NULL), JAM_E_ARGUMENT);
  jam_destroy(sys);
}

/* What a stage has been begun with cannot be changed by a call that resumes it. */
CASE(other_growth_is_not_resumed) {
  jam_system *sys = make(JAM_MODEL_EUCLID, 3, 100, 0.3);
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
    assert_int_equal(paused(sys), JAM_PHASE_COMPRESS);
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
  jam_destroy(sys);
}

/* Any byte of the stage may be damaged and the checksum made right again: an error or a run, never a crash or an
 * endless loop. */
static uint64_t mix64(uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

static void refuse_damaged(int32_t model) {
  jam_system *sys = make(model, 3, 60, 0.3), *out = NULL;
  static unsigned char data[200000];
  size_t size, k, at;
  int refused = 0;
  FILE *f;
  DEFAULTS(compress, c);
  c.collisions_per_particle = 20;
  assert_int_equal(jam_compress(sys, &c, NULL), JAM_LIMIT);
  assert_int_equal(jam_write_checkpoint(sys, path), JAM_OK);
  jam_destroy(sys);
  f = fopen(path, "rb");
  size = fread(data, 1, sizeof data, f);
  fclose(f);
  print_message("%d bytes\n", (int)size);
  assert_true(size > 9000 && size < sizeof data);
  for (at = 60 * 7 * 8 + 100; at + 8 < size; at += 211) {
    const unsigned char was = data[at];
    uint64_t sum = 0x6a616d, word;
    data[at] ^= (unsigned char)(1u << at % 8);
    for (k = 0; k < size - 8; k += 8) {
      word = 0;
      memcpy(&word, data + k, size - 8 - k < 8 ? size - 8 - k : 8);
      sum = mix64(sum ^ word);
    }
    f = fopen(path, "wb");
    fwrite(data, 1, size - 8, f);
    fwrite(&sum, 1, 8, f);
    fclose(f);
    data[at] = was;
    if (jam_read_checkpoint(path, NULL, NULL, &out) < 0) {
      ++refused;
      continue;
    }
    c.resume = 1;
    c.collisions_per_particle = 25;
    c.wall_time = 0.2;
    jam_compress(out, &c, NULL);
    jam_destroy(out);
    out = NULL;
  }
  assert_true(refused > 5);
  remove(path);
}

CASE(damaged_checkpoints_are_refused) {
  refuse_damaged(JAM_MODEL_EUCLID);
  refuse_damaged(JAM_MODEL_MK);
}

CASE(checkpoints_of_another_version_are_refused) {
  jam_system *sys = make(JAM_MODEL_EUCLID, 3, 10, 0.2), *out = NULL;
  FILE *f;
  assert_int_equal(jam_write_checkpoint(sys, path), JAM_OK);
  jam_destroy(sys);
  f = fopen(path, "rb+");
  fseek(f, 7, SEEK_SET);
  fputc('0', f);
  fclose(f);
  SAYS(jam_read_checkpoint(path, NULL, NULL, &out), JAM_E_FORMAT, "another version");
  remove(path);
}
