/* Files of other programs and of people: what is unambiguous is read, the rest is refused by its name with a way out,
 * and what was changed on the way stands in jam_notes and in the log. */
#include <math.h>
#include "io_helpers.h"

static jam_create_options defaults(void) {
  DEFAULTS(create, o);
  return o;
}

/* Three spheres at the places that all texts below write. */
static void same_three(jam_system *sys) {
  static const double want[9] = {0.1, 0.2, 0.3, 0.6, 0.7, 0.8, 0.35, 0.9, 0.15}, sizes[3] = {0.2, 0.2, 0.2};
  expect(sys, 3, 3, want, sizes);
}

CASE(odd_plain_text) {
  same_three(
      read_text("\xef\xbb\xbf"
                "3\n3\n0.2\n0.1 0.2 0.3\n0.6 0.7 0.8\n0.35 0.9 0.15\n"));        /* the mark of UTF-8 */
  same_three(read_text("3\n3\n0.2\n0.1 0.2 0.3\n0.6 0.7 0.8\n0.35 0.9 0.15"));   /* no last newline */
  same_three(read_text("3\n3\n0.2\n0.1 0.2 0.30\n0.6 0.7 0.8\n0.35 0.9 0.15 ")); /* a blank there */
  same_three(read_text("3\r3\r0.2\r0.1 0.2 0.3\r0.6 0.7 0.8\r0.35 0.9 0.15\r"));
  same_three(read_text("3 \r\n3\r\n0.2\t\r\n+0.1 0.2 0.3 \r\n\r\n0.6  0.7\t0.8\r\n0.35 0.9 0.15\r\n\r\n"));
  same_three(read_text(
      "# mine\n3 # dimension\n\n3\n0.2 # diameter\n#x\n0.1 0.2 0.3\n0.6 0.7 0.8 # b\n0.35 0.9 0.15\n# end\n"));
  same_three(read_text("3\n3\n0.2\n0.1,0.2,0.3\n0.6, 0.7,0.8\n0.35 , 0.9,\t0.15\n"));
  same_three(read_text("3\n3\n2.0D-01\n1.0D-01 0.2d0 3D-1\n0.6 0.7 0.8\n0.35 0.9 0.15\n"));
  expect_refused("3\n1\n0.2\n0,1 0,2 0,3\n", JAM_E_FORMAT, "line 4: '0,1' has a comma: write decimal points");
  expect_refused("2\n1\n0.2\n0,1; 0,2\n", JAM_E_FORMAT, "line 4: '0,1;' has a comma");
  expect_refused("2\n1\n0.2\n0.1,,0.2\n", JAM_E_FORMAT, "line 4: column 2 is empty");
  expect_refused("2\n1\n0.2\n0.1 1D\n", JAM_E_FORMAT, "line 4: '1D' is not a number");
}

/* A box that is not named is 1. Positions beyond it say that it was another. */
CASE(a_box_that_is_not_named) {
  jam_create_options o = defaults();
  const char *text = "3\n3\n0.2\n0.1 0.2 0.3\n0.6 0.7 1.8\n0.35 0.9 0.15\n";
  OWNED jam_system *sys = NULL;
  expect_refused(text, JAM_E_FORMAT,
                 "line 5: the coordinate 1.8 lies outside the box [0, 1], and the file names no box");
  expect_refused("2\n1\n0.1\n0.1 -0.2\n", JAM_E_FORMAT, "line 4: the coordinate -0.2");
  o.box = 2.0;
  sys = read_as(text, NULL, &o);
  assert_string_equal(jam_notes(sys), "");
  assert_true(info_of(sys).box == 2.0);
  jam_destroy(read_text("2\n2\n0.1\n0.1 1.000000\n-0.0000004 0.5\n")); /* rounding of six digits */
}

CASE(tables) {
  static const double corner[4] = {.1, .2, .3, .4}, tenth = 0.1;
  jam_create_options o = defaults();
  jam_system *sys = read_text("0.1 0.2 0.3 0.1\n0.6 0.7 0.8 0.1\n0.35 0.9 0.15 0.1\n");
  assert_non_null(
      strstr(jam_notes(sys), "warning: the file does not name its 4 columns: 3 coordinates and the radius"));
  assert_non_null(strstr(jam_notes(sys), "the file names no box: its side is taken as 1"));
  same_three(sys);
  same_three(read_text("# x y z r\n0.1 0.2 0.3 0.1\n0.6 0.7 0.8 0.1\n0.35 0.9 0.15 0.1\n"));
  same_three(read_text("x,y,z,diameter\n0.1,0.2,0.3,0.2\n0.6,0.7,0.8,0.2\n0.35,0.9,0.15,0.2\n"));
  same_three(read_text("Radius id X Z Y\n0.1 7 0.1 0.3 0.2\n0.1 8 0.6 0.8 0.7\n0.1 9 0.35 0.15 0.9\n"));
  expect(noted(read_text("x1 x2 x3 x4 d mass\n.1 .2 .3 .4 .1 7\n"), "columns of the file that were not read: mass"), 4,
         1, corner, &tenth);
  o.dim = 2;
  o.box = 4.0;
  jam_destroy(read_as("1 2 0.5\n3 1 0.25\n", NULL, &o));
  expect_refused("1 2 0.5\n3 1 0.25\n", JAM_E_FORMAT, "line 1: 3 columns, a table without names has 4 in d = 3");
  expect_refused("0.1 0.2 0.3 0.1\n0.6 0.7 1.8 0.1\n", JAM_E_FORMAT, "line 2: the coordinate 1.8 lies outside");
  expect_refused("0.1 0.2 0.3 0.1\n0.6 0.7 0.1\n", JAM_E_FORMAT, "line 2: 3 columns, the first rows have 4");
  expect_refused("x y z\n0.1 0.2 0.3\n", JAM_E_FORMAT, "the columns have no size");
  expect_refused("# x y z mass\n0.1 0.2 0.3 1\n", JAM_E_FORMAT, "the columns have no size");
  o.dim = 3;
  expect_refused_as("0 1 2 0.1\n1 2 2 0.1\n2 3 3 0.1\n", NULL, &o, JAM_E_FORMAT, "the first column counts the rows");
  /* the overlap that a wrong guess leads to repeats the guess */
  expect_refused("0.1 0.2 0.3 0.3\n0.5 0.2 0.3 0.3\n", JAM_E_OVERLAP, "coordinates and the radius were assumed");
}

#define BOX "Lattice=\"1 0 0 0 1 0 0 0 1\" "
CASE(odd_xyz) {
  jam_create_options o = defaults();
  OWNED jam_system *sys = NULL;
#define R "1 0.1 0.2 0.3 0.1\n1 0.6 0.7 0.8 0.1\n1 0.35 0.9 0.15 0.1\n"
  same_three(
      read_text("3\nLattice={1 0 0 0 1 0 0 0 1} Properties=type:I:1:pos:R:3:radius:R:1 pbc=\"TRUE True t\"\n" R));
  same_three(read_text("3\n" BOX "Properties=type:I:1:pos:R:3:Radius:R:1\n" R));
  same_three(read_text("3\n" BOX "Properties=pos:R:3:Diameter:R:1\n0.1 0.2 0.3 0.2\n.6 .7 .8 .2\n0.35 0.9 0.15 .2\n"));
  same_three(read_text("3\nanimation=no pbc=\"T T T\" Properties=species:S:1:radius:R:1:pos:R:3:move:I:2 step " BOX
                       "\nA 0.1 .1 .2 .3 0 0\nB .1 .6 .7 .8 0 0\nB .1 .35 .9 .15 0 0\n"));
  sys = read_text("1\nLattice=\"9 0 0 0 9 0 0 0 9\" Properties=pos:I:3:radius:I:1\n1 2 3 1\n");
  assert_string_equal(jam_notes(sys), "");
  jam_destroy(sys);
  sys = read_text("2\n" BOX "Properties=id:I:1:pos:R:3:radius:R:1\n1 .6 .7 .8 .1\n0 .1 .2 .3 .1\n");
  assert_string_equal(jam_notes(sys), "the ids of the file do not count up: spheres keep its order, ids are not kept");
  jam_destroy(sys);
  expect_refused("1\n" BOX BOX "Properties=pos:R:3:radius:R:1\n.1 .2 .3 .1\n", JAM_E_FORMAT,
                 "'Lattice=' is there twice");
  expect_refused("1\n" BOX "Properties=pos:R:3:radius:R:1:radius:R:1\n.1 .2 .3 .1 .2\n", JAM_E_FORMAT,
                 "two columns give");
  expect_refused("1\n" BOX "Properties=pos:R:3:radius:R:1:diameter:R:1\n.1 .2 .3 .1 .2\n", JAM_E_FORMAT, "two columns");
  expect_refused("1\n" BOX "Properties=pos:R:3:radius:R:1 dim=2\n.1 .2 .3 .1\nmore\n", JAM_E_FORMAT,
                 "there is more after");
  expect_refused("2\n" BOX "Properties=pos:R:3:radius:R:1 dim=2\n.1 .2 0 .1\n.5 .5 .3 .1\n", JAM_E_UNSUPPORTED,
                 "line 4: the third coordinate is 0.3, that of the first disk 0");
  expect_refused("1\n" BOX "Properties=pos:R:3:radius:R:1 pbc=\"T T F\"\n.1 .2 0 .1\n", JAM_E_UNSUPPORTED,
                 "needs dim=2");
  o.dim = 2;
  sys = read_as("1\n" BOX "Properties=pos:R:3:radius:R:1 pbc=\"T T F\"\n.1 .2 7 .1\n", NULL, &o);
  assert_int_equal(info_of(sys).dim, 2);
}

CASE(frames) {
  jam_create_options o = defaults();
  static const char frame[] = "1\n" BOX "Properties=pos:R:3:radius:R:1\n%g .2 .3 .1\n";
  char text[600], cut[600];
  size_t len, k;
  for (len = k = 0; k < 3; ++k) len += (size_t)snprintf(text + len, sizeof text - len, frame, 0.125 * (double)(k + 1));
  jam_system *sys = read_text(text);
  assert_true(view_of(sys, JAM_VIEW_POSITIONS)[0] == 0.375);
  assert_string_equal(jam_notes(sys), "the last of 3 frames was read; frame=0 to 2 read others");
  jam_destroy(sys);
  for (o.frame = -3; o.frame <= 2; ++o.frame) {
    sys = read_as(text, NULL, &o);
    assert_true(view_of(sys, JAM_VIEW_POSITIONS)[0] == 0.125 * (double)((o.frame + 3) % 3 + 1));
    jam_destroy(sys);
  }
  expect_refused_as(text, NULL, &o, JAM_E_ARGUMENT, "frame is 3, the file has 3 (0 to 2");
  o.frame = -4;
  expect_refused_as(text, NULL, &o, JAM_E_ARGUMENT, "frame is -4, the file has 3");
  o.frame = 1;
  expect_refused_as("2\n1\n0.1\n0.5 0.5\n", NULL, &o, JAM_E_ARGUMENT,
                    "frame is 1, but plain text contains one packing");
  snprintf(cut, sizeof cut, "%.*s", (int)len - 5, text); /* a job that was killed amid a frame */
  expect_refused(cut, JAM_E_FORMAT, "; frame=1 can be read");
  jam_destroy(read_as(cut, NULL, &o));
}

/* One table knows files by their first bytes and words, whatever their names. */
CASE(known_by_their_beginning) {
  static const struct {
    const char *bytes;
    size_t length;
    const char *part;
  } files[] = {
#define FILE_OF(bytes, part) {bytes, sizeof bytes - 1, part}
      FILE_OF("\x89HDF\r\n\x1a\n\0\0\0", "HDF5: jam.load of Python"),
      FILE_OF("jam packing file, format 1\nlength 1\n", "a packing of System.save: jam.load of Python"),
      FILE_OF("\xdf\x65\xdf\x65\xdf\x65\xdf\x65\0\0", "GSD of HOOMD-blue: System.read of Python"),
      FILE_OF("\x93NUMPY\x01\0v\0{'descr'", "numpy (npy)"),
      FILE_OF("PK\x03\x04\x14\0\0\0", "a zip archive"),
      FILE_OF("BZh91AY", "packed by bzip2: unpack it"),
      FILE_OF("\xfd"
              "7zXZ\0\0",
              "packed by xz: unpack it"),
      FILE_OF("CDF\x01\0\0", "NetCDF"),
      FILE_OF("T\0\0\0CORD\0", "DCD trajectory"),
      FILE_OF("\x80\x04\x95\0\0", "pickle of Python"),
      FILE_OF("\xff\xfe"
              "3\0\n\0",
              "UTF-16"),
      FILE_OF("\x89PNG\r\n", "picture"),
      FILE_OF("ab\0cd", "binary file of an unknown format"),
      FILE_OF("CRYST1   10.0\nATOM      1\n", "PDB: it has no diameters"),
      FILE_OF("data_x\nloop_\n", "CIF: it has no diameters"),
      FILE_OF("# vtk DataFile Version 3.0\n", "VTK: such files are written only"),
      FILE_OF("<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\">\n\0\1", "VTK: such files are written only"),
      FILE_OF("<!DOCTYPE html>\n", "a page in HTML"),
      FILE_OF("{\n", "JSON"),
      FILE_OF("3\n3 1\n3\n0.2\n1 0 0 0 1 0 0 0 1\nT T T\n0.1 0.2 0.3\n",
              "Skoge and Donev: of equal spheres `sed -e 2d -e 5,6d FILE`"),
      FILE_OF("3\n1.0 1.0 1.0\na 0.1 0.2 0.3 0.1\n", "a snapshot of EDMD (.sph): make line 2 Lattice="),
      FILE_OF("Version 2.0\n====\nInstructions:\n", "particle input of MFIX: its rows are a table"),
      FILE_OF("3\nmy packing\n1 0.1 0.2 0.3 0.1\n", "XYZ without keys on line 2: make line 2 Lattice="),
      FILE_OF("3\nt = 0\n1 0.1 0.2 0.3 0.1\n", "line 2: no Properties=, such as Properties=species:S:1"),
      FILE_OF("hello\n", "line 1: 'hello' begins no file that is read"),
  };
  for (size_t k = 0; k < sizeof files / sizeof *files; ++k) {
    jam_system *sys = NULL;
    put_bytes(in_scratch("in.any"), files[k].bytes, files[k].length);
    assert_int_equal(jam_read(in_scratch("in.any"), NULL, NULL, NULL, &sys), JAM_E_FORMAT);
    if (!strstr(jam_last_error(), files[k].part)) fail_msg("'%s' without '%s'", jam_last_error(), files[k].part);
  }
  {
    jam_system *sys = some_packing(3, 8, 1.0, 1.0), *back = NULL;
    assert_int_equal(jam_write_checkpoint(sys, in_scratch("state")), JAM_OK);
    SAYS(jam_read(in_scratch("state"), NULL, NULL, NULL, &back), JAM_E_FORMAT,
         "a checkpoint of libjam: jam_read_checkpoint");
    jam_destroy(sys);
  }
}

/* Options that the file answers must agree with it. */
CASE(options_that_contradict_the_file) {
  const char *text = "3\n1\n0.2\n0.1 0.2 0.3\n", *xyz = "1\n" BOX "Properties=pos:R:3:radius:R:1\n.1 .2 .3 .1\n";
  jam_create_options o = defaults();
  o.n = 77;
  expect_refused_as(text, NULL, &o, JAM_E_ARGUMENT, "the option n is 77, but the file has 1");
  o = defaults(), o.dim = 4;
  expect_refused_as(text, NULL, &o, JAM_E_ARGUMENT, "the option dim is 4, but the file has 3");
  o = defaults(), o.box = 5.0;
  expect_refused_as(xyz, NULL, &o, JAM_E_ARGUMENT, "the option box is 5, but the file has 1");
  const char *mixture = "1\n" BOX "Properties=pos:R:3:radius:R:1 non_additivity=0.25\n.1 .2 .3 .1\n";
  o = defaults(), o.non_additivity = 0.5;
  expect_refused_as(mixture, NULL, &o, JAM_E_ARGUMENT, "the option non_additivity is 0.5, but the file has 0.25");
  expect_refused("1\n" BOX "Properties=pos:R:3:radius:R:1 non_additivity=-2\n.1 .2 .3 .1\n", JAM_E_ARGUMENT,
                 "line 2: non_additivity is -2");
  o = defaults(), o.packing_fraction = 0.3;
  expect_refused_as(text, NULL, &o, JAM_E_ARGUMENT, "packing_fraction is 0.3");
  o = defaults(), o.n = 1, o.box = 5.0;
  jam_destroy(read_as(text, NULL, &o));
}

static char log_text[2000];
static void keep_line(int32_t level, const char *line, void *user) {
  (void)user;
  snprintf(log_text + strlen(log_text), sizeof log_text - strlen(log_text), "%d %s\n", (int)level, line);
}

/* Shrinking changes all diameters: factor and pair are told, in the notes, in those of a copy and in the log. */
CASE(shrinking_is_told) {
  jam_create_options o = defaults();
  OWNED jam_system *sys = NULL, *copy = NULL;
  const double x[4] = {0.1, 0.5, 0.4, 0.5}, sigma = 0.4;
  double factor = 0.0;
  int i = -1, j = -1;
  o.dim = 2;
  o.overlap = JAM_OVERLAP_SHRINK;
  assert_int_equal(create_from(&o, x, 4, &sigma, 1, &sys), JAM_OK);
  assert_int_equal(
      sscanf(jam_notes(sys), "warning: all diameters were multiplied by %lf: spheres %d and %d", &factor, &i, &j), 3);
  assert_true(fabs(factor - 0.75) < 1e-15);
  assert_int_equal(i, 0);
  assert_int_equal(j, 1);
  assert_int_equal(jam_copy(sys, &copy), JAM_OK);
  assert_string_equal(jam_notes(copy), jam_notes(sys));
  assert_int_equal(jam_set_log(copy, keep_line, JAM_LOG_WARNING, NULL), JAM_OK);
  assert_memory_equal(log_text, "1 all diameters were multiplied by", 34);
  assert_string_equal(jam_notes(NULL), "");
}

/* One duplicate must not take the diameters of all the others. */
CASE(absurd_factors_are_refused) {
  jam_create_options o = defaults();
  const char *near = "2\n3\n0.3\n0.1 0.5\n0.1000001 0.5\n0.6 0.6\n", *faces = "2\n3\n0.3\n0 0.5\n1 0.5\n0.5 0.1\n";
  o.overlap = JAM_OVERLAP_SHRINK;
  expect_refused_as(near, NULL, &o, JAM_E_OVERLAP, "spheres 0 and 1 overlapped by 1 of their contact distance");
  expect_refused_as(near, NULL, &o, JAM_E_OVERLAP, "less than shrink_min 0.001; leave one of two duplicates out");
  expect_refused_as(faces, NULL, &o, JAM_E_OVERLAP, "spheres 0 and 1 have the same centre: no shrinking helps");
  expect_refused(faces, JAM_E_OVERLAP, "they have the same centre");
  o.overlap = JAM_OVERLAP_ALLOW;
  jam_destroy(read_as(near, NULL, &o));
  o.overlap = JAM_OVERLAP_SHRINK;
  o.shrink_min = 1e-8;
  jam_destroy(read_as(near, NULL, &o));
  o.shrink_min = 2.0;
  expect_refused_as(near, NULL, &o, JAM_E_ARGUMENT, "shrink_min is 2, supported are 0..1");
}

FIXTURE(make_scratch, remove_scratch)
