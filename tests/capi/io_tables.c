/* Tables as other programs write them, what the caller says of a file that does not say it (jam_read_as), cells of the
 * code of Torquato and Jiao, frames without spheres, and what jam_formats lists. */
#include "io_helpers.h"

static jam_system *read_in(const char *text, const char *layout, double box) {
  DEFAULTS(create, o);
  o.box = box;
  return read_as(text, layout, &o);
}

static const double two[] = {0.5, 0.5, 0.5, 1.5, 1.5, 1.5}, sizes[] = {0.4, 0.5};

CASE(headings) {
  static const char *const texts[] = {
      "X [m],Y [m],Z [m],Radius [m]\n0.5,0.5,0.5,0.2\n1.5,1.5,1.5,0.25\n",
      "\"radius\",\"id\",\"Points:0\",\"Points:1\",\"Points:2\"\n0.2,1,0.5,0.5,0.5\n0.25,2,1.5,1.5,1.5\n",
      ("ID,X-Coordinate (mm),Y-Coordinate (mm),Z-Coordinate (mm),Particle Diameter "
       "(mm)\n7,.5,.5,.5,.4\n8,1.5,1.5,1.5,.5\n"),
      "Center X, Center Y, Center Z, Diameter\r\n.5, .5, .5, .4\r\n1.5, 1.5, 1.5, .5\r\n",
      "\xef\xbb\xbfname,x_coord,y_coord,z_coord,vx,r\n\"grain, a\",.5,.5,.5,9,.2\n\"b c\",1.5,1.5,1.5,9,.25\n",
      "# pos_x pos_y pos_z radius\n.5 .5 .5 .2\n1.5 1.5 1.5 .25\n",
      "x (mm) y [ mm ] z (mm) radius (mm)\n.5 .5 .5 .2\n1.5 1.5 1.5 .25\n",
      "#format x_y_z_r_matId\n.5 .5 .5 .2 1\n1.5 1.5 1.5 .25 1\n",
      /* ParaView of MFIX; particles of Rocky and of EDEM */
      "\"Diameter\",\"Particle_ID\",\"Points:0\",\"Points:1\",\"Points:2\"\n.4,1,.5,.5,.5\n.5,2,1.5,1.5,1.5\n",
      ("Particle X-Coordinate [m],Particle Y-Coordinate [m],Particle Z-Coordinate [m],Particle Size "
       "[m]\n.5,.5,.5,.4\n1.5,1.5,1.5,.5\n"),
      "Particle Position X (m),Particle Position Y (m),Particle Position Z (m),Particle Diameter (m)\n.5,.5,.5,.4\n"
      "1.5,1.5,1.5,.5\n",
  };
  /* a name with a comma inside its quotes parts the row */
  expect_refused_as(texts[4], "cell=3,3,3", NULL, JAM_E_FORMAT, "line 2");
  for (size_t k = 0; k < sizeof texts / sizeof *texts; ++k)
    if (k != 4) expect(read_in(texts[k], "", 3.0), 3, 2, two, sizes);
  expect(read_in("x,y,z,what,r\n.5,.5,.5,\"a b\",.2\n1.5,1.5,1.5,\"c d\",.25\n", "", 3.0), 3, 2, two, sizes);
  expect_refused("x;y;z;r\n0,5;0,5;0,5;0,2\n", JAM_E_FORMAT, "parted by semicolons");
  expect_refused("0,5;0,5;0,5;0,2\n", JAM_E_FORMAT, "parted by semicolons");
  expect_refused("x,y,z,X,r\n.1,.1,.1,.1,.1\n", JAM_E_FORMAT, "two columns are coordinate 1");
  /* lengths have one unit; columns that are not read may have any */
  expect_refused("X [m],Y [m],Z [m],D [mm]\n.1,.1,.1,.1\n", JAM_E_FORMAT, "'X [m]' and 'D [mm]' have two units");
  expect_refused("x,y (cm),z (m),r\n.1,.1,.1,.1\n", JAM_E_FORMAT, "'y (cm)' and 'z (m)' have two units");
  expect_refused("x (mm) y (mm) z (mm) radius (um)\n.1 .1 .1 .1\n", JAM_E_FORMAT,
                 "'x (mm)' and 'radius (um)' have two");
  expect_refused("# x[m] y[m] z[mm] r[m]\n.1 .1 .1 .1\n", JAM_E_FORMAT, "two units");
  expect(read_in("x [mm],y (mm),z,mass [g],r (radius) [mm]\n.5,.5,.5,9,.2\n1.5,1.5,1.5,9,.25\n", "", 3.0), 3, 2, two,
         sizes);
  expect_refused("vx,vy,vz,r\n.1,.1,.1,.1\n", JAM_E_FORMAT, "begins no file");
  expect_refused("x,y,z\n.1,.1,.1\n", JAM_E_FORMAT, "no size");
  /* neither program nor bindings have an option dim for it */
  expect_refused(".1 .1 .1 .1 7\n", JAM_E_FORMAT, "or by the option columns");
}

CASE(what_the_caller_says) {
  static const char rows[] = "-2 -2 -3.5 1 .2\n-1 -1 -2.5 2 .25\n";
  static const double moved[] = {0.5, 0.5, 0.5, 1.5, 1.5, 1.5};
  static const double tall[9] = {5, 0, 0, 0, 5, 0, 0, 0, 8}, tilted[4] = {2, 0, 0.5, 3};
  jam_system *sys = read_as(rows, "cell=5,5,8 origin=-2.5,-2.5,-4 columns=x,y,z,mass,radius", NULL);
  expect_cell(sys, tall, 9);
  assert_non_null(strstr(jam_notes(sys), "mass"));
  expect(noted(sys, "-2.5 -2.5 -4"), 3, 2, moved, sizes);
  /* rows of MFIX have no names: x y z radius density u v w */
  expect(noted(read_in(".5 .5 .5 .2 2500 0 0 0\n1.5 1.5 1.5 .25 2500 0 0 0\n",
                       "cell=3,3,3 columns=x,y,z,radius,density,u,v,w", 1.0),
               "not read: density, u, v, w"),
         3, 2, two, sizes);
  /* Rocky's word for the diameter of a sphere is quoted */
  expect(noted(read_as("x,y,z,Particle Size (m)\n.5,.5,.5,.4\n1.5,1.5,1.5,.5\n", "cell=3,3,3", NULL),
               "the column 'Particle Size (m)' was taken as the diameter"),
         3, 2, two, sizes);
  /* a row may begin with a word; a heading that columns= replaces is named */
  sys = read_as("x 0.5 0.5 0.5 .2\ny 1.5 1.5 1.5 .25\n", "cell=5,5,8 columns=name,x,y,z,radius", NULL);
  assert_null(strstr(jam_notes(sys), "heading"));
  expect(sys, 3, 2, two, sizes);
  expect(noted(read_in("# grains\nname X Y Z D\nb 0.5 0.5 0.5 .2\nc 1.5 1.5 1.5 .25\n",
                       "cell=5,5,8 columns=name,x,y,z,radius", 1.0),
               "line 2, 'name X Y Z D', has no number and was taken as a heading"),
         3, 2, two, sizes);
  sys = read_as("x y r\n.5 .5 .1\n", "cell=2,0,0.5,3", NULL);
  expect_cell(sys, tilted, 4);
  jam_destroy(sys);
  /* Yade names its periodic cell in a comment */
  sys = read_as("##PERIODIC:: 5 5 8\n#format x_y_z_r\n.5 .5 .5 .2\n1.5 1.5 1.5 .25\n", "", NULL);
  expect_cell(sys, tall, 9);
  expect(sys, 3, 2, two, sizes);
  expect(read_as("x y z r\n.5 .5 .5 .2\n1.5 1.5 1.5 .25\n", "cell=3,3,3", NULL), 3, 2, two, sizes);
  /* plain text and XYZ have no origin of their own */
  expect(read_as("3\n1\n0.4\n-1 -1 -1\n", "cell=3,3,3 origin=-1.5,-1.5,-1.5", NULL), 3, 1, two, sizes);
  expect_refused_as(rows, "cell=5,5 columns=x,y,z,mass,radius", NULL, JAM_E_ARGUMENT, "cell has 2 numbers, in d = 3");
  expect_refused_as(rows, "cell=5,5,a", NULL, JAM_E_ARGUMENT, "cell is '5,5,a'");
  expect_refused_as(rows, "sell=5,5,5", NULL, JAM_E_ARGUMENT, "'sell=5,5,5' is none of");
  expect_refused_as(rows, "cell=5,5,8 origin=1 columns=x,y,z,mass,radius", NULL, JAM_E_ARGUMENT,
                    "origin has 1 numbers");
  expect_refused_as(rows, "cell=5,5,8 columns=x,y,z,radius", NULL, JAM_E_FORMAT, "5 columns, columns names 4");
  expect_refused_as(rows, "columns=x,y,z,r,radius", NULL, JAM_E_FORMAT, "in.any: two columns give sizes");
  expect_refused_as(rows, "columns=a,b,c,e,radius", NULL, JAM_E_ARGUMENT, "columns names no coordinates");
  expect_refused_as("1\nLattice=\"1 0 0 0 1 0 0 0 1\" Properties=pos:R:3:radius:R:1\n0 0 0 .1\n", "cell=2,2,2", NULL,
                    JAM_E_ARGUMENT, "gives its cell");
  expect_refused_as("1\nLattice=\"1 0 0 0 1 0 0 0 1\" Properties=pos:R:3:radius:R:1 Origin=\"0 0 0\"\n0 0 0 .1\n",
                    "origin=0,0,0", NULL, JAM_E_ARGUMENT, "says where the corner");
  expect_refused_as("3\n1\n0.4\n.5 .5 .5\n", "columns=x,y,z,r", NULL, JAM_E_ARGUMENT, "for tables");
}

CASE(disks_in_a_plane) {
  static const double flat[] = {1, 1, 1, 2.5, 4, 4}, widths[] = {1, 0.75, 1};
  static const char text[] = "x y z r\n1 1 0.5 0.5\n1 2.5 0.5 0.375\n4 4 0.5 0.5\n";
  expect(noted(read_in(text, "", 5.0), "d = 2"), 2, 3, flat, widths);
  expect(read_as(text, "cell=5,5", NULL), 2, 3, flat, widths);
  OWNED jam_system *sys = read_as(text, "cell=5,5,5", NULL); /* a third side keeps the third direction */
  assert_null(strstr(jam_notes(sys), "d = 2"));
}

CASE(cells_of_torquato_and_jiao) {
  static const double x[] = {0.1, 0.2, 0.3, 1.6, 0.7, 0.1}, widths[] = {0.3, 0.3};
  const double want[9] = {2, 0, 0, 0.25, 1, 0, 0, 0, 1};
  jam_system *sys =
      read_as("3\n2\n0.3\n2\t0\t0\t\n0.25\t1\t0\t\n0\t0\t1\t\n0.1\t0.2\t0.3\t\n1.6\t0.7\t0.1\t\n", "", NULL);
  expect_cell(sys, want, 9);
  expect(noted(sys, "Torquato and Jiao"), 3, 2, x, widths);
  /* another number of rows is an error, with the line of the first */
  expect_refused("3\n1\n0.3\n1 0 0\n0 1 0\n", JAM_E_FORMAT, "line 5: there is more after the 1 spheres");
  expect_refused("2\n1\n0.3\n1 0\n0 1\n.5 .5\n.2 .2\n", JAM_E_FORMAT, "line 7: there is more after the 1 spheres");
}

CASE(frames_without_spheres) {
  static const char dump[] =
      "ITEM: TIMESTEP\n0\nITEM: NUMBER OF ATOMS\n0\nITEM: BOX BOUNDS pp pp pp\n0 3\n0 3\n0 3\nITEM: ATOMS id x y z "
      "radius\nITEM: TIMESTEP\n1\nITEM: NUMBER OF ATOMS\n2\nITEM: BOX BOUNDS pp pp pp\n0 3\n0 3\n0 3\nITEM: ATOMS id x "
      "y "
      "z radius\n1 .5 .5 .5 .2\n2 1.5 1.5 1.5 .25\n";
  static const char xyz[] =
      "0\nLattice=\"3 0 0 0 3 0 0 0 3\" Properties=pos:R:3:radius:R:1\n2\nLattice=\"[3,0,0,0,3,0,0,0,3]\" "
      "Properties=pos:R:3:radius:R:1 pbc=\"[T, T, T]\"\n.5 .5 .5 .2\n1.5 1.5 1.5 .25\n";
  const char *const texts[] = {dump, xyz};
  for (size_t k = 0; k < 2; ++k) {
    jam_system *sys = NULL;
    expect(read_as(texts[k], "", NULL), 3, 2, two, sizes);
    DEFAULTS(create, o);
    o.frame = 1;
    assert_int_equal(jam_read(in_scratch("in.any"), &o, NULL, NULL, &sys), JAM_OK);
    expect(sys, 3, 2, two, sizes);
    o.frame = 0;
    SAYS(jam_read(in_scratch("in.any"), &o, NULL, NULL, &sys), JAM_E_FORMAT, "frame 0 has no sphere");
    o.frame = 2;
    SAYS(jam_read(in_scratch("in.any"), &o, NULL, NULL, &sys), JAM_E_ARGUMENT, "the file has 2");
  }
}

/* What an error says of another frame is true: it can be read. */
CASE(frames_that_can_be_read_are_named) {
  static const char frame[] = "1\nLattice=\"3 0 0 0 3 0 0 0 3\" Properties=pos:R:3:radius:R:1\n.5 .5 .5 .2\n";
  static const char empty[] = "0\nLattice=\"3 0 0 0 3 0 0 0 3\" Properties=pos:R:3:radius:R:1\n";
  static const char wrong[] = "1\nLattice=\"3 0 0 0 3 0 0 0 3\" Properties=pos:R:3\n.5 .5 .5\n";
  char text[1024];
  snprintf(text, sizeof text, "%s%s", frame, empty);
  expect_refused(text, JAM_E_FORMAT, "frame 1 has no sphere; frame=0 can be read");
  snprintf(text, sizeof text, "%s%s%s", frame, empty, wrong);
  expect_refused(text, JAM_E_FORMAT, "no radius");
  assert_non_null(strstr(jam_last_error(), "; frame=0 can be read"));
  snprintf(text, sizeof text, "%s%s", empty, wrong);
  expect_refused(text, JAM_E_FORMAT, "no radius");
  assert_null(strstr(jam_last_error(), "can be read"));
}

CASE(data_of_mercury_dpm) {
  static const double moved[] = {0.5, 0.5, 0.5, 1.5, 1.5, 1.5}, want[9] = {2, 0, 0, 0, 3, 0, 0, 0, 4};
  static const char frame[] =
      "0 0 -1 -1 -1 1 2 3\n"
      "2 0.5 -1 -1 -1 1 2 3\n-.5 -.5 -.5 9 9 9 .2 0 0 0 1 1 1 0\n.5 .5 .5 8 8 8 .25 0 0 0 1 1 1 1\n";
  static const double flat[] = {0.5, 0.5, 1.5, 1.5};
  static const char disks[] = "0 0 -1 -1 1 2\n2 0.5 -1 -1 1 2\n-.5 -.5 9 9 .2 0 1 0\n.5 .5 8 8 .25 0 1 1\n";
  jam_system *sys = read_as(disks, "", NULL);
  expect_cell(sys, ((double[]){2, 0, 0, 3}), 4);
  expect(sys, 2, 2, flat, sizes);
  expect(read_as(strchr(disks, '\n') + 1, "", NULL), 2, 2, flat, sizes);
  sys = read_as(frame, "", NULL);
  expect_cell(sys, want, 9);
  expect(noted(sys, "the corner of the cell is at -1 -1 -1"), 3, 2, moved, sizes);
  expect_refused("1 0 0 0 0 1 1 1\n.5 .5 .5 0 0 0 .2 0 0 0 0 0 0 0\n.5 .5\n", JAM_E_FORMAT, "where a frame begins");
  expect_refused("2 0 0 0 0 1 1 1\n.5 .5 .5 0 0 0 .2 0 0 0 0 0 0 0\n", JAM_E_FORMAT, "after 1 of 2 spheres");
  expect_refused("1 0 0 0 0 1\n.5 .5 0 0 .2 0 0 0\n", JAM_E_FORMAT, "no extent along x");
  /* tables whose spheres count from 0, or lie at 0, are no empty frames */
  expect(read_as("0 .5 .5 .5 .2 0 0 0\n1 1.5 1.5 1.5 .25 0 0 0\n", "cell=3,3,3 columns=id,x,y,z,radius,u,v,w", NULL), 3,
         2, two, sizes);
  expect(read_as("0 .5 .5 .5 .2 7\n1 1.5 1.5 1.5 .25 7\n", "cell=3,3,3 columns=id,x,y,z,radius,kind", NULL), 3, 2, two,
         sizes);
}

/* Every row says the truth: what is listed as written is written, and what it holds. */
CASE(the_list_of_formats) {
  const char *at = jam_formats();
  jam_system *sys = some_packing(3, 10, 1.0, 1.0);
  int rows = 0;
  for (; *at; at = strchr(at, '\n') + 1, ++rows) {
    char content[16], word[16], name[48], endings[64], holds[64], use[16];
    int number, dim;
    assert_int_equal(sscanf(at, "%15[^\t]\t%d\t%15[^\t]\t%47[^\t]\t%63[^\t]\t%d\t%63[^\t]\t%15[^\n]", content, &number,
                            word, name, endings, &dim, holds, use),
                     8);
    if (strcmp(content, "packings") || !strstr(use, "write")) continue;
    assert_int_equal(jam_write(sys, in_scratch("out.any"), number), JAM_OK);
    assert_int_equal(jam_write_scaled(sys, in_scratch("out.any"), number, 2.0, 1.0), JAM_OK);
    assert_int_equal(jam_write_scaled(sys, in_scratch("out.any"), number, 1.0, 2.0),
                     strstr(holds, "density") ? JAM_OK : JAM_E_UNSUPPORTED);
    if (!strstr(use, "read")) continue;
    jam_destroy(sys);
    assert_int_equal(jam_read(in_scratch("out.any"), NULL, NULL, NULL, &sys), JAM_OK);
  }
  assert_true(rows > 8);
  jam_destroy(sys);
}

FIXTURE(make_scratch, remove_scratch)
