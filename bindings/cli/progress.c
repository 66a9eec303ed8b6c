/* What jam-pack reports while it works: progress on stderr, and the log. */
#define _XOPEN_SOURCE 700
#include <errno.h>
#include <float.h>
#include <math.h>
#include <string.h>
#include <time.h>
#include <unistd.h>
#include "jam-pack.h"
#include "system.h"

static const double seconds_between_lines = 10;

double seconds_now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

double seconds_until(double deadline) { return fmax(deadline - seconds_now(), DBL_MIN); }

void write_checkpoint(const jam_system *sys, const options *o) {
  if (o->checkpoint && jam_write_checkpoint(sys, o->checkpoint) < 0) complain("%s", jam_last_error());
}

/* A crunch cannot be cut into slices as dynamics can: its checkpoints are written while it runs. */
static void keep_crunch(terminal *t, const jam_progress *p, double now) {
  if (t->o->given.verb == VERB_SHEAR || (p->phase != JAM_PHASE_CRUNCH && p->phase != JAM_PHASE_POLISH) ||
      now - t->kept < t->o->checkpoint_every)
    return;
  t->kept = now;
  write_checkpoint(t->sys, t->o);
}

/* "  [####------]  42 %, 30 s left (20 to 45 s)" as far as it is known; the bar on a terminal alone. */
static void show_time_left(const jam_progress *p, int bar) {
  static const char full[] = "####################", empty[] = "--------------------";
  const int marks = isnan(p->fraction) ? 0 : (int)(20 * fmin(fmax(p->fraction, 0), 1));
  if (isnan(p->fraction)) return;
  if (bar) fprintf(stderr, "  [%.*s%.*s]", marks, full, 20 - marks, empty);
  fprintf(stderr, "  %.0f %%", floor(100 * p->fraction));
  if (isnan(p->seconds_left)) return;
  fprintf(stderr, ", %.2g s left (%.2g to %.2g)", p->seconds_left, p->seconds_left / p->seconds_left_spread,
          p->seconds_left * p->seconds_left_spread);
}

static int32_t show_progress(const jam_progress *p, void *user) {
  terminal *t = user;
  const double now = seconds_now();
  const jam_pack_host *const host = t->o->given.host;
  keep_crunch(t, p, now);
  if (host && host->progress && t->o->plot) host->progress(p, host->user);
  if (t->o->quiet) return 0;
  if (!t->is_terminal && now - t->told < seconds_between_lines) return 0;
  t->told = now;
  if (t->is_terminal) fputs("\r\033[K", stderr);
  if (!t->has_counted) { /* hours of work should not begin with the wrong number of spheres */
    const jam_info info = info_of(t->sys);
    fprintf(stderr, "%lld spheres in d = %d\n", (long long)info.n, (int)info.dim);
    t->has_counted = 1;
  }
  if (p->phase == JAM_PHASE_RUN || p->phase == JAM_PHASE_COMPRESS)
    fprintf(stderr, "%s  p %.4g  phi %.6f  %.3g collisions  %.1f s", t->stage, p->pressure, p->packing_fraction,
            (double)p->collisions, now - t->begin);
  else if (p->phase == JAM_PHASE_SHEAR)
    fprintf(stderr, "%s  p %.4g  phi %.6f  %.1f s", t->stage, p->pressure, p->packing_fraction, now - t->begin);
  else
    fprintf(stderr, "%s  %lld LPs  %lld factorisations  gain %.3e  phi %.12f  %.1f s", t->stage, (long long)p->steps,
            (long long)p->factorisations, p->gain, p->packing_fraction, now - t->begin);
  show_time_left(p, t->is_terminal);
  if (!t->is_terminal) fputc('\n', stderr);
  fflush(stderr);
  return 0;
}

static void write_log(int32_t level, const char *line, void *user) {
  terminal *t = user;
  fprintf(t->log, "%10.3f %s %s\n", seconds_now() - t->begin, level == JAM_LOG_WARNING ? "warning" : "info", line);
  fflush(t->log); /* a killed job leaves what was said */
}

/* The log is written in place, so that it can be read while the program runs. */
int start_progress(terminal *t, const options *o, jam_system *sys) {
  t->is_terminal = isatty(STDERR_FILENO);
  t->told = t->begin;
  t->o = o;
  t->sys = sys;
  if (!o->quiet || o->checkpoint || o->plot) jam_set_progress(sys, show_progress, t);
  if (!o->log) return 0;
  t->log = strcmp(o->log, "-") ? open_stream(o->log, "w") : stdout;
  if (t->log) return jam_set_log(sys, write_log, JAM_LOG_INFO, t) < 0;
  complain("cannot write %s: %s", o->log, strerror(errno));
  return -1;
}

int end_progress(terminal *t, const options *o) {
  int bad = 0;
  if (!o->quiet && t->is_terminal) fputs("\r\033[K", stderr);
  if (t->log) {
    bad = ferror(t->log) != 0;
    if (t->log != stdout) bad |= fclose(t->log) != 0;
    if (bad) complain("cannot write %s: %s", o->log, strerror(errno));
  }
  return bad;
}
