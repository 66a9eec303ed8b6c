/* Crunch and the test of rigidity, with the status that a test expects. */
#ifndef JAM_TEST_VERDICTS_H
#define JAM_TEST_VERDICTS_H
#include <jam/jam.h>
#include <string.h>
#include "test.h"

static inline jam_crunch_report crunch_with_strain(jam_system *sys, int32_t strain, jam_status expected) {
  jam_crunch_report r;
  memset(&r, 0, sizeof r);
  r.struct_size = sizeof r;
  DEFAULTS(crunch, o);
  o.strain = strain;
  assert_int_equal(jam_crunch(sys, &o, &r), expected);
  return r;
}

static inline jam_rigidity_report rigidity_test(jam_system *sys, int32_t kind, jam_status expected) {
  jam_rigidity_report r;
  memset(&r, 0, sizeof r);
  r.struct_size = sizeof r;
  assert_int_equal(jam_rigidity(sys, kind, &r), expected);
  assert_int_equal(r.kind, kind);
  return r;
}

#endif
