/* Fuzz target over sequences of calls on tiny systems of any dimension, size ratio, model, cell and overlap policy.
 * Option structs hold bytes of the input behind a struct_size that is mostly right. Every call ends with a known status
 * and a valid state, and soon. */
#define _POSIX_C_SOURCE 200809L
#include "calls.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  input in = {data, size};
  int k;
  jam_system *sys = create(&in);
  if (!sys) return 0;
  check_state(sys);
  limit(sys);
  for (k = 0; k < 6 && in.left > 0; ++k) {
    any_call(&in, sys);
    check_state(sys);
  }
  jam_destroy(sys);
  return 0;
}
