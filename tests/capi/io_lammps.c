/* LAMMPS data and dumps: each line is understood as LAMMPS understands it, or refused with its number. */
#include <math.h>
#include "io_helpers.h"

/* The same spheres, to a few roundings of the box. */
static void same_spheres(jam_system *sys, int32_t dim, size_t n, const double *x, const double *sizes, double box) {
  const double *const y = view_of(sys, JAM_VIEW_POSITIONS);
  assert_true(fabs(info_of(sys).box / box - 1) < 1e-14);
  for (size_t k = 0; k < (size_t)dim * n; ++k)
    if (!(fabs(x[k] - y[k]) < 1e-14 * box)) fail_msg("coordinate %zu is %.17g, not %.17g", k, y[k], x[k]);
  expect(sys, dim, (int64_t)n, y, sizes);
}

#define BOX "0 2 xlo xhi\n0 2 ylo yhi\n0 2 zlo zhi\n"
#define ROWS "\nAtoms # sphere\n\n1 1 0.2 1 0.1 0.2 0.3\n2 1 0.2 1 1.6 1.7 1.8\n3 1 0.2 1 0.35 0.9 0.15\n"
#define HEAD "LAMMPS\n\n3 atoms\n1 atom types\n"
static const double three[9] = {0.1, 0.2, 0.3, 1.6, 1.7, 1.8, 0.35, 0.9, 0.15}, size[3] = {0.2, 0.2, 0.2};

/* LAMMPS of September 2021 takes all of these but the D exponents, which can mean one thing only. */
CASE(headers_as_lammps_takes_them) {
  static const char *const texts[] = {
      HEAD BOX ROWS,
      HEAD "0 2 xlo xhi (x)\n0 2 ylo yhi ! y\n0 2 zlo zhi and more\n" ROWS,
      HEAD "0.0D+00 2.0d+00 xlo xhi\n0 .2D1 ylo yhi\n0 2 zlo zhi\n" ROWS,
      "Granular packing\n\n3 atoms (third line)\n1 atom types\n" BOX ROWS,
      "\n3 atoms\n1 atom types\n" BOX ROWS,
      "7\n3 atoms # by hand\n\n# nothing\n1 atom types\n" BOX
      "\nMasses\n\n1 1\n\nPair Coeffs # granular\n\n1 2 3\n" ROWS,
      HEAD "0 bonds\n0 bond types\n2 extra bond per atom\n0 ellipsoids\n" BOX ROWS "\nVelocities\n\n1 0 0 0 0 0 0\n",
      HEAD "2 0 0 avec\n0 2 0 bvec\n0 0 2 cvec\n0 0 0 abc origin\n" ROWS,
      "\xef\xbb\xbf" HEAD BOX ROWS,
  };
  for (size_t k = 0; k < sizeof texts / sizeof *texts; ++k) same_spheres(read_text(texts[k]), 3, 3, three, size, 2.0);
  same_spheres(read_text("t\r\n\r\n3 atoms\r\n" BOX ROWS), 3, 3, three, size, 2.0);
}

CASE(what_is_not_read_is_said) {
  OWNED jam_system *sys =
      read_text(HEAD "0 2 xlo xhi (x)\n0 2 ylo yhi\n0 2 zlo zhi\n" ROWS "\nVelocities\n\n1 0 0 0 0 0 0\n");
  assert_string_equal(jam_notes(sys),
                      "line 5: text behind 'xhi' was not read\nsections of the file that were not read: Velocities\n"
                      "the file does not say which directions are periodic: all are taken as periodic; the options "
                      "walls and container name walls");
}

/* As write_data of LAMMPS leaves it: a box that does not start at 0, atoms in any order, image counts, velocities. */
CASE(lammps_writes_it_otherwise) {
  static const char text[] =
      "LAMMPS data file via write_data\n\n3 atoms\n2 atom types\n\n-1 3 xlo xhi\n1 5 ylo yhi\n0 4 zlo zhi\n\n"
      "Atoms # sphere\n\n3 1 0.5 1.9 2 4 3 0 0 0\n1 1 1 1.9 -0.5 1.5 0.5 0 0 1\n2 2 0.25 1.9 1 3 2 0 0 0\n\n"
      "Velocities\n\n1 0 0 0 0 0 0\n2 0 0 0 0 0 0\n3 0 0 0 0 0 0\n";
  const double want[9] = {0.5, 0.5, 0.5, 2, 2, 2, 3, 3, 3}, sizes[3] = {1.0, 0.25, 0.5};
  same_spheres(noted(read_text(text), "sorted by their ids"), 3, 3, want, sizes, 4.0);
}

CASE(tilts_are_kept) {
  const double want[9] = {2, 0, 0, 0.5, 2, 0, 0, 0, 2};
  static const char *const texts[] = {
      HEAD BOX "0.5 0 0 xy xz yz tilt\n" ROWS,
      HEAD "2 0 0 avec\n0.5 2 0 bvec\n0 0 2 cvec # rows\n" ROWS,
  };
  for (size_t k = 0; k < 2; ++k) {
    OWNED jam_system *sys = read_text(texts[k]);
    expect_cell(sys, want, 9);
  }
}

CASE(data_that_cannot_be_read) {
#define TWO "LAMMPS\n\n2 atoms\n\n0 1 xlo xhi\n0 1 ylo yhi\n0 1 zlo zhi\n\n"
  expect_refused(TWO "Atoms # atomic\n\n1 1 0 0 0\n", JAM_E_UNSUPPORTED, "atom_style 'atomic' has no diameters");
  expect_refused(TWO "Atoms\n\n1 1 0.1 1 0.2 0.2 0.2\n", JAM_E_FORMAT, "ends after 1 of 2 spheres");
  expect_refused(TWO "Atoms\n\n1 1 0.1 1 0.2 0.2 0.2\n1 1 0.1 1 0.7 0.2 0.2\n", JAM_E_FORMAT, "atom 1 is there twice");
  expect_refused(TWO "Atoms\n\n1 1 0.1 0.2 0.2 0.2\n", JAM_E_FORMAT, "line 11: 6 columns");
  expect_refused(TWO, JAM_E_FORMAT, "ends before the section Atoms");
  expect_refused("LAMMPS\n\nAtoms\n\n1 1 0.1 1 0 0 0\n", JAM_E_FORMAT, "no line '<N> atoms'");
  expect_refused("LAMMPS\n\n1 atoms\n1 1 xlo xhi\n", JAM_E_FORMAT, "no extent along x");
#undef TWO
  expect_refused(HEAD "0 2 xlo xhi\n0 2 ylo yhi\n" ROWS, JAM_E_FORMAT, "no line '<low> <high> zlo zhi'");
  expect_refused(HEAD ROWS, JAM_E_FORMAT, "no line '<low> <high> xlo xhi'");
  expect_refused(HEAD "0 2 xlo\n" ROWS, JAM_E_FORMAT, "line 5: '0 2 xlo' is no line of a header");
  expect_refused(HEAD BOX "2 0 0 avec\n" ROWS, JAM_E_FORMAT, "not parts of both");
  expect_refused(HEAD "1 ellipsoids\n" BOX ROWS, JAM_E_UNSUPPORTED, "line 5: ellipsoids are no spheres");
  expect_refused(HEAD BOX ROWS "4 1 0.2 1 0.7 0.7 0.7\n", JAM_E_FORMAT, "line 14: there is more after the 3 atoms");
  expect_refused(HEAD BOX ROWS ROWS, JAM_E_FORMAT, "second section Atoms");
  expect_refused(HEAD BOX "0 3 xlo xhi\n" ROWS, JAM_E_FORMAT,
                 "line 8: a bound of the box is given twice in the header");
  expect_refused(HEAD "4 atoms\n" BOX ROWS, JAM_E_FORMAT, "line 5: the number of atoms is given twice in the header");
  expect_refused(HEAD BOX "\nAtoms # sphere\n\n1 1 0.2 1 0.1 0.2 0.3 7\n", JAM_E_FORMAT, "line 11: 8 columns");
  expect_refused(HEAD BOX "\nAtoms # sphere\n\n1 1 0.2 0 0.1 0.2 0.3\n", JAM_E_FORMAT, "line 11: the density is '0'");
  expect_refused(HEAD BOX "\nAtoms # full\n\n1 1 1 0.5 1 2 3\n", JAM_E_UNSUPPORTED, "'full' has no diameters");
  expect_refused(HEAD BOX "\nAtoms # sphere\n\n1 1 0.2 1 0.1 0.2 0.3 0 0 0.5\n", JAM_E_FORMAT, "is not an image count");
}

/* Rows of atom_style full have as many columns as those of sphere: id, molecule, type, charge. */
CASE(a_section_without_style) {
  same_spheres(
      noted(read_text(HEAD BOX "\nAtoms\n\n1 1 0.2 1 0.1 0.2 0.3\n2 1 0.2 1 1.6 1.7 1.8\n3 1 0.2 1 0.35 0.9 0.15\n"),
            "warning: the section Atoms names no style: atom_style sphere was assumed"),
      3, 3, three, size, 2.0);
#define FULL "t\n\n2 atoms\n2 atom types\n0 9 xlo xhi\n0 9 ylo yhi\n0 9 zlo zhi\n\nAtoms\n\n"
  expect_refused(FULL "1 1 1 0.0 1 2 3\n2 1 2 0.0 6 7 8\n", JAM_E_FORMAT, "line 11: the density is '0.0'");
  expect_refused(FULL "1 1 1 0.4 1 2 3\n2 1 2 0.4 6 7 8\n", JAM_E_FORMAT, "write 'Atoms # sphere'");
  expect_refused(FULL "1 7 1 0.4 1 2 3\n2 7 2 0.4 6 7 8\n", JAM_E_FORMAT, "the type 7 is not one of the 2");
#undef FULL
}

#define DUMP "ITEM: TIMESTEP\n5\nITEM: NUMBER OF ATOMS\n3\n"
#define BOUNDS "ITEM: BOX BOUNDS pp pp pp\n-1 1\n0 2\n1 3\n"
#define DUMP1 "ITEM: TIMESTEP\n5\nITEM: NUMBER OF ATOMS\n1\n"
CASE(dumps_in_any_form) {
  static const char *const texts[] = {
      DUMP BOUNDS
      "ITEM: ATOMS id type radius x y z \n1 1 0.1 -0.9 0.2 1.3 \n2 1 0.1 0.6 1.7 2.8 \n3 1 0.1 -0.65 0.9 1.15 \n",
      DUMP BOUNDS "ITEM: ATOMS z y diameter x\n1.3 0.2 0.2 -0.9\n2.8 1.7 0.2 0.6\n1.15 0.9 0.2 -0.65\n",
      DUMP BOUNDS "ITEM: ATOMS xs ys zs radius\n0.05 0.1 0.15 0.1\n0.8 0.85 0.9 0.1\n0.175 0.45 0.075 0.1\n",
      "ITEM: UNITS\nlj\nITEM: TIME\n0.5\n" DUMP BOUNDS
      "ITEM: ATOMS id xu yu zu radius\n7 1.1 0.2 -0.7 0.1\n5 0.6 1.7 2.8 0.1\n6 -0.65 0.9 1.15 0.1\n",
      DUMP
      "ITEM: BOX BOUNDS abc origin pp pp pp\n2 0 0 -1\n0 2 0 0\n0 0 2 1\n"
      "ITEM: ATOMS radius x y z\n0.1 -0.9 0.2 1.3\n0.1 0.6 1.7 2.8\n0.1 -0.65 0.9 1.15\n",
  };
  for (size_t k = 0; k < sizeof texts / sizeof *texts; ++k) {
    jam_system *sys = read_text(texts[k]);
    if (k == 0) assert_non_null(strstr(jam_notes(sys), "columns of the file that were not read: type"));
    if (k == 3) {
      assert_non_null(strstr(jam_notes(sys), "ids of the dump do not count up: spheres keep its order"));
      assert_non_null(strstr(jam_notes(sys), "1 of 3 spheres lay outside the cell"));
    }
    same_spheres(sys, 3, 3, three, size, 2.0);
  }
}

/* Bounds of a tilted box are those of the brick around it. */
CASE(tilted_dumps) {
  const double want[9] = {2, 0, 0, 0.5, 2, 0, -0.3, 0.25, 2}, flat[4] = {2, 0, 0.5, 2}, at[2] = {0.35, 0.4};
  double cell[9];
  OWNED jam_system *sys = read_text(DUMP
                                    "ITEM: BOX BOUNDS xy xz yz pp pp pp\n-0.3 2.5 0.5\n0 2.25 -0.3\n0 2 0.25\n"
                                    "ITEM: ATOMS radius x y z\n0.1 0.5 0.5 0.5\n0.1 1 1 1\n0.1 1.5 1.5 1.5\n");
  jam_get_cell(sys, cell, 9, NULL);
  for (size_t len = 0; len < 9; ++len) assert_true(fabs(cell[len] - want[len]) < 1e-15);
  jam_destroy(sys);
  sys = read_text(
      "ITEM: TIMESTEP\n5\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS xy xz yz pp pp pp\n0 2.5 0.5\n0 2 0\n-0.5 0.5 0\n"
      "ITEM: ATOMS radius xs ys zs\n0.1 0.125 0.2 0.5\n");
  expect_cell(sys, flat, 4);
  const double *x = view_of(sys, JAM_VIEW_POSITIONS);
  assert_true(fabs(x[0] - at[0]) < 1e-15 && fabs(x[1] - at[1]) < 1e-15);
}

/* Disks, as LAMMPS dumps them: no column of z, or one of z = 0 to the digits of the others. */
CASE(dumps_of_disks) {
#define DISKS(low, high, columns, z)                                                                \
  "ITEM: TIMESTEP\n5\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n0 8\n0 8\n" low " " high \
  "\nITEM: ATOMS radius " columns "\n0.5 0.125 0.25" z "\n0.25 0.625 0.5" z "\n"
  static const double at[4] = {1, 2, 5, 4}, widths[2] = {1, 0.5};
  static const char *const texts[] = {
      DISKS("-0.5", "0.5", "xs ys", ""),
      DISKS("-0.5", "0.5", "xsu ysu", ""),
      DISKS("-0.5", "0.5", "xs ys zs", " 0.5"),
      DISKS("-1", "2", "xs ys zs", " 0.333333"),
      DISKS("-0.3", "0.4", "xs ys zs", " 0.428571"),
  };
  for (size_t k = 0; k < sizeof texts / sizeof *texts; ++k) expect(read_text(texts[k]), 2, 2, at, widths);
  /* a height that the digits tell from 0, and a box beside the plane */
  jam_system *sys = read_text(DISKS("-1", "2", "xs ys zs", " 0.3334"));
  assert_int_equal(info_of(sys).dim, 3);
  jam_destroy(sys);
  sys = read_text(DISKS("0", "1", "xs ys zs", " 0.5"));
  assert_int_equal(info_of(sys).dim, 3);
  jam_destroy(sys);
  /* fractions are measured from the corner, wherever that is */
  sys = read_text(DISKS("10000", "10008", "xs ys zs", " 0.12345678901234567"));
  assert_true(view_of(sys, JAM_VIEW_POSITIONS)[2] == 8 * 0.12345678901234567);
  jam_destroy(sys);
#undef DISKS
}

CASE(dumps_that_cannot_be_read) {
#define NAMES "ITEM: ATOMS id radius x y z\n"
  expect_refused(DUMP "ITEM: BOX BOUNDS pp pp\n0 1\n0 1\n0 1\n" NAMES, JAM_E_FORMAT, "2 boundaries instead of three");
  expect_refused(DUMP "ITEM: BOX BOUNDS pp pp fs\n0 1\n0 1\n0 1\n" NAMES, JAM_E_UNSUPPORTED,
                 "line 5: the boundary is 'fs'");
  expect_refused(DUMP BOUNDS "ITEM: ATOMS id x y z\n1 0 0 0\n", JAM_E_FORMAT, "no sizes: dump id radius x y z");
  expect_refused(DUMP BOUNDS "ITEM: ATOMS id radius\n1 0.1\n", JAM_E_FORMAT, "no positions");
  expect_refused(DUMP BOUNDS "ITEM: ATOMS x y z radius diameter\n1 0.1\n", JAM_E_FORMAT, "two columns give sizes");
  expect_refused(DUMP BOUNDS NAMES "1 0.1 0 0 1\n1 0.1 0.5 0.5 2\n2 0.1 0.2 1 2\n", JAM_E_FORMAT,
                 "atom 1 is there twice");
  expect_refused(DUMP BOUNDS NAMES "1 0.1 0 0 1\n2 0.1 0.5 0.5\n", JAM_E_FORMAT,
                 "line 11: 4 columns, ITEM: ATOMS names 5");
  expect_refused(DUMP BOUNDS NAMES "1 0.1 0 0 1\n2 0.1 0.5 0.5 2\n", JAM_E_FORMAT, "ends after 2 of 3");
  expect_refused(DUMP NAMES "1 0.1 0 0 1\n", JAM_E_FORMAT, "must come before ITEM: ATOMS");
  expect_refused("ITEM: TIMESTEP\n1\nITEM: NUMBER OF ENTRIES\n1\n", JAM_E_UNSUPPORTED, "no part of a dump of atoms");
  expect_refused(DUMP BOUNDS, JAM_E_FORMAT, "ends before ITEM: ATOMS");
  expect_refused(DUMP BOUNDS BOUNDS, JAM_E_FORMAT, "line 9: BOX BOUNDS are given twice in one frame");
#undef NAMES
}

#define NAMES "ITEM: ATOMS id radius x y z\n"
#define ONE NAMES "1 0.1 0.5 0.5 0.5\n"
static jam_status read_walled(const char *text, int32_t container, int32_t walls, jam_system **sys) {
  const char *path = in_scratch("walled");
  DEFAULTS(create, o);
  o.container = container, o.walls = walls;
  put_bytes(path, text, strlen(text));
  return jam_read(path, &o, NULL, NULL, sys);
}

static int32_t closed_by(const char *text, int32_t container, int32_t walls, int *noted) {
  OWNED jam_system *sys = NULL;
  assert_int_equal(read_walled(text, container, walls, &sys), JAM_OK);
  const jam_info info = info_of(sys);
  assert_int_equal(info.container, container);
  *noted = strstr(jam_notes(sys), "does not say which directions are periodic") != NULL;
  return info.walls;
}

/* Files that do not say where walls stand are periodic with a note, or have the walls that the caller names. What a
 * file says is not overruled. */
CASE(walls_are_named_by_the_file_or_the_caller) {
  static const char data[] =
      "data\n\n1 atoms\n1 atom types\n0 1 xlo xhi\n0 1 ylo yhi\n0 1 zlo zhi\n"
      "\nAtoms # sphere\n\n1 1 0.2 1 0.5 0.5 0.5\n";
  static const char plain[] = "3\n1\n0.2\n0.5 0.5 0.5\n", table[] = "x y z radius\n0.5 0.5 0.5 0.1\n";
  static const char open[] = DUMP1 "ITEM: BOX BOUNDS\n0 1\n0 1\n0 1\n" ONE;
  static const char slit[] = DUMP1 "ITEM: BOX BOUNDS pp pp ff\n0 1\n0 1\n0 1\n" ONE;
  static const char tube[] = DUMP1 "ITEM: BOX BOUNDS fm ss pp\n0 1\n0 1\n0 1\n" ONE;
  static const char cell[] = DUMP1 "ITEM: BOX BOUNDS pp pp pp\n0 1\n0 1\n0 1\n" ONE;
  static const char xyz[] =
      "1\nLattice=\"1 0 0 0 1 0 0 0 1\" pbc=\"T T F\" Properties=pos:R:3:radius:R:1\n.5 .5 .5 .1\n";
  static const char own[] =
      "LAMMPS data file by libjam container=brick walls=\"F F T\"\n\n1 atoms\n1 atom types\n"
      "0 1 xlo xhi\n0 1 ylo yhi\n0 1 zlo zhi\n\nAtoms # sphere\n\n1 1 0.2 1 0.5 0.5 0.5\n";
  const char *const silent[] = {data, table, open};
  jam_system *sys = NULL;
  int noted;
  for (size_t k = 0; k < 3; ++k) {
    assert_int_equal(closed_by(silent[k], JAM_CONTAINER_BRICK, 0, &noted), 0);
    assert_true(noted);
    assert_int_equal(closed_by(silent[k], JAM_CONTAINER_BRICK, 4, &noted), 4);
    assert_false(noted);
    closed_by(silent[k], JAM_CONTAINER_BALL, 0, &noted);
  }
  assert_int_equal(closed_by(plain, JAM_CONTAINER_BRICK, 0, &noted), 0);
  assert_false(noted);
  assert_int_equal(closed_by(plain, JAM_CONTAINER_BRICK, 3, &noted), 3);
  assert_int_equal(closed_by(slit, JAM_CONTAINER_BRICK, 4, &noted), 4);
  assert_int_equal(closed_by(xyz, JAM_CONTAINER_BRICK, 4, &noted), 4);
  assert_int_equal(closed_by(tube, JAM_CONTAINER_CYLINDER, 0, &noted), 0);
  assert_int_equal(closed_by(own, JAM_CONTAINER_BRICK, 4, &noted), 4);
  assert_false(noted);
  SAYS(read_walled(slit, JAM_CONTAINER_BRICK, 0, &sys), JAM_E_UNSUPPORTED, "line 5: the boundary is 'ff'");
  assert_non_null(strstr(jam_last_error(), "the options walls and container name the walls"));
  SAYS(read_walled(slit, JAM_CONTAINER_BRICK, 6, &sys), JAM_E_FORMAT,
       "the boundary of y is 'pp', periodic, but container and walls close it");
  SAYS(read_walled(cell, JAM_CONTAINER_BRICK, 4, &sys), JAM_E_FORMAT, "the boundary of z is 'pp'");
  assert_int_equal(read_walled(xyz, JAM_CONTAINER_BRICK, 0, &sys), JAM_E_UNSUPPORTED);
  assert_int_equal(read_walled(xyz, JAM_CONTAINER_CYLINDER, 4, &sys), JAM_E_FORMAT);
  SAYS(read_walled(own, JAM_CONTAINER_BRICK, 1, &sys), JAM_E_ARGUMENT,
       "close other axes than the file: leave them out");
  assert_null(sys);
}
#undef ONE
#undef NAMES

FIXTURE(make_scratch, remove_scratch)
