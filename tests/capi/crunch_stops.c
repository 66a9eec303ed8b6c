/* Cancel and wall time inside every phase of a crunch: path, LP by either solver, polish. The log callback tells the
 * phase. Rounding decides which phases a crunch has and how long they are, so each crunch runs once without a trap, and
 * traps are set where that one was. Each time the status says so, the state is valid, and the next call goes on from
 * it. Time limits end in a phase because the callback sleeps there; one that ends before it is tried four times as
 * long. */
#include <math.h>
#include <time.h>

#include "steps.h"
#include "verdicts.h"

static jam_system *start(int n) { return random_spheres(3, n, 0.3, 5); }

typedef struct ambush {
  jam_system *sys;
  const char *armed; /* beginning of a log line that must come before; NULL: none */
  const char *word;  /* beginning of the log line that says what runs */
  int wait;          /* lines of it to let pass */
  double sleep;      /* seconds to sleep there, the time limit of the call; 0: cancel */
  int sprung, after; /* lines of it behind the trap: none but one that was on its way */
} ambush;

static void spring(int32_t level, const char *line, void *user) {
  ambush *a = user;
  (void)level;
  if (a->armed) {
    if (strncmp(line, a->armed, strlen(a->armed)) == 0) a->armed = NULL;
    return;
  }
  if (strncmp(line, a->word, strlen(a->word))) return;
  a->after += a->sprung;
  if (a->wait-- > 0 || a->sprung) return;
  a->sprung = 1;
  if (a->sleep > 0.0) {
    struct timespec t = {(time_t)a->sleep, (long)(1e9 * (a->sleep - (double)(time_t)a->sleep))};
    nanosleep(&t, NULL);
  } else {
    assert_int_equal(jam_cancel(a->sys), JAM_OK);
  }
}

typedef struct lines {
  const char *armed, *word;
  int count;
} lines;

static void count_line(int32_t level, const char *line, void *user) {
  lines *found = user;
  (void)level;
  if (!found->armed && strncmp(line, found->word, strlen(found->word)) == 0) ++found->count;
  if (found->armed && strncmp(line, found->armed, strlen(found->armed)) == 0) found->armed = NULL;
}

/* How many lines of this word, behind one that begins with `armed`, a crunch of the start logs on this machine. */
static int lines_of(const char *armed, const char *word, int n, const jam_crunch_options *o) {
  lines found = {armed, word, 0};
  OWNED jam_system *sys = start(n);
  assert_int_equal(jam_set_log(sys, count_line, JAM_LOG_DEBUG, &found), JAM_OK);
  crunch(sys, o, JAM_OK);
  return found.count;
}

/* A crunch of the start that the trap ends: by jam_cancel, or timed by its limit of time. *sys is the system. */
static jam_crunch_report crunch_into(const ambush *given, int n, int timed, jam_crunch_options o, jam_system **sys) {
  double limit = timed ? 0.1 : INFINITY;
  for (;;) {
    ambush a = *given;
    *sys = start(n);
    a.sys = *sys, a.sleep = timed ? limit : 0.0, o.wall_time = limit;
    assert_int_equal(jam_set_log(*sys, spring, JAM_LOG_DEBUG, &a), JAM_OK);
    jam_crunch_report r = crunch(*sys, &o, timed ? JAM_LIMIT : JAM_CANCELLED);
    assert_int_equal(jam_set_log(*sys, NULL, 0, NULL), JAM_OK);
    assert_int_equal(r.stop_reason, timed ? JAM_STOP_WALL_TIME : JAM_STOP_CANCELLED);
    assert_true(r.jammed == (a.sprung && o.prove) && a.after <= 1); /* a proof is of a packing that was found jammed */
    if (a.sprung) return r;
    if (!timed || limit > 1000.0) fail_msg("no line begins with '%s'", a.word);
    jam_destroy(*sys);
    limit *= 4.0;
  }
}

/* What follows from contacts is as unknown as they are. */
static void nothing_of_contacts(const jam_crunch_report *r) {
  const int64_t counts[] = {r->contacts,           r->rattlers,         r->bucklers,
                            r->isostatic_contacts, r->flexes,           r->zero_force_contacts,
                            r->undecided_contacts, r->undercoordinated, r->strict_contacts_needed};
  const double numbers[] = {r->rigidity_margin, r->force_residual,  r->min_force,
                            r->min_gap,         r->max_contact_gap, r->force_scale};
  for (size_t k = 0; k < sizeof counts / sizeof *counts; ++k) assert_int_equal(counts[k], -1);
  for (size_t k = 0; k < sizeof numbers / sizeof *numbers; ++k) assert_true(isnan(numbers[k]));
}

/* A trap in one phase, then the same call again without it. Nothing is lost. */
static void trap(const char *word, int wait, int timed, const jam_crunch_options *o) {
  OWNED jam_system *sys = NULL;
  ambush a;
  memset(&a, 0, sizeof a);
  a.word = word, a.wait = wait;
  jam_crunch_report r = crunch_into(&a, 100, timed, *o, &sys);
  assert_true(r.max_overlap < 1e-12 && r.packing_fraction > 0.2);
  assert_int_equal(r.rattlers + r.stable, r.contacts > 0 ? 100 : -1); /* unknown without contacts */
  if (strcmp(word, "path") == 0) assert_int_equal(r.contacts, -1);    /* those of the LP before are not of this state */
  jam_crunch_report done = crunch(sys, NULL, JAM_OK);
  assert_true(done.jammed && done.packing_fraction > r.packing_fraction * (1.0 - 1e-12) && done.max_overlap < 1e-12);
}

/* Traps at the first line of each phase that there is, and amid it. The first LP and, from such a start, the path are
 * always there. */
static void trap_phases(const jam_crunch_options *o) {
  const char *const words[] = {"path", "ipm", "LP", "polish"};
  for (int k = 0; k < 4; ++k) {
    const int count = lines_of(NULL, words[k], 100, o);
    if (k == 0) assert_true((count > 0) == (o->method == JAM_CRUNCH_BARRIER_PATH));
    if (k == 1) assert_true(count > 1);
    if (count > 0) trap(words[k], 0, 0, o);
    if (count > 2) trap(words[k], count / 2, 0, o);
  }
}

CASE(cancel_in_every_phase) {
  DEFAULTS(crunch, o);
  trap_phases(&o);
  o.method = JAM_CRUNCH_SEQUENTIAL_LP;
  trap_phases(&o);
}

/* The time limit comes inside the first LP: the LP is dropped and no sphere has moved. */
CASE(wall_time_inside_an_lp) {
  DEFAULTS(crunch, o);
  trap("path", 0, 1, &o);
  o.method = JAM_CRUNCH_SEQUENTIAL_LP;
  trap("ipm", 1, 1, &o);
  for (int solver = 0; solver < 2; ++solver) {
    OWNED jam_system *sys = NULL,
                     *plain = start(solver ? 600 : 100); /* 600: one LP by Clp takes far longer than the limit */
    ambush a;
    memset(&a, 0, sizeof a);
    a.word = solver ? "estimate" : "ipm";
    o.lp_solver = solver;
    jam_crunch_report r = crunch_into(&a, solver ? 600 : 100, 1, o, &sys);
    assert_true(r.lp_solves == 0 && r.stable == 0 && r.excess_contacts == 0);
    nothing_of_contacts(&r);
    same_view(plain, sys, JAM_VIEW_POSITIONS);
  }
}

static int32_t count_calls(const jam_progress *p, void *user) {
  if (p->phase == JAM_PHASE_POLISH) ++*(int *)user;
  return p->phase == JAM_PHASE_POLISH;
}

/* A polish that is stopped, or has no time left, leaves the answer of the last LP. */
CASE(a_stopped_polish_leaves_the_lp_answer) {
  OWNED jam_system *plain = start(100);
  DEFAULTS(crunch, o);
  const int ways = lines_of(NULL, "polish", 100, &o) > 0 ? 3 : 1;
  o.polish = 0;
  jam_crunch_report b = crunch(plain, &o, JAM_OK);
  jam_crunch_options_init(&o, sizeof o);
  /* before it begins, by the progress callback; in its first round; out of time there */
  for (int way = 0; way < ways; ++way) {
    OWNED jam_system *sys = NULL;
    jam_crunch_report a;
    int calls = 0;
    if (way) {
      ambush trap_set;
      memset(&trap_set, 0, sizeof trap_set);
      trap_set.word = "polish";
      a = crunch_into(&trap_set, 100, way == 2, o, &sys);
    } else {
      sys = start(100);
      jam_set_progress(sys, count_calls, &calls);
      a = crunch(sys, &o, JAM_CANCELLED);
      assert_true(calls == 1 && a.stop_reason == JAM_STOP_CANCELLED && !a.jammed);
    }
    assert_true(a.contacts == b.contacts && a.packing_fraction == b.packing_fraction &&
                a.force_residual == b.force_residual);
    same_view(plain, sys, JAM_VIEW_POSITIONS);
  }
}

static double volume(const jam_system *sys) {
  double cell[9];
  assert_int_equal(jam_get_cell(sys, cell, 9, NULL), JAM_OK);
  return cell[0] * cell[4] * cell[8]; /* lower-triangular */
}

/* The same once the cell is free. The volume stays, and the next call with strains goes on to a strict packing. */
CASE(stops_in_a_free_cell) {
  const char *const words[] = {"path", "ipm", "polish", "path"};
  DEFAULTS(crunch, o);
  o.strain = JAM_STRAIN_FREE;
  for (int k = 0; k < 4; ++k) {
    const int count = lines_of("fixed cell", words[k], 64, &o);
    OWNED jam_system *sys = NULL;
    ambush a;
    if (k < 2) assert_true(count > 0);
    if (count == 0) continue;
    memset(&a, 0, sizeof a);
    a.armed = "fixed cell", a.word = words[k], a.wait = k == 0 ? count / 2 : 0;
    jam_crunch_report r = crunch_into(&a, 64, k == 3, o, &sys);
    assert_true(r.strictly_jammed != JAM_VERDICT_YES);
    assert_true(r.max_overlap < 1e-12 && r.packing_fraction > 0.5 && fabs(volume(sys) - 1.0) < 1e-12);
    r = crunch(sys, &o, JAM_OK);
    assert_true(r.jammed && r.strictly_jammed == JAM_VERDICT_YES && fabs(volume(sys) - 1.0) < 1e-12);
  }
}

CASE(free_cell_without_polish) {
  SIZED(jam_crunch_report, r);
  OWNED jam_system *sys = start(64);
  DEFAULTS(crunch, o);
  o.strain = JAM_STRAIN_FREE, o.polish = 0;
  assert_true(jam_crunch(sys, &o, &r) >= 0);
  assert_true(r.max_overlap < 1e-12 && fabs(volume(sys) - 1.0) < 1e-12 && r.force_residual < 1e-6);
  assert_true(r.max_contact_gap < 1e-6 && r.contacts >= 3 * (r.stable - 1) + 6);
}

/* A decompression in the free cell follows a verdict: until there is another one, the report has none. */
CASE(a_limit_leaves_no_older_verdict) {
  int limits = 0;
  for (int seed = 0; seed < 6; ++seed) {
    for (int lps = 2; lps <= 20; lps += 3) {
      for (int method = JAM_CRUNCH_BARRIER_PATH; method <= JAM_CRUNCH_SEQUENTIAL_LP; ++method) {
        SIZED(jam_crunch_report, r);
        OWNED jam_system *sys = random_spheres(2, 2, 0.0, seed);
        DEFAULTS(crunch, o);
        o.strain = JAM_STRAIN_FREE, o.max_lps = lps, o.method = method;
        assert_true(jam_crunch(sys, &o, &r) >= 0);
        if (r.stop_reason != JAM_STOP_LP_LIMIT || r.gain < o.gain_tolerance) continue;
        ++limits;
        assert_false(r.stationary || r.jammed);
        if (r.contacts < 0)
          nothing_of_contacts(&r);
        else
          assert_true(r.flexes == 0 && r.zero_force_contacts == 0 && r.rigidity_margin == 0.0);
      }
    }
  }
  assert_true(limits > 10);
}

/* The same where the call is stopped in the LP behind the decompression. Two disks at the sites of a centred square
 * lattice: jammed in this cell, and a saddle of the free one by symmetry. Each LP keeps the symmetry but for rounding,
 * and a displacement of 1e-15 opens contacts by its square: no rounding makes an LP leave the saddle. (Behind a polish
 * that is refused: unit/crunch_fallbacks.) */
CASE(a_stop_leaves_no_older_contacts) {
  const double sites[4] = {0.1, 0.2, 0.6, 0.7}, diameters[2] = {0.6, 0.6};
  ambush a;
  DEFAULTS(create, c);
  c.dim = 2, c.n = 2;
  OWNED jam_system *sys = created_from(&c, sites, 4, diameters, 2);
  DEFAULTS(crunch, o);
  o.strain = JAM_STRAIN_FREE;
  memset(&a, 0, sizeof a);
  a.sys = sys, a.armed = "not shown to be jammed", a.word = "ipm";
  assert_int_equal(jam_set_log(sys, spring, JAM_LOG_DEBUG, &a), JAM_OK);
  jam_crunch_report r = crunch(sys, &o, JAM_CANCELLED);
  if (!a.sprung) fail_msg("no LP behind the saddle");
  assert_false(r.stationary);
  nothing_of_contacts(&r);
}

/* A proof that is stopped leaves the packing, its network and the verdict; the next call makes the proof. */
CASE(stops_in_the_proof) {
  DEFAULTS(crunch, o);
  o.prove = 1;
  for (int timed = 0; timed < 2; ++timed) {
    OWNED jam_system *sys = NULL;
    ambush a;
    memset(&a, 0, sizeof a);
    a.word = "proof of";
    jam_crunch_report r = crunch_into(&a, 100, timed, o, &sys);
    assert_true(strstr(jam_last_error(), "proof") && r.contacts > 0 && r.stationary);
    assert_true(r.theorem == JAM_THEOREM_NONE && r.proof_cause == JAM_CAUSE_NONE);
    assert_true(r.status == (timed ? JAM_LIMIT : JAM_CANCELLED));
    jam_crunch_report done = crunch(sys, &o, JAM_OK);
    assert_true(done.theorem == JAM_THEOREM_EXACT && done.contacts == r.contacts);
  }
}

/* A crystal with vacancies has narrow LPs and decompressions behind its first LPs: max_lps counts all LPs. */
CASE(no_more_lps_than_allowed) {
  double sites[2 * 64];
  const double side = 8.0, h = sqrt(0.75), cell[4] = {side, 0.0, 0.5 * side, h * side}, diameter = 0.999;
  int limits = 0;
  size_t n = 0;
  for (int i = 0; i < 8; ++i)
    for (int j = 0; j < 8; ++j)
      if (i != 1 || (j != 2 && j != 3)) sites[2 * n] = i + 0.5 * j, sites[2 * n++ + 1] = h * j;
  DEFAULTS(create, c);
  c.dim = 2, c.n = (int64_t)n;
  for (int32_t most = 1; most < 16; ++most) {
    SIZED(jam_crunch_report, r);
    OWNED jam_system *sys = created_in_cell(&c, cell, 4, sites, 2 * n, &diameter, 1);
    DEFAULTS(crunch, o);
    o.max_lps = most;
    const jam_status status = jam_crunch(sys, &o, &r);
    if (r.lp_solves > most) fail_msg("%lld LPs, where %d are allowed", (long long)r.lp_solves, most);
    limits += r.stop_reason == JAM_STOP_LP_LIMIT;
    assert_true((r.stop_reason == JAM_STOP_LP_LIMIT) == (status == JAM_LIMIT));
    if (r.contacts < 0) nothing_of_contacts(&r);
  }
  assert_true(limits > 2);
}
