/* Fuzz target over jam_read: any bytes give a handle that writes and reads back the same, or an error with a text. */
#define _GNU_SOURCE
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>
#include "jam/jam.h"

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static void demand(int truth, const char *what) {
  if (truth) return;
  fprintf(stderr, "broken: %s\n", what);
  abort();
}

static void check_round_trip(const jam_system *sys, int32_t format) {
  jam_system *back = NULL;
  const double *x, *y;
  size_t x_len, y_len;
  const char *folder = getenv("TMPDIR");
  char path[4096];
  jam_status written;
  snprintf(path, sizeof path, "%s/jam-fuzz-%ld", folder ? folder : "/tmp", (long)getpid());
  written = jam_write(sys, path, format);
  if (format != JAM_FORMAT_XYZ && written == JAM_E_UNSUPPORTED) return; /* a cell, Delta or d that it cannot hold */
  demand(written == JAM_OK, "what was read can be written");
  demand(jam_read(path, NULL, NULL, NULL, &back) == JAM_OK, "what was written can be read");
  jam_view(sys, JAM_VIEW_POSITIONS, &x, &x_len);
  jam_view(back, JAM_VIEW_POSITIONS, &y, &y_len);
  demand(x_len == y_len && !memcmp(x, y, x_len * sizeof *x), "the same positions");
  jam_view(sys, JAM_VIEW_DIAMETERS, &x, &x_len);
  jam_view(back, JAM_VIEW_DIAMETERS, &y, &y_len);
  demand(x_len == y_len && !memcmp(x, y, x_len * sizeof *x), "the same diameters");
  jam_destroy(back);
  unlink(path);
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  static char path[64];
  static int fd = -1; /* one file for all inputs: making one takes as long as reading it */
  jam_system *sys = NULL;
  jam_status status;
  if (fd < 0) {
    fd = memfd_create("input", 0);
    snprintf(path, sizeof path, "/proc/self/fd/%d", fd);
  }
  demand(fd >= 0 && pwrite(fd, data, size, 0) == (ssize_t)size && ftruncate(fd, (off_t)size) == 0, "memfd_create");
  status = jam_read(path, NULL, NULL, NULL, &sys);
  if (status == JAM_OK) {
    check_round_trip(sys, JAM_FORMAT_PLAIN);
    check_round_trip(sys, JAM_FORMAT_XYZ);
    check_round_trip(sys, JAM_FORMAT_LAMMPS);
  } else {
    demand(status < 0 && !sys, "no handle with an error");
    demand(jam_last_error()[0] != '\0', "an error has a text");
  }
  jam_destroy(sys);
  return 0;
}
