/* What coordinates of a file mean: origin, cell, planes and frames. What was changed stands in jam_notes. */
#include "io_helpers.h"

#define BOX "Lattice=\"1 0 0 0 1 0 0 0 1\" "
#define P "Properties=pos:R:3:radius:R:1 "
/* Keys that change what coordinates mean are honoured, the others named. */
CASE(keys_of_xyz) {
  OWNED jam_system *sys = read_text("1\n" BOX P "Origin=\"-0.5 -0.25 1\"\n-0.25 0.25 1.125 .1\n");
  const double *x = view_of(sys, JAM_VIEW_POSITIONS);
  assert_true(x[0] == 0.25 && x[1] == 0.5 && x[2] == 0.125);
  assert_string_equal(jam_notes(sys),
                      "the corner of the cell is at -0.5 -0.25 1 in the file: positions are measured from there");
  jam_destroy(sys);
  sys = read_text("1\n" BOX P "Origin=\"0 0 0\" Time=0.5 energy=-1 step\n.1 .2 .3 .1\n");
  assert_string_equal(jam_notes(sys), "keys of the file that were not read: Time, energy");
  jam_destroy(sys);
  sys = read_text("1\n" BOX P "dim=2 Origin=\"-0.5 -0.5 0\"\n-.25 .25 2 .1\n");
  x = view_of(sys, JAM_VIEW_POSITIONS);
  assert_true(info_of(sys).dim == 2 && x[0] == 0.25 && x[1] == 0.75);
  assert_non_null(strstr(jam_notes(sys), "the third coordinate, 2 of every disk, was omitted"));
  expect_refused("1\n" BOX P "Origin=\"0 1\"\n.1 .2 .3 .1\n", JAM_E_FORMAT, "line 2: Origin has 2 numbers");
  expect_refused("1\n" BOX P "Origin=\"0 x 1\"\n.1 .2 .3 .1\n", JAM_E_FORMAT, "line 2: 'x' is not a number");
  expect_refused("1\n" BOX "Properties=pos:R:4:radius:R:1 Origin=\"0 1 0\"\n.1 .2 .3 .4 .1\n", JAM_E_UNSUPPORTED,
                 "line 2: Origin has 3 numbers, d = 4 needs 4");
  expect_refused("1\n" BOX P "pbc=\"\"\n.1 .2 .3 .1\n", JAM_E_UNSUPPORTED, "line 2: pbc=''");
  expect_refused("1\n" BOX P "pbc=T\n.1 .2 .3 .1\n", JAM_E_UNSUPPORTED, "line 2: pbc='T'");
  expect_refused("1\n" BOX "Properties=pos:R:4:radius:R:1 cell=\"2 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\"\n.1 .2 .3 .4 .1\n",
                 JAM_E_FORMAT, "line 2: Lattice and cell differ");
}

/* Where a file has its origin elsewhere, positions are not those of its rows: that is said. */
CASE(corners_elsewhere) {
  static const char corner[] = "the corner of the cell is at -1 0 0.5 in the file: positions are measured from there";
  jam_system *sys;
  const double *x;
  for (size_t k = 0; k < 2; ++k) {
    sys = read_text(k ? "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n1\nITEM: BOX BOUNDS pp pp pp\n-1 1\n0 2\n0.5 2.5\n"
                        "ITEM: ATOMS id x y z radius\n1 0 1 1 0.1\n"
                      : "t\n\n1 atoms\n1 atom types\n-1 1 xlo xhi\n0 2 ylo yhi\n0.5 2.5 zlo zhi\n\nAtoms # sphere\n\n"
                        "1 1 0.2 1 0 1 1\n");
    x = view_of(sys, JAM_VIEW_POSITIONS);
    assert_true(x[0] == 1.0 && x[1] == 1.0 && x[2] == 0.5);
    assert_non_null(strstr(jam_notes(sys), corner));
    jam_destroy(sys);
  }
}

/* The cell of a handle is lower-triangular: another one is rotated, and the spheres with it. Extreme vectors give way.
 */
CASE(cells_that_are_changed) {
  OWNED jam_system *sys = read_text("1\nLattice=\"0 2 0 -2 0 0 0 0 2\" " P "\n.1 .2 .3 .1\n");
  assert_non_null(strstr(jam_notes(sys), "rotated with the cell"));
  assert_null(strstr(jam_notes(sys), "shorter"));
  jam_destroy(sys);
  sys = read_text("1\nLattice=\"2 0 0 4 2 0 0 0 2\" " P "\n.1 .2 .3 .1\n");
  assert_string_equal(jam_notes(sys), "");
  jam_destroy(sys);
  sys = read_text("1\nLattice=\"2 0 0 400 2 0 0 0 2\" " P "\n.1 .2 .3 .1\n");
  assert_string_equal(
      jam_notes(sys),
      "the cell vectors were replaced by shorter ones of the same lattice: the product of their lengths "
      "was over 32 V");
}

FIXTURE(make_scratch, remove_scratch)
