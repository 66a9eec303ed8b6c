/* What the options of one command line say together: contradictions, and what has no effect. */
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#define JAM_PACK_OPTIONS_TABLE
#include "jam-pack.h"

#define ROWS (sizeof table / sizeof *table)

int is_named(const options *o, const char *name) {
  size_t k;
  for (k = 0; k < ROWS; ++k)
    if (!strcmp(table[k].name + 2, name)) return o->named[k];
  return 0;
}

/* The density to grow to leaves the crunch out, and the stages of growth are those of the library unless given. */
static int settle_density(options *o) {
  given *const g = &o->given;
  if (isfinite(o->packing_fraction)) g->density = o->packing_fraction;
  if (isfinite(o->porosity)) g->density = 1 - o->porosity;
  if (o->least_distance > 0 && !(g->density > 0 && g->sizes && (g->cell_count || is_named(o, "box")))) {
    complain(
        "--least-distance needs a law of --sizes in the unit of --cell or --box, and --packing-fraction or --porosity");
    return -1;
  }
  if (!(g->density > 0)) return 0;
  o->no_crunch = 1;
  if (isfinite(o->phi0) && o->phi0 > g->density) {
    complain("--phi0 %g lies above the packing fraction %g to grow to", o->phi0, g->density);
    return -1;
  }
  if (!g->stage_count) {
    g->stages[0].growth = 0;
    g->stages[0].pressure = 0; /* that of --pressure */
    g->stage_count = 1;
  }
  return 0;
}

int settle_cell(const options *o) {
  const int d = (int)o->dim, count = o->given.cell_count;
  if (!count || o->input || count == d || count == d * d) return 0;
  complain("--cell has %d numbers, in d = %d it needs %d sides or %d components of vectors", count, d, d, d * d);
  return -1;
}

/* The first option of a list of names that is on the command line; NULL when none is. */
static const char *first_named(const options *o, const char *list, char name[32]) {
  while (*list) {
    const size_t length = strcspn(list, " ");
    snprintf(name, 32, "%.*s", (int)length, list);
    if (is_named(o, name + 2)) return name;
    list += length + (list[length] == ' ');
  }
  return NULL;
}

/* What a file of the host gives itself. */
static int settle_host(const options *o) {
  const char *const named = o->given.cell_text ? "--cell" : o->origin ? "--origin" : o->columns ? "--columns" : NULL;
  if (named && is_host_format(o, o->input)) {
    complain("%s has no effect: %s gives it", named, o->input);
    return -1;
  }
  if ((o->scale == 1 && o->density == 1) || !is_host_format(o, o->output)) return 0;
  complain("%s has no effect on %s: write extended XYZ or LAMMPS data", o->scale != 1 ? "--scale" : "--density",
           o->output);
  return -1;
}

/* Nothing is ignored in silence: an option that can have no effect beside the others is refused. */
static int settle_effects(const options *o) {
  char name[32];
  size_t k;
  for (k = 0; k < ROWS; ++k) {
    const option_row *const row = &table[k];
    if (!o->named[k]) continue;
    if (row->without && first_named(o, row->without, name)) {
      complain("%s has no effect beside %s", row->name, name);
      return -1;
    }
    if (row->needs && !first_named(o, row->needs, name)) {
      complain("%s has no effect without %.*s", row->name, (int)strcspn(row->needs, " "), row->needs);
      return -1;
    }
  }
  if (o->checkpoint && o->no_crunch && !o->resume && !(o->nve > 0) && !o->given.stage_count && (o->no_md || o->input)) {
    complain("--checkpoint has no effect: neither dynamics nor a crunch run");
    return -1;
  }
  return 0;
}

/* What the crunch would refuse after the dynamics. */
static int settle_crunch(const options *o) {
  const double gap = o->duality_gap;
  if (gap == 0) return 0;
  if (!(gap >= 1e-12 && gap <= 1e-2)) {
    complain("--duality-gap is %g, it must be 0 or from 1e-12 to 1e-2", gap);
    return -1;
  }
  if (o->method != JAM_CRUNCH_BARRIER_PATH || o->strain != JAM_STRAIN_NONE) {
    complain("--duality-gap contradicts %s: it needs the barrier path and a fixed cell",
             o->strain != JAM_STRAIN_NONE ? "--strain" : "--method");
    return -1;
  }
  return 0;
}

/* Gives --pressure to the stages without their own; it must be the target of one. */
static int settle_stages(options *o) {
  int k, taken = 0;
  for (k = 0; k < o->given.stage_count; ++k)
    if (!o->given.stages[k].pressure) {
      o->given.stages[k].pressure = o->pressure;
      taken = 1;
    }
  if (!is_named(o, "pressure") || taken) return 0;
  complain("--pressure has no effect: no stage of growth runs up to it");
  return -1;
}

/* What a scene with walls cannot do. At fixed volume one axis alone cannot deform; that of a file the library counts.
 */
static int settle_walls(const options *o) {
  const char *const name = o->container ? "--container" : "--walls";
  int64_t c, open = o->dim;
  if (!o->walls && !o->container) return 0;
  for (c = 0; c < o->dim; ++c) open -= o->walls >> c & 1;
  if (o->strict_proof)
    complain("%s contradicts --strict-proof: walls do not strain", name);
  else if (o->strain != JAM_STRAIN_NONE && (o->container || open < 2))
    complain("%s contradicts --strain: a cell deforms at fixed volume along two axes without walls at least", name);
  else
    return 0;
  return -1;
}

static int is_there(const char *path, void *unused) {
  (void)path, (void)unused;
  return 1;
}

/* What a verb implies. */
static int settle_verb(options *o) {
  const char *const name = verb_table[o->given.verb].name;
  switch (o->given.verb) {
    case VERB_PACK:
      return 0;
    case VERB_COMPRESS:
      o->no_crunch = 1;
      return 0;
    case VERB_SHEAR:
      o->no_md = 1;
      if (!o->to) complain("shear needs --to, the last strain");
      if (!o->to) return -1;
      /* fall through */
    case VERB_CRUNCH:
      if (o->input || o->resume) return 0;
      complain("%s needs a FILE, or --resume", name);
      return -1;
    case VERB_ENSEMBLE:
    case VERB_SEARCH:
      complain("%s is a verb of the program alone", name);
      return -1;
    case VERB_PAGE:
      if (!o->input || !o->page) complain("page needs a FILE and the OUTPUT.html");
      return o->input && o->page ? 0 : -1;
    case VERB_EXPORT:
      if (o->input && !each_output(o, is_there, NULL)) complain("export writes nothing: name an OUTPUT or a table");
      if (o->input) return each_output(o, is_there, NULL) ? 0 : -1;
      /* fall through */
    default:
      if (!o->input) complain("%s needs a FILE", name);
      return o->input ? 0 : -1;
  }
}

int settle(options *o) {
  given *const g = &o->given;
  const int stages_given = g->stage_count;
  if (settle_verb(o)) return -1;
  if (o->json && o->given.verb <= VERB_CRUNCH) o->report = "-";
  if (settle_density(o) || settle_files(o) || settle_crunched(o) || settle_formats(o)) return -1;
  if (o->no_md && (stages_given || o->nve > 0)) {
    complain("--no-md contradicts %s", stages_given ? "--growth" : "--nve");
    return -1;
  }
  if (o->resume && o->input) {
    complain("--resume and --input both give a start: leave one out");
    return -1;
  }
  if (is_named(o, "model") && o->model == JAM_MODEL_EUCLID && (isfinite(o->zeta) || isfinite(o->plant))) {
    complain("--model euclid contradicts %s", isfinite(o->zeta) ? "--zeta" : "--plant");
    return -1;
  }
  if (settle_effects(o) || settle_stdout(o) || (!o->resume && settle_cell(o)) || settle_host(o) || settle_walls(o) ||
      settle_crunch(o))
    return -1;
  g->n = o->n != NOT_GIVEN;
  if (!g->n) o->n = 1024;
  if (isfinite(o->zeta) || isfinite(o->plant)) o->model = JAM_MODEL_MK;
  if (isfinite(o->plant)) o->phi0 = o->plant;
  if (!isfinite(o->phi0)) o->phi0 = 0; /* the library's own */
  if (o->no_md || (o->input && !g->stage_count && g->verb != VERB_COMPRESS)) return settle_stages(o);
  if (!g->stage_count) { /* those stages that --pressure lies beyond, and the one that leads there */
    const size_t stages = sizeof default_stages / sizeof *default_stages;
    size_t j = 0;
    do {
      g->stages[j] = default_stages[j];
      if (j + 1 == stages || o->pressure < default_stages[j].pressure) g->stages[j].pressure = o->pressure;
    } while (o->pressure > default_stages[j].pressure && ++j < stages);
    g->stage_count = (int)(j < stages ? j + 1 : stages);
    return 0;
  }
  return settle_stages(o);
}
