/* Hashes of results, one a line: builds for two processors print the same lines when they compute the same bits.
 * First word: what the bits rest on: `md`, arithmetic of libjam's own; `crunch`, the dense products too.
 *
 * bits.txt has the lines that every machine, compiler and instruction set must print (golden.sh). A line may change
 * only with an algorithm, and CHANGELOG.md says so; the new ones are recorded by `sh tests/platforms/golden.sh BUILD
 * record`. Another verdict on a packing changes no line. */
#include <inttypes.h>
#include <jam/jam.h>
#include <stdio.h>
#include <stdlib.h>

#include "start.h"

static void need(jam_status status) {
  if (status >= 0) return;
  fprintf(stderr, "status %d, %s\n", status, jam_last_error());
  exit(1);
}

/* Of the numbers, not of their bytes in memory, whose order is the processor's. FNV-1a. */
static uint64_t hash_of(uint64_t hash, const double *x, size_t count) {
  size_t k;
  int byte;
  for (k = 0; k < count; ++k) {
    union {
      double real;
      uint64_t bits;
    } number;
    number.real = x[k];
    for (byte = 0; byte < 8; ++byte) hash = (hash ^ (number.bits >> (8 * byte) & 0xff)) * UINT64_C(1099511628211);
  }
  return hash;
}
static const uint64_t begin = UINT64_C(14695981039346656037);

static void say(const char *rests_on, const char *what, const char *stage, const jam_system *sys) {
  const double *view;
  double cell[JAM_MAX_DIM * JAM_MAX_DIM];
  size_t len, cell_len = 0;
  uint64_t hash;
  need(jam_view(sys, JAM_VIEW_POSITIONS, &view, &len));
  hash = hash_of(begin, view, len);
  need(jam_view(sys, JAM_VIEW_DIAMETERS, &view, &len));
  hash = hash_of(hash, view, len);
  need(jam_get_cell(sys, cell, sizeof cell / sizeof *cell, &cell_len));
  printf("%s %s, %s %016" PRIx64 "\n", rests_on, what, stage, hash_of(hash, cell, cell_len));
}

typedef struct scene {
  const char *what;
  int32_t dim;
  int64_t n, seed;
  double largest; /* diameters from 1 to this, in turns */
  double fraction;
  int32_t model, container, walls, strain, method, dynamics;
} scene;

static const scene scenes[] = {
    {"d=2 disks 1 : 1.4", 2, 100, 1, 1.4, 0.4, JAM_MODEL_EUCLID, JAM_CONTAINER_BRICK, 0, 0, 0, 1},
    {"d=3 equal spheres", 3, 100, 2, 1.0, 0.3, JAM_MODEL_EUCLID, JAM_CONTAINER_BRICK, 0, 0, 0, 1},
    {"d=3 spheres 1 : 4", 3, 90, 3, 4.0, 0.2, JAM_MODEL_EUCLID, JAM_CONTAINER_BRICK, 0, 0, 0, 0},
    {"d=2 disks by LPs alone", 2, 80, 4, 1.4, 0.3, JAM_MODEL_EUCLID, JAM_CONTAINER_BRICK, 0, 0,
     JAM_CRUNCH_SEQUENTIAL_LP, 0},
    {"d=3 spheres in a free cell", 3, 60, 5, 1.4, 0.3, JAM_MODEL_EUCLID, JAM_CONTAINER_BRICK, 0, JAM_STRAIN_FREE, 0, 1},
    {"d=2 disks in a free cell", 2, 60, 6, 1.4, 0.3, JAM_MODEL_EUCLID, JAM_CONTAINER_BRICK, 0, JAM_STRAIN_FREE, 0, 0},
    {"d=3 spheres in a slit", 3, 80, 7, 1.4, 0.25, JAM_MODEL_EUCLID, JAM_CONTAINER_BRICK, 4, 0, 0, 1},
    {"d=2 disks in a circle", 2, 60, 8, 1.4, 0.3, JAM_MODEL_EUCLID, JAM_CONTAINER_BALL, 0, 0, 0, 1},
    {"d=3 spheres in a tube", 3, 80, 9, 1.4, 0.2, JAM_MODEL_EUCLID, JAM_CONTAINER_CYLINDER, 0, 0, 0, 0},
    {"d=3 Mari-Kurchan spheres", 3, 60, 10, 1.0, 1.0, JAM_MODEL_MK, JAM_CONTAINER_BRICK, 0, 0, 0, 1}};

static jam_system *start(const scene *s, int32_t overlap) {
  jam_create_options o;
  jam_system *sys = NULL;
  jam_status status;
  double diameter[100];
  int k;
  for (k = 0; k < 100; ++k) diameter[k] = 1.0 + (s->largest - 1.0) * (k % 4) / 3.0;
  need(jam_create_options_init(&o, sizeof o));
  o.dim = s->dim, o.n = s->n, o.seed = s->seed, o.model = s->model, o.overlap = overlap;
  o.packing_fraction = s->fraction, o.container = s->container, o.walls = s->walls;
  status = create_from(&o, NULL, 0, diameter, (size_t)s->n, &sys);
  if (status != JAM_E_DIMENSION) need(status); /* a build may have fewer dimensions */
  return sys;
}

static void dynamics(const scene *s, jam_system *sys) {
  jam_run_options run;
  jam_compress_options grow;
  need(jam_run_options_init(&run, sizeof run));
  need(jam_compress_options_init(&grow, sizeof grow));
  run.collisions_per_particle = 30.0, grow.growth_rate = 0.02, grow.pressure = 1e4;
  need(jam_run(sys, &run, NULL));
  say("md", s->what, "run", sys);
  need(jam_compress(sys, &grow, NULL));
  say("md", s->what, "compression", sys);
}

static void crunch(const scene *s, jam_system *sys) {
  jam_crunch_options o;
  double *forces;
  size_t count = 0;
  need(jam_crunch_options_init(&o, sizeof o));
  o.strain = s->strain, o.method = s->method;
  need(jam_crunch(sys, &o, NULL));
  say("crunch", s->what, "jamming point", sys);
  need(jam_forces(sys, NULL, 0, &count));
  forces = malloc(count * sizeof *forces);
  if (!forces) exit(1);
  need(jam_forces(sys, forces, count, NULL));
  printf("crunch %s, forces %016" PRIx64 "\n", s->what, hash_of(begin, forces, count));
  free(forces);
}

static void make(const scene *s) {
  jam_system *sys = start(s, JAM_OVERLAP_REFUSE);
  say("md", s->what, "start", sys);
  if (s->dynamics) dynamics(s, sys);
  crunch(s, sys);
  jam_destroy(sys);
}

static void monte_carlo(int32_t dim, double alpha) {
  static const char *const what[] = {"d=2 disks",   "d=3 spheres", "d=4 spheres", "d=5 spheres",
                                     "d=6 spheres", "d=7 spheres", "d=8 spheres"};
  const double fraction = 0.2 / (1 << (dim > 3 ? dim - 2 : 0));
  const scene s = {what[dim - 2], dim, 100, 5, 1.4, fraction, JAM_MODEL_EUCLID, 0, 0, 0, 0, 0};
  jam_system *sys = start(&s, alpha > 0.0 ? JAM_OVERLAP_ALLOW : JAM_OVERLAP_REFUSE);
  jam_monte_carlo_options o;
  if (!sys) return;
  need(jam_monte_carlo_options_init(&o, sizeof o));
  o.alpha = alpha, o.sweeps = 20, o.temperature = 0.1;
  if (dim > 3) o.sweeps = 2, o.step = 0.1; /* no time for more, and to tune the step */
  need(jam_monte_carlo(sys, &o, NULL));
  say("md", s.what, alpha > 0.0 ? "soft Monte Carlo" : "hard Monte Carlo", sys);
  jam_destroy(sys);
}

static void soft(int32_t dim) {
  const scene s = {dim == 2 ? "d=2 disks" : "d=3 spheres", dim, 100, 5, 1.4, 1.0, JAM_MODEL_EUCLID, 0, 0, 0, 0, 0};
  jam_system *sys = start(&s, JAM_OVERLAP_ALLOW);
  jam_relax_options o;
  need(jam_relax_options_init(&o, sizeof o));
  o.alpha = 2.7;
  need(jam_relax(sys, &o, NULL));
  say("crunch", s.what, "relaxation", sys);
  jam_destroy(sys);
}

int main(void) {
  size_t k;
  int32_t dim;
  for (k = 0; k < sizeof scenes / sizeof *scenes; ++k) make(scenes + k);
  for (dim = 2; dim <= JAM_MAX_DIM; ++dim) {
    monte_carlo(dim, 0.0);
    monte_carlo(dim, 2.7);
    if (dim <= 3) soft(dim);
  }
  return 0;
}
