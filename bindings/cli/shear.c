/* jam-pack shear FILE: quasi-static shear in slices of a few steps, so that a killed job goes on to the same bits. */
#define _XOPEN_SOURCE 700
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "jam-pack.h"
#include "system.h"

enum { SLICE = 8 };

/* How far a shear has come, at the begin of a slice; a note of the checkpoint holds the same. */
typedef struct place {
  int leg;      /* of the path from turn to turn */
  double steps; /* done in it */
  long long rows, events;
  double first_event, peak_stress, peak_strain;
} place;

typedef struct shear_job {
  const options *o;
  jam_system *sys, *begun; /* begun: at `at`, where a checkpoint is asked for */
  shear_path path;
  jam_shear_options options;
  jam_shear_report last; /* of the last slice */
  place at, reached;
  char *table; /* rows of the run that is continued, with the heading */
  double (*row)[JAM_SHEAR_COLUMNS];
  size_t row_count, row_room; /* of this run */
  double kept;                /* on the clock of seconds_now: the last checkpoint */
} shear_job;

static const char heading[] =
    "strain,stress,pressure,energy,packing_fraction,contacts,made,broken,nonaffine,event,rattlers,evaluations,"
    "factorisations\n";
static const char note[] =
    "shear --to %s --step %.17g --alpha %.17g: leg %d step %.17g rows %lld events %lld first %.17g peak %.17g at %.17g";

/* 0: hard spheres. */
static double alpha_of(const shear_job *job) { return isfinite(job->o->alpha) ? job->o->alpha : 0; }

static double begin_of(const shear_job *job, const place *p) {
  const double from = p->leg ? job->path.turns[p->leg - 1] : 0, way = job->path.turns[p->leg] - from;
  return from + copysign(p->steps * job->o->step, way);
}

/* The strain of the next slice: whole steps, or what is left of the leg. */
static double slice_of(const shear_job *job, const place *p, place *after) {
  const double from = p->leg ? job->path.turns[p->leg - 1] : 0, way = job->path.turns[p->leg] - from,
               step = job->o->step;
  *after = *p;
  if (fabs(way) / step * (1 + 1e-15) >= p->steps + SLICE + 1) {
    after->steps += SLICE;
    return copysign(SLICE * step, way);
  }
  ++after->leg, after->steps = 0;
  return way - copysign(p->steps * step, way);
}

/* ---- what a killed job leaves: the rows, then the state */

static int put_rows(const shear_job *job) {
  output out;
  size_t k, c;
  if (!job->o->rows) return 0;
  if (open_output(&out, job->o->rows)) return -1;
  fputs(job->table ? job->table : heading, out.file);
  for (k = 0; k < job->row_count; ++k)
    for (c = 0; c < JAM_SHEAR_COLUMNS; ++c)
      fprintf(out.file, "%.17g%c", job->row[k][c], c + 1 < JAM_SHEAR_COLUMNS ? ',' : '\n');
  return close_output(&out);
}

static int keep_state(shear_job *job, const jam_system *from) {
  const place *p = &job->at;
  jam_system *copy = NULL;
  char line[1000];
  int bad;
  job->kept = seconds_now();
  if (!job->o->checkpoint || !from) return 0;
  snprintf(line, sizeof line, note, job->path.text, job->o->step, alpha_of(job), p->leg, p->steps, p->rows, p->events,
           p->first_event, p->peak_stress, p->peak_strain);
  bad = put_rows(job) || jam_copy(from, &copy) < 0 || jam_add_note(copy, line) < 0 ||
        jam_write_checkpoint(copy, job->o->checkpoint) < 0;
  if (bad) complain("%s: %s", job->o->checkpoint, jam_last_error());
  jam_destroy(copy);
  return bad ? -1 : 0;
}

/* The last note of a shear that the checkpoint has. */
static int read_place(shear_job *job) {
  const char *at = jam_notes(job->sys), *found = NULL;
  char to[600];
  double step = 0, alpha = 0;
  while ((at = strstr(at, "shear --to "))) found = at++;
  if (found &&
      sscanf(found,
             "shear --to %599s --step %lf --alpha %lf: leg %d step %lf rows %lld events %lld first %lf peak %lf at %lf",
             to, &step, &alpha, &job->at.leg, &job->at.steps, &job->at.rows, &job->at.events, &job->at.first_event,
             &job->at.peak_stress, &job->at.peak_strain) == 10) {
    if (!strcmp(to, job->path.text) && step == job->o->step && alpha == alpha_of(job)) return 0;
    if (alpha > 0)
      complain("%s continues --to %s --step %.17g --alpha %g: give the same", job->o->resume, to, step, alpha);
    else
      complain("%s continues --to %s --step %.17g of hard spheres: give the same", job->o->resume, to, step);
  } else if (found) {
    complain("%s: another version of jam-pack began this shear, and left other words", job->o->resume);
  } else {
    complain("%s is no checkpoint of a shear", job->o->resume);
  }
  return -1;
}

/* Those lines of the table that the state has gone through. */
static int read_rows(shear_job *job) {
  long long lines = 0;
  size_t size = 0;
  int c = 0;
  FILE *from = open_stream(job->o->rows, "r"), *to = open_text(&job->table, &size);
  while (from && to && lines < job->at.rows + 1 && (c = getc(from)) != EOF) {
    putc(c, to);
    lines += c == '\n';
  }
  if (from) fclose(from);
  if (!to || close_text(to, &job->table, &size)) return -1;
  if (lines == job->at.rows + 1 && !strncmp(job->table, heading, strlen(heading))) return 0;
  complain("%s has not the %lld rows of the shear that %s continues", job->o->rows, job->at.rows, job->o->resume);
  return -1;
}

/* ---- the work */

/* The rows of the last call; the first one repeats where it began. */
static int take_rows(shear_job *job) {
  const double begin = begin_of(job, &job->at);
  size_t numbers = 0, rows, k;
  place *const p = &job->reached;
  if (job->last.steps == 0) return 0; /* no minimum */
  if (jam_shear_history(job->sys, JAM_SHEAR_COLUMNS, NULL, 0, &numbers) < 0) return 0;
  rows = numbers / JAM_SHEAR_COLUMNS;
  if (job->row_count + rows > job->row_room) {
    void *const more = realloc(job->row, (job->row_room = 2 * (job->row_count + rows)) * sizeof *job->row);
    if (!more) return -1;
    job->row = more;
  }
  if (jam_shear_history(job->sys, JAM_SHEAR_COLUMNS, job->row[job->row_count], numbers, NULL) < 0) return -1;
  k = p->rows > 0;
  if (k) memmove(job->row[job->row_count], job->row[job->row_count + 1], (rows - 1) * sizeof *job->row);
  for (rows -= k; rows > 0; --rows, ++p->rows) {
    double *const row = job->row[job->row_count++];
    row[JAM_SHEAR_STRAIN] += begin;
    if (row[JAM_SHEAR_EVENT] == 1 && p->events++ == 0)
      p->first_event = job->row_count > 1 ? job->row[job->row_count - 2][JAM_SHEAR_STRAIN] : begin;
    if (row[JAM_SHEAR_PRESSURE] != 0 && !(fabs(row[JAM_SHEAR_STRESS]) <= fabs(p->peak_stress)))
      p->peak_stress = row[JAM_SHEAR_STRESS], p->peak_strain = row[JAM_SHEAR_STRAIN];
  }
  return 0;
}

static jam_status work(shear_job *job, terminal *t) {
  char stage[80];
  jam_status status = JAM_OK;
  t->stage = stage;
  while (job->at.leg < job->path.turn_count && status == JAM_OK) {
    place after;
    const double turn = slice_of(job, &job->at, &after);
    snprintf(stage, sizeof stage, "strain %.6g", begin_of(job, &job->at));
    if (job->o->checkpoint) {
      jam_destroy(job->begun);
      job->begun = NULL;
      if (jam_copy(job->sys, &job->begun) < 0) return JAM_E_MEMORY;
    }
    job->options.wall_time = seconds_until(job->o->given.deadline);
    job->reached = job->at;
    status = turn == 0 ? JAM_OK
                       : jam_shear(job->sys, &job->options, &turn, 1, job->path.mode, job->path.mode_count, &job->last);
    if (status < 0) return status;
    if (turn != 0 && take_rows(job)) return JAM_E_MEMORY;
    if (status != JAM_OK || (turn != 0 && job->last.stop_reason != JAM_STOP_STRAIN)) break;
    after.rows = job->reached.rows, after.events = job->reached.events, after.first_event = job->reached.first_event;
    after.peak_stress = job->reached.peak_stress, after.peak_strain = job->reached.peak_strain;
    job->at = after;
    if (seconds_now() - job->kept > job->o->checkpoint_every && keep_state(job, job->sys)) return JAM_E_IO;
  }
  return status;
}

/* ---- what it says */

static int write_json(const shear_job *job, double strain, int code, const char *path) {
  const jam_shear_report *r = &job->last;
  const place *p = &job->reached;
  double stress[JAM_MAX_DIM * JAM_MAX_DIM];
  size_t numbers = 0;
  const jam_info info = info_of(job->sys);
  output out;
  FILE *f;
  if (open_output(&out, path)) return -1;
  f = out.file;
  begin_json(f, job->o->input ? job->o->input : job->o->resume, code, messages());
  put_count(f, "n", info.n, 1);
  put_count(f, "dim", info.dim, 1);
  put_number(f, "packing_fraction", info.packing_fraction);
  put_number(f, "strain", strain);
  put_number(f, "stress", r->stress);
  put_number(f, "pressure", r->pressure);
  put_stress(f, stress, jam_stress(job->sys, stress, sizeof stress / sizeof *stress, &numbers) == JAM_OK ? numbers : 0);
  put_number(f, "energy", r->steps ? r->energy : NAN);
  fprintf(f, "  \"rigid\": %s,\n", r->rigid ? "true" : "false");
  put_count(f, "contacts", r->contacts, r->steps > 0);
  put_count(f, "rattlers", r->rattlers, r->steps > 0);
  put_count(f, "events", p->events, 1);
  put_number(f, "first_event", p->first_event);
  put_number(f, "peak_stress", p->peak_stress);
  put_number(f, "peak_strain", p->peak_strain);
  put_count(f, "rows", p->rows, 1);
  fprintf(f, "  \"stop_reason\": \"%s\",\n", jam_stop_string(r->stop_reason));
  put_notes(f, jam_notes(job->sys), "");
  return end_json(&out);
}

static void print_end(const shear_job *job, double strain) {
  const jam_shear_report *r = &job->last;
  if (!r->steps) {
    printf("ended at the strain %.9g (%s), before a minimum\n", strain, jam_stop_string(r->stop_reason));
    return;
  }
  printf("sheared to the strain %.9g (%s): stress %.6g, pressure %.6g, packing fraction %.9f\n", strain,
         jam_stop_string(r->stop_reason), r->stress, r->pressure, r->packing_fraction);
  printf("  events    %lld", job->reached.events);
  if (job->reached.events) printf(", the first at %.6g", job->reached.first_event);
  printf("; largest stress %.6g at %.6g\n", job->reached.peak_stress, job->reached.peak_strain);
  printf("  network   %lld contacts, %lld rattlers\n", (long long)r->contacts, (long long)r->rattlers);
}

/* Files, JSON and summary; returns the exit code. */
static int finish(shear_job *job, int code) {
  const options *o = job->o;
  const double strain = job->row_count ? job->row[job->row_count - 1][JAM_SHEAR_STRAIN] : begin_of(job, &job->at);
  const char *const json = o->json ? "-" : o->report;
  int cut_short = 0;
  if (code == EXIT_EARLY && keep_state(job, job->begun)) code = EXIT_OUTPUT;
  if (put_rows(job)) code = EXIT_OUTPUT;
  if (write_files(job->sys, o, job->last.rigid, &cut_short)) code = failure_code();
  if (json && write_json(job, strain, code, json)) code = EXIT_OUTPUT;
  if (!o->quiet && !o->given.stdout_taken) print_end(job, strain);
  return end_stdout(code);
}

/* The packing, and where a job that is continued has come to. */
static int begin(shear_job *job) {
  const options *o = job->o;
  double mean;
  const int code = isfinite(o->alpha) && !o->resume ? read_as_it_is(o, &job->sys) : start(o, &job->sys, &mean);
  if (code || !job->sys) return code ? code : EXIT_FAILED;
  job->at.first_event = job->at.peak_stress = job->at.peak_strain = NAN;
  jam_shear_options_init(&job->options, sizeof job->options);
  if (take_path(o, job->sys, &job->options, &job->path) || check_formats(o, job->sys)) return EXIT_USAGE;
  if (o->resume && (read_place(job) || (o->rows && read_rows(job)))) return EXIT_USAGE;
  job->options.step = o->step;
  job->options.resolution = o->resolution;
  job->options.until = (int32_t)o->until;
  if (isfinite(o->alpha)) job->options.alpha = o->alpha;
  job->last.struct_size = sizeof job->last;
  job->reached = job->at;
  return 0;
}

int shear_file(const options *o) {
  shear_job job = {.o = o};
  terminal t = {"start", seconds_now(), 0, 0, 0, 0, NULL, NULL, NULL};
  jam_status status = JAM_OK;
  int bad, code = begin(&job);
  job.kept = t.begin;
  watch_signals(job.sys);
  if (!code && start_progress(&t, o, job.sys)) code = EXIT_OUTPUT;
  if (!code) {
    status = stop_if_asked(NULL, NULL) ? JAM_CANCELLED : work(&job, &t);
    watch_signals(NULL);
    bad = end_progress(&t, o);
    if (status != JAM_OK) complain("%s", jam_last_error());
    code = bad ? EXIT_OUTPUT : status < 0 ? code_of(status) : status > 0 ? EXIT_EARLY : EXIT_DONE;
    if (status >= 0) code = finish(&job, code);
  }
  watch_signals(NULL);
  free(job.table), free(job.row);
  jam_destroy(job.begun);
  return leave(job.sys, code);
}
