/* What tests/calls.def uses. A fuzz target defines before it includes this: CALL_INPUT, the type of `in`; NUMBER,
 * COUNT, DAMAGED(options, size) and CHOICE(member, how many there are), which take from `in`; SECONDS, a limit of time;
 * CALL_PROGRESS. */
#ifndef JAM_TESTS_CALLS_H
#define JAM_TESTS_CALLS_H

#include <jam/jam.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#ifndef CALL_INPUT
#define CALL_INPUT void
#define NUMBER(usual) (usual)
#define COUNT(usual) (usual)
#define DAMAGED(options, size) ((void)in, (void)(options))
#define CHOICE(member, choices) (void)0
#define SECONDS INFINITY
#define CALL_PROGRESS NULL
#endif

enum { CALL_ROOM = 4096 };
static __thread double real[4][CALL_ROOM];
static __thread int32_t whole[2][CALL_ROOM];
static __thread int64_t large[CALL_ROOM];
static __thread size_t needed;
static __thread const double *view;
static __thread jam_system *other;
static const double instants[] = {1.0, 3.0}, rising[] = {20.0, 50.0, 120.0};
static const int64_t first_contact[] = {0};
static const int32_t first_instant[] = {0};
static const jam_progress_fn call_progress = CALL_PROGRESS;
#define REALS(k) real[k], (size_t)CALL_ROOM
#define WHOLES(k) whole[k], (size_t)CALL_ROOM
#define LARGE large, (size_t)CALL_ROOM
#define WHOLE_ZERO first_instant
#define LARGE_ZERO first_contact

/* A report to be filled: only its struct_size is set. */
static inline void *call_report(uint32_t size) {
  static __thread double report[64];
  memset(report, 0, sizeof report);
  memcpy(report, &size, sizeof size);
  return report;
}
#define REPORT(type) ((type *)call_report((uint32_t)sizeof(type)))

static inline jam_status text(const char *said) { return said ? JAM_OK : JAM_E_INTERNAL; }

/* What this build may lack. */
static inline jam_status if_built(jam_status status) { return status == JAM_E_UNSUPPORTED ? JAM_OK : status; }

/* What is of another model than that of the start. */
static inline jam_status of_model(jam_status status) { return status == JAM_E_UNSUPPORTED ? JAM_OK : status; }

static inline jam_status made(jam_status status, jam_system **system) {
  jam_destroy(*system);
  *system = NULL;
  return status;
}

/* A cancel that no call has taken would stop a later one. */
static inline jam_status cancelled(jam_system *sys) {
  const jam_status status = jam_cancel(sys);
  if (sys) jam_structure_factor(sys, 1.0, JAM_STRUCTURE_COLUMNS, NULL, 0, &needed);
  return status;
}

/* A file of this thread. */
static inline const char *call_file(void) {
  static __thread char path[256];
  const char *folder = getenv("TMPDIR");
  snprintf(path, sizeof path, "%s/jam-calls-%ld-%p", folder ? folder : "/tmp", (long)getpid(), (void *)path);
  return path;
}

/* The same under a name that an image may have. */
static inline const char *call_image(void) {
  static __thread char path[264];
  snprintf(path, sizeof path, "%s.npy", call_file());
  return path;
}

/* Options that are small enough for tests; `bounds` hold for damaged ones too. */
#define OPTIONS(name, small, bounds)                                   \
  static __thread jam_##name##_options options_of_##name;              \
  static inline jam_##name##_options *name##_options(CALL_INPUT *in) { \
    jam_##name##_options *const o = &options_of_##name;                \
    jam_##name##_options_init(o, sizeof *o);                           \
    small;                                                             \
    DAMAGED(o, sizeof *o);                                             \
    bounds;                                                            \
    return o;                                                          \
  }
#define BOUND(member, most) (o->member = o->member <= (most) ? o->member : (most))
OPTIONS(create, (o->n = 12, o->dim = 2), (BOUND(n, 50), BOUND(wall_time, SECONDS), BOUND(memory_limit, 1e8)))
OPTIONS(diameters, o->n = 12, (BOUND(n, 50), BOUND(cell_volume, 0.0)))
OPTIONS(run, o->collisions_per_particle = 5.0, BOUND(wall_time, SECONDS))
OPTIONS(compress, (o->growth_rate = 0.1, o->pressure = 30.0), BOUND(wall_time, SECONDS))
OPTIONS(observe, (o->collisions = 1, o->gap_bins = o->r_bins = 8, o->sample_every = 1.0), (void)o)
OPTIONS(isoconf, (o->runs = 3, o->block = 2), (BOUND(wall_time, SECONDS), BOUND(memory_limit, 1e8)))
OPTIONS(crunch, (void)o, (CHOICE(strain, 4), BOUND(wall_time, SECONDS)))
OPTIONS(radii, o->max_steps = 50, (BOUND(max_steps, 200), BOUND(wall_time, SECONDS)))
OPTIONS(relax, o->force_tolerance = 1e-6, (CHOICE(minimiser, 3), BOUND(wall_time, SECONDS)))
OPTIONS(shear, (o->force_tolerance = 1e-8, o->max_steps = 2), (BOUND(max_steps, 20), BOUND(wall_time, SECONDS)))
OPTIONS(decompress, (o->energy_factor = 1e-3, o->force_tolerance = 1e-8), BOUND(wall_time, SECONDS))
OPTIONS(hessian, (void)o, CHOICE(stiffness, 4))
OPTIONS(modes, o->count = 4, (CHOICE(which, 4), BOUND(memory_limit, 1e8)))
OPTIONS(geometry, (void)o, (void)o)
OPTIONS(check, (void)o, BOUND(wall_time, SECONDS))
OPTIONS(correlation, (o->r_max = 2.0, o->bins = 20), BOUND(bins, (int64_t)CALL_ROOM))
OPTIONS(mesh, o->edge = 1.0, BOUND(contacts, JAM_MESH_SHRUNK))
OPTIONS(voxel, (o->nx = o->ny = 8, o->nz = 1),
        (BOUND(nx, 16), BOUND(ny, 16), BOUND(nz, 1), BOUND(size, 0.0), BOUND(lines, 4)))
OPTIONS(dos, (o->moments = 16, o->vectors = 2, o->points = 10), (void)o)
static __thread jam_monte_carlo_options options_of_monte_carlo;
static inline jam_monte_carlo_options *monte_carlo_options(CALL_INPUT *in, double alpha) {
  jam_monte_carlo_options *const o = &options_of_monte_carlo;
  jam_monte_carlo_options_init(o, sizeof *o);
  o->sweeps = 20, o->alpha = alpha, o->temperature = 1e-4, o->step = alpha > 0.0 ? 0.0 : 0.05;
  DAMAGED(o, sizeof *o);
  BOUND(wall_time, SECONDS);
  return o;
}

/* Copies what a view shows to real[0]; its length. */
static inline size_t numbers_of(CALL_INPUT *in, jam_system *sys, int32_t array) {
  size_t length = 1, k;
  if (!sys || jam_view(sys, array, &view, &length) < 0 || length > CALL_ROOM) return 1;
  for (k = 0; k < length; ++k) real[0][k] = view[k];
  if (length) real[0][0] = NUMBER(real[0][0]);
  (void)in;
  return length;
}

static inline int dimension_of(const jam_system *sys) {
  jam_info info;
  info.struct_size = sizeof info;
  return sys && jam_get_info(sys, &info) >= 0 ? info.dim : 1;
}

/* Puts a matrix with these numbers on its diagonal and at one other place into real[0]; its length. */
static inline size_t matrix_of(CALL_INPUT *in, const jam_system *sys, double diagonal, int place, double elsewhere) {
  const int d = dimension_of(sys);
  int k;
  memset(real[0], 0, sizeof *real[0] * 64);
  for (k = 0; k < d; ++k) real[0][k * (d + 1)] = NUMBER(diagonal);
  if (d > 1) real[0][place] = NUMBER(elsewhere);
  (void)in;
  return (size_t)(d * d);
}

/* Puts numbers of copies into whole[0], or a wave vector into real[0]; its length. */
static inline size_t copies_of(CALL_INPUT *in, jam_system *sys) {
  const int d = dimension_of(sys);
  int k;
  for (k = 0; k < d; ++k) whole[0][k] = COUNT(1 + k % 2);
  (void)in;
  return (size_t)d;
}
static inline size_t wave_of(CALL_INPUT *in, jam_system *sys) {
  const int d = dimension_of(sys);
  int k;
  for (k = 0; k < d; ++k) real[0][k] = NUMBER(0.3);
  (void)in;
  return (size_t)d;
}

/* By jam_read_as where a layout is given. */
static inline jam_status read_back(CALL_INPUT *in, jam_system *sys, const char *layout) {
  const jam_status status = jam_write(sys, call_file(), JAM_FORMAT_XYZ);
  jam_create_options *o = create_options(in);
  if (status < 0) return status;
  o->n = 0, o->dim = 3, o->overlap = JAM_OVERLAP_ALLOW;
  return made(
      layout ? jam_read_as(call_file(), layout, o, NULL, NULL, &other) : jam_read(call_file(), o, NULL, NULL, &other),
      &other);
}

static inline jam_status checkpoint_back(jam_system *sys) {
  const jam_status status = jam_write_checkpoint(sys, call_file());
  return status < 0 ? status : made(jam_read_checkpoint(call_file(), NULL, NULL, &other), &other);
}

typedef enum call_start { NONE, ANY, SPACE, SOFT, NETWORK, SHEARED, MINIMUM, OBSERVED, RUNS, STEP } call_start;

#define CALL(name, start, call)                                           \
  static inline jam_status call_##name(CALL_INPUT *in, jam_system *sys) { \
    (void)in, (void)sys;                                                  \
    return call;                                                          \
  }
#include "calls.def"
#undef CALL

#define CALL(name, start, call) {#name, start, call_##name},
static const struct call_entry {
  const char *name;
  call_start start;
  jam_status (*call)(CALL_INPUT *in, jam_system *sys);
} every_call[] = {
#include "calls.def"
};
#undef CALL
enum { CALLS = sizeof every_call / sizeof *every_call };

/* The system that a call of the table needs, d = 2 but for SPACE; NULL for NONE. */
static inline jam_system *system_for(call_start start) {
  jam_create_options o;
  jam_start from;
  jam_system *sys = NULL;
  jam_status status = JAM_OK;
  double diameter[12];
  const double shear_end = 1e-3;
  int k;
  if (start == NONE) return NULL;
  for (k = 0; k < 12; ++k) diameter[k] = k % 2 ? 1.0 : 1.4;
  memset(&from, 0, sizeof from);
  from.struct_size = sizeof from, from.diameters = diameter, from.diameters_len = 12;
  jam_create_options_init(&o, sizeof o);
  o.n = 12, o.dim = start == SPACE ? 3 : 2, o.seed = 3, o.packing_fraction = 0.3;
  if (start == SOFT || start == SHEARED || start == MINIMUM) o.packing_fraction = 0.95, o.overlap = JAM_OVERLAP_ALLOW;
  if (jam_create(&o, &from, &sys) < 0) return NULL;
  if (start == NETWORK) status = jam_crunch(sys, NULL, NULL);
  if (start == SHEARED) status = jam_shear(sys, NULL, &shear_end, 1, NULL, 0, NULL);
  if (start == MINIMUM) status = jam_decompress(sys, NULL, NULL);
  if (start == OBSERVED) status = call_jam_observe(NULL, sys);
  if (start == OBSERVED && status >= 0) status = call_jam_run(NULL, sys);
  if (start == RUNS) status = call_jam_isoconf(NULL, sys);
  if (status >= 0) return sys;
  jam_destroy(sys);
  return NULL;
}

#endif /* JAM_TESTS_CALLS_H */
