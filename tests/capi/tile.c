/* jam_tile: one copy has the bits of the packing; what cannot be tiled is refused by name, before any work,
 * and modes at a wave vector before memory is taken. */
#include <math.h>

#include "steps.h"
#include "walls.h"

enum { N = 20, MOST = 8192 };
static double left[MOST], right[MOST];

static jam_system *crunched(int dim, int64_t seed) {
  jam_system *sys = random_spheres(dim, N, 0.0, seed);
  assert_true(jam_crunch(sys, NULL, NULL) >= 0);
  return sys;
}

typedef jam_status (*getter)(const jam_system *sys, double *out, size_t out_len, size_t *needed);

static void assert_same(const jam_system *a, const jam_system *b, getter get) {
  size_t here, there;
  assert_int_equal(get(a, left, MOST, &here), JAM_OK);
  assert_int_equal(get(b, right, MOST, &there), JAM_OK);
  assert_int_equal(here, there);
  assert_memory_equal(left, right, here * sizeof *left);
}

CASE(one_copy_has_the_bits_of_the_packing) {
  const int32_t once[3] = {1, 1, 1};
  for (int dim = 2; dim <= 3; ++dim) {
    OWNED jam_system *sys = crunched(dim, 1), *one = NULL;
    jam_crunch_report a = {.struct_size = sizeof a}, b = {.struct_size = sizeof b};
    assert_int_equal(jam_tile(sys, once, (size_t)dim, &one), JAM_OK);
    same_view(sys, one, JAM_VIEW_POSITIONS);
    assert_same(sys, one, jam_get_cell);
    assert_same(sys, one, jam_forces);
    assert_same(sys, one, jam_contact_gaps);
    assert_same(sys, one, jam_contact_vectors);
    assert_int_equal(jam_get_crunch_report(sys, &a), JAM_OK);
    assert_int_equal(jam_get_crunch_report(one, &b), JAM_OK);
    assert_memory_equal(&a, &b, sizeof a);
  }
}

/* Copies of copies are copies: the same spheres at the same places, to the rounding of one sum. */
CASE(copies_of_copies_are_copies) {
  const int32_t along_x[2] = {2, 1}, along_y[2] = {1, 3}, both[2] = {2, 3};
  OWNED jam_system *sys = crunched(2, 3), *half = NULL, *twice = NULL, *at_once = NULL;
  size_t needed, contacts;
  assert_int_equal(jam_tile(sys, along_x, 2, &half), JAM_OK);
  assert_int_equal(jam_tile(half, along_y, 2, &twice), JAM_OK);
  assert_int_equal(jam_tile(sys, both, 2, &at_once), JAM_OK);
  const double *const x = view_of(twice, JAM_VIEW_POSITIONS), *const y = view_of(at_once, JAM_VIEW_POSITIONS);
  assert_true(info_of(twice).n == 6 * N && info_of(at_once).n == 6 * N);
  for (size_t k = 0; k < 2 * 6 * N; ++k) assert_true(x[k] - y[k] < 1e-15 && y[k] - x[k] < 1e-15);
  assert_int_equal(jam_forces(sys, NULL, 0, &contacts), JAM_OK);
  assert_same(twice, at_once, jam_forces);
  assert_int_equal(jam_forces(at_once, NULL, 0, &needed), JAM_OK);
  assert_int_equal(needed, 6 * contacts);
}

static void refuse(const jam_system *sys, int32_t x, int32_t y, int32_t z, size_t len, jam_status code,
                   const char *why) {
  const int32_t count[3] = {x, y, z};
  jam_system *out = NULL;
  assert_int_equal(jam_tile(sys, count, len, &out), code);
  assert_null(out);
  if (!strstr(jam_last_error(), why)) fail_msg("%s", jam_last_error());
}

CASE(what_cannot_be_tiled_is_named) {
  OWNED jam_system *sys = crunched(3, 2), *slit = NULL, *tube = NULL, *ball = NULL;
  refuse(sys, 1, 0, 1, 3, JAM_E_ARGUMENT, "count[1] is 0");
  refuse(sys, 1, 1, -5, 3, JAM_E_ARGUMENT, "count[2] is -5");
  refuse(sys, 1, 1, 1, 2, JAM_E_ARGUMENT, "count has 2 numbers");
  refuse(sys, 2000, 2000, 2000, 3, JAM_E_ARGUMENT, "2^31-1 spheres");
  refuse(sys, 2147483647, 2147483647, 2147483647, 3, JAM_E_ARGUMENT, "2^31-1 spheres");
  assert_int_equal(jam_set_memory_limit(sys, 1e6), JAM_OK);
  refuse(sys, 50, 50, 50, 3, JAM_E_MEMORY, "the copies of the packing need");
  assert_int_equal(create_walled(&walled_scenes[SLIT], N, 0.1, 1, NULL, &slit), JAM_OK);
  refuse(slit, 1, 1, 2, 3, JAM_E_UNSUPPORTED, "the wall z = 0");
  assert_int_equal(create_walled(&walled_scenes[TUBE], N, 0.1, 1, NULL, &tube), JAM_OK);
  refuse(tube, 1, 2, 1, 3, JAM_E_UNSUPPORTED, "count[1] is 2");
  assert_int_equal(create_walled(&walled_scenes[BALL], N, 0.1, 1, NULL, &ball), JAM_OK);
  refuse(ball, 1, 1, 2, 3, JAM_E_UNSUPPORTED, "count[2] is 2");
}

/* So that a binding that asks for the number of modes fills no array in vain. */
CASE(modes_at_a_wave_vector_are_refused_with_their_number) {
  const struct { double wave[3], bytes; } cases[] = {{{0.5, 0.0, 0.0}, 40.0}, {{0.5, 0.25, 0.0}, 96.0}};
  OWNED jam_system *sys = crunched(3, 1);
  for (int k = 0; k < 2; ++k) {
    const double *q = cases[k].wave;
    size_t rows = 0;
    assert_int_equal(jam_set_memory_limit(sys, INFINITY), JAM_OK);
    assert_int_equal(jam_bloch_modes(sys, NULL, q, 3, JAM_MODE_COLUMNS, NULL, 0, NULL, 0, &rows), JAM_OK);
    const double bytes = cases[k].bytes * (double)(rows * rows);
    assert_int_equal(jam_set_memory_limit(sys, 0.99 * bytes), JAM_OK);
    assert_int_equal(jam_bloch_modes(sys, NULL, q, 3, JAM_MODE_COLUMNS, NULL, 0, NULL, 0, &rows), JAM_E_MEMORY);
    assert_int_equal(jam_set_memory_limit(sys, 1.01 * bytes), JAM_OK);
    assert_int_equal(jam_bloch_modes(sys, NULL, q, 3, JAM_MODE_COLUMNS, left, MOST, NULL, 0, &rows), JAM_OK);
  }
}
