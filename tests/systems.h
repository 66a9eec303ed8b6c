/* Systems that tests make and look into. What goes wrong fails the test. */
#ifndef JAM_TESTS_SYSTEMS_H
#define JAM_TESTS_SYSTEMS_H

#include <jam/jam.h>

#include "start.h"
#include "test.h"

/* OWNED jam_system *sys = ...: destroyed at the end of its block. */
static inline void destroy_at(const void *at) { jam_destroy(*(jam_system *const *)at); }
#define OWNED __attribute__((cleanup(destroy_at)))

static inline jam_system *created_from(const jam_create_options *o, const double *x, size_t x_len,
                                       const double *diameter, size_t diameter_len) {
  jam_system *sys = NULL;
  if (create_from(o, x, x_len, diameter, diameter_len, &sys) != JAM_OK) fail_msg("%s", jam_last_error());
  return sys;
}
static inline jam_system *created(const jam_create_options *o) { return created_from(o, NULL, 0, NULL, 0); }

static inline jam_system *created_in_cell(const jam_create_options *o, const double *cell, size_t cell_len,
                                          const double *x, size_t x_len, const double *diameter, size_t diameter_len) {
  jam_system *sys = NULL;
  if (create_in_cell(o, cell, cell_len, x, x_len, diameter, diameter_len, &sys) != JAM_OK)
    fail_msg("%s", jam_last_error());
  return sys;
}

static inline jam_system *copy_of(const jam_system *sys) {
  jam_system *copy = NULL;
  assert_int_equal(jam_copy(sys, &copy), JAM_OK);
  return copy;
}

static inline jam_info info_of(const jam_system *sys) {
  SIZED(jam_info, info);
  assert_int_equal(jam_get_info(sys, &info), JAM_OK);
  return info;
}

static inline void expect_cell(const jam_system *sys, const double *want, size_t count) {
  double cell[JAM_MAX_DIM * JAM_MAX_DIM];
  assert_int_equal(jam_get_cell(sys, cell, count, NULL), JAM_OK);
  assert_memory_equal(cell, want, count * sizeof *want);
}

static inline const double *view_of(const jam_system *sys, int32_t kind) {
  const double *view = NULL;
  size_t len;
  assert_int_equal(jam_view(sys, kind, &view, &len), JAM_OK);
  return view;
}

static inline void same_view(const jam_system *a, const jam_system *b, int32_t kind) {
  const double *x, *y;
  size_t n, m;
  assert_int_equal(jam_view(a, kind, &x, &n), JAM_OK);
  assert_int_equal(jam_view(b, kind, &y, &m), JAM_OK);
  assert_int_equal(n, m);
  assert_memory_equal(x, y, n * sizeof *x);
}

#endif /* JAM_TESTS_SYSTEMS_H */
