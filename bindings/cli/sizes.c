/* Diameters and the cell of a random start, as --sizes, --diameters-ratio and --cell ask. */
#include <ctype.h>
#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>
#include "jam-pack.h"
#include "system.h"

/* Why a line is no diameter, and what its file may be instead. */
static void refuse_line(const char *path, int line, const char *text, int columns) {
  if (columns > 1)
    complain(
        "%s line %d has %d columns, but a file of diameters has one: for sizes and their shares use --sizes list:%s, "
        "for a sieve curve --sizes sieve:%s; a table x y z radius goes to --input; decimal points, not commas",
        path, line, columns, path, path);
  else
    complain("%s line %d: '%.40s' is no diameter, a finite number > 0%s", path, line, text,
             strchr(text, ',') || strchr(text, ';') ? ": write one on each line, with a decimal point" : "");
}

/* What a line says before its comment, without blanks around it; *columns of it, which blanks, commas or semicolons
 * part. Ends of lines as of old Macs are blanks: such a file is one line of many columns. */
static char *plain_line(char *text, int first, int *columns) {
  const char *const parting = " \t,;";
  char *word = text + (first && !strncmp(text, "\xef\xbb\xbf", 3) ? 3 : 0), *at;
  for (at = word; *at; ++at)
    if (*at == '\r' || *at == '\n') *at = ' ';
  word[strcspn(word, "#")] = '\0';
  word += strspn(word, " \t");
  for (at = word + strlen(word); at > word && (at[-1] == ' ' || at[-1] == '\t');) *--at = '\0';
  *columns = 0;
  for (at = word; *at; at += strspn(at, parting)) {
    const size_t length = strcspn(at, parting);
    *columns += length > 0;
    at += length;
  }
  return word;
}

/* One number in each line, below a heading or none. A heading of radii doubles them. */
static int read_diameters(const char *path, double **out, int64_t *count) {
  FILE *file = open_stream(path, "r");
  double *list = NULL, factor = 1;
  int64_t n = 0, room = 0;
  int line = 0, bad = 0, headed = 0;
  char text[4096], *word, *end;
  if (!file) {
    complain("cannot open %s: %s", path, strerror(errno));
    return -1;
  }
  while (!bad && fgets(text, sizeof text, file)) {
    const size_t length = strlen(text);
    int columns;
    double x;
    ++line;
    if ((bad = !length || (text[length - 1] != '\n' && !feof(file)))) {
      complain("%s line %d has a zero byte or more than %d characters: this is no list of diameters", path, line,
               (int)sizeof text - 2);
      break;
    }
    word = plain_line(text, line == 1, &columns);
    if (!*word) continue;
    x = strtod(word, &end);
    if (n == 0 && !headed && end == word && columns == 1 && isalpha((unsigned char)*word)) {
      factor = !strncasecmp(word, "radi", 4) || !strcasecmp(word, "r") ? 2 : 1;
      headed = 1;
      continue;
    }
    if ((bad = columns > 1 || *end || strpbrk(word, "xX") || !isfinite(x) || !(x > 0))) {
      refuse_line(path, line, word, columns);
      break;
    }
    if (n == room) {
      double *wider = realloc(list, (size_t)(room = 2 * room + 1024) * sizeof *list);
      if ((bad = !wider)) complain("out of memory");
      if (bad) break;
      list = wider;
    }
    list[n++] = factor * x;
  }
  fclose(file);
  if (!bad && n == 0) complain("%s contains no diameter", path);
  if (bad || n == 0) {
    free(list);
    return -1;
  }
  *out = list;
  *count = n;
  return 0;
}

/* The law, and its curve in one reading where there is room for it, as in all but the longest curves: a pipe gives no
 * second one. */
static jam_status read_law(const char *text, given *g) {
  jam_status status;
  size_t room = 4096;
  do {
    double *const more = realloc(g->curve, room * sizeof *more);
    if (!more) return JAM_E_MEMORY;
    g->curve = more;
    jam_diameters_options_init(&g->law, sizeof g->law);
    g->curve_len = 0;
    status = jam_parse_diameters(text, &g->law, g->curve, room, &g->curve_len);
  } while (g->curve_len > room && (room = g->curve_len));
  return status;
}

/* Of a (d, d) matrix, which is lost: elimination with row pivots. */
static double determinant(double *a, int d) {
  double product = 1;
  int k, r, c;
  for (k = 0; k < d; ++k) {
    int pivot = k;
    for (r = k + 1; r < d; ++r)
      if (fabs(a[r * d + k]) > fabs(a[pivot * d + k])) pivot = r;
    if (!(fabs(a[pivot * d + k]) > 0)) return 0;
    for (c = 0; pivot != k && c < d; ++c) {
      const double kept = a[k * d + c];
      a[k * d + c] = a[pivot * d + c], a[pivot * d + c] = -kept;
    }
    product *= a[k * d + k];
    for (r = k + 1; r < d; ++r) {
      const double factor = a[r * d + k] / a[k * d + k];
      for (c = k; c < d; ++c) a[r * d + c] -= factor * a[k * d + c];
    }
  }
  return product;
}

int make_scene(const options *o, jam_system **sys) {
  double cell[JAM_MAX_DIM * JAM_MAX_DIM], x[JAM_MAX_DIM] = {0}, size = HUGE_VAL;
  const size_t d = (size_t)o->dim;
  size_t k;
  jam_create_options create;
  jam_start start = {.struct_size = sizeof start, .positions = x, .diameters = &size, .diameters_len = 1, .cell = cell};
  fill_cell(o, cell);
  for (k = 0; k < d * d; ++k) x[k % d] += 0.5 * cell[k];
  for (k = 0; k < d; ++k) size = fmin(size, 1e-3 * fabs(cell[k * d + k]));
  jam_create_options_init(&create, sizeof create);
  create.dim = (int32_t)d;
  create.container = (int32_t)o->container;
  create.walls = (int32_t)o->walls; /* the words of the table stand in the order of the bits */
  start.positions_len = d, start.cell_len = d * d;
  return has_failed(jam_create(&create, &start, sys)) ? -1 : 0;
}

/* Of the container in the cell, as the library has it. */
static int find_room(const options *o, double *volume) {
  jam_system *sys = NULL;
  const int bad = make_scene(o, &sys);
  *volume = info_of(sys).volume;
  jam_destroy(sys);
  return bad;
}

static int find_volume(const options *o, double *volume) {
  double cell[JAM_MAX_DIM * JAM_MAX_DIM];
  fill_cell(o, cell);
  if (o->container != JAM_CONTAINER_BRICK) return find_room(o, volume);
  *volume = determinant(cell, (int)o->dim);
  if (*volume > 0 && *volume < INFINITY) return 0;
  complain("the cell has the volume %g: its vectors are left-handed, or lie in one plane", *volume);
  return 1;
}

static int draw_law(const options *o, double **out, int64_t *n) {
  const given *const g = &o->given;
  const double *const curve = g->curve_len ? g->curve : NULL;
  jam_diameters_options law = g->law;
  size_t count = 0, k;
  if (!g->curve) return has_failed(jam_parse_diameters(g->sizes, &law, NULL, 0, &count)) ? -1 : 0; /* why */
  law.dim = (int32_t)o->dim;
  law.seed = o->seed;
  if (g->density > 0 && !g->n && (g->cell_count || is_named(o, "box"))) {
    law.packing_fraction = g->density;
    if (find_volume(o, &law.cell_volume)) return -1;
  } else
    law.n = *n;
  if (has_failed(jam_diameters(&law, curve, g->curve_len, NULL, 0, &count))) return -1;
  if (!(*out = malloc(count * sizeof **out))) {
    complain("out of memory");
    return -1;
  }
  if (has_failed(jam_diameters(&law, curve, g->curve_len, *out, count, &count))) return -1;
  for (k = 0; k < count; ++k) (*out)[k] += o->least_distance;
  *n = (int64_t)count;
  return 0;
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

double mean_of(const double *diameters, int64_t n) {
  double sum = 0;
  int64_t k;
  for (k = 0; k < n; ++k) sum += diameters[k];
  return sum / (double)n;
}

/* A law, or the name of a file of diameters. A file that the law names may be missing: that is no wrong command line.
 */
int take_sizes(const char *value, options *o) {
  const jam_status status = read_law(value, &o->given);
  if (status < 0) {
    free(o->given.curve);
    o->given.curve = NULL;
  }
  if (status >= 0 || status == JAM_E_IO || status == JAM_E_FORMAT)
    o->given.sizes = value;
  else if (*value && (!strchr(value, ':') || kind_of(value) == KIND_FILE))
    o->given.diameters_file = value;
  else {
    complain("--sizes is '%s': %s", value, *value ? jam_last_error() : "it must be a law or a file of diameters");
    return -1;
  }
  return 0;
}

/* Numbers parted by commas: how many, or 0 where the text is something else or longer. */
int take_numbers(const char *value, double *out, int most) {
  char *end;
  int count = 0;
  while (count < most) {
    out[count] = strtod(value, &end);
    if (end == value || !isfinite(out[count])) return 0;
    ++count;
    if (!*end) return count;
    if (*end != ',') return 0;
    value = end + 1;
  }
  return 0;
}

int take_cell(const char *value, options *o) {
  o->given.cell_text = value;
  o->given.cell_count = take_numbers(value, o->given.cell, JAM_MAX_DIM * JAM_MAX_DIM);
  if (o->given.cell_count) return 0;
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
