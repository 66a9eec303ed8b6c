/* Files that are no packings: a clear error with the line, no handle, no memory for data that is not there. */
#include <sys/resource.h>
#include "io_helpers.h"

CASE(bad_plain_files_are_refused) {
  expect_refused("", JAM_E_FORMAT, "is empty");
  expect_refused("\n\n", JAM_E_FORMAT, "is empty");
  expect_refused("three\n2\n0.1\n", JAM_E_FORMAT, "line 1: 'three'");
  expect_refused("3.0\n2\n0.1\n", JAM_E_FORMAT, "line 1: '3.0'");
  expect_refused("3\n2.0\n0.1\n", JAM_E_FORMAT, "line 2: '2.0'");
  expect_refused("3\n-5\n0.1\n", JAM_E_ARGUMENT, "-5");
  expect_refused("3\n2\n-0.1\n", JAM_E_ARGUMENT, "line 3: the diameter is -0.1");
  expect_refused("3\n2\n0.1\n0.1 0.2 0.3e\n", JAM_E_FORMAT, "line 4: '0.3e'");
  expect_refused("3\n2\n0.1\n0.1 +-0.2 0.3\n", JAM_E_FORMAT, "line 4: '+-0.2'");
  expect_refused("3\n2\n0.1\n0.1 -inf 0.3\n", JAM_E_NONFINITE, "line 4: '-inf'");
  expect_refused("3 2\n", JAM_E_FORMAT, "line 1: '3 2' begins no file that is read");
  expect_refused("3\n", JAM_E_FORMAT, "before the number of spheres");
  expect_refused("1\n2\n0.1\n0.5\n0.2\n", JAM_E_DIMENSION, "line 1: dim is 1");
  expect_refused("9\n2\n0.1\n", JAM_E_DIMENSION, "line 1: dim is 9");
  expect_refused("3\n0\n0.1\n", JAM_E_ARGUMENT, "line 2: n is 0");
  expect_refused("3\n2147483648\n0.1\n", JAM_E_ARGUMENT, "2147483648");
  expect_refused("3\n99999999999999999999999\n0.1\n", JAM_E_FORMAT, "line 2");
  expect_refused("3\n2\n", JAM_E_FORMAT, "before the diameter");
  expect_refused("3\n2\nabc\n", JAM_E_FORMAT, "line 3: 'abc'");
  expect_refused("3\n2\n0\n", JAM_E_ARGUMENT, "line 3: the diameter is 0");
  expect_refused("3\n2\nnan\n", JAM_E_NONFINITE, "line 3: 'nan'");
  expect_refused("3\n2\n0.1 box\n", JAM_E_FORMAT, "line 3");
  expect_refused("3\n2\n0.1 box 0\n", JAM_E_ARGUMENT, "line 3: the box side is 0");
  expect_refused("3\n2\n0.1\n0.1 0.2 0.3\n", JAM_E_FORMAT, "after 1 of 2 spheres");
  expect_refused("3\n2\n0.1\n0.1 0.2 0.3\n0.5 0.6 0.7\n0.1 0.1 0.1\n", JAM_E_FORMAT,
                 "line 6: there is more after the 2 spheres");
  expect_refused("3\n2\n0.1\n0.1 0.2 0.3\n0.5 0.6\n", JAM_E_FORMAT, "line 5: 2 columns, 3 are needed");
  expect_refused("3\n2\n0.1\n0.1 0.2 0.3 0.4\n", JAM_E_FORMAT, "line 4: 4 columns");
  expect_refused("3\n2\n0.1\n0.1 0.2 x3\n", JAM_E_FORMAT, "line 4: 'x3' is not a number");
  expect_refused("3\n2\n0.1\n0.1 nan 0.3\n", JAM_E_NONFINITE, "line 4: 'nan'");
  expect_refused("3\n2\n0.1\n0.1 1e999 0.3\n", JAM_E_FORMAT, "line 4: '1e999' is outside the range");
  expect_refused("2\n2\ndiameters\n0.1 0.2 0.1\n0.5 0.6\n", JAM_E_FORMAT,
                 "line 5: 2 columns, 3 are needed (coordinates and diameter)");
  expect_refused("2\n2\ndiameters\n0.1 0.2 0.1\n0.5 0.6 0\n", JAM_E_ARGUMENT, "line 5: the diameter is 0");
  expect_refused("2\n2\n0.3\n0.1 0.2\n0.2 0.2\n", JAM_E_OVERLAP, "spheres 0 and 1");
  expect_refused("2\n1\n1e9\n0.1 0.2\n", JAM_E_OVERLAP,
                 "diameter 1e+09"); /* and at once, not after listing its images */
  expect_refused("2\n3\n0.9\n0.1 0.2\n0.4 0.4\n0.7 0.9\n", JAM_E_OVERLAP, "packing fraction 1.9");
  expect_refused("2\n1\n4.9e-324\n0.1 0.2\n", JAM_E_ARGUMENT, "diameters[0] is 4.94");
  expect_refused("2\n2\n0.1\n0.1 0.25\n0.5 0.6", JAM_E_FORMAT, "line 5: the file ends inside a line");
  expect_refused("2\n2\n0.1\n0.1 1\n0.5 0", JAM_E_FORMAT, "line 5: the file ends inside a line");
}

#define LATTICE "Lattice=\"1 0 0 0 1 0 0 0 1\" "
CASE(bad_xyz_files_are_refused) {
  expect_refused("0\n" LATTICE "\n", JAM_E_FORMAT, "frame 0 has no sphere");
  expect_refused("1\n" LATTICE "\nA 0 0 0\n", JAM_E_FORMAT, "line 2: no Properties");
  expect_refused("1\nProperties=pos:R:3:radius:R:1\n0 0 0 0.1\n", JAM_E_FORMAT, "line 2: no Lattice");
  expect_refused("1\n" LATTICE "Properties=pos:R:3\n0 0 0\n", JAM_E_FORMAT, "no radius");
  expect_refused("1\n" LATTICE "Properties=radius:R:1\n0.1\n", JAM_E_FORMAT, "no pos");
  expect_refused("1\n" LATTICE "Properties=pos:R\n", JAM_E_FORMAT, "name:type:columns");
  expect_refused("1\n" LATTICE "Properties=pos:R:many:radius:R:1\n", JAM_E_FORMAT, "'many'");
  expect_refused("1\n" LATTICE "Properties=pos:R:9:radius:R:1\n", JAM_E_DIMENSION, "dim is 9");
  expect_refused("1\n" LATTICE "Properties=pos:R:3:radius:R:1 dim=4\n0 0 0 0.1\n", JAM_E_FORMAT, "dim is 4");
  expect_refused("1\nLattice=\"1 0 0\" Properties=pos:R:3:radius:R:1\n0 0 0 0.1\n", JAM_E_FORMAT,
                 "Lattice has 3 numbers");
  expect_refused("1\nLattice=\"1 0 0 0 2 0 0 0 1\" Properties=pos:R:4:radius:R:1\n0 0 0 0 0.1\n", JAM_E_UNSUPPORTED,
                 "not a cube");
  expect_refused("1\nLattice=\"1 0 0 0 0 1 0 1 0\" Properties=pos:R:3:radius:R:1\n0 0 0 0.1\n", JAM_E_ARGUMENT,
                 "line 2: the cell vectors have the determinant -1");
  expect_refused("1\nLattice=\"1 0 0 2 0 0 0 0 1\" Properties=pos:R:3:radius:R:1\n0 0 0 0.1\n", JAM_E_ARGUMENT,
                 "linearly dependent");
  expect_refused("1\nLattice=\"1 0 0 0 1 0.5 0 0 1\" Properties=pos:R:2:radius:R:1\n0 0 0.1\n", JAM_E_UNSUPPORTED,
                 "leaves the plane");
  expect_refused("1\nLattice=\"1 0 0 0 1 0 0 0 1 Properties=pos:R:3:radius:R:1\n0 0 0 0.1\n", JAM_E_FORMAT,
                 "not closed");
  expect_refused("2\n" LATTICE "Properties=pos:R:3:radius:R:1\n0 0 0 0.1\n", JAM_E_FORMAT, "after 1 of 2");
  expect_refused("1\n" LATTICE "Properties=pos:R:3:radius:R:1\n0 0 0 0.1 7\n", JAM_E_FORMAT, "line 3: 5 columns");
  expect_refused("1\n" LATTICE "Properties=pos:R:3:radius:R:1\n0 0 0 -0.1\n", JAM_E_ARGUMENT, "the radius is -0.1");
  expect_refused("1\n" LATTICE "Properties=pos:R:3:radius:R:1 pbc=\"F T T\"\n0 0 0 0.1\n", JAM_E_UNSUPPORTED,
                 "line 2: pbc='F T T'");
}

/* Names of other programs' formats are refused with the list of ours, unless the format is named; nothing is written.
 */
CASE(unknown_endings_refused) {
  static const char *const refused[] = {"q.gsd", "q.gsd.gz", "q.XYZ", "q.lammps"};
  static const char *const taken[] = {"q", "q.dat", "q.txt", "q.12", "q.xyz", "q.extxyz", ".hidden"};
  OWNED jam_system *sys = some_packing(3, 12, 1.0, 1.0);
  int before = count_files();
  for (size_t k = 0; k < sizeof refused / sizeof *refused; ++k) {
    SAYS(jam_write(sys, in_scratch(refused[k]), JAM_FORMAT_AUTO), JAM_E_ARGUMENT,
         ".extxyz (extended XYZ), .data or .lmp");
  }
  assert_int_equal(count_files(), before);
  assert_int_equal(jam_write(sys, in_scratch("q.gsd"), JAM_FORMAT_PLAIN), JAM_OK);
  for (size_t k = 0; k < sizeof taken / sizeof *taken; ++k)
    if (jam_write(sys, in_scratch(taken[k]), JAM_FORMAT_AUTO) != JAM_OK) fail_msg("%s: %s", taken[k], jam_last_error());
}

/* A file cut at any byte is refused, but for its last newline: without that it may be read, to the same bits. */
static void every_truncation(const char *name, double ratio) {
  jam_system *sys = some_packing(3, 12, ratio, 1.0), *back = NULL;
  size_t size;
  assert_int_equal(jam_write(sys, in_scratch(name), JAM_FORMAT_AUTO), JAM_OK);
  char *text = get_bytes(in_scratch(name), &size);
  for (size_t cut = 0; cut < size; ++cut) {
    put_bytes(in_scratch("cut.dat"), text, cut);
    if (jam_read(in_scratch("cut.dat"), NULL, NULL, NULL, &back) >= 0) {
      if (cut + 1 < size) fail_msg("%s cut to %zu of %zu bytes was read", name, cut, size);
      assert_same_bits(sys, back);
      jam_destroy(back);
      continue;
    }
    assert_null(back);
    assert_true(strlen(jam_last_error()) > 0);
  }
  put_bytes(in_scratch("cut.dat"), text, size);
  assert_int_equal(jam_read(in_scratch("cut.dat"), NULL, NULL, NULL, &back), JAM_OK);
  assert_same_bits(sys, back);
  free(text);
  jam_destroy(sys);
  jam_destroy(back);
}

CASE(cut_files_are_refused) {
  every_truncation("t.dat", 1.0);
  every_truncation("t2.dat", 1.4);
  every_truncation("t.xyz", 1.4);
}

/* A count of 2^31-1 in the header, and a line that never ends, must not take memory. */
CASE(header_counts_allocate_nothing) {
  struct rusage before, after;
  char *line = malloc(50u << 20);
  assert_non_null(line);
  memset(line, '7', 50u << 20);
  getrusage(RUSAGE_SELF, &before);
  expect_refused("8\n2147483647\ndiameters\n", JAM_E_FORMAT, "after 0 of 2147483647");
  expect_refused("2147483647\n" LATTICE "Properties=pos:R:3:radius:R:1\n", JAM_E_FORMAT, "after 0 of 2147483647");
  put_bytes(in_scratch("endless.dat"), line, 50u << 20);
  {
    jam_system *sys = NULL;
    SAYS(jam_read(in_scratch("endless.dat"), NULL, NULL, NULL, &sys), JAM_E_FORMAT, "line 1: longer than");
  }
  getrusage(RUSAGE_SELF, &after);
  assert_true(after.ru_maxrss - before.ru_maxrss < 20 * 1024); /* kilobytes */
  free(line);
}

CASE(missing_files_are_refused) {
  jam_system *sys = NULL;
  jam_create_options o;
  assert_int_equal(jam_read(NULL, NULL, NULL, NULL, &sys), JAM_E_NULL);
  assert_int_equal(jam_read(in_scratch("none.dat"), NULL, NULL, NULL, NULL), JAM_E_NULL);
  SAYS(jam_read(in_scratch("none.dat"), NULL, NULL, NULL, &sys), JAM_E_IO, "none.dat");
  assert_non_null(strstr(jam_last_error(), strerror(ENOENT)));
  assert_int_equal(jam_read("", NULL, NULL, NULL, &sys), JAM_E_IO);
  SAYS(jam_read(scratch, NULL, NULL, NULL, &sys), JAM_E_IO, strerror(EISDIR));
  memset(&o, 0, sizeof o);
  assert_int_equal(jam_read(in_scratch("none.dat"), &o, NULL, NULL, &sys), JAM_E_STRUCT_SIZE);
  jam_create_options_init(&o, sizeof o);
  o.box = -1.0;
  put_bytes(in_scratch("ok.dat"), "2\n1\n0.1\n0.5 0.5\n", 16);
  assert_int_equal(jam_read(in_scratch("ok.dat"), &o, NULL, NULL, &sys), JAM_E_ARGUMENT);
  assert_null(sys);
}

/* The reason stands behind the path, however long that is; of the path its end is shown. */
CASE(long_paths_do_not_hide_the_reason) {
  OWNED jam_system *sys = some_packing(3, 8, 1.0, 1.0);
  jam_system *back = NULL;
  static const char nan_file[] = "1\n" LATTICE "Properties=pos:R:3:radius:R:1\n0 0 nan 0.1\n";
  static const char overlap[] = "2\n2\n0.3\n0.1 0.2\n0.2 0.2\n";
  char folder[600], path[700];
  size_t length = (size_t)snprintf(folder, sizeof folder, "%s", scratch);
  for (int depth = 0; depth < 4; ++depth) {
    length += (size_t)snprintf(folder + length, sizeof folder - length, "/%0100d", depth);
    assert_int_equal(mkdir(folder, 0700), 0);
  }
  snprintf(path, sizeof path, "%s/last.xyz", folder);
  SAYS(jam_read(path, NULL, NULL, NULL, &back), JAM_E_IO, strerror(ENOENT));
  put_bytes(path, nan_file, sizeof nan_file - 1);
  SAYS(jam_read(path, NULL, NULL, NULL, &back), JAM_E_NONFINITE, "last.xyz line 3: 'nan' is not finite");
  SAYS(jam_read_checkpoint(path, NULL, NULL, &back), JAM_E_FORMAT, "last.xyz is no checkpoint of libjam");
  put_bytes(path, overlap, sizeof overlap - 1);
  SAYS(jam_read(path, NULL, NULL, NULL, &back), JAM_E_OVERLAP, "spheres 0 and 1");
  snprintf(path, sizeof path, "%s/none/last.xyz", folder);
  SAYS(jam_write(sys, path, JAM_FORMAT_XYZ), JAM_E_IO, strerror(ENOENT));
  assert_non_null(strstr(jam_last_error(), "last.xyz"));
  assert_null(back);
}

FIXTURE(make_scratch, remove_scratch)
