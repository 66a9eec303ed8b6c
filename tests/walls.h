/* Scenes with walls, as tests start them. */
#ifndef JAM_TESTS_WALLS_H
#define JAM_TESTS_WALLS_H

#include <jam/jam.h>
#include "test.h"

typedef struct walled {
  const char *name;
  int32_t dim, container, walls;
  double edge[JAM_MAX_DIM];
} walled;

enum { SLIT = 0, BOX = 1, TUBE = 2, CAN = 3, BALL = 4, LINES = 5, CIRCLE = 6, WALLED = 7 };
static const walled walled_scenes[WALLED] = {
    {"slit", 3, JAM_CONTAINER_BRICK, 4, {1.0, 1.0, 1.0}},    {"box", 3, JAM_CONTAINER_BRICK, 7, {1.0, 2.0, 1.5}},
    {"tube", 3, JAM_CONTAINER_CYLINDER, 0, {1.0, 1.0, 2.0}}, {"can", 3, JAM_CONTAINER_CYLINDER, 4, {1.0, 1.0, 1.0}},
    {"ball", 3, JAM_CONTAINER_BALL, 0, {1.0, 1.0, 1.0}},     {"lines", 2, JAM_CONTAINER_BRICK, 2, {1.0, 1.0}},
    {"circle", 2, JAM_CONTAINER_BALL, 0, {1.0, 1.0}},
};

/* diameters: NULL, all equal. */
static inline jam_status create_walled(const walled *s, int64_t n, double fraction, int64_t seed,
                                       const double *diameters, jam_system **out) {
  double cell[JAM_MAX_DIM * JAM_MAX_DIM] = {0.0};
  jam_start start = {.struct_size = sizeof start};
  DEFAULTS(create, o);
  o.dim = s->dim, o.n = n, o.seed = seed, o.packing_fraction = fraction;
  for (int c = 0; c < s->dim; ++c) cell[c * s->dim + c] = s->edge[c];
  start.cell = cell, start.cell_len = (size_t)(s->dim * s->dim);
  o.container = s->container, o.walls = s->walls;
  start.diameters = diameters, start.diameters_len = diameters ? (size_t)n : 0;
  return jam_create(&o, &start, out);
}

/* Value of a column of jam_walls. */
static inline double of_wall(const jam_system *sys, int w, int column) {
  double table[(2 * JAM_MAX_DIM + 1) * (JAM_WALL_STRESS + 1)];
  size_t needed = 0;
  assert_int_equal(jam_walls(sys, JAM_WALL_COLUMNS, table, sizeof table / sizeof *table, &needed), JAM_OK);
  assert_true((size_t)w * (JAM_WALL_STRESS + 1) < needed);
  return table[w * (JAM_WALL_STRESS + 1) + column];
}

static inline int count_walls(const jam_system *sys) {
  size_t needed = 0;
  assert_int_equal(jam_walls(sys, JAM_WALL_COLUMNS, NULL, 0, &needed), JAM_OK);
  return (int)needed / (JAM_WALL_STRESS + 1);
}

#endif
