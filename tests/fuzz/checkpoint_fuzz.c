/* Fuzz target over jam_read_checkpoint: the input changes a good checkpoint, and the checksum is put right, so that
 * every field is reached. The answer is an error with a text, or a valid system that runs on.
 *
 * Input: a byte that chooses the checkpoint, then changes: two bytes of place, one of kind, and what it needs. The good
 * checkpoints are written by the library under test, so they have its format. */
#define _GNU_SOURCE
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>
#include "fuzz.h"

#define BASES 8
#define LARGEST (1 << 16)
static uint8_t base[BASES][LARGEST];
static size_t base_size[BASES];

static uint64_t mix64(uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

static uint64_t checksum(const uint8_t *data, size_t size) {
  uint64_t sum = 0x6a616d;
  size_t k;
  for (k = 0; k < size; k += 8) {
    uint64_t word = 0;
    memcpy(&word, data + k, size - k < 8 ? size - k : 8);
    sum = mix64(sum ^ word);
  }
  return sum;
}

static int32_t stop_at_once(const jam_progress *progress, void *user) {
  (void)progress, (void)user;
  return 1;
}

/* A few factorisations after the first LP, where a crunch follows the barrier path. */
static int32_t stop_on_path(const jam_progress *progress, void *user) {
  int64_t *first = user;
  if (progress->steps == 1 && *first == 0) *first = progress->factorisations;
  return *first > 0 && progress->factorisations > *first + 3;
}

/* 0: created. 1: Mari-Kurchan. 2: a run, 3: a compression, 4: Monte Carlo, 5: runs from one configuration, 6: a crunch;
 * these five were stopped and go on. 7: a crunched packing with its results and steps. */
static jam_system *make(int kind) {
  jam_create_options o;
  jam_system *sys = NULL;
  jam_create_options_init(&o, sizeof o);
  o.dim = kind == 3 || kind == 6 ? 3 : 2;
  o.n = kind >= 6 ? 16 : 8;
  if (kind == 1) o.model = JAM_MODEL_MK, o.packing_fraction = 1.0;
  demand(jam_create(&o, NULL, &sys) == JAM_OK, "create");
  jam_set_progress(sys, stop_at_once, NULL);
  if (kind == 2) demand(jam_run(sys, NULL, NULL) == JAM_CANCELLED, "run");
  if (kind == 3) demand(jam_compress(sys, NULL, NULL) == JAM_CANCELLED, "compress");
  if (kind == 4) demand(jam_monte_carlo(sys, NULL, NULL) == JAM_CANCELLED, "monte_carlo");
  if (kind == 5) {
    const double instant[2] = {1.0, 2.0};
    jam_isoconf_options runs;
    jam_isoconf_options_init(&runs, sizeof runs);
    demand(jam_isoconf(sys, &runs, NULL, instant, 2, NULL, 0, NULL) == JAM_CANCELLED, "runs");
  }
  if (kind == 6) {
    int64_t first = 0;
    jam_crunch_options crunch;
    jam_crunch_options_init(&crunch, sizeof crunch);
    crunch.steps = 1; /* the callback hears of each */
    jam_set_progress(sys, stop_on_path, &first);
    demand(jam_crunch(sys, &crunch, NULL) == JAM_CANCELLED, "crunch");
  }
  jam_set_progress(sys, NULL, NULL);
  if (kind == 7) {
    jam_crunch_options crunch;
    jam_crunch_options_init(&crunch, sizeof crunch);
    crunch.keep_steps = 3;
    demand(jam_crunch(sys, &crunch, NULL) >= 0, "crunch");
  }
  return sys;
}

/* Calls that rely on the results of a checkpoint. */
static void use_results(jam_system *sys) {
  static double out[LARGEST];
  static int32_t flags[LARGEST];
  jam_crunch_report r;
  size_t m = 0;
  r.struct_size = sizeof r;
  check_status(jam_get_crunch_report(sys, &r));
  check_status(jam_contact_classes(sys, flags, LARGEST, &m));
  check_status(jam_local_values(sys, JAM_LOCAL_FORCE_PAIRS, JAM_POPULATION_ALL, out, LARGEST, &m));
  check_status(jam_hessian_map(sys, flags, LARGEST, &m));
  check_status(jam_modes(sys, NULL, NULL, JAM_MODE_COLUMNS, out, LARGEST, NULL, 0, &m));
  check_status(jam_stress_states(sys, out, LARGEST, NULL, 0, NULL, &m));
  check_status(jam_rigidity(sys, JAM_RIGIDITY_STRICT, NULL));
  check_status(jam_compare(sys, sys, NULL, out, LARGEST, &m));
  check_status(jam_write_page(sys, "/dev/null", "", 0, "", NULL, 0));
  check_status(jam_write_contacts(sys, "/dev/null", JAM_CONTACTS_CSV));
}

/* Spheres in a cube without walls overlap by no more than rounding; other scenes are not tested. */
static void demand_apart(const jam_system *sys) {
  const double *x, *sigma;
  double cell[JAM_MAX_DIM * JAM_MAX_DIM], most = 1.0;
  size_t len, d, i, j, c;
  jam_info info;
  info.struct_size = sizeof info;
  if (jam_get_info(sys, &info) != JAM_OK || info.model != JAM_MODEL_EUCLID || info.container || info.walls) return;
  d = (size_t)info.dim;
  demand(jam_get_cell(sys, cell, JAM_MAX_DIM * JAM_MAX_DIM, &len) == JAM_OK, "cell");
  for (c = 0; c < len; ++c)
    if (cell[c] != (c % (d + 1) ? 0.0 : cell[0])) return;
  jam_view(sys, JAM_VIEW_POSITIONS, &x, &len);
  jam_view(sys, JAM_VIEW_DIAMETERS, &sigma, &len);
  for (i = 0; i < len; ++i)
    for (j = 0; j < i; ++j) {
      const double mean = 0.5 * (sigma[i] + sigma[j]), factor = sigma[i] == sigma[j] ? 1.0 : 1.0 + info.non_additivity;
      double r2 = 0.0;
      for (c = 0; c < d; ++c) {
        const double r = fabs(x[i * d + c] - x[j * d + c]), near = r < cell[0] - r ? r : cell[0] - r;
        r2 += near * near;
      }
      most = fmin(most, sqrt(r2) / (mean * factor));
    }
  demand(most > 1.0 - 2e-6, "no spheres overlap"); /* 1e-6 is what a very dilute gas may leave */
}

static jam_status read_back(const uint8_t *data, size_t size, jam_system **sys) {
  char path[64];
  jam_status status;
  const int fd = memfd_create("input", 0);
  demand(fd >= 0 && write(fd, data, size) == (ssize_t)size, "memfd_create");
  snprintf(path, sizeof path, "/proc/self/fd/%d", fd);
  status = jam_read_checkpoint(path, NULL, NULL, sys);
  close(fd);
  return status;
}

static void prepare(void) {
  int k;
  if (base_size[0]) return;
  for (k = 0; k < BASES; ++k) {
    jam_system *sys = make(k), *again = NULL;
    const char *folder = getenv("TMPDIR");
    char path[4096];
    uint64_t sum;
    FILE *f;
    snprintf(path, sizeof path, "%s/jam-fuzz-%ld.jam", folder ? folder : "/tmp", (long)getpid());
    demand(jam_write_checkpoint(sys, path) == JAM_OK, "write_checkpoint");
    jam_destroy(sys);
    f = fopen(path, "rb");
    demand(f != NULL, "open");
    base_size[k] = fread(base[k], 1, LARGEST, f);
    fclose(f);
    unlink(path);
    demand(base_size[k] > 16 && base_size[k] < LARGEST, "size");
    memcpy(&sum, base[k] + base_size[k] - 8, 8);
    demand(sum == checksum(base[k], base_size[k] - 8), "the checksum is the one that the target puts right");
    demand(read_back(base[k], base_size[k], &again) == JAM_OK, "a good checkpoint is read");
    jam_destroy(again);
  }
}

/* The changed checkpoint; returns its size. Kinds: a byte, 4 bytes, 8 bytes of the input, one of the special doubles,
 * one bit, a shorter file. */
static size_t change(uint8_t *data, size_t size, const uint8_t *in, size_t left) {
  static const double special[] = {0.0, -1.0, NAN, INFINITY, 1e300, -1e300, 1e-300, 5e-324};
  size -= 8;
  while (left >= 4) {
    const size_t at = (in[0] | (size_t)in[1] << 8) % size;
    const int kind = in[2] % 6;
    const size_t given = kind == 1 ? 4 : kind == 2 ? 8 : 1;
    const size_t length = kind == 3 ? 8 : given;
    const uint8_t *what = in + 3;
    if (left < 3 + given) break;
    if (kind == 5) {
      if (at > 8) size = at;
    } else if (at + length <= size) {
      if (kind == 3)
        memcpy(data + at, &special[*what % 8], 8);
      else if (kind == 4)
        data[at] ^= (uint8_t)(1u << *what % 8);
      else
        memcpy(data + at, what, given);
    }
    in += 3 + given, left -= 3 + given;
  }
  {
    const uint64_t sum = checksum(data, size);
    memcpy(data + size, &sum, 8);
  }
  return size + 8;
}

int LLVMFuzzerTestOneInput(const uint8_t *input, size_t size) {
  static uint8_t data[LARGEST];
  jam_system *sys = NULL;
  jam_status status;
  jam_run_options run;
  jam_compress_options compress;
  jam_monte_carlo_options sweeps;
  int kind;
  prepare();
  if (!size) return 0;
  kind = input[0] % BASES;
  memcpy(data, base[kind], base_size[kind]);
  status = read_back(data, change(data, base_size[kind], input + 1, size - 1), &sys);
  check_status(status);
  if (status != JAM_OK) {
    demand(!sys, "no handle with an error");
    return 0;
  }
  check_state(sys);
  jam_run_options_init(&run, sizeof run);
  jam_compress_options_init(&compress, sizeof compress);
  jam_monte_carlo_options_init(&sweeps, sizeof sweeps);
  if (kind >= 6) use_results(sys);
  run.resume = compress.resume = sweeps.resume = kind >= 2 && kind < 7;
  run.collisions_per_particle = compress.collisions_per_particle = 5.0;
  sweeps.sweeps = 5;
  run.wall_time = compress.wall_time = sweeps.wall_time = 0.05;
  if (kind == 6) {
    jam_crunch_options crunch;
    jam_crunch_options_init(&crunch, sizeof crunch);
    crunch.wall_time = 0.05;
    check_status(jam_crunch(sys, &crunch, NULL));
    check_state(sys);
  }
  check_status(status = jam_run(sys, &run, NULL));
  check_state(sys);
  if (kind == 2 && status >= 0) demand_apart(sys);
  check_status(status = jam_compress(sys, &compress, NULL));
  check_state(sys);
  if (kind == 3 && status >= 0) demand_apart(sys);
  check_status(jam_monte_carlo(sys, &sweeps, NULL));
  check_state(sys);
  jam_destroy(sys);
  return 0;
}
