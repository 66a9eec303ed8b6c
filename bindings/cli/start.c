/* How jam-pack begins: a random start of one of the models, a file, or a checkpoint. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "jam-pack.h"

/* Uniform in (0, 1): the k-th number of a seed, by the finaliser of splitmix64 (Steele, Lea and Flood 2014). */
static double uniform(int64_t seed, int64_t k) {
  uint64_t x = (uint64_t)seed * 0x9e3779b97f4a7c15u + (uint64_t)k;
  int round;
  for (round = 0; round < 2; ++round) {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9u;
    x = (x ^ (x >> 27)) * 0x94d049bb133111ebu;
    x ^= x >> 31;
  }
  return ((double)(x >> 11) + 0.5) * 0x1.0p-53;
}

static int read_diameters(const char *path, double **out, int64_t *count) {
  FILE *file = fopen(path, "r");
  double *list = NULL, x;
  int64_t n = 0, room = 0;
  int got = 1;
  if (!file) {
    complain("cannot open %s: %s", path, strerror(errno));
    return -1;
  }
  while ((got = fscanf(file, "%lf", &x)) == 1 && isfinite(x) && x > 0) {
    if (n == room) {
      double *wider = realloc(list, (size_t)(room = 2 * room + 1024) * sizeof *list);
      if (!wider) break;
      list = wider;
    }
    list[n++] = x;
  }
  fclose(file);
  if (got != EOF || n == 0) {
    complain("%s: number %lld is no diameter, a finite number > 0", path, (long long)n + 1);
    free(list);
    return -1;
  }
  *out = list;
  *count = n;
  return 0;
}

/* Ratios of diameters as --diameters asks; NULL when all are equal. */
static int make_diameters(const options *o, double **out, int64_t *n) {
  const double width = o->given.lognormal > 0 ? sqrt(log1p(o->given.lognormal * o->given.lognormal)) : 0;
  int64_t k;
  *out = NULL;
  if (o->given.diameters_file) {
    if (read_diameters(o->given.diameters_file, out, &k)) return -1;
    if (o->given.n && k != *n) {
      complain("%s holds %lld diameters, --n is %lld", o->given.diameters_file, (long long)k, (long long)*n);
      free(*out);
      return -1;
    }
    *n = k;
    return 0;
  }
  if (o->diameters_ratio == 1 && width == 0) return 0;
  *out = malloc((size_t)*n * sizeof **out);
  if (!*out) {
    complain("out of memory");
    return -1;
  }
  for (k = 0; k < *n; ++k) {
    if (width > 0)
      (*out)[k] =
          exp(width * sqrt(-2 * log(uniform(o->seed, 2 * k))) * cos(6.283185307179586 * uniform(o->seed, 2 * k + 1)));
    else
      (*out)[k] = k < *n / 2 ? 1 : o->diameters_ratio;
  }
  return 0;
}

/* The options of a killed job are given again: those that the checkpoint holds must be the same. */
static int check_resumed(const options *o, const jam_system *sys) {
  jam_info info;
  info.struct_size = sizeof info;
  jam_info_get(sys, &info);
  if (o->given.n && o->n != info.n)
    complain("--n is %lld, the checkpoint has %lld spheres", (long long)o->n, (long long)info.n);
  else if (is_named(o, "dim") && o->dim != info.dim)
    complain("--dim is %lld, the checkpoint has d = %d", (long long)o->dim, (int)info.dim);
  else if (is_named(o, "seed") && o->seed != info.seed)
    complain("--seed is %lld, the checkpoint has seed %lld", (long long)o->seed, (long long)info.seed);
  else
    return 0;
  return EXIT_USAGE;
}

/* Why there is no start, with the option that helps. An option that contradicts the file is a wrong command line. */
static int refused_start(const options *o, jam_status status) {
  const char *const text = jam_last_error()[0] ? jam_last_error() : jam_status_string(status);
  if (status == JAM_E_OVERLAP && o->input && !o->shrink && !strstr(text, "the same centre"))
    complain("%s; --shrink multiplies all diameters by the factor that brings the worst pair to contact", text);
  else
    complain("%s", text);
  return status == JAM_E_ARGUMENT && (is_named(o, "box") || is_named(o, "non-additivity") || is_named(o, "frame"))
             ? EXIT_USAGE
             : EXIT_FAILED;
}

int start(const options *o, jam_progress_fn stop, jam_system **sys) {
  jam_create_options create;
  double *diameters = NULL;
  jam_status status = jam_create_options_init(&create, sizeof create);
  create.seed = o->seed;
  create.box = o->box;
  create.overlap = o->shrink ? JAM_OVERLAP_SHRINK : JAM_OVERLAP_REFUSE;
  create.shrink_min = o->shrink_min;
  create.frame = o->frame;
  create.model = (int32_t)o->model;
  create.mk_zeta = o->zeta;
  create.non_additivity = o->non_additivity;
  if (o->resume)
    status = jam_checkpoint_read_watched(o->resume, stop, NULL, sys);
  else if (o->input)
    status = jam_read_watched(o->input, &create, stop, NULL, sys);
  else {
    create.n = o->n;
    if (make_diameters(o, &diameters, &create.n)) return EXIT_FAILED;
    create.dim = (int32_t)o->dim;
    create.packing_fraction = o->phi0;
    status = jam_create_watched(&create, NULL, 0, diameters, diameters ? (size_t)create.n : 0, stop, NULL, sys);
    free(diameters);
  }
  if (status < 0) return refused_start(o, status);
  if (!*sys) {
    complain("interrupted before the packing was made");
    return EXIT_FAILED;
  }
  return o->resume ? check_resumed(o, *sys) : 0;
}

/* The value of --diameters: lognormal:S, bidisperse:RATIO, or the name of a file. */
int take_diameters(const char *value, options *o) {
  const char *colon = strchr(value, ':');
  char *end = NULL;
  double x;
  if (!colon || (strncmp(value, "lognormal:", 10) && strncmp(value, "bidisperse:", 11))) {
    o->given.diameters_file = value;
    return 0;
  }
  x = strtod(colon + 1, &end);
  if (end == colon + 1 || *end || !isfinite(x) || x <= 0) return -1;
  if (value[0] == 'l')
    o->given.lognormal = x;
  else
    o->diameters_ratio = x;
  return 0;
}
