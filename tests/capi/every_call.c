/* Every call of the table tests/calls.def: without a handle, without what it needs, and as a user calls it. */
#include "calls.h"
#include "systems.h"

static void text_is_there(const char *name, jam_status status) {
  if (status != JAM_OK && jam_last_error()[0] == '\0') fail_msg("%s: status %d without a text", name, status);
}

CASE(a_null_handle_is_refused) {
  for (int k = 0; k < CALLS; ++k) {
    if (every_call[k].start == NONE) continue;
    jam_set_error(NULL);
    jam_status status = every_call[k].call(NULL, NULL);
    if (status != JAM_E_NULL) fail_msg("%s(NULL, ...) gives %d: %s", every_call[k].name, status, jam_last_error());
  }
}

/* A network, a minimum, observations, runs, a step: without them JAM_E_STATE, and nothing moves. */
CASE(what_is_missing_is_reported) {
  OWNED jam_system *fluid = system_for(ANY), *before = copy_of(fluid);
  for (int k = 0; k < CALLS; ++k) {
    if (every_call[k].start < NETWORK) continue;
    jam_set_error(NULL);
    jam_status status = every_call[k].call(NULL, fluid);
    if (status != JAM_E_STATE) fail_msg("%s gives %d: %s", every_call[k].name, status, jam_last_error());
    text_is_there(every_call[k].name, status);
    same_view(fluid, before, JAM_VIEW_POSITIONS);
  }
}

/* A network without contacts is one, too: the packing is not jammed, and what asks for a contact is refused. */
CASE(an_empty_network_is_answered) {
  OWNED jam_system *fluid = system_for(ANY);
  size_t m;
  assert_int_equal(jam_contacts_from_geometry(fluid, NULL, NULL), JAM_NOT_JAMMED);
  for (int k = 0; k < CALLS; ++k) {
    if (every_call[k].start != NETWORK) continue;
    const jam_status status = every_call[k].call(NULL, fluid);
    text_is_there(every_call[k].name, status);
    if (status < 0 && status != JAM_E_STATE && status != JAM_E_ARGUMENT) /* a history, a stable sphere, a contact */
      fail_msg("%s gives %d: %s", every_call[k].name, status, jam_last_error());
  }
  assert_int_equal(jam_hessian_map(fluid, NULL, 0, &m), JAM_OK);
  assert_int_equal(m, 0);
  double x[10];
  jam_moduli_report moduli = {.struct_size = sizeof moduli};
  assert_int_equal(jam_modes(fluid, NULL, NULL, JAM_MODE_COLUMNS, x, 10, NULL, 0, &m), JAM_NOT_JAMMED);
  assert_int_equal(jam_stress_states(fluid, x, 10, NULL, 0, NULL, &m), JAM_NOT_JAMMED);
  assert_int_equal(jam_moduli(fluid, NULL, &moduli), JAM_NOT_JAMMED);
  assert_int_equal(jam_floppy_modes(fluid, NULL, 0, JAM_FLOPPY_COLUMNS, x, 10, NULL, 0, &m), JAM_NOT_JAMMED);
}

/* With what it needs no call fails, but for what belongs into a callback. */
CASE(every_call_does_its_work) {
  for (int k = 0; k < CALLS; ++k) {
    OWNED jam_system *sys = system_for(every_call[k].start);
    if (every_call[k].start != NONE && !sys) fail_msg("%s: no system: %s", every_call[k].name, jam_last_error());
    jam_set_error(NULL);
    jam_status status = every_call[k].call(NULL, sys);
    if (every_call[k].start == STEP ? status != JAM_E_STATE : status < 0)
      fail_msg("%s gives %d: %s", every_call[k].name, status, jam_last_error());
    text_is_there(every_call[k].name, status);
  }
  remove(call_file()), remove(call_image());
}
