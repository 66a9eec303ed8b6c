/* Every kind of call runs on a thread with the stack that the header promises to suffice. */
#include <pthread.h>

#include "steps.h"

#define STACK (256 * 1024) /* as the header promises */

static void check(jam_status status, const char *call, int dim) {
  if (status < 0) fail_msg("d = %d: %s: %d %s", dim, call, status, jam_last_error());
}

static void write_and_read(jam_system *sys, int dim) {
  char name[64];
  jam_system *other = NULL;
  snprintf(name, sizeof name, "small_stack_%d.xyz.gz", (int)getpid());
  check(jam_write(sys, name, JAM_FORMAT_XYZ), "jam_write", dim);
  check(jam_read(name, NULL, NULL, NULL, &other), "jam_read", dim);
  jam_destroy(other);
  remove(name);
  jam_destroy(from_checkpoint(sys));
  check(jam_write_page(sys, name, "t", 0, "", NULL, 0), "jam_write_page", dim);
  remove(name);
}
static void analyse(jam_system *sys, int dim) {
  static double out[100000];
  static int32_t whole[100000];
  size_t needed;
  SIZED(jam_moduli_report, moduli);
  check(jam_rigidity(sys, JAM_RIGIDITY_STRICT, NULL), "jam_rigidity", dim);
  check(jam_modes(sys, NULL, NULL, JAM_MODE_COLUMNS, out, 100000, NULL, 0, &needed), "jam_modes", dim);
  check(jam_moduli(sys, NULL, &moduli), "jam_moduli", dim);
  check(jam_gaps(sys, 0.1, 0, out, 100000, NULL, 0, &needed), "jam_gaps", dim);
  check(jam_floppy_modes(sys, NULL, 0, JAM_FLOPPY_COLUMNS, NULL, 0, NULL, 0, &needed), "jam_floppy_modes", dim);
  check(jam_stress_states(sys, out, 100000, NULL, 0, NULL, &needed), "jam_stress_states", dim);
  check(jam_contacts(sys, whole, 100000, &needed), "jam_contacts", dim);
  if (dim == 3) check(jam_local_fraction(sys, out, 100000, &needed), "jam_local_fraction", dim);
  if (dim <= 3) {
    check(jam_bond_order(sys, 6, 1.5, out, 100000, &needed), "jam_bond_order", dim);
    check(jam_structure_factor(sys, 10.0, JAM_STRUCTURE_COLUMNS, out, 100000, &needed), "jam_structure_factor", dim);
  }
}
static void solve_by_clp(jam_system *sys, int dim) {
  DEFAULTS(crunch, o);
  o.lp_solver = JAM_LP_CLP, o.method = JAM_CRUNCH_SEQUENTIAL_LP, o.max_lps = 3;
  check(jam_scale_diameters(sys, 0.9), "jam_scale_diameters", dim);
  check(jam_crunch(sys, &o, NULL), "jam_crunch by Clp", dim);
}
static void relax(int dim) {
  static const double fraction[] = {0, 0, 1.0, 0.8, 0.5, 0.3, 0.2, 0.1, 0.05};
  jam_system *sys = NULL;
  DEFAULTS(create, o);
  o.dim = dim, o.n = 40, o.packing_fraction = fraction[dim], o.overlap = JAM_OVERLAP_ALLOW;
  check(jam_create(&o, NULL, &sys), "jam_create", dim);
  check(jam_decompress(sys, NULL, NULL), "jam_decompress", dim);
  jam_destroy(sys);
}
static void live(int dim) {
  /* in d = 8 a box of more than two diameters: Monte Carlo looks at 6561 images of each pair in a narrower one */
  static const double fraction[] = {0, 0, 0.3, 0.2, 0.1, 0.04, 0.02, 0.01, 0.002};
  const double instant = 1.0;
  jam_system *sys = NULL;
  DEFAULTS(create, o);
  o.dim = dim, o.n = dim <= 3 ? 100 : 50, o.seed = 3, o.packing_fraction = fraction[dim];
  check(jam_create(&o, NULL, &sys), "jam_create", dim);
  DEFAULTS(monte_carlo, mc);
  mc.sweeps = 5;
  check(jam_monte_carlo(sys, &mc, NULL), "jam_monte_carlo", dim);
  DEFAULTS(isoconf, runs);
  runs.runs = 2;
  check(jam_isoconf(sys, &runs, NULL, &instant, 1, NULL, 0, NULL), "jam_isoconf", dim);
  DEFAULTS(compress, grow);
  grow.growth_rate = 0.3, grow.pressure = 1e3;
  check(jam_compress(sys, &grow, NULL), "jam_compress", dim);
  DEFAULTS(crunch, crunch);
  crunch.threads = 2, crunch.keep_steps = 10;
  check(jam_crunch(sys, &crunch, NULL), "jam_crunch", dim);
  write_and_read(sys, dim);
  analyse(sys, dim);
  solve_by_clp(sys, dim);
  crunch.strain = JAM_STRAIN_FREE;
  check(jam_crunch(sys, &crunch, NULL), "jam_crunch in a free cell", dim);
  jam_destroy(sys);
  relax(dim);
}
static void *on_small_stack(void *data) {
  (void)data;
  for (int dim = 2; dim <= 8; ++dim) live(dim);
  return NULL;
}

CASE(a_small_stack_is_enough) {
  pthread_attr_t attributes;
  pthread_t thread;
#ifdef JAM_SANITIZED
  skip(); /* their frames are larger */
#endif
  assert_int_equal(pthread_attr_init(&attributes), 0);
  assert_int_equal(pthread_attr_setstacksize(&attributes, STACK), 0);
  assert_int_equal(pthread_create(&thread, &attributes, on_small_stack, NULL), 0);
  assert_int_equal(pthread_join(thread, NULL), 0);
}
