/* Hashes of results, one a line: builds for two processors print the same lines when they compute the same bits.
 * First word: what the bits rest on: `md`, arithmetic of libjam's own; `crunch`, the dense products too. */
#include <inttypes.h>
#include <jam/jam.h>
#include <stdio.h>
#include <stdlib.h>

#include "start.h"

static void need(jam_status status) {
  if (status == JAM_OK || status == JAM_NOT_CONVERGED) return;
  fprintf(stderr, "status %d, %s\n", status, jam_last_error());
  exit(1);
}

/* Of the numbers, not of their bytes in memory, whose order is the processor's. FNV-1a. */
static uint64_t hash_of(uint64_t hash, const double *x, size_t count) {
  size_t k;
  int byte;
  for (k = 0; k < count; ++k) {
    union {
      double real;
      uint64_t bits;
    } number;
    number.real = x[k];
    for (byte = 0; byte < 8; ++byte) hash = (hash ^ (number.bits >> (8 * byte) & 0xff)) * UINT64_C(1099511628211);
  }
  return hash;
}
static const uint64_t begin = UINT64_C(14695981039346656037);

static void say(const char *rests_on, int dim, const char *what, const jam_system *sys) {
  const double *view;
  size_t len;
  uint64_t hash;
  need(jam_view_positions(sys, &view, &len));
  hash = hash_of(begin, view, len);
  need(jam_view_diameters(sys, &view, &len));
  printf("%s d=%d %s %016" PRIx64 "\n", rests_on, dim, what, hash_of(hash, view, len));
}

static jam_system *start(int dim, int model, double fraction, int overlap) {
  jam_create_options o;
  jam_system *sys = NULL;
  double diameter[120];
  int k;
  for (k = 0; k < 120; ++k) diameter[k] = k % 2 ? 1.4 : 1.0;
  need(jam_create_options_init(&o, sizeof o));
  o.dim = dim, o.n = 120, o.seed = 5, o.model = model, o.overlap = overlap, o.packing_fraction = fraction;
  need(create_from(&o, NULL, 0, diameter, 120, &sys));
  return sys;
}

static void crunch(jam_system *sys, int dim) {
  jam_crunch_options o;
  double *forces;
  size_t count = 0;
  need(jam_crunch_options_init(&o, sizeof o));
  need(jam_crunch(sys, &o, NULL));
  say("crunch", dim, "jamming point", sys);
  need(jam_forces(sys, NULL, 0, &count));
  forces = malloc(count * sizeof *forces);
  if (!forces) exit(1);
  need(jam_forces(sys, forces, count, NULL));
  printf("crunch d=%d forces %016" PRIx64 "\n", dim, hash_of(begin, forces, count));
  free(forces);
}

static void dynamics(int dim, int model) {
  jam_system *sys = start(dim, model, dim == 2 ? 0.4 : 0.3, JAM_OVERLAP_REFUSE);
  jam_run_options run;
  jam_compress_options grow;
  const char *const name = model == JAM_MODEL_MK ? "Mari-Kurchan" : "";
  char what[64];
  need(jam_run_options_init(&run, sizeof run));
  need(jam_compress_options_init(&grow, sizeof grow));
  run.collisions_per_particle = 50.0, grow.growth_rate = 0.01, grow.pressure = 1e4;
  snprintf(what, sizeof what, "%s start", name), say("md", dim, what, sys);
  need(jam_run(sys, &run, NULL));
  snprintf(what, sizeof what, "%s run", name), say("md", dim, what, sys);
  need(jam_compress(sys, &grow, NULL));
  snprintf(what, sizeof what, "%s compression", name), say("md", dim, what, sys);
  if (model == JAM_MODEL_EUCLID) crunch(sys, dim);
  jam_destroy(sys);
}

static void monte_carlo(int dim, double alpha) {
  jam_system *sys = start(dim, JAM_MODEL_EUCLID, 0.2, alpha > 0.0 ? JAM_OVERLAP_ALLOW : JAM_OVERLAP_REFUSE);
  jam_monte_carlo_options o;
  need(jam_monte_carlo_options_init(&o, sizeof o));
  o.alpha = alpha, o.sweeps = 20, o.temperature = 0.1;
  need(jam_monte_carlo(sys, &o, NULL));
  say("md", dim, alpha > 0.0 ? "soft Monte Carlo" : "hard Monte Carlo", sys);
  jam_destroy(sys);
}

static void soft(int dim) {
  jam_system *sys = start(dim, JAM_MODEL_EUCLID, 1.0, JAM_OVERLAP_ALLOW);
  jam_relax_options o;
  need(jam_relax_options_init(&o, sizeof o));
  o.alpha = 2.7;
  need(jam_relax(sys, &o, NULL));
  say("md", dim, "relaxation", sys);
  jam_destroy(sys);
}

int main(void) {
  int dim;
  for (dim = 2; dim <= 3; ++dim) {
    dynamics(dim, JAM_MODEL_EUCLID);
    monte_carlo(dim, 0.0);
    monte_carlo(dim, 2.7);
    soft(dim);
  }
  dynamics(3, JAM_MODEL_MK);
  return 0;
}
