/* Texts have a decimal point where the host's locale has a comma; the host's callbacks, and the host after each call,
 * have their locale. */
#include <ctype.h>
#include "comma.h"
#include "steps.h"

static void no_comma_in_number(const char *text) {
  const char *c;
  for (c = text; *c; ++c)
    if (*c == ',' && c > text && isdigit((unsigned char)c[-1]) && isdigit((unsigned char)c[1]))
      fail_msg("a decimal comma: %s", text);
}

static int number_with_point(const char *text) {
  const char *c;
  for (c = text; *c; ++c)
    if (*c == '.' && c > text && isdigit((unsigned char)c[-1]) && isdigit((unsigned char)c[1])) return 1;
  return 0;
}

static void read_text(const char *text) {
  no_comma_in_number(text);
  if (!number_with_point(text)) fail_msg("no number with a decimal point: %s", text);
}

static void host_has_comma(void) { assert_int_equal(localeconv()->decimal_point[0], ','); }

static int lines, with_point;
static void on_line(int32_t level, const char *line, void *user) {
  (void)level, (void)user;
  host_has_comma();
  no_comma_in_number(line);
  ++lines;
  with_point += number_with_point(line);
}

static int32_t on_progress(const jam_progress *p, void *user) {
  (void)p, (void)user;
  host_has_comma();
  return 0;
}

static void comma(void) {
  char folder[] = "/tmp/jam_decimal_point_XXXXXX";
  assert_non_null(mkdtemp(folder));
  if (!set_comma_locale(folder)) {
    print_message("no locale with a decimal comma is installed: skipped\n");
    skip();
  }
  host_has_comma();
}

CASE(errors) {
  const double x[] = {0.0, 0.0, 0.5, 0.0}, diameter[] = {0.6};
  jam_system *sys = NULL;
  comma();
  DEFAULTS(create, o);
  o.dim = 2, o.n = 2, o.box = 2.5;
  assert_int_equal(create_from(&o, x, 4, diameter, 1, &sys), JAM_E_OVERLAP);
  host_has_comma();
  read_text(jam_last_error());
  o.packing_fraction = 0.95;
  assert_true(jam_create(&o, NULL, &sys) < 0);
  read_text(jam_last_error());
  setlocale(LC_ALL, "C");
}

CASE(texts_and_callbacks) {
  jam_check_report r = {.struct_size = sizeof r};
  comma();
  OWNED jam_system *sys = random_spheres(2, 30, 0.4, 3);
  assert_int_equal(jam_set_log(sys, on_line, 3, NULL), JAM_OK);
  assert_int_equal(jam_set_progress(sys, on_progress, NULL), JAM_OK);
  DEFAULTS(compress, c);
  c.pressure = 100.0;
  assert_true(jam_compress(sys, &c, NULL) >= 0);
  DEFAULTS(check, k);
  assert_true(jam_check_packing(sys, &k, &r) > 0);
  read_text(jam_check_text(&r));
  read_text(jam_last_error());
  assert_true(jam_crunch(sys, NULL, NULL) >= 0);
  assert_true(lines > 0 && with_point > 0);
  read_text(jam_proof_text(JAM_THEOREM_EXACT, JAM_CAUSE_NONE, 1.5e-30, 0.0, 0.0));
  host_has_comma();
  setlocale(LC_ALL, "C");
}
