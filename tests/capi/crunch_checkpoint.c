/* Checkpoints that the callback of a crunch writes: each is a valid packing, and a crunch goes on from each. */
#include <math.h>
#include <stdio.h>

#include "columns.h"
#include "steps.h"
#include "verdicts.h"

static const char *path = "crunch_checkpoint.bin";

typedef struct keeper {
  const jam_system *sys;
  double part;            /* of the call, at which the checkpoint to keep is written; 1: the last one */
  int64_t factorisations; /* of the callback before: one that comes by the clock alone follows no step */
  int kept, failed;       /* checkpoints so far; statuses other than JAM_OK */
  double phi;             /* of the callback's record then */
} keeper;

static int32_t keep(const jam_progress *p, void *user) {
  keeper *k = user;
  const int step = p->factorisations > k->factorisations;
  k->factorisations = p->factorisations;
  if (!step || (k->kept && k->part < 1.0) || p->fraction < (k->part < 1.0 ? k->part : 0.0)) return 0;
  k->failed += jam_write_checkpoint(k->sys, path) != JAM_OK;
  ++k->kept;
  k->phi = p->packing_fraction;
  return 0;
}

static jam_system *start(double cell) {
  jam_system *sys = random_spheres(3, 100, 0.3, 5);
  if (cell != 0.0) {
    const double strain[9] = {0, cell, 0, 0, 0, 0, 0, 0, 0};
    assert_int_equal(jam_scale_diameters(sys, 0.9), JAM_OK);
    assert_int_equal(jam_strain(sys, strain, 9), JAM_OK);
  }
  return sys;
}

static jam_crunch_report in_steps(jam_system *sys, int32_t steps, jam_status expected) {
  DEFAULTS(crunch, o);
  o.steps = steps;
  return crunch(sys, &o, expected);
}

/* Of the checkpoint that the first step behind this part of the call wrote: what it holds, and where a crunch from it
 * ends. */
static double go_on_from(double part, double cell, double *phi) {
  OWNED jam_system *sys = start(cell), *again = NULL;
  const double before = info_of(sys).packing_fraction;
  keeper k = {sys, part, 0, 0, 0, 0.0};
  assert_int_equal(jam_set_progress(sys, keep, &k), JAM_OK);
  jam_crunch_report whole = in_steps(sys, 1, JAM_OK);
  assert_true(k.kept > 0 && k.failed == 0);
  if (jam_read_checkpoint(path, NULL, NULL, &again) < 0)
    fail_msg("checkpoint at %g: %s", part, jam_last_error()); /* no overlap */
  jam_info info = info_of(again);
  assert_int_equal(info.paused, JAM_PHASE_CRUNCH);
  assert_true(info.packing_fraction >= before && info.packing_fraction < whole.packing_fraction * (1.0 + 1e-12));
  assert_true(info.packing_fraction > k.phi * (1.0 - 1e-12)); /* the step that was told, not the one before */
  jam_crunch_report rest = in_steps(again, 0, JAM_OK);
  assert_true(rest.jammed && rest.packing_fraction > info.packing_fraction * (1.0 - 1e-12));
  assert_int_equal(info_of(again).paused, 0);
  *phi = rest.packing_fraction;
  return whole.packing_fraction;
}

CASE(each_one_goes_on) {
  double phi = 0.0;
  for (int k = 0; k < 6; ++k) go_on_from(0.15 * k, 0.0, &phi);
  go_on_from(0.2, 0.3, &phi); /* a sheared cell */
  double whole = go_on_from(1.0, 0.0, &phi);
  assert_true(phi > whole * (1.0 - 1e-10) && phi < whole * (1.0 + 1e-10)); /* at its end the same packing */
  remove(path);
}

static int32_t stop(const jam_progress *p, void *user) {
  (void)user;
  return p->factorisations > 5;
}

/* The handle itself, its copies and its checkpoints know of a crunch that was stopped, until spheres change. */
CASE(a_stopped_crunch_is_known) {
  OWNED jam_system *sys = start(0.0), *copy = NULL, *again = NULL;
  assert_int_equal(jam_set_progress(sys, stop, NULL), JAM_OK);
  in_steps(sys, 1, JAM_CANCELLED);
  assert_int_equal(info_of(sys).paused, JAM_PHASE_CRUNCH);
  copy = copy_of(sys), again = from_checkpoint(sys);
  assert_int_equal(info_of(copy).paused, JAM_PHASE_CRUNCH);
  assert_int_equal(info_of(again).paused, JAM_PHASE_CRUNCH);
  assert_int_equal(jam_scale_diameters(sys, 0.99), JAM_OK);
  assert_int_equal(info_of(sys).paused, 0);
}

static double history(const jam_system *sys, size_t column, int last) {
  double rows[200];
  size_t count;
  assert_int_equal(column_of(jam_crunch_history, sys, JAM_HISTORY_TOTAL_MSD_STABLE + 1, column, rows, 200, &count),
                   JAM_OK);
  assert_true(count > 0);
  return rows[last ? count - 1 : 0];
}

typedef struct lps {
  int64_t made, factorisations;
} lps;

/* Further from the last LP than an LP is long. Every step is told, so that a fast machine stops as a slow one does. */
static int32_t stop_on_path(const jam_progress *p, void *user) {
  lps *last = user;
  if (p->steps > last->made) last->made = p->steps, last->factorisations = p->factorisations;
  return last->made > 0 && p->factorisations > last->factorisations + 15;
}

/* A path that was stopped goes on where it was: no LP comes first, and the duality gap is that of the stop, for which
 * mu stands. An LP would close it, a new path would begin at the first mu. By LPs alone it begins with one. */
CASE(a_path_goes_on) {
  OWNED jam_system *sys = start(0.0), *again = NULL, *by_lps = NULL;
  lps last = {0, 0};
  assert_int_equal(jam_set_progress(sys, stop_on_path, &last), JAM_OK);
  in_steps(sys, 1, JAM_CANCELLED);
  assert_true(history(sys, JAM_HISTORY_PHASE, 1) == JAM_STEP_PATH);
  double gap = history(sys, JAM_HISTORY_DUALITY_GAP, 1);
  again = from_checkpoint(sys), by_lps = copy_of(again);
  assert_true(in_steps(again, 0, JAM_OK).jammed);
  assert_true(history(again, JAM_HISTORY_PHASE, 0) == JAM_STEP_PATH);
  assert_true(fabs(history(again, JAM_HISTORY_DUALITY_GAP, 0) / gap - 1.0) < 0.5); /* forces are those of the centre */
  DEFAULTS(crunch, o);
  o.method = JAM_CRUNCH_SEQUENTIAL_LP;
  assert_int_equal(jam_crunch(by_lps, &o, NULL), JAM_OK);
  assert_true(history(by_lps, JAM_HISTORY_PHASE, 0) == JAM_STEP_LP);
}
