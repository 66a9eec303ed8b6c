/* Walls and containers: what is made, what is refused, and that files and checkpoints keep them. */
#include "walls.h"
#include <math.h>
#include "io_helpers.h"
#include "steps.h"

static double distance(const walled *s, int w, const double *x) {
  const int round = s->container == JAM_CONTAINER_BALL ? s->dim : s->container == JAM_CONTAINER_CYLINDER ? 2 : 0;
  double r2 = 0.0;
  for (int c = 0; c < s->dim; ++c) {
    if (!(s->walls >> c & 1)) continue;
    if (w < 2) return w ? s->edge[c] - x[c] : x[c];
    w -= 2;
  }
  for (int c = 0; c < round; ++c) r2 += (x[c] - 0.5 * s->edge[0]) * (x[c] - 0.5 * s->edge[0]);
  return 0.5 * s->edge[0] - sqrt(r2);
}

static double volume(const walled *s) {
  const double r = 0.5 * s->edge[0];
  if (s->container == JAM_CONTAINER_BALL) return s->dim == 2 ? M_PI * r * r : M_PI * r * r * r * 4.0 / 3.0;
  if (s->container == JAM_CONTAINER_CYLINDER) return M_PI * r * r * s->edge[2];
  return s->edge[0] * s->edge[1] * (s->dim == 3 ? s->edge[2] : 1.0);
}

CASE(random_start_lies_inside) {
  for (int k = 0; k < WALLED; ++k) {
    const walled *s = &walled_scenes[k];
    OWNED jam_system *sys = NULL;
    double sum = 0.0, areas = 0.0;
    const size_t len = 60;
    assert_int_equal(create_walled(s, 60, 0.15, 7, NULL, &sys), JAM_OK);
    const jam_info info = info_of(sys);
    assert_int_equal(info.container, s->container);
    assert_int_equal(info.walls, s->walls);
    assert_true(fabs(info.volume / volume(s) - 1.0) < 1e-14);
    const double *const x = view_of(sys, JAM_VIEW_POSITIONS), *const sigma = view_of(sys, JAM_VIEW_DIAMETERS);
    for (size_t i = 0; i < len; ++i) sum += pow(sigma[i], s->dim) * (s->dim == 2 ? M_PI / 4.0 : M_PI / 6.0);
    assert_true(fabs(sum / volume(s) / 0.15 - 1.0) < 1e-12 && fabs(info.packing_fraction / 0.15 - 1.0) < 1e-12);
    for (int w = 0; w < count_walls(sys); ++w) {
      double least = INFINITY;
      for (size_t i = 0; i < len; ++i) least = fmin(least, distance(s, w, &x[i * s->dim]) / (0.5 * sigma[i]) - 1.0);
      assert_true(least >= 0.0 && fabs(of_wall(sys, w, JAM_WALL_GAP) - least) < 1e-12);
      assert_true(isnan(of_wall(sys, w, JAM_WALL_PRESSURE)));
      /* Divergence theorem: the sum over walls of area times height over the origin is V for each closed axis. */
      areas += of_wall(sys, w, JAM_WALL_AREA) * (of_wall(sys, w, JAM_WALL_AXIS) < s->dim
                                                     ? 0.5 * s->edge[(int)of_wall(sys, w, JAM_WALL_AXIS)]
                                                     : 0.5 * s->edge[0]);
    }
    const int round = s->container == JAM_CONTAINER_BALL ? s->dim : s->container == JAM_CONTAINER_CYLINDER ? 2 : 0;
    int closed = round;
    for (int c = 0; c < s->dim; ++c) closed += s->walls >> c & 1;
    assert_true(fabs(areas / (closed * volume(s)) - 1.0) < 1e-14);
  }
}

static jam_status from_arrays(const walled *s, const double *x, int64_t n, double sigma, int32_t policy,
                              jam_system **sys) {
  double cell[9] = {0.0};
  jam_start start = {.struct_size = sizeof start};
  DEFAULTS(create, o);
  o.dim = s->dim, o.n = n, o.overlap = policy;
  for (int c = 0; c < s->dim; ++c) cell[c * s->dim + c] = s->edge[c];
  start.cell = cell, start.cell_len = (size_t)(s->dim * s->dim);
  start.positions = x, start.positions_len = (size_t)(n * s->dim), start.diameters = &sigma, start.diameters_len = 1;
  o.container = s->container, o.walls = s->walls;
  return jam_create(&o, &start, sys);
}

CASE(overlaps_with_walls_are_named_or_shrunk) {
  const double x[] = {0.5, 0.95, 0.5, 0.3}, outside[] = {0.5, 1.2, 0.5, 0.3};
  jam_system *sys = NULL;
  const double *sigma;
  for (int k = LINES; k <= CIRCLE; ++k) {
    SAYS(from_arrays(&walled_scenes[k], x, 2, 0.2, JAM_OVERLAP_REFUSE, &sys), JAM_E_OVERLAP,
         k == LINES ? "sphere 0 overlaps the wall y = 1 by 0.5" : "sphere 0 overlaps the round wall by 0.5");
    SAYS(from_arrays(&walled_scenes[k], outside, 2, 0.2, JAM_OVERLAP_ALLOW, &sys), JAM_E_OVERLAP,
         "the centre of sphere 0 lies outside");
    assert_non_null(
        strstr(jam_last_error(), "positions count from the corner of the cell; if yours count from its centre, add"));
    assert_int_equal(from_arrays(&walled_scenes[k], x, 2, 0.2, JAM_OVERLAP_SHRINK, &sys), JAM_OK);
    sigma = view_of(sys, JAM_VIEW_DIAMETERS);
    assert_true(fabs(sigma[0] - 0.1) < 1e-14);
    jam_destroy(sys);
  }
}

CASE(spheres_do_not_meet_across_a_wall) {
  /* In a periodic cell these two would overlap. */
  const double x[] = {0.5, 0.11, 0.5, 0.89};
  OWNED jam_system *sys = NULL;
  assert_int_equal(from_arrays(&walled_scenes[LINES], x, 2, 0.21, JAM_OVERLAP_REFUSE, &sys), JAM_OK);
}

static jam_status start_with(int32_t dim, const double *cell, int32_t container, int32_t walls, int32_t model,
                             double delta) {
  jam_start start = {.struct_size = sizeof start};
  OWNED jam_system *sys = NULL;
  DEFAULTS(create, o);
  o.dim = dim, o.n = 10, o.packing_fraction = 0.1, o.model = model, o.non_additivity = delta;
  if (cell) start.cell = cell, start.cell_len = (size_t)(dim * dim);
  o.container = container, o.walls = walls;
  return jam_create(&o, &start, &sys);
}

/* Overlaps are allowed, but a sphere has nearly no place beside the walls. */
CASE(places_that_are_not_found_are_told) {
  jam_system *sys = NULL;
  DEFAULTS(create, o);
  o.n = 1, o.container = JAM_CONTAINER_CONE, o.walls = 4, o.overlap = JAM_OVERLAP_ALLOW;
  for (o.packing_fraction = 0.54; o.packing_fraction < 0.5437; o.packing_fraction += 2e-4) {
    const jam_status status = jam_create(&o, NULL, &sys);
    if (status == JAM_OK) jam_destroy(sys);
    if (status != JAM_OK) assert_int_equal(status, JAM_E_UNPLACEABLE);
  }
}

CASE(bad_containers_are_named) {
  const double tilted[] = {1, 0, 0, 0.3, 1, 0, 0, 0, 1}, brick[] = {2, 0, 0, 0, 1, 0, 0, 0, 3};
  assert_int_equal(start_with(2, NULL, JAM_CONTAINER_CYLINDER, 0, 0, 0.0), JAM_E_DIMENSION);
  assert_int_equal(start_with(3, NULL, JAM_CONTAINER_CYLINDER, 1, 0, 0.0), JAM_E_ARGUMENT);
  assert_int_equal(start_with(3, NULL, JAM_CONTAINER_BALL, 4, 0, 0.0), JAM_E_ARGUMENT);
  assert_int_equal(start_with(3, brick, JAM_CONTAINER_BALL, 0, 0, 0.0), JAM_E_ARGUMENT);
  SAYS(start_with(3, tilted, JAM_CONTAINER_BRICK, 1, 0, 0.0), JAM_E_ARGUMENT, "walls on axis x");
  assert_int_equal(start_with(3, tilted, JAM_CONTAINER_BRICK, 4, 0, 0.0), JAM_OK);
  assert_int_equal(start_with(3, brick, JAM_CONTAINER_BRICK, 2, 0, 0.0), JAM_OK);
  assert_int_equal(start_with(3, NULL, JAM_CONTAINER_BRICK, 1, JAM_MODEL_MK, 0.0), JAM_E_UNSUPPORTED);
  assert_int_equal(start_with(3, NULL, JAM_CONTAINER_BRICK, 1, 0, 0.1), JAM_E_UNSUPPORTED);
  assert_int_equal(start_with(3, NULL, JAM_CONTAINER_BRICK, 1, 0, -0.1), JAM_OK);
  /* Walls closer than the largest sphere. */
  const walled flat = {"flat", 3, JAM_CONTAINER_BRICK, 4, {1.0, 1.0, 0.2}};
  const double x[] = {0.5, 0.5, 0.1};
  jam_system *sys = NULL;
  SAYS(from_arrays(&flat, x, 1, 0.21, JAM_OVERLAP_REFUSE, &sys), JAM_E_OVERLAP, "does not fit between walls 0.2 apart");
  assert_int_equal(create_walled(&flat, 4, 0.5, 1, NULL, &sys), JAM_E_UNPLACEABLE);
}

CASE(files_keep_the_container) {
  const char *const path = in_scratch("walls");
  const int formats[] = {JAM_FORMAT_XYZ, JAM_FORMAT_LAMMPS};
  for (int k = 0; k < WALLED; ++k) {
    OWNED jam_system *sys = NULL;
    assert_int_equal(create_walled(&walled_scenes[k], 30, 0.1, 3, NULL, &sys), JAM_OK);
    for (int f = 0; f < 2; ++f) {
      OWNED jam_system *back = NULL;
      assert_int_equal(jam_write(sys, path, formats[f]), JAM_OK);
      assert_int_equal(jam_read(path, NULL, NULL, NULL, &back), JAM_OK);
      const jam_info a = info_of(sys), b = info_of(back);
      assert_true(a.container == b.container && a.walls == b.walls && a.volume == b.volume);
      same_view(sys, back, JAM_VIEW_POSITIONS), same_view(sys, back, JAM_VIEW_DIAMETERS);
    }
    SAYS(jam_write(sys, path, JAM_FORMAT_PLAIN), JAM_E_UNSUPPORTED, "cannot store walls");
    assert_int_equal(jam_write(sys, path, JAM_FORMAT_VTP), JAM_OK);
  }
}

/* What pbc, container and walls say of an axis must agree. */
CASE(contradicting_files_are_refused) {
#define FILE_OF(pbc, walls)                                                   \
  "1\nLattice=\"1 0 0 0 1 0 0 0 1\" Properties=pos:R:3:radius:R:1 pbc=\"" pbc \
  "\" container=brick "                                                       \
  "walls=\"" walls "\"\n0.5 0.5 0.5 0.1\n"
  jam_destroy(read_text(FILE_OF("T T F", "F F T")));
  expect_refused(FILE_OF("T T T", "F F T"), JAM_E_FORMAT, "container= and walls=");
  expect_refused(FILE_OF("F F F", "F F T"), JAM_E_UNSUPPORTED, "pbc='F F F'");
  expect_refused(FILE_OF("T T F", "a b c"), JAM_E_FORMAT, "a b c");
}

/* A stopped run goes on from a checkpoint to the bits of one that never stopped. */
CASE(checkpoints_go_on_to_the_same_bits) {
  for (int k = 0; k < WALLED; ++k) {
    OWNED jam_system *whole = NULL, *part = NULL, *back = NULL;
    jam_compress_options o;
    jam_compress_options_init(&o, sizeof o);
    o.growth_rate = 1e-2, o.pressure = 50.0;
    assert_int_equal(create_walled(&walled_scenes[k], 40, 0.15, 5, NULL, &whole), JAM_OK);
    assert_int_equal(jam_copy(whole, &part), JAM_OK);
    assert_int_equal(jam_compress(whole, &o, NULL), JAM_OK);
    o.collisions_per_particle = 20;
    assert_int_equal(jam_compress(part, &o, NULL), JAM_LIMIT);
    back = from_checkpoint(part);
    jam_compress_options_init(&o, sizeof o);
    o.growth_rate = 1e-2, o.pressure = 50.0, o.resume = 1;
    assert_int_equal(jam_compress(back, &o, NULL), JAM_OK);
    same(whole, back);
    for (int w = 0; w < count_walls(whole); ++w)
      assert_true(of_wall(whole, w, JAM_WALL_PRESSURE) == of_wall(back, w, JAM_WALL_PRESSURE));
  }
}

/* Every call that would give an answer for a cell without walls refuses. */
CASE(calls_that_know_no_walls_refuse) {
  OWNED jam_system *sys = NULL, *tube = NULL, *ball = NULL;
  double real[4096];
  size_t needed;
  const double cell[] = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  assert_int_equal(create_walled(&walled_scenes[SLIT], 20, 0.1, 1, NULL, &sys), JAM_OK);
  assert_int_equal(create_walled(&walled_scenes[TUBE], 20, 0.1, 1, NULL, &tube), JAM_OK);
  assert_int_equal(create_walled(&walled_scenes[BALL], 20, 0.1, 1, NULL, &ball), JAM_OK);
  DEFAULTS(crunch, crunch);
  crunch.strain = JAM_STRAIN_FREE; /* at fixed volume one axis cannot deform */
  jam_moduli_report moduli = {.struct_size = sizeof moduli};
  const jam_status statuses[] = {jam_crunch(tube, &crunch, NULL),
                                 jam_prove(sys, JAM_RIGIDITY_STRICT, NULL, 0, NULL),
                                 jam_prove(ball, JAM_RIGIDITY_STRICT, NULL, 0, NULL),
                                 jam_moduli(tube, NULL, &moduli),
                                 jam_elastic_tensor(ball, NULL, real, 81, NULL, 0, &needed),
                                 jam_structure_factor(ball, 10.0, JAM_STRUCTURE_COLUMNS, real, 4096, &needed),
                                 jam_set_cell(sys, cell, 9, NULL, 0, NULL, 0, NULL),
                                 jam_strain(sys, cell, 9)};
  for (size_t k = 0; k < sizeof statuses / sizeof *statuses; ++k) {
    if (statuses[k] != JAM_E_UNSUPPORTED) print_error("call %zu gives %d\n", k, (int)statuses[k]);
    assert_int_equal(statuses[k], JAM_E_UNSUPPORTED);
  }
}

/* Lists of all pairs, for ever: few spheres, or steps as long as the cell. */
CASE(dilute_monte_carlo_ends) {
  for (int k = 0; k < WALLED; ++k) {
    OWNED jam_system *sys = NULL;
    jam_monte_carlo_report report = {.struct_size = sizeof report};
    DEFAULTS(monte_carlo, o);
    o.sweeps = 200;
    assert_int_equal(create_walled(&walled_scenes[k], 20, 0.01, 3, NULL, &sys), JAM_OK);
    assert_int_equal(jam_monte_carlo(sys, &o, &report), JAM_OK);
    assert_true(report.pressure > 0.5 && report.pressure < 2.0); /* near the ideal gas */
  }
}

/* At the centre of its container it touches the wall all around: no time passes. */
CASE(a_sphere_that_fills_its_container_stalls) {
  const int scenes[] = {BALL, CIRCLE, CAN};
  const double centre[] = {0.5, 0.5, 0.5};
  for (int k = 0; k < 3; ++k) {
    OWNED jam_system *sys = NULL;
    jam_md_report report = {.struct_size = sizeof report};
    assert_int_equal(from_arrays(&walled_scenes[scenes[k]], centre, 1, 1.0, JAM_OVERLAP_REFUSE, &sys), JAM_OK);
    assert_int_equal(jam_run(sys, NULL, &report), JAM_NOT_CONVERGED);
    assert_int_equal(report.stop_reason, JAM_STOP_STALLED);
  }
}

/* Tubes, channels and boxes in which the usual density leaves no place, or is that of spheres wider than the scene: the
 * start is lower, and a note says so. A density that is given is met or refused. */
CASE(narrow_scenes_start_lower) {
  static const struct {
    int32_t dim, container, walls;
    double edge[3];
  } scenes[] = {{3, JAM_CONTAINER_CYLINDER, 0, {1, 1, 20}}, {3, JAM_CONTAINER_CYLINDER, 4, {1, 1, 20}},
                {3, JAM_CONTAINER_BRICK, 3, {1, 1, 20}},    {3, JAM_CONTAINER_BRICK, 1, {0.2, 2, 2}},
                {3, JAM_CONTAINER_BALL, 0, {1, 1, 1}},      {2, JAM_CONTAINER_BALL, 0, {1, 1, 1}},
                {2, JAM_CONTAINER_BRICK, 2, {10, 0.5, 1}},  {3, JAM_CONTAINER_BRICK, 0, {1, 1, 30}}};
  static const int64_t counts[] = {1, 2, 3, 5, 8, 13, 20, 30, 40, 60};
  int lower = 0;
  for (size_t k = 0; k < sizeof scenes / sizeof *scenes; ++k)
    for (size_t q = 0; q < sizeof counts / sizeof *counts; ++q)
      for (int64_t seed = 1; seed <= 2; ++seed) {
        double cell[9] = {0.0};
        OWNED jam_system *sys = NULL;
        const int d = scenes[k].dim;
        DEFAULTS(create, o);
        o.dim = d, o.n = counts[q], o.seed = seed, o.container = scenes[k].container, o.walls = scenes[k].walls;
        for (int c = 0; c < d; ++c) cell[c * (d + 1)] = scenes[k].edge[c];
        if (create_in_cell(&o, cell, (size_t)(d * d), NULL, 0, NULL, 0, &sys) != JAM_OK)
          fail_msg("scene %zu, %lld spheres: %s", k, (long long)counts[q], jam_last_error());
        const jam_info info = info_of(sys);
        if (info.packing_fraction > 0.2 * (1 - 1e-12)) {
          assert_string_equal(jam_notes(sys), "");
        } else {
          ++lower;
          assert_non_null(strstr(jam_notes(sys), "the random start has the packing fraction"));
          jam_destroy(sys);
          sys = NULL, o.packing_fraction = 0.2;
          assert_true(create_in_cell(&o, cell, (size_t)(d * d), NULL, 0, NULL, 0, &sys) < 0);
        }
      }
  assert_true(lower > 10);
}

FIXTURE(make_scratch, remove_scratch)
