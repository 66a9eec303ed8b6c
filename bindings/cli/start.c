/* How jam-pack begins: a random start of one of the models, a file, or a checkpoint. */
#include <math.h>
#include <stdlib.h>
#include <string.h>
#include "jam-pack.h"
#include "system.h"

/* A start below the density that it is to grow to. */
static double start_fraction(const options *o) {
  const double usual = START_FRACTION(o->dim);
  return o->phi0 > 0 || !(o->given.density > 0 && o->given.density < usual) ? o->phi0 : o->given.density;
}

static void complain_note(const char *line, int warns, void *with) {
  (void)with;
  complain("%s%s", warns ? "" : "note: ", line);
}

void complain_notes(const jam_system *sys) { each_note(jam_notes(sys), complain_note, NULL); }

/* A word of a layout of jam_read_as, which blanks would end: those behind commas are left out. */
static void put_fact(FILE *f, const char *name, const char *value) {
  const char *at;
  if (!value) return;
  fprintf(f, " %s=", name);
  for (at = value; *at; ++at)
    if (*at != ' ' || !(at == value || strchr(", ", at[-1]))) fputc(*at, f);
}

/* The file, with the options that give what it lacks. */
static jam_status read_input(const options *o, const jam_create_options *create, jam_system **sys) {
  char *layout = NULL;
  size_t size = 0;
  jam_status status = JAM_E_MEMORY;
  FILE *const f = open_text(&layout, &size);
  if (f) {
    put_fact(f, "cell", o->given.cell_text);
    put_fact(f, "origin", o->origin);
    put_fact(f, "columns", o->columns);
  }
  if (!f || close_text(f, &layout, &size))
    jam_set_error("out of memory for the options of the file");
  else
    status = jam_read_as(o->input, layout, create, stop_if_asked, NULL, sys);
  free(layout);
  return status;
}

static jam_create_options create_options(const options *o, int32_t overlap) {
  jam_create_options create;
  jam_create_options_init(&create, sizeof create);
  create.box = o->box;
  create.frame = o->frame;
  create.non_additivity = o->non_additivity;
  create.container = (int32_t)o->container;
  create.walls = (int32_t)o->walls; /* the words of the table stand in the order of the bits */
  create.overlap = overlap;
  return create;
}

/* What reading assumed may be why spheres overlap: a box of side 1 for a file without one. */
static void complain_assumptions(const options *o) {
  const jam_create_options create = create_options(o, JAM_OVERLAP_ALLOW);
  jam_system *sys = NULL;
  if (read_input(o, &create, &sys) >= 0 && sys) complain_notes(sys);
  jam_destroy(sys);
}

/* Why there is no start, with the option that helps. An option that contradicts the file is a wrong command line. */
static int refused_start(const options *o, jam_status status) {
  const char *const text = jam_last_error()[0] ? jam_last_error() : jam_status_string(status);
  const int takes_it = o->input && !o->shrink && o->given.verb <= VERB_CRUNCH;
  if (status == JAM_E_OVERLAP && takes_it && !strstr(text, "the same centre") && !strstr(text, "lies outside"))
    complain("%s; --shrink multiplies all diameters by the factor that brings the worst pair to contact", text);
  else if (status == JAM_E_UNPLACEABLE && !o->input)
    complain("%s; --phi0 sets it", text);
  else
    complain("%s", text);
  if (status == JAM_E_OVERLAP && o->input && !is_host_format(o, o->input)) complain_assumptions(o);
  return status == JAM_E_ARGUMENT &&
                 (is_named(o, "box") || is_named(o, "non-additivity") || is_named(o, "frame") || is_named(o, "walls") ||
                  is_named(o, "container") || is_named(o, "cell") || is_named(o, "origin") || is_named(o, "columns"))
             ? EXIT_USAGE
             : EXIT_FAILED;
}

/* --tile: the copies take the place of what was read. */
static int tile(const options *o, jam_system **sys) {
  jam_system *copies = NULL;
  const jam_status status =
      o->given.copies_count ? jam_tile(*sys, o->given.copies, (size_t)o->given.copies_count, &copies) : JAM_OK;
  if (status != JAM_OK) {
    complain("--tile: %s", jam_last_error());
    jam_destroy(*sys);
    *sys = NULL;
    return status == JAM_E_ARGUMENT || status == JAM_E_UNSUPPORTED ? EXIT_USAGE : EXIT_FAILED;
  }
  if (copies) {
    jam_destroy(*sys);
    *sys = copies;
  }
  return 0;
}

/* The library starts lower where the usual density leaves no place. So does a start at the density to grow to. */
static jam_status create_start(const options *o, jam_create_options *create, const jam_start *from, jam_system **sys) {
  const double first = create->packing_fraction;
  char line[120];
  jam_status status = jam_create(create, from, sys);
  while (status == JAM_E_UNPLACEABLE && first > 0 && !(o->phi0 > 0) && create->packing_fraction > 1e-3 * first) {
    create->packing_fraction *= 0.7;
    status = jam_create(create, from, sys);
  }
  if (status >= 0 && *sys && create->packing_fraction < first) {
    snprintf(line, sizeof line, "the random start has the packing fraction %.4g: at %g these spheres found no place",
             create->packing_fraction, first);
    jam_add_note(*sys, line);
  }
  return status;
}

int start(const options *o, jam_system **sys, double *mean) {
  jam_create_options create = create_options(o, o->shrink ? JAM_OVERLAP_SHRINK : JAM_OVERLAP_REFUSE);
  jam_start from = {.struct_size = sizeof from};
  double *diameters = NULL, cell[JAM_MAX_DIM * JAM_MAX_DIM];
  jam_status status = JAM_OK;
  *mean = NAN;
  create.seed = o->seed;
  create.shrink_min = o->shrink_min;
  create.model = (int32_t)o->model;
  create.mk_zeta = o->zeta;
  if (o->resume)
    status = jam_read_checkpoint(o->resume, stop_if_asked, NULL, sys);
  else if (is_host_format(o, o->input)) {
    if (o->given.host->read(o->input, &create, o->given.host->user, sys)) return refused_start(o, JAM_E_IO);
  } else if (o->input)
    status = read_input(o, &create, sys);
  else {
    create.n = o->n;
    if (make_diameters(o, &diameters, &create.n)) {
      free(diameters);
      return EXIT_FAILED;
    }
    if (o->given.sizes || o->given.diameters_file) *mean = mean_of(diameters, create.n);
    create.dim = (int32_t)o->dim;
    create.packing_fraction = start_fraction(o);
    from.diameters = diameters;
    from.diameters_len = diameters ? (size_t)create.n : 0;
    from.progress = stop_if_asked;
    if (o->given.cell_count) {
      fill_cell(o, cell);
      from.cell = cell;
      from.cell_len = (size_t)(o->dim * o->dim);
    }
    status = create_start(o, &create, &from, sys);
    free(diameters);
  }
  if (status < 0) return refused_start(o, status);
  if (!*sys) {
    complain("interrupted before the packing was made");
    return EXIT_FAILED;
  }
  if (o->input || o->resume) *mean = info_of(*sys).diameter_mean;
  return o->resume ? check_resumed(o, *sys, mean) : tile(o, sys);
}

int read_as_it_is(const options *o, jam_system **sys) {
  const jam_create_options create = create_options(o, JAM_OVERLAP_ALLOW);
  jam_status status = JAM_OK;
  if (!is_host_format(o, o->input))
    status = read_input(o, &create, sys);
  else if (o->given.host->read(o->input, &create, o->given.host->user, sys))
    status = JAM_E_IO;
  if (status < 0) return refused_start(o, status);
  if (!*sys) {
    complain("interrupted before %s was read", o->input);
    return 0;
  }
  print_warnings(jam_notes(*sys));
  return tile(o, sys);
}
