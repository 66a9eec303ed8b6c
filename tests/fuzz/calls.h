/* Systems and calls of the fuzz target `calls` and of the soak test. */
#ifndef JAM_FUZZ_CALLS_H
#define JAM_FUZZ_CALLS_H
#include <time.h>
#include "calls_bundles.h"

static inline double now(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* The callback asks every call to stop after a tenth of a second. */
static __thread double begun;
static inline int32_t stop_soon(const jam_progress *p, void *user) {
  (void)p, (void)user;
  return now() - begun > 0.1;
}

/* A number of the table of calls, or another one. */
static inline double other_number(input *in, double usual) { return byte(in) % 2 ? usual : number(in); }
static inline int32_t other_count(input *in, int32_t usual) {
  const int how = byte(in);
  if (how < 64) return usual;
  return how < 224 ? how % 32 - 1 : (int32_t)1 << how % 31;
}
#define CALL_INPUT input
#define NUMBER(usual) other_number(in, usual)
#define COUNT(usual) other_count(in, usual)
#define DAMAGED(options, size) damage(in, options, size)
#define SECONDS 0.02
#define CALL_PROGRESS stop_soon
#include "../calls.h"
#include "../start.h"

/* Several calls in an order that makes sense. */
typedef void (*fuzz_call)(input *in, jam_system *sys);
static const fuzz_call bundles[] = {
    call_run,      call_compress,   call_crunch,   call_monte_carlo, call_isoconfigurational,
    call_relax,    call_decompress, call_observe,  call_cell,        call_network,
    call_rigidity, call_modes,      call_spectrum, call_compared,
};

static inline jam_system *create(input *in) {
  jam_create_options o;
  jam_system *sys = NULL;
  double x[6 * 8], diameter[6];
  int k, given, n, coordinates;
  jam_status status;
  jam_create_options_init(&o, sizeof o);
  o.dim = 2 + byte(in) % 7;
  n = 1 + byte(in) % 6;
  o.n = n;
  o.seed = byte(in);
  o.model = byte(in) % 4 == 0;
  o.packing_fraction = 0.001 * (1 + byte(in) % 100);
  o.wall_time = 0.2, o.memory_limit = 1e8;
  given = byte(in);
  o.overlap = given % 16 >= 12 ? JAM_OVERLAP_ALLOW : JAM_OVERLAP_SHRINK;
  if (given % 8 == 0) o.box = number(in);
  if (given % 16 == 1) o.mk_zeta = number(in);
  if (given % 16 == 5) o.non_additivity = number(in);
  damage(in, &o, sizeof o);
  o.wall_time = at_most(o.wall_time, 0.2);
  if (!(o.memory_limit < 1e8) || o.memory_limit == 0.0) o.memory_limit = 1e8;
  for (k = 0; k < n; ++k) diameter[k] = given % 4 == 2 ? number(in) : given % 4 == 3 ? 0.1 + 0.002 * byte(in) : 0.1;
  coordinates = o.dim >= 2 && o.dim <= 8 ? n * o.dim : 0;
  for (k = 0; k < coordinates; ++k) x[k] = given % 32 == 3 ? number(in) : byte(in) / 256.0;
  if (coordinates == 0 || o.n != n || given % 3 == 0) {
    if (o.n > 50) o.n = 50;
    status = jam_create(&o, NULL, &sys);
  } else {
    status = create_from(&o, x, (size_t)coordinates, diameter, (size_t)n, &sys);
  }
  check_status(status);
  demand((status == JAM_OK) == (sys != NULL), "a handle exactly with success");
  return sys;
}

static inline void limit(jam_system *sys) {
  jam_set_memory_limit(sys, 1e8); /* and with it the time of searches for pairs */
  jam_set_progress(sys, stop_soon, NULL);
}

static inline void any_call(input *in, jam_system *sys) {
  begun = now();
  if (byte(in) % 2)
    bundles[(size_t)byte(in) % (sizeof bundles / sizeof *bundles)](in, sys);
  else
    check_status(every_call[(size_t)byte(in) % CALLS].call(in, sys));
  remove(call_file());
}
#endif
