/* From nothing, or from a file, to a certified jammed packing: the whole of jam-pack. */
#define _XOPEN_SOURCE 700
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "jam-pack.h"
#include "system.h"

/* ---- the parts of the job; each returns the library's status */

static void add_md(outcome *result, const jam_md_report *md) {
  result->has_md = 1;
  result->md_stop = md->stop_reason;
  result->collisions += md->collisions;
  result->pressure = md->pressure;
  result->seconds_md += md->seconds;
}

/* Least seconds of a slice, and least ratio to the time of writing its checkpoint, but for the last slice. So most time
 * goes to the dynamics, and no other slice ends before the first collision. */
static const double least_time = 1e-3, slice_per_writing = 10;

/* With --checkpoint a stage runs in slices, and a killed job goes on from the last one. */
static double slice(const options *o, double deadline, double writing) {
  const double left = seconds_until(deadline), least = fmax(slice_per_writing * writing, least_time);
  return o->checkpoint ? fmin(left, fmax(o->checkpoint_every, least)) : left;
}

static int goes_on(const jam_system *sys, const options *o, double deadline, jam_status status, const jam_md_report *md,
                   double *writing) {
  const double begun = seconds_now();
  if (status >= 0) write_checkpoint(sys, o);
  *writing = seconds_now() - begun;
  return status == JAM_LIMIT && md->stop_reason == JAM_STOP_WALL_TIME && seconds_until(deadline) > least_time &&
         !stop_if_asked(NULL, NULL);
}

static jam_status run_nve(jam_system *sys, const options *o, int32_t resume, double deadline, outcome *result) {
  jam_run_options run;
  jam_md_report md;
  double writing = 0;
  jam_status status = jam_run_options_init(&run, sizeof run);
  md.struct_size = sizeof md;
  run.collisions_per_particle = o->nve > 0 ? o->nve : run.collisions_per_particle;
  run.resume = resume;
  do {
    run.wall_time = slice(o, deadline, writing);
    status = jam_run(sys, &run, &md);
    if (status >= 0) add_md(result, &md);
    run.resume = 1;
  } while (goes_on(sys, o, deadline, status, &md, &writing));
  return status;
}

/* s NULL: the stage of a checkpoint. */
static jam_status run_stage(jam_system *sys, const options *o, const stage *s, double deadline, outcome *result) {
  jam_compress_options compress;
  jam_md_report md;
  double writing = 0;
  jam_status status = jam_compress_options_init(&compress, sizeof compress);
  md.struct_size = sizeof md;
  compress.resume = !s;
  if (s) {
    compress.growth_rate = s->growth;
    compress.pressure = s->pressure;
    if (o->given.density > 0) compress.packing_fraction = o->given.density;
  }
  do {
    compress.wall_time = slice(o, deadline, writing);
    status = jam_compress(sys, &compress, &md);
    if (status >= 0) add_md(result, &md);
    compress.resume = 1;
  } while (goes_on(sys, o, deadline, status, &md, &writing));
  return status;
}

/* What a checkpoint was in the middle of; then the stages that lead beyond its pressure are left, or the crunch alone.
 */
static jam_status finish_paused(jam_system *sys, const options *o, terminal *t, double deadline, outcome *result,
                                int *stages_left) {
  const jam_info info = info_of(sys);
  if (info.paused == JAM_PHASE_CRUNCH) *stages_left = 0;
  t->stage = "resumed stage";
  result->pressure = info.pressure;
  if (info.paused == JAM_PHASE_RUN) return run_nve(sys, o, 1, deadline, result);
  return info.paused && *stages_left ? run_stage(sys, o, NULL, deadline, result) : JAM_OK;
}

static jam_status run_crunch(jam_system *sys, const options *o, double wall_time, outcome *result) {
  jam_crunch_options crunch;
  jam_status status = jam_crunch_options_init(&crunch, sizeof crunch);
  crunch.lp_solver = (int32_t)o->lp;
  crunch.method = (int32_t)o->method;
  crunch.strain = (int32_t)o->strain;
  crunch.threads = (int32_t)o->threads;
  crunch.duality_gap = o->duality_gap;
  crunch.prove = o->prove;
  crunch.keep_steps = o->page ? (int32_t)o->page_steps : 0;
  crunch.wall_time = wall_time;
  result->crunch.struct_size = sizeof result->crunch;
  if (status >= 0) status = jam_crunch(sys, &crunch, &result->crunch);
  result->has_crunch = status >= 0;
  if (result->has_crunch && o->prove && o->strict_proof && result->crunch.jammed) {
    result->strict.struct_size = sizeof result->strict;
    result->has_strict = jam_prove(sys, JAM_RIGIDITY_STRICT, NULL, 0, &result->strict) >= 0;
  }
  if (status == JAM_CANCELLED || status == JAM_LIMIT ||
      (status == JAM_OK && result->crunch.stop_reason == JAM_STOP_DUALITY_GAP))
    write_checkpoint(sys, o);
  return status;
}

/* Dynamics kept on disk before the crunch: a killed crunch then costs the crunch only. */
static void keep(const jam_system *sys, const char *path) {
  if (path && appears_whole(path)) jam_write(sys, path, JAM_FORMAT_AUTO);
}

/* Dynamics that end before their aim are no reason to stop, but never go unseen. */
static void warn(const terminal *t, jam_status status, outcome *result) {
  if (status != JAM_NOT_CONVERGED && status != JAM_PRECISION) return;
  if (status == JAM_NOT_CONVERGED) result->fell_short = 1;
  complain("warning: %s ended at p = %.4g: %s: %s", t->stage, result->pressure, jam_stop_string(result->md_stop),
           jam_last_error());
}

/* Molecular dynamics may end by precision or by stalling, and the crunch goes on from there; limits and Ctrl-C end the
 * job. */
static int ends_job(jam_status status) {
  return status < 0 || status == JAM_CANCELLED || status == JAM_LIMIT || stop_if_asked(NULL, NULL);
}

/* Growth leads to no density below that of the start. */
static int lies_above(const jam_system *sys, double density) {
  const jam_info info = info_of(sys);
  if (!(density > 0) || info.packing_fraction <= density * (1 + 1e-12)) return 0;
  complain("warning: the packing fraction is %.6g, above the %.6g to grow to: nothing was done", info.packing_fraction,
           density);
  return 1;
}

static jam_status work(jam_system *sys, const options *o, terminal *t, outcome *result) {
  const double deadline = o->given.deadline;
  char name[64] = "NVE";
  jam_status status = JAM_OK;
  int k, stages_left = o->given.stage_count;
  t->stage = name;
  result->fell_short = lies_above(sys, o->given.density);
  if (result->fell_short) return JAM_OK;
  if (o->resume)
    status = finish_paused(sys, o, t, deadline, result, &stages_left);
  else if (o->nve > 0)
    status = run_nve(sys, o, 0, deadline, result);
  warn(t, status, result);
  t->stage = name;
  for (k = 0; k < stages_left && !ends_job(status); ++k) {
    if (o->resume && o->given.stages[k].pressure <= result->pressure) continue;
    if (o->given.density > 0 && result->has_md && result->md_stop == JAM_STOP_PACKING_FRACTION) break;
    snprintf(name, sizeof name, o->given.stages[k].growth > 0 ? "growth %g" : "growth", o->given.stages[k].growth);
    status = run_stage(sys, o, &o->given.stages[k], deadline, result);
    if (status >= 0) result->stage_stop[k] = result->md_stop;
    if (!(o->given.density > 0 && result->md_stop == JAM_STOP_PRESSURE)) warn(t, status, result);
  }
  if (o->given.density > 0 && !ends_job(status) && !(result->has_md && result->md_stop == JAM_STOP_PACKING_FRACTION)) {
    complain("warning: growth ended at p = %.4g, before the packing fraction %.6g", result->pressure, o->given.density);
    result->fell_short = 1;
  }
  if (o->no_crunch || ends_job(status)) return status;
  if (result->has_md && !is_host_format(o, o->output)) keep(sys, o->output);
  strcpy(name, o->radii ? "radii" : "crunch");
  return (o->radii ? run_radii : run_crunch)(sys, o, seconds_until(deadline), result);
}

/* Whole spheres of one size, or of a few, miss the density asked for by up to half a sphere: it is theirs that they
 * grow to. With --least-distance it is that of their shells. */
static void take_density_of_sizes(options *o, jam_system *sys, double mean) {
  const jam_info info = info_of(sys);
  char line[200];
  double density;
  if (!(o->given.density > 0) || !o->given.sizes || o->given.n || !(mean > 0)) return;
  density = info.packing_fraction * pow(mean / info.diameter_mean, info.dim);
  if (fabs(density / o->given.density - 1) < 1e-11) return;
  if (o->least_distance > 0)
    snprintf(line, sizeof line,
             "the spheres of --sizes grow in shells of %g to the packing fraction %.9g of the shells, and keep the "
             "distance %g",
             0.5 * o->least_distance, density, o->least_distance);
  else
    snprintf(line, sizeof line,
             "%lld whole spheres of --sizes have the packing fraction %.9g, nearest to the requested %g: they grow to "
             "it",
             (long long)info.n, density, o->given.density);
  if (!strstr(jam_notes(sys), line)) jam_add_note(sys, line); /* a checkpoint has it */
  o->given.density = density;
}

static void copy_note(const char *line, int warns, void *to) {
  (void)warns;
  jam_add_note(to, line);
}

/* The spheres without the shells that kept them apart. Growth that fell short has left both smaller by one factor. */
static jam_status leave_shells(const options *o, double mean, double asked, jam_system **sys) {
  jam_info info = info_of(*sys);
  jam_create_options create;
  jam_start from = {.struct_size = sizeof from};
  jam_system *bare = NULL;
  double cell[JAM_MAX_DIM * JAM_MAX_DIM], *diameters = NULL;
  const double *shells;
  size_t k, needed;
  char line[160];
  jam_status status = jam_create_options_init(&create, sizeof create);
  jam_view(*sys, JAM_VIEW_POSITIONS, &from.positions, &from.positions_len);
  jam_view(*sys, JAM_VIEW_DIAMETERS, &shells, &from.diameters_len);
  jam_get_cell(*sys, cell, sizeof cell / sizeof *cell, &needed);
  diameters = malloc(from.diameters_len * sizeof *diameters);
  if (!diameters) return JAM_E_MEMORY;
  for (k = 0; k < from.diameters_len; ++k) diameters[k] = shells[k] - o->least_distance * (info.diameter_mean / mean);
  create.dim = info.dim, create.seed = info.seed, create.container = info.container, create.walls = info.walls;
  from.diameters = diameters, from.cell = cell, from.cell_len = needed;
  if (status >= 0) status = jam_create(&create, &from, &bare);
  free(diameters);
  if (!bare) return status;
  each_note(jam_notes(*sys), copy_note, bare);
  jam_destroy(*sys);
  *sys = bare;
  info = info_of(bare);
  if (fabs(info.packing_fraction / asked - 1) < 1e-11) return status;
  snprintf(line, sizeof line, "without the shells the packing fraction is %.9g, requested was %g",
           info.packing_fraction, asked);
  jam_add_note(bare, line);
  return status;
}

/* The job of one command line, from its start to its files. */
int run_job(const options *given) {
  options own = *given, *const o = &own;
  outcome result;
  terminal t = {"start", seconds_now(), 0, 0, 0, 0, NULL, NULL, NULL};
  jam_system *sys = NULL;
  jam_status status = JAM_OK;
  int bad, code;
  jam_radii_options radii;
  memset(&result, 0, sizeof result);
  if (o->radii && take_radii(o, &radii)) return EXIT_USAGE;
  code = start(o, &sys, &result.diameter_given);
  if (!code && (o->input || o->resume || o->dim > 3 || o->given.cell_count || o->n == 1 || o->walls || o->container) &&
      check_formats(o, sys))
    code = EXIT_USAGE;
  if (!code) print_warnings(jam_notes(sys));
  if (!code) take_density_of_sizes(o, sys, result.diameter_given);
  watch_signals(sys);
  if (!code && start_progress(&t, o, sys)) code = EXIT_OUTPUT;
  if (code) {
    watch_signals(NULL);
    return leave(sys, code);
  }
  if (!stop_if_asked(NULL, NULL)) status = work(sys, o, &t, &result);
  watch_signals(NULL);
  bad = end_progress(&t, o);
  if (status >= 0 && o->least_distance > 0) {
    const jam_status left = leave_shells(o, result.diameter_given, given->given.density, &sys);
    result.diameter_given -= o->least_distance;
    if (left < 0) status = left;
  }
  if (status == JAM_E_UNPLACEABLE) { /* the density lies beyond reach: nothing was done that is worth a file */
    complain("%s%s", o->least_distance > 0 ? "the spheres in their shells: " : "", jam_last_error());
    return leave(sys, EXIT_FAILED);
  }
  if (status < 0)
    complain("%s", jam_last_error());
  else if (stop_if_asked(NULL, NULL) || status > 0)
    print_stop(sys, o, status, &result);
  else if (result.fell_short)
    complain("dynamics fell short of their aim: see the warning above");
  result.code = bad                                                            ? EXIT_OUTPUT
                : status < 0                                                   ? code_of(status)
                : status > 0 || stop_if_asked(NULL, NULL) || result.fell_short ? EXIT_EARLY
                                                                               : EXIT_DONE;
  return leave(sys, write_all(sys, o, &result));
}
