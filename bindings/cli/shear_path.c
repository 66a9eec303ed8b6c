/* --to, --mode and --stress of jam-pack shear: the strains, their direction, and the stress that is held. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "jam-pack.h"
#include "system.h"

/* What comes before '=' of one part of --stress: the place of a component on or above the diagonal; -1: none. */
static int component(const char *name, int dim) {
  static const char axes[] = "xyz";
  const char *const first = name[0] ? strchr(axes, name[0]) : NULL;
  const char *const second = first && name[1] ? strchr(axes, name[1]) : NULL;
  const int c = first ? (int)(first - axes) : 0, k = second ? (int)(second - axes) : -1;
  return c <= k && k < dim && name[2] == '=' ? c * dim + k : -1;
}

/* Components of the stress, each with its value: behind the mode. Those of the cell become free. */
static int take_held(const char *given, int dim, jam_shear_options *options, shear_path *path) {
  double *const stress = path->mode + dim * dim;
  const char *at = given;
  int edges = 0, tilts = 0;
  int64_t held = 0;
  do {
    const int place = component(at += strspn(at, " "), dim);
    char *end = NULL;
    const double value = place < 0 ? 0 : strtod(at + 3, &end);
    if (!end || end == at + 3 || !isfinite(value) || (*end && *end != ',') || held >> place & 1) {
      complain("--stress is '%s', it must be components of the stress, each with its value: xx=0.01,xy=0", given);
      return -1;
    }
    if (path->mode[place] != 0) {
      complain("--stress is '%s': the shear drives %.2s, so its stress cannot be held", given, at);
      return -1;
    }
    stress[place] = stress[place % dim * dim + place / dim] = value;
    held |= (int64_t)1 << place;
    if (place % (dim + 1))
      tilts = 1;
    else
      edges = 1;
    at = *end ? end + 1 : NULL;
  } while (at);
  path->mode_count *= 2;
  options->strain = !tilts ? JAM_STRAIN_EDGES_VOLUME : edges ? JAM_STRAIN_ALL : JAM_STRAIN_TILTS;
  options->components = held;
  return 0;
}

/* The shortest text that is this number. */
static void put_shortest(FILE *f, const char *before, double x) {
  char text[32];
  int digits = 14;
  do snprintf(text, sizeof text, "%.*g", ++digits, x + 0.0);
  while (strtod(text, NULL) != x && digits < 17);
  fprintf(f, "%s%s", before, text);
}

/* The path in one form, whatever blanks and zeros it was given with: a checkpoint has it, and ends it at a blank. */
static int describe(const options *o, int dim, int64_t held, shear_path *path) {
  static const char axes[] = "xyz";
  const double *const stress = path->mode + dim * dim;
  char *text = NULL;
  size_t size = 0;
  int k, first = 1, bad = -1;
  FILE *const f = open_text(&text, &size);
  if (f) {
    for (k = 0; k < path->turn_count; ++k) put_shortest(f, k ? "," : "", path->turns[k]);
    for (k = 0; o->mode && k < dim * dim; ++k) put_shortest(f, k ? "," : ";--mode=", path->mode[k]);
    for (k = 0; k < dim * dim; ++k) {
      char name[24];
      if (!(held >> k & 1)) continue;
      snprintf(name, sizeof name, "%s%c%c=", first ? ";--stress=" : ",", axes[k / dim], axes[k % dim]);
      put_shortest(f, name, stress[k]);
      first = 0;
    }
  }
  if (!f || close_text(f, &text, &size))
    complain("out of memory");
  else if (strlen(text) >= sizeof path->text)
    complain("--to, --mode and --stress have more than %d characters", (int)sizeof path->text - 1);
  else
    strcpy(path->text, text), bad = 0;
  free(text);
  return bad;
}

int take_path(const options *o, const jam_system *sys, jam_shear_options *options, shear_path *path) {
  const int dim = info_of(sys).dim, numbers = dim * dim;
  int k;
  path->turn_count = take_numbers(o->to, path->turns, MOST_TURNS);
  if (!path->turn_count) {
    complain("--to is '%s', it must be strains, parted by commas, at most %d", o->to, MOST_TURNS);
    return -1;
  }
  for (k = 0; k < path->turn_count; ++k)
    if (path->turns[k] == (k ? path->turns[k - 1] : 0)) {
      complain("--to is '%s': the strain %g is that before it", o->to, path->turns[k]);
      return -1;
    }
  path->mode_count = (size_t)numbers;
  path->mode[1] = 1; /* simple shear */
  if (o->mode && take_numbers(o->mode, path->mode, numbers) != numbers) {
    complain("--mode is '%s', it must be %d numbers, parted by commas", o->mode, numbers);
    return -1;
  }
  if (o->stress && take_held(o->stress, dim, options, path)) return -1;
  return describe(o, dim, o->stress ? options->components : 0, path);
}
