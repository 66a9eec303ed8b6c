/* Results belong to the packing: copies and checkpoints hold them whole, and whatever moves a sphere clears them whole.
 */
#include <math.h>

#include "io_helpers.h"
#include "steps.h"

static jam_system *start(int32_t dim, int64_t n, double fraction, int32_t overlap) {
  DEFAULTS(create, o);
  o.dim = dim, o.n = n, o.packing_fraction = fraction, o.overlap = overlap, o.seed = 3;
  return created(&o);
}

static jam_status crunch(jam_system *sys, int32_t strain, int64_t max_lps, double gap, int32_t keep) {
  DEFAULTS(crunch, o);
  o.strain = strain, o.keep_steps = keep, o.duality_gap = gap;
  if (max_lps) o.max_lps = (int32_t)max_lps;
  return jam_crunch(sys, &o, NULL);
}

/* The array that a call gives is the same, bit for bit, of both. */
#define DEFINE_SAME(NAME, T)                                                                          \
  static void NAME(jam_status (*get)(const jam_system *, T *, size_t, size_t *), const jam_system *a, \
                   const jam_system *b) {                                                             \
    size_t m = 0, k = 0;                                                                              \
    T *x, *y;                                                                                         \
    assert_int_equal(get(a, NULL, 0, &m), JAM_OK);                                                    \
    assert_int_equal(get(b, NULL, 0, &k), JAM_OK);                                                    \
    assert_int_equal(m, k);                                                                           \
    x = malloc((m + 1) * sizeof *x), y = malloc((m + 1) * sizeof *y);                                 \
    assert_int_equal(get(a, x, m, &m), JAM_OK);                                                       \
    assert_int_equal(get(b, y, m, &m), JAM_OK);                                                       \
    assert_memory_equal(x, y, m * sizeof *x);                                                         \
    free(x), free(y);                                                                                 \
  }
DEFINE_SAME(same_array, double)
DEFINE_SAME(same_array32, int32_t)

static jam_status history(const jam_system *s, double *out, size_t len, size_t *needed) {
  return jam_crunch_history(s, JAM_HISTORY_COLUMNS, out, len, needed);
}
static jam_status minima(const jam_system *s, double *out, size_t len, size_t *needed) {
  return jam_decompress_history(s, JAM_SOFT_COLUMNS, out, len, needed);
}

static void same_results(const jam_system *a, const jam_system *b, int crunched) {
  size_t size[2];
  SIZED(jam_crunch_report, r);
  SIZED(jam_crunch_report, s);
  SIZED(jam_comparison_report, c);
  assert_int_equal(jam_get_crunch_report(a, &r), JAM_OK);
  assert_int_equal(jam_get_crunch_report(b, &s), JAM_OK);
  assert_memory_equal(&r, &s, sizeof r);
  same_array32(jam_contacts, a, b), same_array32(jam_coordination, a, b);
  same_array(jam_contact_vectors, a, b), same_array(jam_contact_gaps, a, b), same_array(jam_forces, a, b);
  if (crunched) same_array(history, a, b);
  assert_int_equal(jam_compare(a, b, &c, NULL, 0, NULL), JAM_OK);
  assert_int_equal(c.common_contacts, c.contacts_a);
  assert_int_equal(c.common_contacts, c.contacts_b);
  for (int k = 0; k < 2; ++k) { /* a page, where the network and the steps of the crunch show too */
    assert_int_equal(jam_write_page(k ? b : a, in_scratch("page"), "", 0, "", NULL, 0), JAM_OK);
    free(get_bytes(in_scratch("page"), &size[k]));
  }
  assert_int_equal(size[0], size[1]);
}

/* A copy and a checkpoint of sys have its results. */
static void kept(jam_system *sys, int crunched) {
  OWNED jam_system *copy = copy_of(sys), *again = from_checkpoint(sys);
  same_results(sys, copy, crunched);
  same_results(sys, again, crunched);
}

CASE(a_crunch_is_kept) {
  for (int32_t dim = 2; dim <= 4; ++dim)
    for (int32_t strain = JAM_STRAIN_NONE; strain <= JAM_STRAIN_FREE; strain += JAM_STRAIN_FREE) {
      OWNED jam_system *sys = start(dim, 40, dim == 4 ? 0.1 : 0.3, JAM_OVERLAP_REFUSE), *other = NULL;
      crunch(sys, strain, 0, 0.0, 8);
      kept(sys, 1);
      for (int64_t lps = 1; lps < 6; ++lps) { /* one that was stopped */
        other = start(dim, 40, dim == 4 ? 0.1 : 0.3, JAM_OVERLAP_REFUSE);
        crunch(other, strain, lps, 0.0, 3);
        kept(other, 1);
        jam_destroy(other);
      }
      other = start(dim, 60, dim == 4 ? 0.1 : 0.3, JAM_OVERLAP_REFUSE);
      crunch(other, JAM_STRAIN_NONE, 0, 1e-3, 0);
      kept(other, 1);
    }
}

CASE(networks_of_other_calls_are_kept) {
  OWNED jam_system *sys = start(2, 50, 0.9, JAM_OVERLAP_ALLOW), *again = NULL;
  assert_true(jam_relax(sys, NULL, NULL) >= 0);
  kept(sys, 0); /* with stiffnesses */
  DEFAULTS(decompress, o);
  o.crunch = 0;
  assert_true(jam_decompress(sys, &o, NULL) >= 0);
  kept(sys, 0);
  again = from_checkpoint(sys);
  same_array(minima, sys, again);
  jam_destroy(sys);
  sys = start(3, 50, 0.3, JAM_OVERLAP_REFUSE); /* a fluid: contacts of a wide tolerance carry no force */
  DEFAULTS(geometry, g);
  g.tolerance = 0.2;
  assert_int_equal(jam_contacts_from_geometry(sys, &g, NULL), JAM_NOT_JAMMED);
  kept(sys, 0);
  crunch(sys, JAM_STRAIN_NONE, 0, 0.0, 0);
  assert_true(jam_contacts_from_geometry(sys, NULL, NULL) >= 0);
  kept(sys, 1); /* the history is that of the crunch still */
}

static int32_t stop(const jam_progress *p, void *user) { return p->steps > 2 || p->collisions > 10 || user; }

static int knows(const jam_system *sys) {
  size_t m;
  SIZED(jam_crunch_report, r);
  return (jam_contacts(sys, NULL, 0, &m) == JAM_OK) + (jam_get_crunch_report(sys, &r) == JAM_OK) +
         (jam_crunch_history(sys, JAM_HISTORY_COLUMNS, NULL, 0, &m) == JAM_OK) +
         (jam_decompress_history(sys, JAM_SOFT_COLUMNS, NULL, 0, &m) == JAM_OK);
}

static const double shear[4] = {0.0, 1e-3, 0.0, 0.0};

static void each_move(int move, jam_system *sys) {
  const double *const x = view_of(sys, JAM_VIEW_POSITIONS);
  DEFAULTS(run, run);
  run.collisions_per_particle = 1e6;
  DEFAULTS(monte_carlo, mc);
  mc.sweeps = 1000000, mc.step = 1e-3;
  assert_int_equal(jam_set_progress(sys, stop, NULL), JAM_OK);
  switch (move) {
    case 0:
      assert_int_equal(jam_scale_diameters(sys, 0.9), JAM_OK);
      break;
    case 1:
      assert_int_equal(jam_set_positions(sys, x, 100), JAM_OK);
      break;
    case 2:
      assert_true(jam_strain(sys, shear, 4) == JAM_E_OVERLAP); /* refused: nothing moved */
      assert_int_equal(knows(sys), 3);
      assert_int_equal(jam_scale_diameters(sys, 0.9), JAM_OK);
      assert_int_equal(jam_strain(sys, shear, 4), JAM_OK);
      break;
    case 3:
      assert_true(jam_run(sys, &run, NULL) > 0); /* cancelled, or stalled first: gaps are below what doubles resolve */
      break;
    case 4:
      assert_true(jam_compress(sys, NULL, NULL) > 0);
      break;
    default:
      assert_int_equal(jam_monte_carlo(sys, &mc, NULL), JAM_CANCELLED);
  }
}

CASE(every_move_clears_all) {
  OWNED jam_system *jammed = start(2, 50, 0.4, JAM_OVERLAP_REFUSE);
  crunch(jammed, JAM_STRAIN_NONE, 0, 0.0, 0);
  assert_int_equal(jam_set_velocities(jammed, view_of(jammed, JAM_VIEW_POSITIONS), 100), JAM_OK); /* any will do */
  assert_int_equal(knows(jammed), 3); /* velocities move nothing */
  for (int move = 0; move < 6; ++move) {
    OWNED jam_system *sys = copy_of(jammed);
    each_move(move, sys);
    assert_int_equal(knows(sys), 0);
  }
}

/* A pressure that dynamics has measured is one of its own packing. */
CASE(pressures_are_of_this_packing) {
  OWNED jam_system *grown = start(2, 50, 0.4, JAM_OVERLAP_REFUSE), *again = NULL;
  assert_true(isnan(info_of(grown).pressure));
  run(grown, 20);
  assert_true(info_of(grown).pressure > 1.0);
  again = from_checkpoint(grown);
  assert_true(info_of(again).pressure == info_of(grown).pressure);
  DEFAULTS(monte_carlo, mc);
  mc.sweeps = 2;
  for (int move = 0; move < 4; ++move) {
    OWNED jam_system *sys = copy_of(grown);
    assert_true(info_of(sys).pressure == info_of(grown).pressure);
    if (move == 0) assert_true(crunch(sys, JAM_STRAIN_NONE, 0, 0.0, 0) >= 0);
    if (move == 1) assert_int_equal(jam_monte_carlo(sys, &mc, NULL), JAM_OK);
    if (move == 2) assert_int_equal(jam_scale_diameters(sys, 0.9), JAM_OK);
    if (move == 3) assert_int_equal(jam_set_positions(sys, view_of(sys, JAM_VIEW_POSITIONS), 100), JAM_OK);
    assert_true(isnan(info_of(sys).pressure));
  }
}

/* The history of a decompression goes with the packing that it led to. */
CASE(soft_history_is_cleared) {
  OWNED jam_system *sys = start(2, 50, 0.9, JAM_OVERLAP_ALLOW);
  assert_true(jam_decompress(sys, NULL, NULL) >= 0);
  assert_true(knows(sys) >= 3);
  assert_int_equal(jam_scale_diameters(sys, 0.9), JAM_OK);
  assert_int_equal(knows(sys), 0);
}

static int32_t look(const jam_progress *p, void *user) {
  jam_system *sys = *(jam_system **)user;
  if (p->snapshot > 0) assert_int_equal(knows(sys), 0); /* the view shows spheres that have moved */
  return 0;
}

CASE(snapshots_have_no_old_results) {
  OWNED jam_system *sys = start(2, 50, 0.4, JAM_OVERLAP_REFUSE);
  crunch(sys, JAM_STRAIN_NONE, 0, 0.0, 0);
  DEFAULTS(observe, o);
  o.snapshot_every = 1.0;
  assert_int_equal(jam_observe(sys, &o), JAM_OK);
  assert_int_equal(jam_set_progress(sys, look, &sys), JAM_OK);
  DEFAULTS(run, run);
  run.collisions_per_particle = 10.0;
  assert_int_equal(jam_run(sys, &run, NULL), JAM_NOT_CONVERGED); /* stalled: no time passes at contact */
}

static jam_status series(const jam_system *s, double *out, size_t len, size_t *needed) {
  return jam_observed_series(s, JAM_SERIES_COLUMNS, out, len, needed);
}

/* A copy has what was observed, and observes on. */
CASE(observed_data_are_copied) {
  OWNED jam_system *sys = start(3, 60, 0.3, JAM_OVERLAP_REFUSE), *copy = NULL;
  DEFAULTS(observe, o);
  o.collisions = 1, o.gap_bins = 10, o.r_bins = 10;
  assert_int_equal(jam_observe(sys, &o), JAM_OK);
  assert_int_equal(jam_run(sys, NULL, NULL), JAM_OK);
  assert_int_equal(jam_copy(sys, &copy), JAM_OK);
  same_array(series, sys, copy);
  assert_int_equal(jam_run(sys, NULL, NULL), JAM_OK);
  assert_int_equal(jam_run(copy, NULL, NULL), JAM_OK);
  same_array(series, sys, copy);
}

/* What reading assumed is known of a copy and of a checkpoint, too. */
CASE(notes_are_kept) {
  const double x[4] = {0.5, 0.5, 0.5000001, 0.5}, sigma = 2e-7;
  OWNED jam_system *sys = NULL, *copy = NULL, *again = NULL;
  DEFAULTS(create, o);
  o.dim = 2, o.n = 2, o.overlap = JAM_OVERLAP_SHRINK;
  assert_int_equal(create_from(&o, x, 4, &sigma, 1, &sys), JAM_OK);
  assert_true(strlen(jam_notes(sys)) > 0);
  assert_int_equal(jam_add_note(sys, "the velocities of the file were not read"), JAM_OK);
  assert_non_null(strstr(jam_notes(sys), "overlapped by"));
  assert_non_null(strstr(jam_notes(sys), "\nthe velocities of the file were not read"));
  assert_int_equal(jam_add_note(sys, ""), JAM_E_ARGUMENT);
  assert_int_equal(jam_add_note(sys, "two\nlines"), JAM_E_ARGUMENT);
  assert_int_equal(jam_add_note(sys, NULL), JAM_E_NULL);
  copy = copy_of(sys), again = from_checkpoint(sys);
  assert_string_equal(jam_notes(copy), jam_notes(sys));
  assert_string_equal(jam_notes(again), jam_notes(sys));
}

FIXTURE(make_scratch, remove_scratch)

/* A crunch that is refused, or has too little memory to begin, leaves network, report, history and a pause. */
CASE(a_refused_crunch_changes_nothing) {
  for (int paused = 0; paused < 2; ++paused) {
    OWNED jam_system *sys = start(3, 60, 0.3, JAM_OVERLAP_REFUSE), *before = NULL;
    SIZED(jam_estimate_report, e);
    assert_int_equal(crunch(sys, JAM_STRAIN_NONE, 0, paused ? 1e-4 : 0.0, 0), JAM_OK);
    before = copy_of(sys);
    const int32_t phase = info_of(sys).paused;
    assert_int_equal(phase, paused ? JAM_PHASE_CRUNCH : 0);
    DEFAULTS(crunch, o);
    o.neighbour_radius = 0.5;
    SAYS(jam_crunch(sys, &o, NULL), JAM_E_ARGUMENT, "neighbour radius");
    SAYS(jam_estimate_crunch(sys, &o, &e), JAM_E_ARGUMENT, "neighbour radius");
    o.neighbour_radius = 0.0, o.step_bound = 1000.0, o.method = JAM_CRUNCH_SEQUENTIAL_LP;
    assert_int_equal(jam_crunch(sys, &o, NULL), JAM_E_MEMORY);
    same_results(before, sys, 1);
    assert_int_equal(info_of(sys).paused, phase);
    assert_string_equal(jam_notes(sys), jam_notes(before));
  }
}
