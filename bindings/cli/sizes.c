/* Diameters and the cell of a random start, as --sizes, --diameters-ratio and --cell ask. */
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "jam-pack.h"
#include "system.h"

static int read_diameters(const char *path, double **out, int64_t *count) {
  FILE *file = open_stream(path, "r");
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

static int read_law(const char *text, jam_diameters_options *law, double **curve, size_t *curve_len) {
  *curve = NULL;
  if (has_failed(jam_parse_diameters(text, law, NULL, 0, curve_len))) return -1;
  if (!*curve_len) return 0;
  *curve = malloc(*curve_len * sizeof **curve);
  if (*curve) return has_failed(jam_parse_diameters(text, law, *curve, *curve_len, curve_len));
  complain("out of memory");
  return -1;
}

/* Of the container, which takes this share of its cell. */
static int find_volume(const options *o, double *volume) {
  const double pi = 3.14159265358979323846;
  const double share = o->container == JAM_CONTAINER_BRICK                ? 1
                       : o->container == JAM_CONTAINER_BALL && o->dim > 2 ? pi / 6
                                                                          : pi / 4;
  double cell[JAM_MAX_DIM * JAM_MAX_DIM];
  fill_cell(o, cell);
  if (has_failed(jam_cell_volume((int32_t)o->dim, cell, (size_t)(o->dim * o->dim), volume))) return 1;
  *volume *= share;
  return 0;
}

static int draw_law(const options *o, double **out, int64_t *n) {
  jam_diameters_options law;
  double *curve = NULL;
  size_t curve_len = 0, count = 0;
  int bad;
  jam_diameters_options_init(&law, sizeof law);
  law.dim = (int32_t)o->dim;
  law.seed = o->seed;
  bad = read_law(o->given.sizes, &law, &curve, &curve_len);
  if (o->given.density > 0 && !o->given.n && (o->given.cell_count || is_named(o, "box"))) {
    law.packing_fraction = o->given.density;
    bad = bad || find_volume(o, &law.cell_volume);
  } else
    law.n = *n;
  bad = bad || has_failed(jam_diameters(&law, curve, curve_len, NULL, 0, &count));
  if (!bad && !(*out = malloc(count * sizeof **out))) {
    complain("out of memory");
    bad = 1;
  }
  bad = bad || has_failed(jam_diameters(&law, curve, curve_len, *out, count, &count));
  free(curve);
  *n = (int64_t)count;
  return bad ? -1 : 0;
}

void fill_cell(const options *o, double *cell) {
  const int d = (int)o->dim;
  int k;
  for (k = 0; k < d * d; ++k) {
    const double side = o->given.cell_count ? o->given.cell[k / (d + 1)] : o->box;
    cell[k] = o->given.cell_count > d ? o->given.cell[k] : k % (d + 1) ? 0 : side;
  }
}

int make_diameters(const options *o, double **out, int64_t *n) {
  int64_t k;
  *out = NULL;
  if (o->given.diameters_file) {
    if (read_diameters(o->given.diameters_file, out, &k)) return -1;
    if (o->given.n && k != *n) {
      complain("%s has %lld diameters, --n is %lld", o->given.diameters_file, (long long)k, (long long)*n);
      return -1;
    }
    *n = k;
    return 0;
  }
  if (o->given.sizes) return draw_law(o, out, n);
  if (o->diameters_ratio == 1) return 0;
  *out = malloc((size_t)*n * sizeof **out);
  if (!*out) {
    complain("out of memory");
    return -1;
  }
  for (k = 0; k < *n; ++k) (*out)[k] = k < *n / 2 ? 1 : o->diameters_ratio;
  return 0;
}

double mean_given(const options *o, const jam_system *sys) {
  jam_info info = {.struct_size = sizeof info};
  double *diameters = NULL, sum = 0.0;
  int64_t n = 0, k;
  jam_get_info(sys, &info);
  if (o->input || o->resume) return info.diameter_mean;
  if (!o->given.sizes && !o->given.diameters_file) return NAN;
  n = info.n;
  if (make_diameters(o, &diameters, &n)) return NAN;
  for (k = 0; k < n; ++k) sum += diameters[k];
  free(diameters);
  return sum / (double)n;
}

/* A law, or the name of a file of diameters. A file that the law names may be missing: that is no wrong command line.
 */
int take_sizes(const char *value, options *o) {
  jam_diameters_options law;
  size_t rows;
  jam_status status = jam_diameters_options_init(&law, sizeof law);
  status = jam_parse_diameters(value, &law, NULL, 0, &rows);
  if (status >= 0 || status == JAM_E_IO || status == JAM_E_FORMAT)
    o->given.sizes = value;
  else if (*value && !strchr(value, ':'))
    o->given.diameters_file = value;
  else {
    complain("--sizes is '%s': %s", value, *value ? jam_last_error() : "it must be a law or a file of diameters");
    return -1;
  }
  return 0;
}

int take_cell(const char *value, options *o) {
  const char *at = value;
  char *end;
  int count = 0;
  while (count < JAM_MAX_DIM * JAM_MAX_DIM) {
    o->given.cell[count] = strtod(at, &end);
    if (end == at || !isfinite(o->given.cell[count])) break;
    ++count;
    if (!*end) {
      o->given.cell_count = count;
      return 0;
    }
    if (*end != ',') break;
    at = end + 1;
  }
  complain("--cell is '%s', it must be d sides or d * d components of vectors, parted by commas", value);
  return -1;
}

int take_copies(const char *value, options *o) {
  const char *at = value;
  char *end;
  int count = 0;
  while (count < JAM_MAX_DIM) {
    const long number = strtol(at, &end, 10);
    if (end == at || number < 1 || number > INT32_MAX) break;
    o->given.copies[count++] = (int32_t)number;
    if (!*end) {
      o->given.copies_count = count;
      return 0;
    }
    if (*end != ',') break;
    at = end + 1;
  }
  complain("--tile is '%s', it must be d whole numbers above 0, parted by commas", value);
  return -1;
}
