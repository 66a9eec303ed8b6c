/* The files that the options of one command line name: each output has its own, and none is an input. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#define JAM_PACK_OPTIONS_TABLE
#include "jam-pack.h"
#include "system.h"

#define ROWS (sizeof table / sizeof *table)

/* One file under two names, but for pipes and devices, which take what comes. */
static int same(const char *a, const char *b) {
  char *x, *y;
  int equal;
  if (!a || !b || !strcmp(a, "-") || !strcmp(b, "-")) return 0;
  if (kind_of(a) == KIND_FOLDER || kind_of(a) == KIND_OTHER) return 0;
  x = resolve(a);
  y = resolve(b);
  equal = x && y ? !strcmp(x, y) : !strcmp(a, b);
  free(x);
  free(y);
  return equal;
}

static const char *file_of(const options *o, const option_row *row) {
  return *(const char *const *)((const char *)o + row->place);
}

int each_output(const options *o, int (*f)(const char *path, void *with), void *with) {
  size_t k;
  for (k = 0; k < sizeof table / sizeof *table; ++k)
    if (table[k].kind == TAKE_OUTPUT && file_of(o, &table[k]) && f(file_of(o, &table[k]), with)) return -1;
  if (o->vtk && !is_omitted(o->vtk)) {
    char first[4096];
    snprintf(first, sizeof first, "%s.vtp", o->vtk);
    return f(first, with) ? -1 : 0;
  }
  return 0;
}

int settle_stdout(options *o) {
  const option_row *row, *const end = table + ROWS;
  const char *taken = o->json ? "--json" : NULL;
  for (row = table; row < end; ++row) {
    if (row->kind != TAKE_OUTPUT || !is_named(o, row->name + 2) || !is_stdout(file_of(o, row))) continue;
    if (!(row->flags & TAKES_STDOUT) && !strcmp(file_of(o, row), "-")) {
      complain("%s -: it cannot go to standard output: name a file", row->name);
      return -1;
    }
    if (taken) {
      complain("%s %s contradicts %s: both write to standard output", row->name, file_of(o, row), taken);
      return -1;
    }
    taken = row->name;
  }
  o->given.stdout_taken = taken != NULL;
  return 0;
}

/* The files among the items of a law of --sizes. */
static int is_in_law(const char *law, const char *path) {
  const char *at = law ? strchr(law, ':') : NULL;
  char item[4096];
  while (at) {
    at += 1 + strspn(at + 1, " ");
    snprintf(item, sizeof item, "%.*s", (int)strcspn(at, ","), at);
    if (same(item, path)) return 1;
    at = strchr(at, ',');
  }
  return 0;
}

typedef struct named_file {
  const char *name, *path;
} named_file;

/* All that will be written, with the option. vtk: room for the two files of --vtk. */
static size_t list_outputs(const options *o, char vtk[2][4096], named_file *list) {
  static const char *const ends[] = {".vtp", "-forces.vtp"};
  size_t k, count = 0;
  for (k = 0; k < ROWS; ++k)
    if (table[k].kind == TAKE_OUTPUT && file_of(o, &table[k]))
      list[count++] = (named_file){table[k].name, file_of(o, &table[k])};
  for (k = 0; o->vtk && k < 2; ++k) {
    snprintf(vtk[k], sizeof vtk[k], "%s%s", o->vtk, ends[k]);
    list[count++] = (named_file){"--vtk", vtk[k]};
  }
  return count;
}

int settle_files(const options *o) {
  char vtk[2][4096];
  named_file list[ROWS + 2];
  const size_t count = list_outputs(o, vtk, list);
  size_t a, b;
  for (a = 0; a < count; ++a) {
    const char *const name = list[a].name, *const path = list[a].path;
    for (b = 0; b < a; ++b)
      if (same(path, list[b].path)) {
        complain("%s and %s must be different files", list[b].name, name);
        return -1;
      }
    if ((strcmp(name, "--output") && same(o->input, path)) || (strcmp(name, "--checkpoint") && same(o->resume, path)) ||
        same(o->given.diameters_file, path) || is_in_law(o->given.sizes, path)) {
      complain("%s would overwrite the input", name);
      return -1;
    }
  }
  if (o->rows && (o->checkpoint || o->resume) && !appears_whole(o->rows)) {
    complain("--rows %s contradicts %s: a shear that continues reads its table again: name a file", o->rows,
             o->resume ? "--resume" : "--checkpoint");
    return -1;
  }
  return 0;
}

int settle_crunched(const options *o) {
  const option_row *row;
  for (row = table; row < table + ROWS; ++row)
    if (o->no_crunch && row->flags & AFTER_CRUNCH && file_of(o, row)) {
      complain("%s needs the crunch, which %s omits", row->name,
               isfinite(o->porosity)           ? "--porosity"
               : isfinite(o->packing_fraction) ? "--packing-fraction"
                                               : "--no-crunch");
      return -1;
    }
  return 0;
}
