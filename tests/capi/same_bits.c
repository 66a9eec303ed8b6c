/* LPs by Clp have the same bits whatever kernel and threads OpenBLAS has. This program runs itself again with other
 * variables. (unit/golden_bits: all else, and other processors; lint: no function of the C library that rounds
 * otherwise on another processor.) */
#define _POSIX_C_SOURCE 200809L
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "steps.h"

static uint64_t hash_of(uint64_t hash, const void *data, size_t size) {
  const unsigned char *byte = data;
  while (size--) hash = (hash ^ *byte++) * 1099511628211u;
  return hash;
}

/* Large enough that Clp would factorise dense parts by LAPACK, if libjam did not turn that off. */
static void clp(int dim, int n, double fraction) {
  OWNED jam_system *sys = random_spheres(dim, n, fraction, 3);
  DEFAULTS(crunch, o);
  o.lp_solver = JAM_LP_CLP, o.method = JAM_CRUNCH_SEQUENTIAL_LP, o.max_lps = 1;
  const jam_status status = jam_crunch(sys, &o, NULL);
  if (status < 0) {
    printf("status %d, %s\n", status, jam_last_error());
    exit(1);
  }
  const uint64_t hash = hash_of(14695981039346656037u, view_of(sys, JAM_VIEW_POSITIONS), sizeof(double) * dim * n);
  printf("d=%d %016" PRIx64 "\n", dim, hash_of(hash, view_of(sys, JAM_VIEW_DIAMETERS), sizeof(double) * n));
}

static const char *me;

static void run_again(const char *variables, char *text, size_t size) {
  char command[4096];
  snprintf(command, sizeof command, "%s '%s' clp", variables, me);
  FILE *pipe = popen(command, "r");
  assert_non_null(pipe);
  const size_t got = fread(text, 1, size - 1, pipe);
  text[got] = '\0';
  if (pclose(pipe) != 0) fail_msg("%s", text);
}

CASE(kernel_and_threads_of_openblas_change_no_bit) {
  static char one[4096], two[4096];
  run_again("OPENBLAS_NUM_THREADS=1 OPENBLAS_CORETYPE=Prescott", one, sizeof one);
  run_again("OPENBLAS_NUM_THREADS=2 OPENBLAS_CORETYPE=Nehalem", two, sizeof two);
  assert_string_equal(one, two);
}

static int take(int argc, char **argv) {
  me = argv[0];
  if (argc < 2 || strcmp(argv[1], "clp") != 0) return -1;
  clp(5, 80, 0.04);
  clp(4, 120, 0.1);
  return 0;
}

ARGUMENTS(take)
