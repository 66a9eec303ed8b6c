/* What every fuzz target demands of libjam. */
#ifndef JAM_FUZZ_H
#define JAM_FUZZ_H
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "jam/jam.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static inline void demand(int truth, const char *what) {
  if (truth) return;
  fprintf(stderr, "broken: %s (%s)\n", what, jam_last_error());
  abort();
}

/* A known status; an error has a text, and is never a bug that libjam found in itself. */
static inline void check_status(jam_status status) {
  demand(strcmp(jam_status_string(status), "unknown status") != 0, "the status is known");
  demand(status == JAM_OK || jam_last_error()[0] != '\0', "every other status has a text");
  demand(status != JAM_E_INTERNAL, "no internal error");
}

/* Positions in the brick of the cell, diameters positive and finite, velocities finite. */
static inline void check_state(const jam_system *sys) {
  const double *x;
  double cell[JAM_MAX_DIM * JAM_MAX_DIM];
  size_t len, k, d;
  jam_info info;
  memset(&info, 0, sizeof info);
  info.struct_size = sizeof info;
  demand(jam_get_info(sys, &info) == JAM_OK && info.n > 0 && info.box > 0.0 && isfinite(info.box), "info");
  d = (size_t)info.dim;
  demand(jam_get_cell(sys, cell, JAM_MAX_DIM * JAM_MAX_DIM, &len) == JAM_OK && len == d * d, "cell");
  demand(jam_view(sys, JAM_VIEW_POSITIONS, &x, &len) == JAM_OK && len == (size_t)info.n * (size_t)info.dim,
         "positions");
  for (k = 0; k < len; ++k) demand(x[k] >= 0.0 && x[k] < cell[k % d * (d + 1)], "positions in the brick");
  demand(jam_view(sys, JAM_VIEW_DIAMETERS, &x, &len) == JAM_OK && len == (size_t)info.n, "diameters");
  for (k = 0; k < len; ++k) demand(x[k] > 0.0 && isfinite(x[k]), "diameters are positive");
  demand(jam_view(sys, JAM_VIEW_VELOCITIES, &x, &len) == JAM_OK, "velocities");
  for (k = 0; k < len; ++k) demand(isfinite(x[k]), "velocities are finite");
}
#endif
