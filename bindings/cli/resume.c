/* --resume: the options of a killed job are given again, and those that its checkpoint contains must be the same. */
#include <math.h>
#include <stdlib.h>
#include "jam-pack.h"

/* Of numbers that went through other sums. */
static int equal(double a, double b) { return fabs(a - b) <= 1e-9 * fmax(fabs(a), fabs(b)); }

/* A job with --strain or of shear has deformed the cell that it began with. */
static int has_other_cell(const options *o, const jam_system *sys) {
  double wanted[JAM_MAX_DIM * JAM_MAX_DIM] = {0}, cell[JAM_MAX_DIM * JAM_MAX_DIM] = {0};
  const int32_t *const copies = o->given.copies_count ? o->given.copies : NULL;
  jam_system *one = NULL, *tiled = NULL;
  size_t k, numbers = 0;
  int other = 0;
  if (o->strain != JAM_STRAIN_NONE || o->given.verb == VERB_SHEAR) return 0;
  if (make_scene(o, &one)) return 1;
  if (copies && has_failed(jam_tile(one, copies, (size_t)o->given.copies_count, &tiled))) other = 1;
  jam_get_cell(tiled ? tiled : one, wanted, sizeof wanted / sizeof *wanted, &numbers);
  jam_get_cell(sys, cell, sizeof cell / sizeof *cell, &numbers);
  for (k = 0; k < numbers; ++k)
    if (fabs(cell[k] - wanted[k]) > 1e-9 * info_of(sys).box) other = 1;
  jam_destroy(one), jam_destroy(tiled);
  return other;
}

/* Diameters as a whole may have grown. */
static int has_other_sizes(const jam_system *sys, const double *diameters, int64_t n) {
  const jam_info info = info_of(sys);
  const double *kept = NULL;
  size_t numbers = 0, k;
  if (n != info.n || jam_view(sys, JAM_VIEW_DIAMETERS, &kept, &numbers) < 0) return 1;
  for (k = 0; k < numbers; ++k)
    if (!equal(kept[k] / kept[0], diameters ? diameters[k] / diameters[0] : 1)) return 1;
  return 0;
}

/* The option that is another one than that of the job; NULL: none. */
static const char *other_scene(const options *o, const jam_system *sys) {
  const jam_info info = info_of(sys);
  if (is_named(o, "non-additivity") && o->non_additivity != info.non_additivity) return "--non-additivity";
  if (o->model != info.model && is_named(o, "model")) return "--model";
  if (o->model != info.model && isfinite(o->zeta)) return "--zeta";
  if (o->model != info.model && isfinite(o->plant)) return "--plant";
  if (is_named(o, "walls") && o->walls != info.walls) return "--walls";
  if (is_named(o, "container") && o->container != info.container) return "--container";
  if (is_named(o, "box") || o->given.cell_count) {
    options scene = *o;
    scene.walls = info.walls, scene.container = info.container;
    if (has_other_cell(&scene, sys)) return o->given.cell_count ? "--cell" : "--box";
  }
  return NULL;
}

static int check_sizes(const options *o, const jam_system *sys, double *mean, const char **other) {
  const int has_unit = o->given.sizes || o->given.diameters_file;
  double *diameters = NULL;
  int64_t n = info_of(sys).n;
  const int bad = make_diameters(o, &diameters, &n);
  if (!bad && has_other_sizes(sys, diameters, n)) *other = has_unit ? "--sizes" : "--diameters-ratio";
  if (!bad && has_unit) *mean = mean_of(diameters, n);
  free(diameters);
  return bad ? EXIT_FAILED : 0;
}

int check_resumed(const options *given, const jam_system *sys, double *mean) {
  const jam_info info = info_of(sys);
  options own = *given, *const o = &own;
  const char *other;
  if (o->given.n && o->n != info.n)
    complain("--n is %lld, the checkpoint has %lld spheres", (long long)o->n, (long long)info.n);
  else if (is_named(o, "dim") && o->dim != info.dim)
    complain("--dim is %lld, the checkpoint has d = %d", (long long)o->dim, (int)info.dim);
  else if (is_named(o, "seed") && o->seed != info.seed)
    complain("--seed is %lld, the checkpoint has seed %lld", (long long)o->seed, (long long)info.seed);
  else {
    own.dim = info.dim, own.seed = info.seed;
    if (settle_cell(o)) return EXIT_USAGE;
    other = other_scene(o, sys);
    if (!other && (is_named(o, "sizes") || is_named(o, "diameters-ratio")) && check_sizes(o, sys, mean, &other))
      return EXIT_FAILED;
    if (!other) return 0;
    complain("%s is another one than that of the job that left %s: give the same", other, o->resume);
  }
  return EXIT_USAGE;
}
