/* Results have the same bits on every processor, although the C library chooses other code for log, exp, pow, sin and
 * cos by processor, and whatever kernel and threads OpenBLAS has. This program runs itself again with other variables:
 * GLIBC_TUNABLES hides instructions from the C library. (unit/golden_bits: crunches, and libjam's own vectors.) */
#define _POSIX_C_SOURCE 200809L
#include <inttypes.h>
#include <jam/jam.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "start.h"
#include "test.h"

static uint64_t hash_of(uint64_t hash, const void *data, size_t size) {
  const unsigned char *byte = data;
  while (size--) hash = (hash ^ *byte++) * 1099511628211u;
  return hash;
}

static void say(const char *what, int dim, const jam_system *sys) {
  const double *view;
  size_t len;
  uint64_t hash = 14695981039346656037u;
  if (jam_view(sys, JAM_VIEW_POSITIONS, &view, &len)) exit(1);
  hash = hash_of(hash, view, len * sizeof *view);
  if (jam_view(sys, JAM_VIEW_DIAMETERS, &view, &len)) exit(1);
  printf("d=%d %s %016" PRIx64 "\n", dim, what, hash_of(hash, view, len * sizeof *view));
}
static void need(jam_status status) {
  if (status == JAM_OK || status == JAM_NOT_CONVERGED) return;
  printf("status %d, %s\n", status, jam_last_error());
  exit(1);
}
static jam_system *start(int dim, int model, double fraction, int overlap) {
  jam_create_options o;
  jam_system *sys = NULL;
  double diameter[120];
  for (int k = 0; k < 120; ++k) diameter[k] = k % 2 ? 1.4 : 1.0;
  need(jam_create_options_init(&o, sizeof o));
  o.dim = dim, o.n = 120, o.seed = 5, o.model = model, o.overlap = overlap, o.packing_fraction = fraction;
  need(create_from(&o, NULL, 0, diameter, 120, &sys));
  return sys;
}

static void dynamics(int dim, int model) {
  jam_system *sys = start(dim, model, 0.2 * pow(0.5, dim - 2), JAM_OVERLAP_REFUSE);
  jam_run_options run;
  jam_compress_options grow;
  need(jam_run_options_init(&run, sizeof run));
  need(jam_compress_options_init(&grow, sizeof grow));
  run.collisions_per_particle = 20.0, grow.growth_rate = 0.1, grow.pressure = 50.0;
  say("start", dim, sys);
  need(jam_run(sys, &run, NULL));
  say("run", dim, sys);
  need(jam_compress(sys, &grow, NULL));
  say("compress", dim, sys);
  jam_destroy(sys);
}
static void monte_carlo(int dim, double alpha) {
  const int32_t overlaps = alpha > 0.0 ? JAM_OVERLAP_ALLOW : JAM_OVERLAP_REFUSE;
  jam_system *sys = start(dim, JAM_MODEL_EUCLID, 0.2 * pow(0.5, dim - 2), overlaps);
  jam_monte_carlo_options o;
  need(jam_monte_carlo_options_init(&o, sizeof o));
  o.alpha = alpha, o.sweeps = 20, o.temperature = 0.1;
  need(jam_monte_carlo(sys, &o, NULL));
  say(alpha > 0.0 ? "soft Monte Carlo" : "hard Monte Carlo", dim, sys);
  jam_destroy(sys);
}
static void soft(int dim) {
  jam_system *sys = start(dim, JAM_MODEL_EUCLID, 1.0, JAM_OVERLAP_ALLOW);
  jam_relax_options o;
  need(jam_relax_options_init(&o, sizeof o));
  o.alpha = 2.7;
  need(jam_relax(sys, &o, NULL));
  say("relax", dim, sys);
  jam_destroy(sys);
}
/* Large enough that Clp would factorise dense parts by LAPACK, if libjam did not turn that off. */
static void clp(int dim, int n, double fraction) {
  jam_create_options o;
  jam_crunch_options c;
  jam_system *sys = NULL;
  need(jam_create_options_init(&o, sizeof o));
  need(jam_crunch_options_init(&c, sizeof c));
  o.dim = dim, o.n = n, o.seed = 3, o.packing_fraction = fraction;
  c.lp_solver = JAM_LP_CLP, c.method = JAM_CRUNCH_SEQUENTIAL_LP, c.max_lps = 1;
  need(jam_create(&o, NULL, &sys));
  if (jam_crunch(sys, &c, NULL) < 0) need(JAM_E_SOLVER);
  say("crunch by Clp", dim, sys);
  jam_destroy(sys);
}
static int say_clp(void) {
  clp(5, 80, 0.04);
  clp(4, 120, 0.1);
  return 0;
}

static int say_all(void) {
  uint64_t hash = 0;
  for (int k = 1; k < 20000; ++k) {
    const double values[] = {log(k), cos(k), pow(k, 0.3), exp(1e-3 * k)};
    hash = hash_of(hash, values, sizeof values);
  }
  printf("C library %016" PRIx64 "\n", hash);
  for (int dim = 2; dim <= 8; ++dim) {
    dynamics(dim, JAM_MODEL_EUCLID);
    monte_carlo(dim, 0.0);
    monte_carlo(dim, 2.7);
  }
  dynamics(3, JAM_MODEL_MK);
  soft(2);
  soft(3);
  return 0;
}

static const char *me;

static void run_again(const char *variable, const char *what, char *text, size_t size) {
  char command[4096];
  snprintf(command, sizeof command, "%s '%s' %s", variable, me, what);
  FILE *pipe = popen(command, "r");
  assert_non_null(pipe);
  const size_t got = fread(text, 1, size - 1, pipe);
  text[got] = '\0';
  if (pclose(pipe) != 0) fail_msg("%s", text);
}

CASE(instructions_of_the_c_library_change_no_bit) {
  static char all[16384], fewer[16384];
  run_again("GLIBC_TUNABLES=", "all", all, sizeof all);
  run_again("GLIBC_TUNABLES=glibc.cpu.hwcaps=-AVX2,-FMA,-FMA4,-AVX512F", "all", fewer, sizeof fewer);
  char *behind = strchr(all, '\n'), *behind_fewer = strchr(fewer, '\n');
  assert_true(behind && behind_fewer);
  assert_string_equal(behind, behind_fewer);
  if (strcmp(all, fewer) == 0) {
    print_message("the C library has one version alone on this processor: nothing was compared\n");
    skip();
  }
}

CASE(kernel_and_threads_of_openblas_change_no_bit) {
  static char one[4096], two[4096];
  run_again("OPENBLAS_NUM_THREADS=1 OPENBLAS_CORETYPE=Prescott", "clp", one, sizeof one);
  run_again("OPENBLAS_NUM_THREADS=2 OPENBLAS_CORETYPE=Nehalem", "clp", two, sizeof two);
  assert_string_equal(one, two);
}

static int take(int argc, char **argv) {
  if (argc > 1 && strcmp(argv[1], "all") == 0) return say_all();
  if (argc > 1 && strcmp(argv[1], "clp") == 0) return say_clp();
  me = argv[0];
  return -1;
}

ARGUMENTS(take)
