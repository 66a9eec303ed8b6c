/* Crunches of starts at the rim: few spheres of very unequal sizes, farther apart than the first linear program lets
 * them move; and cells as thin as the limits allow, that are free to become thick. Each ends with a status and a valid
 * state: a finite cell of the same volume and no overlap. */
#include "steps.h"

#include <math.h>

static void assert_valid(const jam_system *sys, double before) {
  double cell[64];
  size_t rows;
  const jam_info info = info_of(sys);
  assert_true(info.packing_fraction >= before * (1.0 - 1e-12) && info.packing_fraction < 1.0);
  assert_int_equal(jam_get_cell(sys, cell, 64, &rows), JAM_OK);
  for (size_t k = 0; k < rows; ++k) assert_true(isfinite(cell[k]));
  OWNED jam_system *copy = copy_of(sys);
  assert_int_equal(jam_scale_diameters(copy, 1.0 + 1e-13), JAM_OK); /* looks for overlaps */
}

/* One large sphere and five small ones: no pair lies within the bound of the first step. */
CASE(very_unequal_spheres) {
  const struct {
    int dim;
    double ratio;
  } cases[] = {{4, 10.0}, {3, 100.0}, {4, 100.0}, {2, 100.0}, {2, 5.0}, {3, 1000.0}};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k)
    for (int64_t seed = 1; seed <= 5; ++seed)
      for (int few = 0; few < 2; ++few) {
        double diameters[6] = {cases[k].ratio, 1, 1, 1, 1, 1};
        const size_t n = few ? 2 : 6;
        DEFAULTS(create, o);
        DEFAULTS(crunch, c);
        o.n = (int64_t)n, o.dim = cases[k].dim, o.seed = seed, o.packing_fraction = 0.02;
        OWNED jam_system *sys = created_from(&o, NULL, 0, diameters, n);
        c.wall_time = 20.0;
        const jam_status status = jam_crunch(sys, &c, NULL);
        if (status < 0) fail_msg("d %d ratio %g seed %d: %s", o.dim, cases[k].ratio, (int)seed, jam_last_error());
        assert_valid(sys, 0.02);
      }
}

/* Most gaps are between small spheres, thousands of their diameters wide: the start of the path stays dense. */
CASE(many_small_spheres_in_a_cylinder) {
  double diameters[30];
  DEFAULTS(create, o);
  DEFAULTS(compress, c);
  SIZED(jam_crunch_report, r);
  for (int k = 0; k < 30; ++k) diameters[k] = k < 5 ? 1e4 : 1.0;
  o.n = 30, o.seed = 3, o.packing_fraction = 0.1, o.container = JAM_CONTAINER_CYLINDER;
  OWNED jam_system *sys = created_from(&o, NULL, 0, diameters, 30);
  c.growth_rate = 0.1, c.pressure = 1e4;
  assert_int_equal(jam_compress(sys, &c, NULL), JAM_OK);
  const double before = info_of(sys).packing_fraction;
  assert_int_equal(jam_crunch(sys, NULL, &r), JAM_OK);
  assert_int_equal(r.jammed, 1);
  assert_valid(sys, before);
}

/* A small bound of the steps, by option, makes the lists as short. */
CASE(short_steps) {
  DEFAULTS(crunch, c);
  OWNED jam_system *sys = random_spheres(3, 6, 0.05, 1);
  c.step_bound = 1e-3, c.max_lps = 30;
  const jam_status status = jam_crunch(sys, &c, NULL);
  if (status < 0) fail_msg("%s", jam_last_error());
  assert_valid(sys, 0.05);
  c.neighbour_radius = 1e-3; /* what the user asks for is not changed */
  assert_int_equal(jam_scale_diameters(sys, 0.5), JAM_OK);
  SAYS(jam_crunch(sys, &c, NULL), JAM_E_ARGUMENT, "neighbour radius");
}

/* An LP has the pairs whose gap is below neighbour_radius minus the largest diameter, in mean diameters. A smaller
 * radius is refused with that number; a larger one gives the pairs that are counted from positions. */
CASE(radius_and_largest_diameter) {
  double diameters[16] = {8, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}, history[JAM_HISTORY_COLUMNS * 4];
  const double mean = 23.0 / 16.0, radius = 8.0 / mean + 0.8;
  OWNED jam_system *sys = NULL;
  size_t rows;
  int pairs = 0;
  DEFAULTS(create, o);
  DEFAULTS(crunch, c);
  o.n = 16, o.dim = 2, o.packing_fraction = 0.3;
  const jam_start start = {.struct_size = sizeof start, .diameters = diameters, .diameters_len = 16};
  assert_int_equal(jam_create(&o, &start, &sys), JAM_OK);
  const double *x = view_of(sys, JAM_VIEW_POSITIONS);
  const double *sigma = view_of(sys, JAM_VIEW_DIAMETERS);
  const double unit = sigma[1] * mean, reach = radius * unit - sigma[0];
  for (int i = 0; i < 16; ++i)
    for (int j = 0; j < i; ++j)
      for (int k = -1; k <= 1; ++k) /* images too: the box is 1, and the reach less than half of it */
        for (int l = -1; l <= 1; ++l) {
          const double r = hypot(x[2 * i] - x[2 * j] + k, x[2 * i + 1] - x[2 * j + 1] + l);
          pairs += r - 0.5 * (sigma[i] + sigma[j]) < reach;
        }
  c.method = JAM_CRUNCH_SEQUENTIAL_LP, c.full_lps = 1, c.max_lps = 1, c.polish = 0;
  c.neighbour_radius = 2.0, c.step_bound = 0.1;
  SAYS(jam_crunch(sys, &c, NULL), JAM_E_ARGUMENT, "neighbour radius 2 is below the largest diameter, 5.57");
  c.neighbour_radius = radius;
  if (jam_crunch(sys, &c, NULL) < 0) fail_msg("%s", jam_last_error());
  assert_int_equal(jam_crunch_history(sys, JAM_HISTORY_COLUMNS, history, JAM_HISTORY_COLUMNS * 4, &rows), JAM_OK);
  assert_int_equal((int)history[JAM_HISTORY_PAIRS], pairs);
}

/* Rods of height h, and a flat cell. The volume is 1. */
CASE(thin_cells) {
  const struct {
    int dim, n;
    double height;
    int flat;
  } cases[] = {{3, 20, 1.1e-3, 0}, {4, 20, 1.1e-3, 0}, {4, 20, 1e-2, 0},   {4, 20, 5e-2, 0},
               {5, 20, 5e-2, 0},   {3, 20, 1e-2, 1},   {8, 10, 1.01e-3, 1}};
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
    const int d = cases[k].dim;
    const double h = cases[k].height, wide = cases[k].flat ? pow(h, -1.0 / (d - 1)) : h;
    OWNED jam_system *sys = NULL;
    double cell[64] = {0}, ball = pow(acos(-1.0), 0.5 * d) / tgamma(0.5 * d + 1.0);
    DEFAULTS(create, o);
    DEFAULTS(crunch, c);
    for (int q = 0; q < d; ++q) cell[q * d + q] = wide;
    if (cases[k].flat)
      cell[0] = h;
    else
      cell[d * d - 1] = pow(h, 1 - d);
    o.dim = d, o.n = cases[k].n;
    o.packing_fraction = cases[k].n * ball * pow(0.35 * h, d);
    const double longest = cases[k].flat ? wide : cell[d * d - 1];
    const jam_status made = create_in_cell(&o, cell, (size_t)(d * d), NULL, 0, NULL, 0, &sys);
    if (0.7 * h < 1e-9 * longest) { /* coordinates along the rod would not resolve its spheres */
      SAYS(made, JAM_E_ARGUMENT, "edge");
      continue;
    }
    assert_int_equal(made, JAM_OK);
    c.strain = JAM_STRAIN_FREE, c.wall_time = 2.0; /* some would take long to end */
    const jam_status status = jam_crunch(sys, &c, NULL);
    if (status < 0) fail_msg("d %d height %g: %d %s", d, h, status, jam_last_error());
    assert_valid(sys, o.packing_fraction);
  }
}
