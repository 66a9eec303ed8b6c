/* jam-pack info FILE: what the file holds, without a test or a move. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include "jam-pack.h"

static const double rounding = 1e-12; /* of gaps of coordinates with all digits */

typedef struct content {
  jam_info info;
  jam_size_report sizes;
  double cell[JAM_MAX_DIM * JAM_MAX_DIM];
  double nearest_gap; /* of spheres or a wall; infinite: none below 1 */
  int overlaps;       /* the packing fraction counts some volume twice */
  double porosity;    /* NAN: not computed, in d > 3 */
} content;

/* All but dilute packings have gaps within the first of these. */
static jam_status find_nearest_gap(const jam_system *sys, double *gap) {
  static const double within[] = {1e-3, 0.03, 1.0};
  double *all;
  size_t m = 0, k;
  jam_status status = JAM_OK;
  *gap = INFINITY;
  for (k = 0; m == 0 && k < sizeof within / sizeof *within; ++k) {
    status = jam_gaps(sys, within[k], 0, NULL, 0, NULL, 0, &m);
    if (status < 0) return status;
  }
  if (m == 0) return status;
  all = malloc(m * sizeof *all);
  if (!all) {
    jam_set_error("out of memory");
    return JAM_E_MEMORY;
  }
  status = jam_gaps(sys, within[k - 1], 0, all, m, NULL, 0, NULL);
  *gap = all[0];
  free(all);
  return status;
}

/* Of spheres that overlap, or pass a wall, the solid is their union in the container: one slab of all of it. */
static jam_status find_porosity(const jam_system *sys, content *c) {
  double slab[JAM_PROFILE_COLUMNS];
  jam_status status;
  c->overlaps = c->nearest_gap < -rounding || c->info.non_additivity < 0;
  c->porosity = c->overlaps ? NAN : 1 - c->info.packing_fraction;
  if (!c->overlaps || c->info.dim > 3) return JAM_OK;
  status = jam_solid_profile(sys, 0, 1, JAM_PROFILE_COLUMNS, slab, JAM_PROFILE_COLUMNS, NULL);
  if (status >= 0) c->porosity = 1 - slab[JAM_PROFILE_SOLID];
  return status;
}

static jam_status look(const jam_system *sys, content *c) {
  const double *diameters;
  size_t n;
  jam_status status;
  c->info.struct_size = sizeof c->info;
  c->sizes.struct_size = sizeof c->sizes;
  status = jam_get_info(sys, &c->info);
  if (status >= 0) status = jam_view(sys, JAM_VIEW_DIAMETERS, &diameters, &n);
  if (status >= 0) status = jam_get_size_report(c->info.dim, diameters, n, &c->sizes);
  if (status >= 0) status = jam_get_cell(sys, c->cell, sizeof c->cell / sizeof *c->cell, NULL);
  if (status >= 0) status = find_nearest_gap(sys, &c->nearest_gap);
  return status < 0 ? status : find_porosity(sys, c);
}

static void put_cell(FILE *f, const content *c) {
  const int d = c->info.dim;
  int k;
  fputs("  \"cell\": [", f);
  for (k = 0; k < d * d; ++k)
    fprintf(f, "%s%s%.17g", k ? ", " : "", k % d ? "" : "[", c->cell[k]), k % d == d - 1 && fputc(']', f);
  fputs("],\n", f);
}

static void put_walls(FILE *f, const content *c) {
  char word[32];
  int k;
  fprintf(f, "  \"container\": \"%s\",\n  \"walls\": [", word_of_choice("--container", c->info.container, word));
  for (k = 0; k < c->info.dim; ++k) fprintf(f, "%s%s", k ? ", " : "", c->info.walls >> k & 1 ? "true" : "false");
  fputs("],\n", f);
}

static int write_json(const options *o, const content *c, const char *notes) {
  output out;
  FILE *f;
  if (open_output(&out, "-")) return -1;
  f = out.file;
  begin_json(f, o->input, EXIT_DONE, messages());
  put_count(f, "n", c->info.n, 1);
  put_count(f, "dim", c->info.dim, 1);
  put_cell(f, c);
  put_walls(f, c);
  put_number(f, "volume", c->info.volume);
  put_number(f, "packing_fraction", c->info.packing_fraction);
  put_number(f, "porosity", c->porosity);
  put_number(f, "diameter_mean", c->sizes.mean);
  put_number(f, "diameter_least", c->sizes.least);
  put_number(f, "diameter_largest", c->sizes.largest);
  put_number(f, "polydispersity", c->sizes.polydispersity);
  put_number(f, "d10", c->sizes.d10);
  put_number(f, "d50", c->sizes.d50);
  put_number(f, "d90", c->sizes.d90);
  put_number(f, "non_additivity", c->info.non_additivity);
  put_number(f, "nearest_gap", c->nearest_gap);
  put_notes(f, notes, "");
  return end_json(&out);
}

/* "  walls     a cylinder, flat walls at both ends of z" */
static void print_walls(const content *c) {
  const char *before = c->info.container ? ", flat walls at both ends of " : "flat walls at both ends of ";
  char word[32];
  int k;
  if (!c->info.container && !c->info.walls) return;
  fputs("  walls     ", stdout);
  if (c->info.container)
    printf("a %s%s", word_of_choice("--container", c->info.container, word),
           c->info.container == JAM_CONTAINER_BALL ? "" : " about z");
  for (k = 0; k < c->info.dim && k < 3; ++k)
    if (c->info.walls >> k & 1) {
      printf("%s%c", before, "xyz"[k]);
      before = ", ";
    }
  putchar('\n');
}

static void print_note(const char *line, int warns, void *with) {
  (void)with;
  if (!warns) printf("  note      %s\n", line); /* warnings went to stderr */
}

static void print_text(const options *o, const content *c, const char *notes) {
  const int d = c->info.dim;
  int k;
  printf("%s: %lld spheres in d = %d, packing fraction %.12f%s", o->input, (long long)c->info.n, d,
         c->info.packing_fraction, c->overlaps ? " (overlaps counted twice)" : "");
  if (isfinite(c->porosity)) printf(", porosity %.12f", c->porosity);
  putchar('\n');
  fputs("  cell     ", stdout);
  for (k = 0; k < d * d; ++k) printf("%s%.12g", k % d ? " " : k ? ", " : " ", c->cell[k]);
  printf("; volume %.12g\n", c->info.volume);
  print_walls(c);
  if (c->sizes.least == c->sizes.largest)
    printf("  diameter  %.12g\n", c->sizes.mean);
  else
    printf("  diameter  %.6g to %.6g, mean %.6g, polydispersity %.4g; by volume D10 %.6g, D50 %.6g, D90 %.6g\n",
           c->sizes.least, c->sizes.largest, c->sizes.mean, c->sizes.polydispersity, c->sizes.d10, c->sizes.d50,
           c->sizes.d90);
  if (isfinite(c->nearest_gap))
    printf("  nearest   a pair%s with gap %.3g of its contact distance%s\n",
           c->info.container || c->info.walls ? ", or a sphere and its wall," : "", c->nearest_gap,
           c->nearest_gap < -rounding ? ": they overlap" : "");
  each_note(notes, print_note, NULL);
}

int show_info(const options *o) {
  content c = {.nearest_gap = INFINITY};
  jam_system *sys = NULL;
  const int code = read_as_it_is(o, &sys);
  int failed, bad = 0;
  if (code || !sys) return code ? code : EXIT_FAILED;
  cancel_on_signal(sys);
  failed = has_failed(look(sys, &c));
  cancel_on_signal(NULL);
  if (!failed && o->json)
    bad = write_json(o, &c, jam_notes(sys));
  else if (!failed && !o->quiet)
    print_text(o, &c, jam_notes(sys));
  if (failed) return leave(sys, EXIT_FAILED);
  return leave(sys, bad ? EXIT_OUTPUT : end_stdout(EXIT_DONE));
}
