/* Files for other programs: LAMMPS data, compressed files, contact networks, ParaView's files, the page. */
#include <math.h>
#include "io_helpers.h"
#include "start.h"

static void same_after(jam_system *sys, const char *name) {
  OWNED jam_system *back = NULL;
  const char *path = in_scratch(name);
  assert_int_equal(jam_write(sys, path, JAM_FORMAT_AUTO), JAM_OK);
  if (jam_read(path, NULL, NULL, NULL, &back) != JAM_OK) fail_msg("%s", jam_last_error());
  assert_same_bits(sys, back);
}

CASE(compressed_files_keep_the_bits) {
  jam_system *sys = some_packing(3, 500, 1.4, 7.3), *back = NULL;
  size_t plain, packed;
  same_after(sys, "a.xyz.gz");
  same_after(sys, "a.dat.gz");
  same_after(sys, "a.xyz");
  char *bytes = get_bytes(in_scratch("a.xyz"), &plain);
  free(bytes);
  char *once = get_bytes(in_scratch("a.xyz.gz"), &packed);
  assert_true(packed < plain);
  assert_memory_equal(once, "\x1f\x8b", 2);
  same_after(sys, "b.xyz.gz"); /* the same packing gives the same bytes */
  bytes = get_bytes(in_scratch("b.xyz.gz"), &plain);
  assert_int_equal(plain, packed);
  assert_memory_equal(bytes, once, packed);
  put_bytes(in_scratch("cut.xyz.gz"), bytes, packed / 2);
  SAYS(jam_read(in_scratch("cut.xyz.gz"), NULL, NULL, NULL, &back), JAM_E_FORMAT, "compressed file is cut short");
  bytes[packed / 2] ^= 0x55;
  put_bytes(in_scratch("bad.xyz.gz"), bytes, packed);
  assert_int_equal(jam_read(in_scratch("bad.xyz.gz"), NULL, NULL, NULL, &back), JAM_E_FORMAT);
  assert_null(back);
  free(bytes);
  free(once);
  jam_destroy(sys);
}

CASE(what_a_format_cannot_hold_is_refused) {
  OWNED jam_system *four = some_packing(4, 60, 1.0, 1.0);
  assert_int_equal(jam_write(four, in_scratch("a.data"), JAM_FORMAT_AUTO), JAM_E_UNSUPPORTED);
  assert_int_equal(jam_write(four, in_scratch("a.vtp"), JAM_FORMAT_AUTO), JAM_E_UNSUPPORTED);
  assert_int_equal(jam_write_contacts(four, in_scratch("c.csv"), JAM_CONTACTS_AUTO), JAM_E_STATE);
  assert_int_equal(jam_crunch(four, NULL, NULL), JAM_OK);
  assert_int_equal(jam_write_contacts(four, in_scratch("c.csv"), JAM_CONTACTS_AUTO), JAM_OK);
  assert_int_equal(jam_write_contacts(four, in_scratch("c.dump"), JAM_CONTACTS_AUTO), JAM_E_UNSUPPORTED);
  assert_int_equal(jam_write_contacts(four, in_scratch("c.vtp"), JAM_CONTACTS_AUTO), JAM_E_UNSUPPORTED);
  SAYS(jam_write_contacts(four, in_scratch("c.xyz"), JAM_CONTACTS_AUTO), JAM_E_ARGUMENT, ".dump (a LAMMPS dump local)");
  assert_int_equal(jam_write_contacts(four, in_scratch("c.csv"), 4), JAM_E_ARGUMENT);
  assert_int_equal(jam_write(four, in_scratch("c.csv"), 5), JAM_E_ARGUMENT);
}

CASE(page_holds_its_data_and_nothing_else) {
  OWNED jam_system *sys = some_packing(2, 60, 1.4, 1.0);
  double values[120];
  size_t size;
  for (size_t k = 0; k < 120; ++k) values[k] = (double)k;
  assert_int_equal(jam_write_page(sys, in_scratch("a.html"), "</script>\"", 0, "a\nb", values, 120), JAM_OK);
  char *text = get_bytes(in_scratch("a.html"), &size);
  assert_non_null(strstr(text, "\"title\": \"\\u003c/script>\\\"\""));
  assert_non_null(strstr(text, "{\"name\": \"b\", \"values\": \""));
  assert_null(strstr(text, "http"));
  assert_memory_equal(text + size - 8, "</html>\n", 8);
  free(text);
  assert_int_equal(jam_write_page(sys, in_scratch("a.html"), "", 0, "a[]", values, 120), JAM_OK); /* d rows */
  text = get_bytes(in_scratch("a.html"), &size);
  assert_non_null(strstr(text, "\"values\": [],\n\"motions\": [{\"name\": \"a\", \"rows\": \""));
  free(text);
  SAYS(jam_write_page(sys, in_scratch("b.html"), "", 0, "a[]", values, 60), JAM_E_ARGUMENT,
       "1 names of 60 spheres need 120");
  SAYS(jam_write_page(sys, in_scratch("b.html"), "", 0, "a", values, 120), JAM_E_ARGUMENT,
       "1 names of 60 spheres need 60");
  assert_int_equal(jam_write_page(sys, in_scratch("b.html"), "", 2, "", NULL, 0), JAM_E_ARGUMENT);
  assert_int_equal(jam_write_page(sys, in_scratch("b.html"), "", 0, "", NULL, 3), JAM_E_NULL);
  assert_int_equal(jam_write_page(sys, in_scratch("b.html"), NULL, 0, "", NULL, 0), JAM_E_NULL);
  values[7] = NAN;
  assert_int_equal(jam_write_page(sys, in_scratch("b.html"), "", 0, "a", values, 60), JAM_E_NONFINITE);
  assert_int_equal(access(in_scratch("b.html"), F_OK), -1);
}

static int states_on_the_page(const jam_system *sys) {
  size_t size;
  int count = 0;
  char *at;
  assert_int_equal(jam_write_page(sys, in_scratch("s.html"), "", 1, "", NULL, 0), JAM_OK);
  char *text = get_bytes(in_scratch("s.html"), &size);
  for (at = text; (at = strstr(at, "\"kind\": ")); ++at) ++count;
  free(text);
  return count;
}

CASE(page_shows_the_steps_that_the_crunch_kept) {
  OWNED jam_system *sys = some_packing(2, 60, 1.4, 1.0), *plain = NULL, *copy = NULL;
  DEFAULTS(crunch, o);
  assert_int_equal(jam_copy(sys, &plain), JAM_OK);
  o.keep_steps = 3;
  assert_true(jam_crunch(sys, &o, NULL) >= 0);
  int states = states_on_the_page(sys);
  assert_in_range(states, 2, 4); /* the start, at most two more, and the end */
  assert_int_equal(jam_copy(sys, &copy), JAM_OK);
  assert_int_equal(states_on_the_page(copy), states);
  assert_true(jam_crunch(plain, NULL, NULL) >= 0);
  assert_same_bits(sys, plain);
  assert_int_equal(states_on_the_page(plain), 0);
  assert_true(jam_crunch(sys, NULL, NULL) >= 0); /* another crunch forgets them, and so does all that moves spheres */
  assert_int_equal(states_on_the_page(sys), 0);
  assert_true(jam_run(copy, NULL, NULL) >= 0);
  assert_int_equal(states_on_the_page(copy), 0);
}

FIXTURE(make_scratch, remove_scratch)
