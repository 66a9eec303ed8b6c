/* Write and read back gives the same bits, in every dimension, format, box and locale. */
#include <locale.h>
#include "comma.h"
#include "io_helpers.h"

static void round_trip(int32_t dim, double ratio, double box, const char *name, int32_t format) {
  OWNED jam_system *sys = some_packing(dim, 60, ratio, box), *back = NULL;
  const char *path = in_scratch(name);
  assert_int_equal(jam_write(sys, path, format), JAM_OK);
  if (jam_read(path, NULL, NULL, NULL, &back) != JAM_OK) fail_msg("%s", jam_last_error());
  assert_same_bits(sys, back);
}

static void all_round_trips(void) {
  const double boxes[] = {1.0, 7.3, 1e-3}, ratios[] = {1.0, 1.4};
  for (int32_t dim = 2; dim <= JAM_MAX_DIM; ++dim)
    for (size_t b = 0; b < 3; ++b)
      for (size_t r = 0; r < 2; ++r) {
        round_trip(dim, ratios[r], boxes[b], "a.dat", JAM_FORMAT_AUTO);
        round_trip(dim, ratios[r], boxes[b], "a.xyz", JAM_FORMAT_AUTO);
        round_trip(dim, ratios[r], boxes[b], "a.extxyz", JAM_FORMAT_AUTO);
        round_trip(dim, ratios[r], boxes[b], "a.txt", JAM_FORMAT_XYZ);
        round_trip(dim, ratios[r], boxes[b], "b.xyz", JAM_FORMAT_PLAIN);
        if (dim > 3) continue;
        round_trip(dim, ratios[r], boxes[b], "a.data", JAM_FORMAT_AUTO);
        round_trip(dim, ratios[r], boxes[b], "a.lmp.gz", JAM_FORMAT_AUTO);
      }
}

CASE(written_files_read_back_to_the_same_bits) { all_round_trips(); }

/* A host program with a decimal comma must neither write nor read commas.
 * Every kind of file with numbers as text, below the scratch folder: NAME.ENDING. */
static const char *const endings[] = {"dat", "xyz", "extxyz", "data", "vtp", "csv", "dump", "html", "mha", "vti"};
enum { ENDINGS = sizeof endings / sizeof endings[0] };

static void write_all(const jam_system *sys, const char *name) {
  char path[256];
  DEFAULTS(voxel, o);
  o.nx = o.ny = o.nz = 8;
  for (size_t k = 0; k < ENDINGS; ++k) {
    jam_status status;
    snprintf(path, sizeof path, "%s/%s.%s", scratch, name, endings[k]);
    if (!strcmp(endings[k], "csv") || !strcmp(endings[k], "dump"))
      status = jam_write_contacts(sys, path, JAM_CONTACTS_AUTO);
    else if (!strcmp(endings[k], "html"))
      status = jam_write_page(sys, path, "comma", 0, "", NULL, 0);
    else if (!strcmp(endings[k], "mha") || !strcmp(endings[k], "vti"))
      status = jam_write_voxels(sys, path, &o, NULL);
    else
      status = jam_write(sys, path, JAM_FORMAT_AUTO);
    if (status != JAM_OK) fail_msg("%s: %s", endings[k], jam_last_error());
  }
}

static void assert_all_equal(const char *first, const char *second) {
  for (size_t k = 0; k < ENDINGS; ++k) {
    char path[256];
    size_t size;
    snprintf(path, sizeof path, "%s/%s.%s", scratch, first, endings[k]);
    char *text = get_bytes(path, &size);
    snprintf(path, sizeof path, "%s/%s.%s", scratch, second, endings[k]);
    assert_bytes(path, text, size);
    free(text);
  }
}

CASE(locale_with_comma_changes_nothing) {
  OWNED jam_system *sys = some_packing(3, 30, 1.4, 7.3);
  size_t size;
  assert_true(jam_crunch(sys, NULL, NULL) >= 0);
  write_all(sys, "point");
  if (!set_comma_locale(scratch)) {
    print_message("no locale with a decimal comma is installed: skipped\n");
    skip();
  }
  assert_int_equal(localeconv()->decimal_point[0], ',');
  all_round_trips();
  round_trip(3, 1.4, 7.3, "comma.dat", JAM_FORMAT_PLAIN);
  write_all(sys, "commas");
  setlocale(LC_ALL, "C");
  assert_all_equal("point", "commas");
  char *text = get_bytes(in_scratch("comma.dat"), &size);
  assert_null(strchr(text, ','));
  free(text);
}

static void writes(const jam_system *sys, const char *name, const char *text) {
  assert_int_equal(jam_write(sys, in_scratch(name), JAM_FORMAT_AUTO), JAM_OK);
  assert_bytes(in_scratch(name), text, strlen(text));
}

CASE(layout_of_plain) {
  const double x[] = {0.25, 0.5, 0.75, 0.125}, s[] = {0.25, 0.125}, one = 0.25;
  DEFAULTS(create, o);
  o.dim = 2;
  OWNED jam_system *equal = created_from(&o, x, 4, &one, 1);
  writes(equal, "one.dat", "2\n2\n0.25\n0.25 0.5\n0.75 0.125\n");
  o.box = 2.0;
  OWNED jam_system *sys = created_from(&o, x, 4, s, 2);
  writes(sys, "two.dat", "2\n2\ndiameters box 2\n0.25 0.5 0.25\n0.75 0.125 0.125\n");
  writes(sys, "two.xyz",
         "2\nLattice=\"2 0 0 0 2 0 0 0 2\" Properties=id:I:1:pos:R:3:radius:R:1 pbc=\"T T F\" dim=2\n"
         "0 0.25 0.5 0 0.125\n1 0.75 0.125 0 0.0625\n");
}

FIXTURE(make_scratch, remove_scratch)
