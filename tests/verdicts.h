/* Crunch and the test of rigidity, with the status that a test expects. */
#ifndef JAM_TEST_VERDICTS_H
#define JAM_TEST_VERDICTS_H
#include <jam/jam.h>
#include "test.h"

static inline jam_crunch_report crunch(jam_system *sys, const jam_crunch_options *o, jam_status expected) {
  SIZED(jam_crunch_report, r);
  const jam_status status = jam_crunch(sys, o, &r);
  if (status != expected)
    fail_msg("status %d (%s, %s)", status, jam_stop_string(r.stop_reason), status < 0 ? jam_last_error() : "");
  return r;
}

static inline jam_crunch_report crunch_with_strain(jam_system *sys, int32_t strain, jam_status expected) {
  DEFAULTS(crunch, o);
  o.strain = strain;
  return crunch(sys, &o, expected);
}

static inline jam_rigidity_report rigidity_test(jam_system *sys, int32_t kind, jam_status expected) {
  SIZED(jam_rigidity_report, r);
  assert_int_equal(jam_rigidity(sys, kind, &r), expected);
  assert_int_equal(r.kind, kind);
  return r;
}

#endif
