/* Systems and calls of the fuzz target `calls` and of the soak test. */
#ifndef JAM_FUZZ_CALLS_H
#define JAM_FUZZ_CALLS_H
#include <time.h>
#include "input.h"

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
/* Half of the bytes leave what there is. */
static inline void choose(input *in, int32_t *member, int choices) {
  const int how = byte(in);
  if (how < 128) *member = how % choices;
}
#define CALL_INPUT input
#define NUMBER(usual) other_number(in, usual)
#define COUNT(usual) other_count(in, usual)
#define CHOICE(member, choices) choose(in, &o->member, choices)
#define DAMAGED(options, size) damage(in, options, size)
#define SECONDS 0.02
#define CALL_PROGRESS stop_soon
#include "../calls.h"
#include "../start.h"

/* Any cell or strain, not near the one that the table of calls sets. */
static inline jam_status call_cell(input *in, jam_system *sys) {
  double a[64];
  const int dim = 2 + byte(in) % 7, strain = byte(in) % 2;
  int k;
  for (k = 0; k < 64; ++k) a[k] = byte(in) % 32 == 0 ? number(in) : (byte(in) - 128) / 256.0;
  if (strain) {
    for (k = 0; k < 64; ++k) a[k] *= 0.05;
    return jam_strain(sys, a, (size_t)(dim * dim));
  }
  for (k = 0; k < dim; ++k) a[k * (dim + 1)] = 1.0 + byte(in) / 64.0;
  return jam_set_cell(sys, a, (size_t)(dim * dim), NULL, 0, NULL, 0, NULL);
}

/* Calls in an order that makes sense. The corpus names them by their place: new ones come last. */
typedef jam_status (*fuzz_call)(input *in, jam_system *sys);
static const fuzz_call sequences[][6] = {
    {call_jam_run},
    {call_jam_compress},
    {call_jam_crunch},
    {call_jam_monte_carlo},
    {call_jam_isoconf, call_jam_get_isoconf_report, call_jam_isoconf_series, call_jam_isoconf_kept},
    {call_jam_relax},
    {call_jam_decompress},
    {call_jam_observe, call_jam_run, call_jam_observed_series, call_jam_observed_pairs, call_jam_observed_gaps},
    {call_cell},
    {call_jam_contacts_from_geometry, call_jam_contacts, call_jam_forces, call_jam_stress_states},
    {call_jam_rigidity, call_jam_flex, call_jam_check_packing, call_jam_prove, call_jam_refined_positions},
    {call_jam_modes, call_jam_hessian, call_jam_moduli},
    {call_jam_density_of_states},
    {call_jam_copy, call_jam_compare},
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
  if (byte(in) % 2) {
    const fuzz_call *const call = sequences[(size_t)byte(in) % (sizeof sequences / sizeof *sequences)];
    for (int k = 0; k < 6 && call[k]; ++k) check_status(call[k](in, sys));
  } else {
    check_status(every_call[(size_t)byte(in) % CALLS].call(in, sys));
  }
  remove(call_file());
}
#endif
