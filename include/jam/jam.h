/* libjam: jammed packings of hard spheres, made and analysed.
 *
 * The only public header. C99. SPDX-License-Identifier: MIT
 *
 * Typical use: jam_create or jam_read makes a system. jam_run and jam_compress move it by event-driven molecular
 * dynamics. jam_crunch brings it to its jamming point by a barrier method and linear programs. jam_get_crunch_report,
 * jam_contacts, jam_forces, jam_hessian and jam_modes then describe the jammed packing.
 *
 * Units
 * - Lengths are in the user's unit. The box is a periodic cube of side `box` (default 1), or any periodic cell
 *   (jam_start); then `box` is V^(1/d), V its volume. Times are in box / sqrt(kT/m).
 * - m = k_B T = 1: a velocity component has unit variance.
 * - Packing fraction, reduced pressure p = beta P / rho, gaps h = r / sigma_ij - 1 and growth rates are dimensionless.
 *   Reports give displacements in mean diameters, relative to the mean displacement.
 * - sigma is always a DIAMETER. The growth rate is G = (d<sigma>/dt) / sqrt(kT/m), with <sigma> the mean diameter.
 *   (Skoge-Donev code: radius rate g at mean v^2 = 1, so G = 2 sqrt(d) g, 3.464 g in d = 3.)
 *
 * Cells
 * - Cell vectors are the rows of a (d, d) matrix, as in ASE, extended XYZ and H5MD.
 * - Vectors that form a lower triangle with a positive diagonal are kept as given. Others are rotated into that form,
 *   together with the spheres. Vectors whose lengths have a product above 2^(d+2) V are replaced by shorter ones.
 * - Positions lie in the brick [0, a_00) x [0, a_11) x ..., which repeats as the cell does.
 * - The plain text format stores cubes only. Everything else works in any cell.
 * - d (N' - 1) in a count of contacts is d N' minus d translations. With walls it is d N' minus the rigid motions that
 *   they allow: a translation along each periodic axis, the rotations of a cylinder (1) or a ball (d (d - 1) / 2).
 *
 * Arrays and pointers
 * - Arrays of shape (n, d) are row-major: the same bytes as numpy (n, d), Fortran x(d, n) and a Julia d-by-n matrix.
 *   Indices are 0-based.
 * - Arrays in: pointer and length in elements. The length is checked.
 * - Arrays out: the caller's buffer, its length in elements, and `needed`, in elements too. NULL and 0 only return the
 *   size. A buffer that is too short gives JAM_E_BUFFER, sets `needed` and is not written.
 * - A `table` has shape (rows, columns), and an enum lists its columns. Pass the number of columns of your header, such
 *   as JAM_HISTORY_COLUMNS; the call writes that many, from the first. Counts in a table are whole numbers. A column
 *   that has no meaning, or that the library does not have, is NaN.
 * - A call with several arrays out gives the number of rows in `rows` instead of `needed`; the length of each array
 *   follows from its @shape. Each of them may be NULL with length 0.
 * - Options, reports and other structs begin with struct_size, which the caller sets to sizeof. Fill options by
 *   jam_X_options_init(&o, sizeof o), then change what differs. A NULL option pointer means all defaults. Fields named
 *   `reserved` must be 0.
 * - Programs and libraries of all 1.x work together. Later versions add members at the end of a struct or in place of
 *   `reserved`, and columns after the last. If the program's struct is the shorter one, its members are filled, and
 *   missing options have their defaults. If it is longer, by 512 bytes at most, members unknown to the library are NaN
 *   or -1 in a report and must be 0 in options, as jam_X_options_init sets them; else the call fails with
 *   JAM_E_STRUCT_SIZE. A callback reads no member of jam_progress beyond its struct_size.
 * - NaN or -1 in a report: unknown. The `report` of a call that computes and any callback may be NULL. Another pointer
 *   may be NULL only where a comment allows it; its length is then 0.
 *
 * Status, for every call unless its comment says otherwise
 * - 0 done; > 0 stopped early, or the answer is negative, imprecise or not unique: the state is valid and kept; < 0
 *   failed, the state is as before the call. For every status but 0 jam_last_error() gives the reason in one sentence.
 *   A status < 0 writes no output but `needed` or `rows`, always with JAM_E_BUFFER.
 * - Calls that work on a system or make one may return JAM_CANCELLED; calls with a wall_time may return JAM_LIMIT. A
 *   setter or a const call that returns either has changed nothing and written no output, but a part to a pipe.
 * - Comments end in tags: @shape of arrays; @enum, @bool and @optional of arguments; @errors besides those of any call.
 * - Errors of any call: JAM_E_NULL, JAM_E_STRUCT_SIZE, JAM_E_ARGUMENT (a value or a length is out of its range),
 *   JAM_E_NONFINITE, JAM_E_BUFFER, JAM_E_MEMORY, JAM_E_BUSY. Comments name the others.
 *
 * Threads
 * - Distinct handles are independent. Calls that take the same handle as const may run together. Any other call must be
 *   the only one on its handle: meanwhile calls of other threads on this handle return JAM_E_BUSY, and its callback may
 *   make const calls. jam_cancel may be called from any thread or signal handler at any time. Calls without a handle
 *   may be called from any thread.
 * - The same seed and options give the same packing bit for bit on every processor, on one thread. 2 to 64 threads all
 *   give the same packing, which may differ from that of one thread. Modes (jam_modes, jam_bloch_modes) differ in the
 *   last digits: full spectra by LAPACK between processors, others between WebAssembly and native code. In a build
 *   whose products are those of a BLAS library (jam_blas_kernel) a crunch can end at another jamming point on another
 *   processor, unless the environment variable OPENBLAS_CORETYPE selects the same kernel of OpenBLAS.
 * - While a call computes all modes by LAPACK, OpenBLAS has one thread in the whole process. libjam restores the
 *   previous number of threads afterwards. Host threads that use OpenBLAS meanwhile run on one thread each. No other
 *   call of the default build touches OpenBLAS.
 * - Calls compute in the default floating-point environment of C: rounding mode, traps, exception flags, treatment of
 *   denormal numbers. libjam restores the caller's environment after each call, and while a callback runs.
 * - pthread_cancel takes effect when a call ends or waits for the other end of a pipe, jam_cancel sooner.
 * - A thread that calls libjam needs a stack of 256 kB plus the stack of its callbacks.
 *
 * Trust
 * - Files, checkpoints, arrays and options are checked before use. None of them can do more than make a call fail.
 *   Files are written under another name and then renamed. Pointers, lengths and callbacks are trusted.
 *
 * Limits, checked wherever a value enters (options, arrays, files, checkpoints):
 * - dimension; spheres n      2 .. JAM_MAX_DIM; 1 .. 2^31 - 1
 * - box                       1e-30 .. 1e30
 * - cell: distance of faces   at least 1e-3 box, after reduction
 * - diameter                  at least 1e-9 of the longest cell edge (of a cube the box), which coordinates resolve to
 *                             1e-16; at most the shortest cell vector
 * - largest / least diameter  1 .. 1e4
 * - diameters without a cell  1e-39 .. 1e36
 * - non_additivity; mk_zeta   above -1, at most 1; 0 .. 1e15, or infinity
 * - packing fraction          above 0; a random start: below saturation, 0.38 in d = 3
 * - radii of pair searches    at most 1000 mean diameters; ends of histograms at least 1e-15
 * - energy, k_B T, P, stress  1e-100 .. 1e100, also the energy of two soft spheres at one place
 * - growth rate               1e-15 .. 1000
 * - wall_time, in seconds     above 0, of the call that takes it; infinity, the default: no limit
 * - velocities                root of sum m v^2 / (d n) 0 or 1e-9 .. 1e6. Light spheres among heavy ones may be faster
 */
#ifndef JAM_JAM_H
#define JAM_JAM_H

#include <stddef.h>
#include <stdint.h>

#if defined(__GNUC__) && !defined(SWIG)
#define JAM_API __attribute__((visibility("default")))
#else
#define JAM_API
#endif

/* JAM_DEPRECATED("jam_successor") marks a call that has a successor. The call works until the ABI number changes. */
#if defined(__GNUC__) && !defined(SWIG)
#define JAM_DEPRECATED(instead) __attribute__((deprecated("use " instead)))
#else
#define JAM_DEPRECATED(instead)
#endif

#ifdef __cplusplus
extern "C" {
#endif

/* ABI number of this header, equal to the SOVERSION of the library. */
#define JAM_ABI 1
/* Largest dimension compiled in. */
#define JAM_MAX_DIM 8

/* ------------------------------------------------------------------ status and text */

/* Status of a call: a jam_status_code. */
typedef int32_t jam_status;
/* All status codes; values are ABI and never reused. */
typedef enum jam_status_code {
  JAM_OK = 0,              /* done: the target was reached */
  JAM_CANCELLED = 1,       /* jam_cancel or a callback requested a stop */
  JAM_LIMIT = 2,           /* a limit on work or time was reached before the target */
  JAM_NOT_CONVERGED = 3,   /* the method made no further progress; the last state is kept */
  JAM_PRECISION = 4,       /* the target lies beyond what the numbers can resolve */
  JAM_NOT_JAMMED = 5,      /* there is no jammed network to work on */
  JAM_AMBIGUOUS = 6,       /* the answer is not unique; the text says which was returned */
  JAM_E_NULL = -1,         /* a pointer that is needed is NULL */
  JAM_E_STRUCT_SIZE = -2,  /* struct_size was not set, or an option is of a later version */
  JAM_E_ARGUMENT = -3,     /* a value is out of its range */
  JAM_E_DIMENSION = -4,    /* dim is not in 2..JAM_MAX_DIM */
  JAM_E_NONFINITE = -5,    /* NaN or infinity where a number is needed */
  JAM_E_OVERLAP = -6,      /* spheres overlap; the text names the worst pair */
  JAM_E_UNPLACEABLE = -7,  /* the spheres cannot reach the packing fraction */
  JAM_E_BUFFER = -8,       /* the caller's buffer is too short; *needed is the length */
  JAM_E_MEMORY = -9,       /* out of memory */
  JAM_E_IO = -10,          /* a file cannot be opened, read or written */
  JAM_E_FORMAT = -11,      /* a file does not have the format; the text names the line */
  JAM_E_STATE = -12,       /* the handle has no such result yet, e.g. forces before crunch */
  JAM_E_SOLVER = -13,      /* no LP or eigenvalue solver gave an answer that checks out */
  JAM_E_TOO_FEW = -14,     /* too few spheres for this call */
  JAM_E_BUSY = -15,        /* another call is running on this handle */
  JAM_E_UNSUPPORTED = -16, /* not available in this build or for this model */
  JAM_E_INTERNAL = -17     /* a bug in libjam; please report the text */
} jam_status_code;
/* Why a run ended: stop_reason of the reports. */
typedef enum jam_stop_reason {
  JAM_STOP_NONE = 0,             /* has not run */
  JAM_STOP_PRESSURE = 1,         /* MD reached its pressure */
  JAM_STOP_PACKING_FRACTION = 2, /* MD reached its packing fraction */
  JAM_STOP_COLLISIONS = 3,       /* MD made its collisions per particle */
  JAM_STOP_WALL_TIME = 4,        /* the wall-clock limit came first */
  JAM_STOP_CANCELLED = 5,        /* jam_cancel or a callback */
  JAM_STOP_STALLED = 6,          /* no progress: MD time or LP gain stopped moving */
  JAM_STOP_PRECISION = 7,        /* gaps, overlaps or forces are at rounding */
  JAM_STOP_CONVERGED = 8,        /* crunch: both tolerances met, certificate computed; radii: a maximum */
  JAM_STOP_LP_LIMIT = 9,         /* crunch: max_lps came first */
  JAM_STOP_SOLVER = 10,          /* crunch: no LP answer passed the checks */
  JAM_STOP_UNJAMMED = 11,        /* crunch: converged without a rigid network */
  JAM_STOP_TIME = 12,            /* MD: its simulated time is over */
  JAM_STOP_EVALUATIONS = 13,     /* soft spheres: max_evaluations came first */
  JAM_STOP_STEPS = 14,           /* shear, radii: max_steps came first */
  JAM_STOP_SADDLE = 15,          /* crunch: forces balance, but a flex remains after every decompression */
  JAM_STOP_DUALITY_GAP = 16,     /* crunch: it reached the duality gap of its options */
  JAM_STOP_STRAIN = 17,          /* shear: the last strain */
  JAM_STOP_EVENT = 18,           /* shear: the first plastic event */
  JAM_STOP_JAMMED = 19           /* shear: contacts carry force */
} jam_stop_reason;
/* Version of the library, e.g. "1.0.0". Static storage, as the texts of the next five calls. */
JAM_API const char *jam_version(void);
/* Commit of the source that the library was built from, 12 hex digits, or ""; uncommitted changes do not show. */
JAM_API const char *jam_commit(void);
/* JAM_ABI of the library that is loaded. */
JAM_API int32_t jam_abi_version(void);
/* What computes the matrix products of a crunch: "builtin" (libjam's own loops, the default), or in a build with a BLAS
 * library the kernel that OpenBLAS chose for this processor, e.g. "Haswell", or the path of another library. */
JAM_API const char *jam_blas_kernel(void);
/* One-line text of a status code ("unknown status" for others). */
JAM_API const char *jam_status_string(jam_status code);
/* One-word name of a jam_stop_reason, e.g. "converged". */
JAM_API const char *jam_stop_string(int32_t reason);
/* Reason for the last status other than JAM_OK on this thread, with the name and value at fault; "" when there was
 * none. The log callback receives the same sentence. Valid until the next status other than JAM_OK on this thread. */
JAM_API const char *jam_last_error(void);
/* Sets the text of jam_last_error() on this thread; long texts are truncated, NULL sets "". For language bindings. */
JAM_API void jam_set_error(const char *text);

/* ------------------------------------------------------------------ progress */

/* Which part reports progress. */
typedef enum jam_phase {
  JAM_PHASE_RUN = 1,         /* NVE molecular dynamics */
  JAM_PHASE_COMPRESS = 2,    /* molecular dynamics with growth */
  JAM_PHASE_CRUNCH = 3,      /* one LP or re-linearised Newton step done */
  JAM_PHASE_POLISH = 4,      /* refinement of the final network */
  JAM_PHASE_ANALYSE = 5,     /* long analysis calls, and setters that search for overlaps */
  JAM_PHASE_RELAX = 6,       /* minimising the energy of soft spheres */
  JAM_PHASE_DECOMPRESS = 7,  /* soft spheres on their way down to jamming; steps: decompressions so far */
  JAM_PHASE_MONTE_CARLO = 8, /* Metropolis sweeps */
  JAM_PHASE_ISOCONF = 9,     /* runs from one configuration; steps counts those that are done */
  JAM_PHASE_CREATE = 10,     /* making a system; steps counts the spheres placed */
  JAM_PHASE_SHEAR = 11       /* quasi-static shear; steps counts the minima */
} jam_phase;
/* Given to the progress callback; valid during the call only. NaN: unknown. */
typedef struct jam_progress {
  uint32_t struct_size;    /* as in this library */
  int32_t phase;           /* @enum jam_phase */
  double packing_fraction; /* now */
  double pressure;         /* MD: reduced pressure of the last window */
  double gain;             /* crunch: sqrt(Gamma) - 1 of the last LP; on the barrier path its duality gap */
  double max_step;         /* crunch: largest |s_i| over mean diameter */
  double seconds;          /* since the call began */
  double fraction;         /* share of this call done, 0..1: never decreases, may be an estimate, ignores wall_time */
  int64_t collisions;      /* MD: so far in this call */
  int64_t steps, factorisations; /* crunch: LPs so far, analysis: items done; crunch: so far */
  int64_t snapshot;              /* number of the snapshot (jam_observe) that the views show now; 0: no snapshot */
  double seconds_left;           /* until the end, estimated from the growth of `fraction` */
  double seconds_left_spread;    /* s > 1: two of three calls end between seconds_left / s and s seconds_left */
} jam_progress;
/* Progress callback, on the calling thread. A non-zero return stops the call with JAM_CANCELLED and a valid state. It
 * must not throw or longjmp. On its handle it may call jam_cancel, jam_write_checkpoint (which saves the running stage)
 * and const getters. These show the state before the call, or the last snapshot. */
typedef int32_t (*jam_progress_fn)(const jam_progress *progress, void *user);

/* ------------------------------------------------------------------ the system */
/* jam_create and jam_read make a system, jam_get_info describes it, jam_view shows its arrays, jam_destroy frees it. */

/* N spheres in a cell; opaque. Made by jam_create, jam_read, jam_read_checkpoint, jam_copy or jam_tile. */
typedef struct jam_system jam_system;
/* What to do with overlaps in given positions. */
typedef enum jam_overlap_policy {
  JAM_OVERLAP_REFUSE = 0, /* JAM_E_OVERLAP naming the worst pair */
  JAM_OVERLAP_SHRINK = 1, /* scale all diameters down until the worst pair just touches; jam_notes gives the factor */
  JAM_OVERLAP_ALLOW = 2   /* keep them (soft spheres): uniform random starts; calls for hard spheres refuse overlaps */
} jam_overlap_policy;
/* Pair distance. */
typedef enum jam_model {
  JAM_MODEL_EUCLID = 0, /* |r_i - r_j|, nearest images */
  JAM_MODEL_MK = 1      /* Mari-Kurchan: |r_i - r_j + zeta A_ij|, quenched random shifts */
} jam_model;
/* Masses of the spheres in molecular dynamics; the mean is 1. */
typedef enum jam_masses {
  JAM_MASSES_EQUAL = 0, /* all 1 */
  JAM_MASSES_VOLUME = 1 /* as the volumes, sigma_i^d */
} jam_masses;
/* What encloses the spheres; the cell is the brick around it. The gap of a sphere to a wall is h = distance / radius -
 * 1, as to its mirror image. In contacts the wall of row w of jam_walls is the partner j = -1 - w. */
typedef enum jam_container {
  JAM_CONTAINER_BRICK = 0,    /* the cell: flat walls on the axes of `walls`, the other axes periodic */
  JAM_CONTAINER_CYLINDER = 1, /* d = 3, axis z, periodic or between flat walls; diameter: the edges x and y */
  JAM_CONTAINER_BALL = 2,     /* d = 2 a circle, d = 3 a ball; diameter: the edge of the cube */
  JAM_CONTAINER_CONE = 3 /* d = 3, axis z between flat walls; diameter: at z = 0 the edges x and y, half at the end */
} jam_container;
/* Options of jam_create and jam_read. If a file gives the value of an option, the option must have its default or that
 * value. A random Mari-Kurchan start is planted in equilibrium. */
typedef struct jam_create_options {
  uint32_t struct_size;
  int32_t dim;               /* 2..8, default 3 */
  int64_t n, seed;           /* spheres, default 0: as many as the arrays have; of every random stream, default 1 */
  double box;                /* side of the cube, > 0, default 1 */
  double packing_fraction;   /* of a random start, > 0; default 0: 0.2, halved for each dimension above 3 */
  int32_t overlap, model;    /* @enum jam_overlap_policy, default REFUSE; @enum jam_model, default EUCLID */
  double mk_zeta;            /* MK: strength of the shifts, 0..1e15; default infinity: uniform shifts */
  int32_t masses, container; /* @enum jam_masses, default EQUAL; @enum jam_container, default BRICK */
  int32_t walls, reserved;   /* axes with flat walls: sum of 2^c, default 0; 0 */
  double non_additivity; /* Delta in (-1, 1]: unequal spheres touch at (1 + Delta) (sigma_i + sigma_j) / 2; default 0 */
  double wall_time;      /* of reading, of a random start and of the search for overlaps */
  double memory_limit;   /* as jam_set_memory_limit, also while a file is read; default 0: half the machine's memory */
  int64_t frame;     /* which packing of a file with several, from 0; negative: from the end; default -1, the last */
  double shrink_min; /* JAM_OVERLAP_SHRINK refuses a smaller factor (a sign of wrong units), in 0..1, default 1e-3 */
} jam_create_options;
/* Fills *o with the defaults. size = sizeof *o as the caller compiled it. So do all jam_X_options_init. */
JAM_API jam_status jam_create_options_init(jam_create_options *o, size_t size);
/* The start of a system. NULL instead of the struct: a random sequential start of equal spheres in a cube. */
typedef struct jam_start {
  uint32_t struct_size;
  int32_t reserved;
  const double *positions; /* (n, d), Cartesian, any finite value (wrapped into the cell); NULL: a random start */
  size_t positions_len;
  const double *diameters; /* n values, or 1 for all; needed with positions. Random start: ratios alone, NULL: equal */
  size_t diameters_len;
  const double *cell; /* (d, d), needs the default box of 1; not left-handed, singular or flat. NULL: a cube */
  size_t cell_len;
  jam_progress_fn progress; /* or NULL; a non-zero return ends the call. The new system has no callback */
  void *user;               /* given to progress */
} jam_start;
/* Makes a system of d = o->dim. Without positions, spheres are added one by one at random up to the packing_fraction of
 * the options. The caller frees *out by jam_destroy; after JAM_CANCELLED or JAM_LIMIT it is NULL. The call takes long
 * when many pairs of spheres are close together, and in the Mari-Kurchan model, where all pairs are compared. Example:
 * examples/c/first.c @errors DIMENSION, OVERLAP, UNPLACEABLE (the text gives the fraction in reach) */
JAM_API jam_status jam_create(const jam_create_options *o, const jam_start *start, jam_system **out);
/* Deep copy of src with its results and observations (jam_observe stays on), without its callbacks. The copy has the
 * seed of src and draws the same velocities. For independent runs use jam_set_velocities. */
JAM_API jam_status jam_copy(const jam_system *src, jam_system **out);
/* Frees a system; NULL is fine. */
JAM_API void jam_destroy(jam_system *sys);
/* What the system is now. */
typedef struct jam_info {
  uint32_t struct_size;
  int32_t dim;              /* d */
  int64_t n, seed;          /* number of spheres; as recorded at creation */
  double box;               /* side of the cube, V^(1/d) of another cell */
  double packing_fraction;  /* sum of sphere volumes over V */
  double diameter_mean;     /* unit of box */
  double pressure;          /* reduced p of this packing as MD measured it, NaN after other moves */
  int32_t model;            /* @enum jam_model */
  int32_t monodisperse;     /* @bool all diameters are equal */
  int32_t masses;           /* @enum jam_masses */
  int32_t paused;           /* @enum jam_phase of a stopped call that can continue (a crunch: by jam_crunch), or 0 */
  double non_additivity;    /* Delta of a non-additive mixture, 0 for additive diameters */
  int32_t container, walls; /* @enum jam_container; as in jam_create_options */
  double volume;            /* V of the container, else of the cell */
  double contact_gap;       /* of jam_contacts_by_distance, while its contacts are kept; else NaN */
} jam_info;
/* Fills *info. */
JAM_API jam_status jam_get_info(const jam_system *sys, jam_info *info);
/* What jam_view shows. */
typedef enum jam_view_array {
  JAM_VIEW_POSITIONS = 0, /* (n, d), in [0, box), in other cells in the brick */
  JAM_VIEW_DIAMETERS = 1, /* n */
  JAM_VIEW_VELOCITIES = 2 /* (n, d), kT/m = 1; zero until the first MD call draws them */
} jam_view_array;
/* View of an array of the system. The pointer stays valid as long as the handle. Its content changes only at the end of
 * calls that move spheres. @enum array jam_view_array */
JAM_API jam_status jam_view(const jam_system *sys, int32_t array, const double **view, size_t *view_len);
/* Replaces the positions (wrapped); drops results of a crunch. @shape positions (n, d) @errors OVERLAP */
JAM_API jam_status jam_set_positions(jam_system *sys, const double *positions, size_t positions_len);
/* Replaces the velocities. Results of a crunch are kept: they do not depend on velocities. jam_run uses the velocities
 * as they are. jam_compress rescales them to kT/m = 1. @shape velocities (n, d) */
JAM_API jam_status jam_set_velocities(jam_system *sys, const double *velocities, size_t velocities_len);
/* Multiplies all diameters by factor > 0; results of crunch are dropped. @errors OVERLAP (when growing) */
JAM_API jam_status jam_scale_diameters(jam_system *sys, double factor);
/* Columns of jam_walls. */
typedef enum jam_wall_column {
  JAM_WALL_AXIS = 0,     /* of a flat wall; d: the round wall */
  JAM_WALL_SIDE = 1,     /* 0: at 0; 1: at the edge of the cell, or round */
  JAM_WALL_AREA = 2,     /* unit^(d-1) */
  JAM_WALL_PRESSURE = 3, /* beta P V / N as MD measured it; NaN after other moves */
  JAM_WALL_GAP = 4,      /* least h of a sphere */
  JAM_WALL_STRESS = 5    /* contact forces per area, over the mean pressure sum f r / (d V); NaN without contacts */
} jam_wall_column;
#define JAM_WALL_COLUMNS 6
/* One row per wall: flat ones axis by axis, then the round one. @shape table (m, jam_wall_column) */
JAM_API jam_status jam_walls(const jam_system *sys, int32_t columns, double *table, size_t table_len, size_t *needed);

/* ------------------------------------------------------------------ the cell */

/* Cell vectors in normal form. @shape out (d, d) */
JAM_API jam_status jam_get_cell(const jam_system *sys, double *out, size_t out_len, size_t *needed);
/* Replaces the cell; a left-handed, singular or flat one is refused. Diameters and Cartesian positions, in the frame of
 * `cell`, stay; results of a crunch are dropped. transform: integers T; the new vectors are T `cell`, rotated by Q,
 * which takes a point x to Q x. *rows = d. Mari-Kurchan shifts are fractions of the cell vectors: other vectors give
 * another system. @shape cell (d, d), transform (d, d), rotation (d, d) @errors OVERLAP */
JAM_API jam_status jam_set_cell(jam_system *sys, const double *cell, size_t cell_len, int64_t *transform,
                                size_t transform_len, double *rotation, size_t rotation_len, size_t *rows);
/* Deforms cell and positions by r -> (1 + strain) r, without components of axes with walls; diameters stay, results of
 * crunch are dropped. The cell vectors deform too; jam_notes says whether they were replaced by shorter ones or rotated
 * to a lower triangle. Velocities are rotated, not strained. @shape strain (d, d) @errors OVERLAP, UNSUPPORTED */
JAM_API jam_status jam_strain(jam_system *sys, const double *strain, size_t strain_len);
/* Copies of src side by side, count[c] along cell vector a_c. Copy (k_0, k_1, ...) stands at sum of k_c a_c; its sphere
 * i is number i + n (k_0 + count[0] (k_1 + count[1] ...)). The cell has the vectors count[c] a_c. Velocities, contacts,
 * gaps and forces are copied; steps and histories are not. If a sphere of src touches its own image and the network of
 * src omits this contact, the copies have no network, and a note says so. The report of several copies has no verdicts,
 * since copies may have flexes that src does not have. Along axes with walls count is 1. @shape count (d)
 * @errors UNSUPPORTED (Mari-Kurchan model, walls), OVERLAP (coordinates no longer resolve the gaps) */
JAM_API jam_status jam_tile(const jam_system *src, const int32_t *count, size_t count_len, jam_system **out);

/* ------------------------------------------------------------------ sizes */

/* Laws of diameters s. Each takes the fields named here, and no others. */
typedef enum jam_size_law {
  JAM_SIZES_EQUAL = 0,     /* mean */
  JAM_SIZES_LIST = 1,      /* curve: rows (diameter, share) */
  JAM_SIZES_UNIFORM = 2,   /* low, high: constant density between them */
  JAM_SIZES_NORMAL = 3,    /* mean, deviation; cut at 0, or by low and high */
  JAM_SIZES_LOGNORMAL = 4, /* mean, deviation, both of s, not of its logarithm; may be cut by low and high */
  JAM_SIZES_POWER = 5,     /* exponent, low, high: density s^exponent between them */
  JAM_SIZES_WEIBULL = 6,   /* scale, shape (Rosin-Rammler): share above s is exp(-(s / scale)^shape); may be cut */
  JAM_SIZES_SIEVE = 7      /* curve: rows (size, share passing, from 0 to 1 or 100 per cent); straight in log size */
} jam_size_law;
/* What the shares of a law count. */
typedef enum jam_size_share {
  JAM_SHARE_USUAL = 0,  /* volume for WEIBULL and SIEVE, number for the others */
  JAM_SHARE_NUMBER = 1, /* spheres */
  JAM_SHARE_VOLUME = 2  /* volume: mass at one density */
} jam_size_share;
/* How diameters are drawn from a law. */
typedef enum jam_size_draw {
  JAM_DRAW_QUANTILES = 0, /* one sphere for each n-th part of the law: its median, or by volume its mean volume */
  JAM_DRAW_RANDOM = 1     /* independent, by the seed */
} jam_size_draw;
/* Options of jam_diameters. Lengths are in the user's unit. NaN or 0: not given. */
typedef struct jam_diameters_options {
  uint32_t struct_size;
  int32_t law, share; /* @enum jam_size_law, default EQUAL; @enum jam_size_share, default USUAL */
  int32_t draw, dim;  /* @enum jam_size_draw, default QUANTILES; 2..8, default 3, for volumes */
  int32_t reserved;
  int64_t n, seed;         /* number of spheres, default 0: by packing_fraction; of RANDOM, default 1 */
  double mean, deviation;  /* diameter, > 0, default 1; its standard deviation, > 0, default NaN */
  double low, high;        /* smallest diameter, default 0; largest diameter, default infinity: not given */
  double exponent;         /* default NaN; POWER: (|exponent| + 9) ln(high / low) at most 600 */
  double scale, shape;     /* > 0, default 1; > 0, default NaN */
  double cell_volume;      /* default 0. Spheres of more volume are refused */
  double packing_fraction; /* in cell_volume, in place of n; default 0. Above the estimate of jamming: refused */
} jam_diameters_options;
JAM_API jam_status jam_diameters_options_init(jam_diameters_options *o, size_t size);
/* Diameters of a law. Quantiles ascend. curve: of LIST and SIEVE, else NULL. If packing_fraction is given instead of n,
 * the volumes add up to packing_fraction * cell_volume: for EQUAL and LIST to half a sphere, for other laws to 1e-13.
 * There the last sphere is adjusted, below the largest. The error text gives the fraction in reach. Example:
 * examples/c/sieve.c @shape curve (rows, 2), out (m) @errors DIMENSION, UNPLACEABLE (packing_fraction) */
JAM_API jam_status jam_diameters(const jam_diameters_options *o, const double *curve, size_t curve_len, double *out,
                                 size_t out_len, size_t *needed);
/* Reads a law from text into *o, whose other fields stay as they are, and gives its curve. The text is `LAW` or
 * `LAW:item,item...`. An item is a field (`deviation=0.3`, `share=volume`, `draw=random`), a row of the curve
 * (`0.5=0.12`), or a file of two columns, with comments behind #. @shape curve (rows, 2)
 * @errors IO, FORMAT (the text names the line) */
JAM_API jam_status jam_parse_diameters(const char *text, jam_diameters_options *o, double *curve, size_t curve_len,
                                       size_t *needed);
/* Where jam_size_report.jammed_fraction comes from. */
typedef enum jam_reach_source {
  JAM_REACH_FARR_GROOT = 1, /* d = 3: spheres as rods on a line (Farr, Groot, J. Chem. Phys. 131, 244104 (2009)) */
  JAM_REACH_MEASURED = 2,   /* other d: the same map, fitted to packings of libjam: equal spheres, disks 1 : 1.4 */
  JAM_REACH_CRYSTAL = 3     /* disks of nearly one size, which order: the hexagonal packing */
} jam_reach_source;
/* What a set of diameters is. sequential_fraction: Zhang and Torquato, Phys. Rev. E 88, 053312 (2013). */
typedef struct jam_size_report {
  uint32_t struct_size;
  int32_t source;             /* @enum jam_reach_source */
  int64_t n;                  /* number of spheres */
  double mean, deviation;     /* diameter, by number; its standard deviation, by number */
  double polydispersity;      /* deviation / mean */
  double least, largest;      /* diameter */
  double d10, d50, d90;       /* diameter below which 10 % of the volume lies; 50 %; 90 % */
  double volume;              /* of all spheres, unit^d */
  double largest_share;       /* volume of the largest sphere over that of all: limits how closely a curve is met */
  double sequential_fraction; /* saturation of random sequential addition of equal spheres; mixtures exceed it */
  double jammed_fraction;     /* estimate of phi_J of disordered packings of these sizes in bulk; walls lower it */
} jam_size_report;
/* Describes diameters > 0 in dimension dim. @shape diameters (n) @errors DIMENSION */
JAM_API jam_status jam_get_size_report(int32_t dim, const double *diameters, size_t diameters_len,
                                       jam_size_report *report);

/* ------------------------------------------------------------------ progress, log, cancel */

/* Sets (or with NULL removes) the progress callback. It is called at most every 0.05 s, also by long const calls and
 * setters, on the thread of each call, but not by calls that a callback makes. */
JAM_API jam_status jam_set_progress(jam_system *sys, jam_progress_fn callback, void *user);
/* Log levels. */
typedef enum jam_log_level {
  JAM_LOG_NONE = 0,    /* silent, the default */
  JAM_LOG_WARNING = 1, /* what a user should know, e.g. a fallback solver was used */
  JAM_LOG_INFO = 2,    /* one line per stage or LP */
  JAM_LOG_DEBUG = 3    /* solver detail */
} jam_log_level;
/* Log callback: one line without newline, valid during the call. */
typedef void (*jam_log_fn)(int32_t level, const char *line, void *user);
/* Sets (or with NULL removes) the log callback and its level; first logs jam_notes. @enum level jam_log_level */
JAM_API jam_status jam_set_log(jam_system *sys, jam_log_fn callback, int32_t level, void *user);
/* Requests that all calls on sys stop soon with JAM_CANCELLED. If no call runs, the next non-const call on sys stops,
 * unless it is a setter. jam_cancel only increments an atomic counter. */
JAM_API jam_status jam_cancel(jam_system *sys);
/* Limits the bytes > 0 of pair lists, factorised matrices and arrays made from them in one call on sys; default: half
 * the machine's memory, infinity: no limit. A call that needs more fails with JAM_E_MEMORY before it allocates.
 * jam_crunch compares the limit with jam_estimate_crunch before it begins, and with each matrix before it factorises
 * it. An option memory_limit can lower the limit for its own call. */
JAM_API jam_status jam_set_memory_limit(jam_system *sys, double bytes);

/* ------------------------------------------------------------------ files */

/* File formats. A further ending .gz compresses the file. PLAIN: line 1: d. Line 2: N. Line 3: the diameter, or the
 * word `diameters`; then, when it is not 1, the box as `box <L>`. Then one line per sphere: position, and diameter if
 * line 3 is `diameters`, with 17 digits. XYZ: Lattice, dim, Properties=id:I:1:pos:R:d:radius:R:1 and, after a crunch,
 * contacts:I:1. VTP: points with diameter, cell, and after a crunch contacts, kind (0 rattler, 1 buckler, 2 other). */
typedef enum jam_format {
  JAM_FORMAT_AUTO = 0, /* .xyz, .extxyz: XYZ; .data, .lmp: LAMMPS; .vtp: VTP; .dat, .txt, none: PLAIN; others refused */
  JAM_FORMAT_PLAIN = 1,  /* text, cubes without walls only */
  JAM_FORMAT_XYZ = 2,    /* extended XYZ; d = 2 gets a third coordinate 0 */
  JAM_FORMAT_LAMMPS = 3, /* LAMMPS data, atom_style sphere, density 1, d = 2, 3, any cell; walls in its title */
  JAM_FORMAT_VTP = 4     /* VTK PolyData in binary, d = 2 and 3. Written only */
} jam_format;
/* Table of file formats as text, one line per format, fields separated by tabs: content (packings, contacts, images);
 * number in jam_format or jam_contact_format, or 0; word for options; name; file endings separated by blanks, or a
 * minus sign; largest dimension; which of spheres walls cells non_additivity density it stores; read, write or both. */
JAM_API const char *jam_formats(void);
/* Reads plain text, extended XYZ, LAMMPS data and dumps with diameters, data of MercuryDPM, or a table of columns. The
 * content decides the format. For another format the error names it and what to do. o gives overlap policy, seed, model
 * and frame; also box, dim, container and walls if the file does not. A line that does not fit the format is an error.
 * jam_notes lists what was not kept. Spheres keep the order of the file; LAMMPS data are sorted by id. A last line
 * without newline is refused if its last number may have lost digits. callback, user: as in jam_start. @errors IO,
 * FORMAT (line named), UNSUPPORTED (a box that is not periodic), DIMENSION, OVERLAP, UNPLACEABLE */
JAM_API jam_status jam_read(const char *path, const jam_create_options *o, jam_progress_fn callback, void *user,
                            jam_system **out);
/* jam_read with facts that the file lacks. layout: words separated by blanks, or "". cell=5,5,8: sides of the cell, or
 * all components of its vectors. origin=-2.5,-2.5,0: corner of the cell in the file, default 0. columns=x,y,z,radius:
 * names of the columns of a table; also x1 to x8, diameter; others are not read. A fact that the file gives is refused.
 * @errors IO, FORMAT (line named), UNSUPPORTED (a box that is not periodic), DIMENSION, OVERLAP, UNPLACEABLE */
JAM_API jam_status jam_read_as(const char *path, const char *layout, const jam_create_options *o,
                               jam_progress_fn callback, void *user, jam_system **out);
/* What was changed or assumed when sys was made, one sentence per line, or "": shrunk diameters, wrapped or sorted
 * spheres, columns and frames that were not read. A warning begins with `warning: `. jam_set_log logs these lines too.
 * Valid until a note is added, or jam_destroy; "" for NULL. Checkpoints contain the notes. */
JAM_API const char *jam_notes(const jam_system *sys);
/* Adds one sentence to jam_notes: what a reader of another format changed or assumed. text: one line, not empty. */
JAM_API jam_status jam_add_note(jam_system *sys, const char *text);
/* Writes the packing with 17 digits, so that reading gives the same bits. Links are followed. Pipes, devices and open
 * descriptors (/dev/stdout, /dev/fd/N) are written in place; a file opened with >> gets the packing at its end. A pipe
 * that closes, and the process's limit on file sizes, give JAM_E_IO without a signal. Shifts of JAM_MODEL_MK are not
 * saved: read the file with the same seed and mk_zeta; planted ones need jam_write_checkpoint. Only XYZ can store
 * non_additivity; only XYZ, LAMMPS and VTP walls or a cell that is no cube. @enum format jam_format
 * @errors UNSUPPORTED, IO */
JAM_API jam_status jam_write(const jam_system *sys, const char *path, int32_t format);
/* jam_write in another unit: all lengths are multiplied by scale, 1e-12 to 1e12; scale = 1 gives the bits of jam_write.
 * density of the spheres, > 0: for LAMMPS data; 1 in other formats. @enum format jam_format @errors UNSUPPORTED, IO */
JAM_API jam_status jam_write_scaled(const jam_system *sys, const char *path, int32_t format, double scale,
                                    double density);
/* Formats of contact networks. */
typedef enum jam_contact_format {
  JAM_CONTACTS_AUTO = 0, /* by name: .csv, .dump, .vtp; with .gz behind it compressed; others are refused */
  JAM_CONTACTS_CSV = 1,  /* one line per contact: i, j, unit vector from j to i, gap, force (mean 1), 17 digits */
  JAM_CONTACTS_DUMP = 2, /* the same as a LAMMPS dump local, whose spheres count from 1; d = 2 and 3 */
  JAM_CONTACTS_VTP = 3 /* VTK PolyData in binary, d = 2, 3: two half lines a contact, with force, gap and its number */
} jam_contact_format;
/* Writes the contact network, to a file as of jam_write. @enum format jam_contact_format @errors STATE, UNSUPPORTED,
 * IO */
JAM_API jam_status jam_write_contacts(const jam_system *sys, const char *path, int32_t format);
/* Writes one HTML file that shows the packing in a browser, offline: spheres and forces to turn and to slice, numbers
 * of each sphere, certificate, distributions, and a slider over the steps of a crunch with keep_steps. title: a heading
 * or "". small: the picture alone. values: k rows of numbers, one per sphere, that colour the spheres, or NULL. names:
 * one line per row, or ""; a name ending in [] has d rows: a motion. @shape values (k, n) @bool small @errors IO */
JAM_API jam_status jam_write_page(const jam_system *sys, const char *path, const char *title, int32_t small,
                                  const char *names, const double *values, size_t values_len);

/* ------------------------------------------------------------------ molecular dynamics */
/* jam_compress makes a dense packing, which jam_crunch takes to its jamming point. jam_run is for measurements at one
 * density; jam_observe records what happens in both. */

/* Limits of jam_run (NVE). Whichever comes first ends the run. All but wall_time count since the run began. */
typedef struct jam_run_options {
  uint32_t struct_size;
  int32_t resume;                 /* @bool continue the stopped run; default 0 */
  double collisions_per_particle; /* limit, > 0, default 100 */
  double wall_time;               /* seconds of this call */
  double time; /* limit of simulated time (ends at the last event before it), > 0, default infinity */
} jam_run_options;
/* How the spheres grow. */
typedef enum jam_growth_law {
  JAM_GROWTH_DIAMETER = 0, /* growth_rate is d<sigma>/dt over sqrt(kT/m), constant */
  JAM_GROWTH_DENSITY =
      1 /* growth_rate is d ln<sigma>/dt box / (n^(1/d) sqrt(kT/m)), constant; ln(density) grows d times as fast */
} jam_growth_law;
/* Lubachevsky-Stillinger growth: one stage at a given growth rate, or the two stages of jam_compress, to which targets,
 * limits and growth_law apply too. The target reached first ends the growth. Limits count per stage. At one growth_rate
 * each law is the same protocol at every n. JAM_GROWTH_DENSITY sets a new rate at each 0.5 % of sigma. */
typedef struct jam_compress_options {
  uint32_t struct_size;
  int32_t resume;                 /* @bool continue the stopped stage, with the limits of this call; default 0 */
  double growth_rate;             /* G > 0: one stage at this rate; 0, the default: the two stages of jam_compress */
  double pressure;                /* target reduced pressure of the last stage, > 1, default 1e6 */
  double packing_fraction;        /* target, > 0, default infinity */
  double collisions_per_particle; /* limit, > 0, default infinity */
  double wall_time;               /* limit of this call */
  double time;                    /* limit of simulated time, > 0, default infinity */
  double growth_rate_end; /* final rate, approached as a power of p, in [0, growth_rate]; 0, the default: constant */
  int32_t growth_law;     /* @enum jam_growth_law, default DIAMETER */
  int32_t reserved;
} jam_compress_options;
/* What MD did. Pressure: P V / (N kT) without the part of the growth, kT = sum m v^2 / (d N - periodic axes). */
typedef struct jam_md_report {
  uint32_t struct_size;
  int32_t stop_reason;          /* @enum jam_stop_reason */
  int64_t collisions, events;   /* in this call; with list updates and stale events */
  double collisions_per_second; /* of wall time */
  double pressure;              /* reduced. jam_run: mean since it began; jam_compress: last window */
  double pressure_error;        /* standard error of that mean from its windows; NaN with too few */
  double packing_fraction;      /* at the end */
  double time;                  /* simulated */
  double energy_drift;          /* jam_run: |K_end/K_start - 1| */
  double max_overlap;           /* largest -h of neighbours, examined at events of either sphere, >= 0 */
  double seconds;               /* wall time */
  double growth_rate;           /* d<sigma>/dt over sqrt(kT/m) at the end */
} jam_md_report;
JAM_API jam_status jam_run_options_init(jam_run_options *o, size_t size);
JAM_API jam_status jam_compress_options_init(jam_compress_options *o, size_t size);

/* Event-driven NVE dynamics (Alder and Wainwright, J. Chem. Phys. 31, 459 (1959)). The first use draws
 * Maxwell-Boltzmann velocities by the seed alone, with sum m v^2 = d N and zero total momentum. The handle and its
 * checkpoints keep a run or stage that ended with JAM_CANCELLED or JAM_LIMIT, until the next call that changes spheres.
 * resume = 1 continues it (JAM_E_STATE if there is none) to the same bits as without the stop. If the resumed run
 * fails, the stage is lost, the packing is not. Status: JAM_PRECISION; JAM_NOT_CONVERGED: no collision can happen (one
 * sphere, zero velocities, paths that never meet). The log gives the reason of both. @errors OVERLAP */
JAM_API jam_status jam_run(jam_system *sys, const jam_run_options *o, jam_md_report *report);
/* Lubachevsky-Stillinger compression (J. Stat. Phys. 60, 561 (1990)). Without a growth_rate or with o = NULL it runs
 * the two-stage protocol that avoids crystals in d = 3: G = 1e-2 to p = 500, then G = 3e-3 to the pressure of o, 1e6 by
 * default (a stage costs about d/sqrt(pi) (N/G) ln(p2/p1) collisions). For another protocol make one call per stage. A
 * thermostat keeps sum m v^2 within 5 % of d N, and at the end the velocities are scaled to it exactly. Status:
 * JAM_PRECISION; JAM_NOT_CONVERGED: the pressure was reached before the packing fraction, or immediately since spheres
 * touch; the start is denser than the target; a sphere touches its own image; or simulated time stands still. A resumed
 * call continues with the next stage. Systems below about 200 equal spheres in d = 3 order under this protocol. From a
 * fluid, a packing fraction that these sizes do not reach in disorder is refused. @errors OVERLAP, UNPLACEABLE */
JAM_API jam_status jam_compress(jam_system *sys, const jam_compress_options *o, jam_md_report *report);

/* Writes all that the dynamics depend on to a binary file: positions, diameters, velocities, shifts of the MK model,
 * and a stage that was stopped early or runs now. The file also contains the results (contact network, report,
 * histories, kept steps, isoconfigurational runs), but no observations, memory limit or callbacks. A callback that
 * of jam_run, jam_compress, jam_monte_carlo or jam_crunch saves the packing of the last step, without results; of any
 * other call that of before the call. Dynamics continue from the file to the same bits as without a stop. A crunch
 * continues on its path, and from a dilute start usually ends at another packing. @errors IO */
JAM_API jam_status jam_write_checkpoint(const jam_system *sys, const char *path);
/* Makes a system from a checkpoint. callback, user: as in jam_start. @errors IO, FORMAT (no checkpoint, or damaged, or
 * from a machine with another byte order), OVERLAP */
JAM_API jam_status jam_read_checkpoint(const char *path, jam_progress_fn callback, void *user, jam_system **out);

/* What jam_observe records. */
typedef struct jam_observe_options {
  uint32_t struct_size;
  int32_t collisions;       /* @bool collisions of each sphere, and collisions and momentum of each pair; default 0 */
  int32_t gap_bins, r_bins; /* bins of the gap histogram, 0 (default: none) or >= 2; bins of g(r), default 0: none */
  double sample_every;      /* collisions per particle between samples of the series, gaps and g(r), > 0, default 10 */
  double gap_min, gap_max;  /* end of the first bin, [0, gap_min], > 0, default 1e-8; of the last, <= 10, default 1 */
  double r_max;             /* of g(r), mean diameters, > 0, default 4 */
  double snapshot_every;    /* collisions per particle before the first snapshot; 0, the default: none */
  double snapshot_factor;   /* ratio of successive intervals between snapshots, >= 1, default 1 */
} jam_observe_options;
JAM_API jam_status jam_observe_options_init(jam_observe_options *o, size_t size);
/* Records in all later calls of jam_run and jam_compress until jam_stop_observing; earlier records are dropped.
 * Recording does not change the dynamics. A snapshot calls the progress callback with jam_progress.snapshot > 0; views
 * and const calls in this callback work on the present state. */
JAM_API jam_status jam_observe(jam_system *sys, const jam_observe_options *o);
/* Stops recording; what was recorded can still be read. */
JAM_API jam_status jam_stop_observing(jam_system *sys);
/* Columns of jam_observed_series. */
typedef enum jam_series_column {
  JAM_SERIES_TIME = 0,       /* simulated time */
  JAM_SERIES_COLLISIONS = 1, /* collisions per particle */
  JAM_SERIES_FRACTION = 2,   /* packing fraction */
  JAM_SERIES_PRESSURE = 3,   /* reduced pressure since the sample before */
  JAM_SERIES_ERROR = 4,      /* its standard error, from eight parts of the sample */
  JAM_SERIES_MSD = 5         /* mean-square displacement since jam_observe, unit box^2 */
} jam_series_column;
#define JAM_SERIES_COLUMNS 6
/* Series of samples. @shape table (samples, jam_series_column) @errors STATE (nothing observed) */
JAM_API jam_status jam_observed_series(const jam_system *sys, int32_t columns, double *table, size_t table_len,
                                       size_t *needed);
/* Stress tensor since jam_observe, P_ab V / (N kT), positive in compression: momentum exchanged in collisions, and
 * carried by the spheres. Its trace is d times the reduced pressure. NaN before a collision. @shape out (d, d) @errors
 * STATE */
JAM_API jam_status jam_observed_stress(const jam_system *sys, double *out, size_t out_len, size_t *needed);
/* Collisions and unwrapped displacement of each sphere since jam_observe. *rows = n. @shape collisions (n),
 * displacement (n, d) @errors STATE */
JAM_API jam_status jam_observed_spheres(const jam_system *sys, int64_t *collisions, size_t collisions_len,
                                        double *displacement, size_t displacement_len, size_t *rows);
/* Pairs that collided, their collisions and the exchanged momentum, unit sqrt(m kT), without the part of the growth.
 * momentum / *time (simulated) is the mean force. @shape pair (m, 2), collisions (m), momentum (m) @errors STATE */
JAM_API jam_status jam_observed_pairs(const jam_system *sys, int32_t *pair, size_t pair_len, int64_t *collisions,
                                      size_t collisions_len, double *momentum, size_t momentum_len, double *time,
                                      size_t *rows);
/* Columns of jam_observed_gaps, one row per bin. */
typedef enum jam_gap_column {
  JAM_GAP_LOW = 0,     /* smallest gap h of the bin */
  JAM_GAP_HIGH = 1,    /* largest gap */
  JAM_GAP_DENSITY = 2, /* pairs over those of an ideal gas */
  JAM_GAP_ERROR = 3    /* its standard error over samples */
} jam_gap_column;
#define JAM_GAP_COLUMNS 4
/* Histogram of gaps h, sampled between collisions, since at a collision one more pair touches. As h -> 0 density tends
 * to g(sigma), (p - 1) / (4 phi) for equal spheres in d = 3. @shape table (bins, jam_gap_column) @errors STATE */
JAM_API jam_status jam_observed_gaps(const jam_system *sys, int32_t columns, double *table, size_t table_len,
                                     size_t *needed);
/* Columns of jam_observed_correlation, one row per bin. */
typedef enum jam_correlation_column {
  JAM_CORRELATION_R = 0, /* middle of the bin, mean diameters */
  JAM_CORRELATION_G = 1  /* g(r) */
} jam_correlation_column;
#define JAM_CORRELATION_COLUMNS 2
/* g(r), pairs over N (N - 1) / 2 in these samples. @shape table (bins, jam_correlation_column) @errors STATE */
JAM_API jam_status jam_observed_correlation(const jam_system *sys, int32_t columns, double *table, size_t table_len,
                                            size_t *needed);

/* ------------------------------------------------------------------ Monte Carlo, runs from one configuration */
/* jam_monte_carlo moves the packing; jam_isoconf makes many runs from it, which leave it as it is. */

/* Unit of the overlap x of a soft pair. */
typedef enum jam_energy_unit {
  JAM_ENERGY_LENGTH = 0,  /* x = sigma_ij - r, unit of the box */
  JAM_ENERGY_RELATIVE = 1 /* x = 1 - r / sigma_ij */
} jam_energy_unit;
/* Metropolis Monte Carlo at constant volume. A sweep is one trial of each sphere. */
typedef struct jam_monte_carlo_options {
  uint32_t struct_size;
  int32_t resume;      /* @bool continue the stopped run; only limits are taken from here; default 0 */
  int32_t energy_unit; /* @enum jam_energy_unit, default LENGTH */
  int32_t reserved;
  double alpha, energy_scale; /* 0 (default): hard, above 1, <= 1000: overlap x costs energy_scale x^alpha; default 1 */
  double temperature;         /* of soft spheres, k_B T, default 1 */
  double step;                /* half side of the cube of trials, mean diameters, >= 2^-54 box; 0, the default: tuned */
  double acceptance;          /* that a tuned step aims at, in (0, 1), default 0.45 */
  double swap_share;          /* share of trials that exchange two diameters, in [0, 1), default 0 */
  int64_t sweeps;             /* since the run began, >= 1, default 1000 */
  int64_t run;                /* number of the random stream of this seed, >= 0, default 0 */
  int64_t first_sweep;        /* number of the first sweep in its stream; -1, the default: after the earlier ones */
  double wall_time;           /* seconds of this call */
} jam_monte_carlo_options;
/* What Monte Carlo did. */
typedef struct jam_monte_carlo_report {
  uint32_t struct_size;
  int32_t stop_reason;                /* @enum jam_stop_reason, COLLISIONS when all sweeps were made */
  int64_t sweeps, next_sweep;         /* since the run began; number of the sweep that would come next */
  double acceptance, swap_acceptance; /* of moves; of swaps, NaN without any */
  double step;                        /* used, mean diameters */
  double energy, energy_error;        /* mean energy a sphere; its standard error from 20 parts, NaN with few sweeps */
  double pressure, pressure_error;    /* reduced p, soft: virial, hard: pairs at contact, NaN of few; its error */
  double msd;                         /* mean-square displacement since the run began, box^2 */
  double trials_per_second, seconds;  /* of this call, wall time */
} jam_monte_carlo_report;
JAM_API jam_status jam_monte_carlo_options_init(jam_monte_carlo_options *o, size_t size);
/* Metropolis Monte Carlo (J. Chem. Phys. 21, 1087 (1953)) of hard or soft spheres. step = 0 is tuned in a preliminary
 * run and then kept; JAM_E_ARGUMENT if no trial is accepted. With soft spheres the system allows overlaps from then on,
 * as with JAM_OVERLAP_ALLOW. Random numbers depend only on seed, run, sweep and sphere. Velocities are dropped.
 * jam_observed_spheres gives the displacements. A stopped run can be resumed, also from a checkpoint. @errors STATE,
 * UNSUPPORTED (Mari-Kurchan model), OVERLAP (of hard spheres) */
JAM_API jam_status jam_monte_carlo(jam_system *sys, const jam_monte_carlo_options *o, jam_monte_carlo_report *report);

/* What instants are counted in. Monte Carlo always counts sweeps. */
typedef enum jam_clock {
  JAM_CLOCK_COLLISIONS = 0, /* collisions per particle; each collision counts for both of its spheres */
  JAM_CLOCK_TIME = 1        /* simulated time, box / sqrt(kT/m) at T = 1 */
} jam_clock;
/* Options of jam_isoconf. */
typedef struct jam_isoconf_options {
  uint32_t struct_size;
  int32_t threads;         /* 1 .. 64, default 1; the bits do not depend on it */
  int32_t clock;           /* @enum jam_clock, default COLLISIONS */
  int32_t resume;          /* @bool continue the runs of this handle; default 0 */
  int64_t first_run, runs; /* number of the first run, >= 0, default 0; how many runs, >= 1, default 100 */
  int64_t block;           /* runs per block, >= 1, default 20; sums are kept for each block */
  double density_ratio;    /* packing fraction of the runs over that of the packing, in (0, 1], default 1 */
  double temperature;      /* of the velocities, 1e-18 .. 1e12, default 1 */
  double wave_number;      /* q of F_s, 1 / mean diameter, > 0, at most 1e6, default 7 */
  double overlap_length;   /* spheres that moved less count in the overlap, mean diameters, > 0, default 0.3 */
  double memory_limit;     /* bytes, default 2e9; a larger estimate gives JAM_E_MEMORY before any run */
  double wall_time;        /* seconds of this call */
} jam_isoconf_options;
/* What the runs gave so far. */
typedef struct jam_isoconf_report {
  uint32_t struct_size;
  int32_t stop_reason;              /* @enum jam_stop_reason, COLLISIONS: all made; STALLED: the next run cannot move */
  int64_t first_run, runs;          /* number of the first run; runs in the sums */
  int64_t blocks, instants;         /* blocks that these runs fill or begin; instants of each run */
  double energy_drift, max_overlap; /* largest |K_end/K_start - 1| of a run; largest -h of a run */
  double step, acceptance;          /* Monte Carlo: half side of the trial cube, mean diameters; mean over runs */
  double seconds;                   /* wall time over all calls */
} jam_isoconf_report;
/* Columns of jam_isoconf_series: one number a run and instant, summed over runs. */
typedef enum jam_isoconf_column {
  JAM_ISOCONF_TIME = 0,        /* simulated time, or sweeps */
  JAM_ISOCONF_TIME2 = 1,       /* its square */
  JAM_ISOCONF_MSD = 2,         /* mean of |dr|^2 over spheres, box^2 */
  JAM_ISOCONF_MSD2 = 3,        /* its square */
  JAM_ISOCONF_SCATTERING = 4,  /* mean of cos(q dr_c) over spheres and axes */
  JAM_ISOCONF_SCATTERING2 = 5, /* its square */
  JAM_ISOCONF_OVERLAP = 6,     /* share of spheres that moved less than overlap_length */
  JAM_ISOCONF_OVERLAP2 = 7,    /* its square */
  JAM_ISOCONF_ENERGY = 8,      /* Monte Carlo: energy a sphere */
  JAM_ISOCONF_ENERGY2 = 9,     /* its square */
  JAM_ISOCONF_VELOCITY = 10,   /* sum m v(t).v(0) over sum m v(0).v(0) */
  JAM_ISOCONF_COLLISIONS = 11, /* collisions per particle */
  JAM_ISOCONF_PRESSURE = 12,   /* reduced pressure: since the start of the run; soft spheres: at the instant */
  JAM_ISOCONF_RUNS = 13        /* runs in these sums and in those of the next two calls, the same at each instant */
} jam_isoconf_column;
#define JAM_ISOCONF_COLUMNS 14
JAM_API jam_status jam_isoconf_options_init(jam_isoconf_options *o, size_t size);
/* Isoconfigurational ensemble (Widmer-Cooper et al., Phys. Rev. Lett. 93, 135701 (2004)): runs that all start from
 * the packing, which does not change, with its diameters scaled to density_ratio (refused if gaps are then
 * rounding). Run k draws its velocities from its own stream. m NULL: molecular dynamics; else Monte Carlo with these
 * options (not sweeps, run, first_sweep, resume, wall_time). instant: ascending, > 0. kept: indices of instants
 * whose displacements every run keeps, or NULL. The handle keeps the sums, added in the order of run numbers, until
 * the next call. A stopped call keeps the finished runs, also in checkpoints; resume continues. Status:
 * JAM_NOT_CONVERGED (a run cannot move). @shape instant (instants), kept (k) @errors STATE (nothing to resume, or
 * not the same), OVERLAP, UNSUPPORTED */
JAM_API jam_status jam_isoconf(jam_system *sys, const jam_isoconf_options *o, const jam_monte_carlo_options *m,
                               const double *instant, size_t instant_len, const int32_t *kept, size_t kept_len,
                               jam_isoconf_report *report);
/* Report of the runs that the handle keeps. @errors STATE (no runs) */
JAM_API jam_status jam_get_isoconf_report(const jam_system *sys, jam_isoconf_report *report);
/* Sums over the runs of a block (-1: all). @shape table (instants, jam_isoconf_column) @errors STATE */
JAM_API jam_status jam_isoconf_series(const jam_system *sys, int64_t block, int32_t columns, double *table,
                                      size_t table_len, size_t *needed);
/* Sums over the runs of a block (-1: all) of the displacement dr_c of each sphere, unit of the box, and of its square.
 * *rows = instants. @shape displacement (instants, n, d), square (instants, n, d) @errors STATE */
JAM_API jam_status jam_isoconf_displacements(const jam_system *sys, int64_t block, double *displacement,
                                             size_t displacement_len, double *square, size_t square_len, size_t *rows);
/* Sums over the runs of a block (-1: all) of |dr|^2 and |dr|^4 of each sphere. @shape distance2 (instants, n),
 * distance4 (instants, n) @errors STATE */
JAM_API jam_status jam_isoconf_distances(const jam_system *sys, int64_t block, double *distance2, size_t distance2_len,
                                         double *distance4, size_t distance4_len, size_t *rows);
/* Displacements at one kept instant, given by its index. @shape out (runs, n, d) @errors STATE */
JAM_API jam_status jam_isoconf_kept(const jam_system *sys, int32_t instant, double *out, size_t out_len,
                                    size_t *needed);

/* ------------------------------------------------------------------ crunch to the jamming point */
/* jam_crunch is the call for users, its report the certificate; history and steps are for studies of the method. */

/* How the LPs are solved. */
typedef enum jam_lp_solver {
  JAM_LP_IPM = 0, /* libjam's interior point on the particle graph; Clp if it fails */
  JAM_LP_CLP = 1  /* Clp's simplex: slow, independent */
} jam_lp_solver;
/* Quench to the jamming point. Both methods end with fully solved LPs in which no sphere moves. The barrier path begins
 * with LPs far from jamming; then its constraints are linearised anew after each Newton step. */
typedef enum jam_crunch_method {
  JAM_CRUNCH_BARRIER_PATH = 0, /* fewest factorisations; usually denser packings */
  JAM_CRUNCH_SEQUENTIAL_LP = 1 /* only LPs, as published */
} jam_crunch_method;
/* Strains of axes without walls that jam_crunch or jam_relax may make; the volume is fixed without VOLUME. */
typedef enum jam_free_strain {
  JAM_STRAIN_NONE = 0,         /* a fixed cell */
  JAM_STRAIN_EDGES = 1,        /* the diagonal of the cell: lengths of a brick */
  JAM_STRAIN_TILTS = 2,        /* components off the diagonal */
  JAM_STRAIN_FREE = 3,         /* both */
  JAM_STRAIN_VOLUME = 4,       /* the volume; this kind and the following need a pressure: jam_relax, jam_shear */
  JAM_STRAIN_EDGES_VOLUME = 5, /* each edge by itself */
  JAM_STRAIN_TILTS_VOLUME = 6, /* tilts and the volume */
  JAM_STRAIN_ALL = 7           /* edges, tilts and the volume */
} jam_free_strain;
/* Options of jam_crunch. Lengths are in mean diameters. The guide's page "Coming from other programs" names the
 * parameter of CALiPPSO.jl beside each.
 * - polish: 1 ends the LPs at a gain below gain_tolerance, even if rattlers still move. 0: the last LP's answer.
 * - full_lps: 0 stops an LP that gains more than 1e-7 at a duality gap of 0.02 times its gain.
 * - strain: after the optimum in the fixed cell, the cell deforms at fixed volume; FREE ends strictly jammed, or as
 *   a saddle. A single sphere needs a strain, since its contacts are with its own images.
 * - keep_steps: if there are more states, or more than 2^24 coordinates, every second, fourth, ... state is kept.
 * - duality_gap: for packings too large to reach the jamming point. The barrier path ends at this duality gap, and an
 *   LP determines contacts and balanced forces. The report gives the duality gap e of these forces: to first order no
 *   motion increases Gamma by more than e, so phi_J is about phi (1 + e)^(d/2). Contacts that a smaller gap may change
 *   count as undecided. Needs BARRIER_PATH and no strain. */
typedef struct jam_crunch_options {
  uint32_t struct_size;
  int32_t lp_solver;       /* @enum jam_lp_solver, default IPM */
  int32_t method;          /* @enum jam_crunch_method, default BARRIER_PATH */
  int32_t polish;          /* @bool at the end Newton steps close contacts and balance forces to rounding; default 1 */
  int32_t max_lps;         /* of all LPs, narrow ones and those after a decompression too; >= 1, default 1000 */
  int32_t threads;         /* 1 .. 64, default 1; 2 to 64 give the same bits, 1 may give others */
  double gain_tolerance;   /* on sqrt(Gamma) - 1, > 0, default 1e-12 */
  double step_tolerance;   /* on max |s_i| of non-rattlers, > 0, default 1e-9 */
  double lp_tolerance;     /* relative complementarity, residual of an LP, default 1e-15; above 1e-9 it acts as 1e-9 */
  double neighbour_radius; /* LPs contain pairs with gap < this - largest diameter; 0, the default: adapts */
  double step_bound;       /* bound on each |s_i| component, >= gain_tolerance, 1e-15 .. 1000; 0, the default: adapts */
  double wall_time;        /* limit of the call, its proof included */
  int32_t steps;           /* @bool the callback is called at every step and may call jam_crunch_step; default 0 */
  int32_t full_lps;        /* @bool every LP is solved to lp_tolerance, so that its network balances; default 0 */
  int32_t strain;          /* @enum jam_free_strain, default NONE */
  int32_t keep_steps;      /* states before the end that are kept for jam_write_page, 0 .. 1000, default 0 */
  double duality_gap;      /* 0, the default: to the jamming point; or 1e-12 .. 1e-2 */
  int32_t prove;           /* @bool a packing that ends jammed is proved collectively jammed by jam_prove; default 0 */
  int32_t reserved;
} jam_crunch_options;
/* Result and certificate of jam_crunch. If contacts are unknown, as after an early stop, counts are -1 (stable and
 * excess_contacts 0), forces and gaps NaN, and calls that need them return JAM_E_STATE. packing_fraction_start to
 * contacts_kept compare before and after; displacements include rattlers and a strain of the cell. After
 * JAM_STOP_DUALITY_GAP undecided_contacts counts pairs with 1e-4 < f / (2 h) < 1e4, f: force / mean force. */
typedef struct jam_crunch_report {
  uint32_t struct_size;
  int32_t jammed;          /* @bool collectively jammed by the test of jam_rigidity; 0: not, undecided, untested */
  int32_t stop_reason;     /* @enum jam_stop_reason */
  int32_t lp_solver;       /* @enum jam_lp_solver that gave the last LP */
  int32_t method;          /* @enum jam_crunch_method that led here: BARRIER_PATH if the path was followed */
  int32_t stationary;      /* @bool contact forces balance: to first order no motion lets diameters grow */
  int32_t strictly_jammed; /* @enum jam_verdict of jam_rigidity, or of a crunch with a strain; else UNTESTED */
  int32_t reserved;
  double packing_fraction;        /* phi_J when jammed */
  double diameter_mean;           /* unit of box */
  int64_t contacts;               /* pairs with a force, without rattlers */
  int64_t rattlers, stable;       /* spheres that no force-carrying contact touches; n - rattlers = N', or 0 */
  int64_t bucklers;               /* stable spheres with exactly d+1 contacts */
  int64_t isostatic_contacts;     /* d (N' - 1) + 1: contacts of a single state of self-stress */
  int64_t excess_contacts;        /* contacts - isostatic_contacts: 0 isostatic or no network, > 0 hyperstatic */
  int64_t flexes;                 /* motions of stable spheres beyond symmetries that keep contacts with force closed */
  int64_t zero_force_contacts;    /* closed pairs without force in every state of self-stress, those of rattlers too */
  int64_t undecided_contacts;     /* pairs with gaps of 1e-10 to 1e-7; after JAM_STOP_DUALITY_GAP as above */
  int64_t undercoordinated;       /* stable spheres with d force-carrying contacts or fewer */
  int64_t strict_contacts_needed; /* d (N' - 1) + d (d + 1) / 2: fewest contacts of a strictly jammed packing */
  double rigidity_margin;         /* as in jam_rigidity_report */
  int64_t lp_solves, factorisations; /* LPs solved in full; Cholesky factorisations */
  double gain;                       /* sqrt(Gamma) - 1 of the last LP */
  double max_step;                   /* largest |s_i| of a stable sphere in the last LP, mean diameters */
  double max_overlap;                /* largest -h over all pairs, >= 0 */
  double force_residual;             /* largest |sum_j f_ij n_ij| over mean force */
  double gamma_residual;             /* |sum lambda_ij sigma_ij^2 - 1| of the last LP */
  double min_force;                  /* smallest contact force over the mean */
  double min_gap;                    /* least h of stable spheres not in contact; in a free cell also of own images */
  double max_contact_gap;            /* largest |h| of a contact */
  double duality_gap;             /* of the last LP, relative to Gamma; after JAM_STOP_DUALITY_GAP that of the forces */
  double force_scale;             /* mean force in units where sum lambda sigma^2 = 1 (lambda r) */
  double seconds, seconds_factor; /* wall time of crunch; of it in factorisations */
  double seconds_assemble, seconds_solve;    /* of it in neighbour lists and assembly; of it in triangular solves */
  int32_t status;                            /* @enum jam_status_code of the call that made this report */
  int32_t decompressions;                    /* how many, each after an end that was not shown to be jammed */
  double packing_fraction_start;             /* before this call */
  double displacement_max, displacement_rms; /* largest displacement; root of the mean square */
  double displacement_max_stable, displacement_rms_stable; /* the same over spheres with contacts at the end */
  int64_t contacts_start;       /* pairs that touched before, as far as the digits of the coordinates show */
  int64_t contacts_kept;        /* those of them that are contacts of this report */
  int32_t theorem, proof_cause; /* @enum jam_theorem, NONE without prove; @enum jam_proof_cause: why it is not EXACT */
  double proof_radius;          /* unit of the box: radius of EXACT, inner of TRAPPED (jam_proof_report), or infinite */
  double proof_value, proof_bound; /* the two numbers of the cause */
} jam_crunch_report;
JAM_API jam_status jam_crunch_options_init(jam_crunch_options *o, size_t size);
/* Brings the packing to its jamming point and keeps the contact network (o->method; Artiaco et al., Phys. Rev. E 106,
 * 055310 (2022)). No step creates an overlap. If the packing is not shown to be jammed, the crunch decreases the
 * diameters by 1e-4 to 0.1, displaces the spheres at random by less than half of that, and compresses again. A stopped
 * crunch leaves a valid packing, a stopped proof the verdict too. Another call, also from a checkpoint, continues on
 * the path at its mu; bits may differ, and its report counts its own steps and times. Status: JAM_OK jammed, or at the
 * duality gap of the options (`jammed` is then 0, and another call continues); JAM_NOT_CONVERGED, JAM_NOT_JAMMED with
 * the last valid state. An error amid the steps keeps the last good state with a report, and another call continues.
 * @errors OVERLAP, TOO_FEW (one sphere in a fixed cell), SOLVER */
JAM_API jam_status jam_crunch(jam_system *sys, const jam_crunch_options *o, jam_crunch_report *report);

/* Memory and time of a crunch, estimated from the graph of pairs and its elimination tree. */
typedef struct jam_estimate_report {
  uint32_t struct_size;
  int32_t reserved;
  int64_t pairs;         /* of the longest neighbour list */
  double bytes;          /* peak memory on top of that in use; for spheres above 20 MB mostly within 30 % */
  double factor_bytes;   /* of it for the factorisation */
  double flops;          /* of one factorisation on the path (sequential LPs: of the widest LP) */
  double factorisations; /* median of packings equally near to jamming; one packing may differ by a factor of 2 */
  double step_seconds;   /* one factorisation and its assembly and solves, on this core; mean of first LP and path */
  double seconds;        /* factorisations * step_seconds */
  /* Nine of ten crunches end between these; decompressions, narrow LPs and saddles of crystals cannot be predicted. */
  double seconds_low, seconds_high;
} jam_estimate_report;
/* Estimates memory and time of jam_crunch with these options (NULL: defaults) without running it; jam_crunch logs the
 * same at JAM_LOG_INFO. Takes as long as a few steps. @errors OVERLAP, TOO_FEW */
JAM_API jam_status jam_estimate_crunch(const jam_system *sys, const jam_crunch_options *o, jam_estimate_report *report);
/* The report of the last crunch. @errors STATE */
JAM_API jam_status jam_get_crunch_report(const jam_system *sys, jam_crunch_report *report);

/* What kind of step a row of the history is. */
typedef enum jam_step_phase {
  JAM_STEP_PATH = 1,  /* a Newton step of the barrier path; or a decompression, which opens contacts */
  JAM_STEP_LP = 2,    /* an LP and the move to its solution */
  JAM_STEP_POLISH = 3 /* contacts closed and forces balanced to rounding */
} jam_step_phase;
/* Columns of the history of a crunch, one row per step. Displacements: as in reports. */
typedef enum jam_history_column {
  JAM_HISTORY_PHASE = 0,           /* a jam_step_phase */
  JAM_HISTORY_GAIN = 1,            /* sqrt(Gamma) - 1: relative growth of the diameters in this step */
  JAM_HISTORY_PHI = 2,             /* packing fraction after the step */
  JAM_HISTORY_STEP_MAX = 3,        /* largest displacement in this step */
  JAM_HISTORY_STEP_MSD = 4,        /* mean-square displacement in this step */
  JAM_HISTORY_TOTAL_MAX = 5,       /* largest displacement since the start of the crunch */
  JAM_HISTORY_TOTAL_MSD = 6,       /* mean-square displacement since then */
  JAM_HISTORY_CONTACTS = 7,        /* LP: pairs of stable spheres that carry force in it */
  JAM_HISTORY_EXCESS = 8,          /* LP: contacts - (d (N' - 1) + 1) */
  JAM_HISTORY_RATTLERS = 9,        /* LP: spheres that are not stable */
  JAM_HISTORY_SECONDS = 10,        /* wall time of the step */
  JAM_HISTORY_ITERATIONS = 11,     /* of the LP solver; Newton steps elsewhere */
  JAM_HISTORY_FACTORISATIONS = 12, /* in this step */
  JAM_HISTORY_DUALITY_GAP = 13,    /* after the step, in Gamma */
  JAM_HISTORY_PAIRS = 14,          /* rows of the LP */
  JAM_HISTORY_HELD = 15,           /* LP: displacement components at the step bound, whose forces do not balance */
  JAM_HISTORY_PART = 16,  /* LP: part of the step that was made; below 1 where an unlisted pair would overlap */
  JAM_HISTORY_BOUND = 17, /* LP: step bound */
  JAM_HISTORY_STEP_MSD_STABLE = 18, /* LP, polish: STEP_MSD over stable spheres only, relative to their mean */
  JAM_HISTORY_TOTAL_MSD_STABLE = 19 /* LP, polish: TOTAL_MSD over the spheres that are stable now */
} jam_history_column;
#define JAM_HISTORY_COLUMNS 20
/* Steps of the last crunch. @shape table (steps, jam_history_column) @errors STATE */
JAM_API jam_status jam_crunch_history(const jam_system *sys, int32_t columns, double *table, size_t table_len,
                                      size_t *needed);
/* The step that has just ended; only in the progress callback of jam_crunch with steps = 1. displacement of all
 * spheres, unit of box, a strain included, without wrapping: those of all steps add up from start to end, unless the
 * cell was rotated (jam_notes). The other arrays describe an LP: its *rows = m pairs with a positive dual, rattlers
 * included; m = 0 after other steps. vector: r_ij, dual: lambda_ij, with sum lambda_ij sigma_ij^2 = 1, r and sigma
 * before the step, and sum_j lambda_ij r_ij = 0 on every sphere without an active step bound, unless the LP ended early
 * (full_lps). @shape displacement (n, d), pair (m, 2), vector (m, d), dual (m) @errors STATE */
JAM_API jam_status jam_crunch_step(const jam_system *sys, double *displacement, size_t displacement_len, int32_t *pair,
                                   size_t pair_len, double *vector, size_t vector_len, double *dual, size_t dual_len,
                                   size_t *rows);

/* ------------------------------------------------------------------ radii as unknowns */
/* Options of jam_maximise_radii. Lengths are in the unit of the box. With a strain the cell deforms at fixed volume. */
typedef struct jam_radii_options {
  uint32_t struct_size;
  int32_t threads;               /* 1 .. 64, default 1; 2 to 64 give the same bits, 1 may give others */
  double radius_min, radius_max; /* default 0; infinity. radius_min is below radius_max and half the longest edge */
  double room; /* share of each radius that is taken off first, in (0, 1), default 0.1; small: stays near the start */
  int64_t max_steps; /* of Newton's method, >= 1, default 100000 */
  double wall_time;  /* limit of the call */
  int64_t moments;   /* 0, the default: the sum; 1 .. 4: so many power sums keep their ratios, of these exponents: */
  double exponent_1, exponent_2, exponent_3, exponent_4; /* |exponent| in [0.01, 8], 0.01 apart, default 1; 2; 3; 4 */
  int32_t strain;                                        /* @enum jam_free_strain, up to FREE, default NONE */
  int32_t reserved;
} jam_radii_options;
/* What jam_maximise_radii found. Where maximum is 0, contacts to excess are -1, balance_residual to min_force NaN. */
typedef struct jam_radii_report {
  uint32_t struct_size;
  int32_t stop_reason;        /* @enum jam_stop_reason, CONVERGED at a maximum */
  int32_t maximum;            /* @bool contacts closed, forces >= 0 that balance, and no saddle */
  int32_t saddles;            /* that it moved away from */
  double value;               /* sum of w_i R_i; moments: lambda, 1 at the start */
  int64_t contacts, rattlers; /* pairs and walls with force; spheres without, all held by a bound or the moments */
  int64_t at_bounds;          /* radii held by radius_min or radius_max */
  int64_t excess; /* contacts + at_bounds + max(moments, 1) - 1 - ((d + 1) n - symmetries + strains), mostly 0 */
  double balance_residual; /* largest of balance and sums of forces, over the sphere's weight; of strains, over all */
  double max_contact_gap, min_gap; /* largest |distance - sum of radii| of a contact; least of another pair */
  double min_force; /* least force, in units of value; forces on sphere i add up to w_i minus that of its bound */
  double radius_smallest, radius_largest, polydispersity; /* standard deviation of the radii over their mean */
  double packing_fraction;
  int64_t steps, factorisations;                                 /* of Newton's method; Cholesky factorisations */
  double seconds;                                                /* wall time */
  double multiplier_1, multiplier_2, multiplier_3, multiplier_4; /* lambda_q of the moments, else NaN */
  double moment_residual; /* largest |M_q / (lambda^q M_q of the start) - 1|; 0 for a sum */
} jam_radii_report;
JAM_API jam_status jam_radii_options_init(jam_radii_options *o, size_t size);
/* Moves spheres and changes radii to a local maximum of sum w_i R_i, w_i = 1 if weights is NULL; jam_crunch keeps the
 * ratios of radii. With moments: to a maximum of lambda, where sum R_i^q = lambda^q M_q for each q, M_q at the start;
 * forces on sphere i add up to sum_q lambda_q q R_i^(q - 1), and radius_min is at least 1e-3 of the smallest and 2e-4
 * of the largest radius. A stopped call leaves a valid packing. No pair overlaps, in two doubles. At a maximum the
 * handle keeps the network, with forces of mean 1, and the verdict of jam_rigidity. Status: JAM_LIMIT,
 * JAM_NOT_CONVERGED with the last valid state: if a sphere gets as wide as its wall or contacts are not found.
 * @shape weights (n) @errors OVERLAP, UNSUPPORTED */
JAM_API jam_status jam_maximise_radii(jam_system *sys, const jam_radii_options *o, const double *weights,
                                      size_t weights_len, jam_radii_report *report);

/* ------------------------------------------------------------------ soft spheres */
/* Spheres that overlap repel by an energy U = sum of v over overlapping pairs, v = c ((sigma_ij - r) / l)^alpha.
 * Energies are in units of epsilon, pressures in epsilon / length^d. Systems with overlaps need JAM_OVERLAP_ALLOW. F_i:
 * force on sphere i. Rattlers (fewer than d + 1 contacts) are removed recursively; the others are stable. */

/* Factor c and length l of the energy. */
typedef enum jam_soft_scale {
  JAM_SOFT_RELATIVE = 0, /* c = 1 / alpha, l = sigma_ij: overlaps relative to the contact distance */
  JAM_SOFT_ABSOLUTE = 1, /* c = 1 / alpha, l = 1 in the unit of the box */
  JAM_SOFT_BARE = 2      /* c = 1, l = 1 */
} jam_soft_scale;
/* How the energy is minimised. From one start the methods reach different minima: each is a protocol. NEWTON:
 * L-BFGS until the contacts stop changing, then Newton's method with pre-stress. Methods move away from saddles;
 * all except NEWTON test for them only up to some 5000 spheres (d = 3), and the log says so. */
typedef enum jam_minimiser {
  JAM_MINIMISER_NEWTON = 0, /* Newton's method; rattlers are put in the middle of their cages */
  JAM_MINIMISER_FIRE = 1,   /* FIRE 2.0 alone (Guenole et al., Comput. Mater. Sci. 175, 109584 (2020)) */
  JAM_MINIMISER_LBFGS = 2   /* limited-memory BFGS alone (Nocedal, Math. Comput. 35, 773 (1980)) */
} jam_minimiser;
/* How the overlap of a pair is computed. */
typedef enum jam_soft_precision {
  JAM_SOFT_REFERENCE = 0, /* displacements from reference gaps in twice the digits: balance to 1e-14 at any overlap */
  JAM_SOFT_DOUBLE = 1     /* from coordinates in doubles: balance to about 1e-15 / overlap; for comparison */
} jam_soft_precision;
/* Options of jam_relax. A free cell is minimised after the minimum of the fixed one, and far from P in steps. */
typedef struct jam_relax_options {
  uint32_t struct_size;
  int32_t minimiser;       /* @enum jam_minimiser, default NEWTON */
  int32_t scale;           /* @enum jam_soft_scale, default RELATIVE */
  int32_t precision;       /* @enum jam_soft_precision, default REFERENCE */
  double alpha;            /* exponent of the energy, above 1, at most 12, default 2 */
  double force_tolerance;  /* on max |F_i| of stable spheres over the mean contact force, > 0, default 1e-12 */
  int64_t max_evaluations; /* of the forces, >= 1, default 1e6 */
  double wall_time;        /* limit of the call */
  int32_t strain;          /* @enum jam_free_strain, default NONE */
  int32_t reserved;
  double pressure; /* P > 0 with JAM_STRAIN_VOLUME: U + P V is minimised, of unjammed starts too; else 0, the default */
  int64_t components; /* bit c d + k: edge (c, c) or tilt (c, k), c < k, may change; default -1: all. Not VOLUME */
} jam_relax_options;
/* What jam_relax found. */
typedef struct jam_relax_report {
  uint32_t struct_size;
  int32_t converged;       /* @bool both residuals are below force_tolerance, or no spheres overlap */
  int32_t stop_reason;     /* @enum jam_stop_reason */
  int32_t minimiser;       /* @enum jam_minimiser */
  double force_residual;   /* max |F_i| of stable spheres over the mean contact force; 0 without contacts */
  double energy, pressure; /* U; sum of f r over d V */
  double packing_fraction; /* of the diameters, overlaps counted twice */
  double distance;         /* alpha U / sum of f r, an estimate of ln(R / R_J) */
  double jammed_fraction;  /* phi (1 - distance)^d, an estimate of phi_J */
  double coordination;     /* mean number of contacts of a stable sphere */
  double mean_overlap,
      max_overlap; /* mean of (sigma - r) / sigma over contacts of stable spheres; largest of all pairs */
  int64_t contacts, excess_contacts;   /* overlapping pairs of stable spheres; contacts - (d (stable - 1) + 1) */
  int64_t stable, rattlers;            /* n - rattlers; spheres not in the network */
  int64_t evaluations, factorisations; /* of the forces; of the Hessian */
  double seconds;                      /* wall time */
  double stress_residual;              /* free cell: largest difference of stress and target, over the pressure */
} jam_relax_report;
JAM_API jam_status jam_relax_options_init(jam_relax_options *o, size_t size);
/* Minimises the energy of overlapping spheres at fixed diameters, and at a fixed cell unless `strain` frees it. With a
 * free cell, stresses too fall below force_tolerance. The handle keeps the contact network with its forces and
 * stiffnesses for jam_contacts, jam_forces, jam_hessian (JAM_STIFFNESS_SOFT) and the like. Positions are rounded to
 * doubles at the end; the network has further digits. Status: JAM_NOT_JAMMED: energy 0, no overlaps. JAM_PRECISION:
 * overlaps are below the rounding of positions, or forces at rounding. JAM_NOT_CONVERGED. Example: examples/c/soft.c
 * @errors STATE (made without JAM_OVERLAP_ALLOW), OVERLAP (wider than the cell) */
JAM_API jam_status jam_relax(jam_system *sys, const jam_relax_options *o, jam_relax_report *report);

/* Options of jam_decompress. The target reached first ends the decompression. With crunch, a copy is crunched from just
 * below contact, and the decompression continues until both have the same network; the system ends as the crunched
 * packing. Without crunch it ends as the soft one. max_evaluations: a later step may take 4 times the evaluations of
 * all earlier ones, but at least 1/20 of this limit and at most the limit. */
typedef struct jam_decompress_options {
  uint32_t struct_size;
  int32_t minimiser;         /* @enum jam_minimiser, default NEWTON */
  int32_t scale;             /* @enum jam_soft_scale, default RELATIVE */
  int32_t precision;         /* @enum jam_soft_precision, default REFERENCE */
  double alpha;              /* exponent of the energy, above 1, at most 12, default 2 */
  double force_tolerance;    /* as in jam_relax_options, default 1e-12 */
  double energy_factor;      /* of U per step, in (0, 1), default 0.01; closer to 1 after a failed step */
  double pressure, distance; /* targets, as in jam_relax_report, >= 0, default 0: none */
  int32_t isostatic;         /* @bool end at contacts of one self-stress and d zero modes of the Hessian; default 1 */
  int32_t crunch;            /* @bool then crunch; default 1 */
  int32_t max_steps;         /* >= 1, default 1000 */
  int32_t reserved;
  int64_t max_evaluations; /* of the forces, in one step, >= 1, default 1e6 */
  double wall_time;        /* limit of the call */
} jam_decompress_options;
/* What jam_decompress found: numbers of the last soft packing as in jam_relax_report, and what crunch made of it. */
typedef struct jam_decompress_report {
  uint32_t struct_size;
  int32_t stop_reason;     /* @enum jam_stop_reason */
  int32_t isostatic;       /* @bool contacts of one state of self-stress and d zero modes of the Hessian */
  int32_t same_network;    /* 1: crunch ended with the same contacts; 0: with others; -1: it did not end */
  double force_residual;   /* max |F_i| of stable spheres over the mean contact force */
  double energy, pressure; /* U; sum of f r over d V */
  double packing_fraction; /* of the soft packing */
  double distance;         /* estimate of ln(R / R_J) */
  double jammed_fraction, crunch_fraction; /* estimate of phi_J; phi_J by crunch, NaN if it did not end */
  double force_difference;                 /* largest |f_soft - f_crunch| over the mean; NaN without the same network */
  double coordination;                     /* mean number of contacts of a stable sphere */
  int64_t contacts, excess_contacts;       /* overlapping pairs of stable spheres; contacts - (d (stable - 1) + 1) */
  int64_t common_contacts;                 /* with crunch; -1 if it did not end */
  int64_t rattlers;                        /* spheres not in the network */
  int64_t steps, restored;                 /* of the decompression; steps undone because they lost the network */
  int64_t evaluations, factorisations;     /* of the forces; of the Hessian, crunch not counted */
  double seconds, seconds_crunch;          /* wall time; of it in crunch */
} jam_decompress_report;
/* Columns of the history of a decompression, one row per minimum. */
typedef enum jam_soft_column {
  JAM_SOFT_PHI = 0,            /* packing fraction */
  JAM_SOFT_PRESSURE = 1,       /* epsilon / length^d */
  JAM_SOFT_ENERGY = 2,         /* U / n */
  JAM_SOFT_COORDINATION = 3,   /* mean number of contacts of a stable sphere */
  JAM_SOFT_DISTANCE = 4,       /* alpha U / sum of f r */
  JAM_SOFT_EXCESS = 5,         /* contacts - (d (stable - 1) + 1) */
  JAM_SOFT_RATTLERS = 6,       /* spheres not in the network */
  JAM_SOFT_RESIDUAL = 7,       /* max |F_i| over the mean force */
  JAM_SOFT_EVALUATIONS = 8,    /* of the forces, in this step */
  JAM_SOFT_FACTORISATIONS = 9, /* in this step */
  JAM_SOFT_SECONDS = 10        /* wall time of the step */
} jam_soft_column;
#define JAM_SOFT_COLUMNS 11
JAM_API jam_status jam_decompress_options_init(jam_decompress_options *o, size_t size);
/* From overlapping spheres down to jamming. Each step minimises and then shrinks all diameters by one factor, so that
 * the energy falls by energy_factor (O'Hern et al., Phys. Rev. E 68, 011306 (2003)). A step that leaves too few
 * contacts is undone and tried with the square root of its factor. Status: JAM_OK: a target was reached; with isostatic
 * and crunch, both networks agree. JAM_NOT_JAMMED: the first minimum has no overlaps. JAM_PRECISION: overlaps, forces
 * or steps reached rounding first. JAM_NOT_CONVERGED: the last minimum is kept. @errors STATE, TOO_FEW, SOLVER */
JAM_API jam_status jam_decompress(jam_system *sys, const jam_decompress_options *o, jam_decompress_report *report);
/* Minima of the last decompression. @shape table (minima, jam_soft_column) @errors STATE */
JAM_API jam_status jam_decompress_history(const jam_system *sys, int32_t columns, double *table, size_t table_len,
                                          size_t *needed);

/* When a shear ends before its last strain. */
typedef enum jam_shear_until {
  JAM_UNTIL_STRAIN = 0,  /* it does not */
  JAM_UNTIL_EVENT = 1,   /* after the first plastic event */
  JAM_UNTIL_JAMMED = 2,  /* at the first minimum whose contacts carry force */
  JAM_UNTIL_UNJAMMED = 3 /* at the first minimum without such contacts */
} jam_shear_until;
/* Options of jam_shear. Those from minimiser to max_evaluations and from strain on are of soft spheres, as in
 * jam_relax_options; with hard spheres they must have their defaults. */
typedef struct jam_shear_options {
  uint32_t struct_size;
  int32_t minimiser;       /* @enum jam_minimiser, default NEWTON */
  int32_t scale;           /* @enum jam_soft_scale, default RELATIVE */
  int32_t precision;       /* @enum jam_soft_precision, default REFERENCE */
  double alpha;            /* exponent of the energy, above 1, at most 12, default 2 */
  double force_tolerance;  /* on max |F_i| of stable spheres over the mean contact force, > 0, default 1e-12 */
  int64_t max_evaluations; /* of the forces, for one minimum, >= 1, default 1e6 */
  double wall_time;        /* limit of the call */
  double step;             /* strain between two minima; times the largest number of mode >= 1e-15; default 1e-3 */
  double resolution;       /* uncertainty of the strain of an event, >= 1e-15, default 1e-6 */
  int64_t max_steps;       /* minima, >= 1, default 1e6 */
  int32_t until;           /* @enum jam_shear_until, default STRAIN */
  int32_t strain;          /* @enum jam_free_strain, what else of the cell may change, default NONE */
  double pressure;         /* P > 0 with JAM_STRAIN_VOLUME; else 0, the default */
  int64_t components;      /* bit c d + k: strain (c, k), c <= k, may change too; default -1: all but those of mode */
} jam_shear_options;
/* Columns of jam_shear_history: a row for the start, every step, and the states just before and after an event.
 * Comparisons are with the row before. Pressure is positive in compression, JAM_SHEAR_STRESS when the packing resists.
 * Stresses of soft spheres are in epsilon / length^d, of hard spheres in multiples of the pressure. */
typedef enum jam_shear_column {
  JAM_SHEAR_STRAIN = 0,    /* amplitude of the mode since the start of the call */
  JAM_SHEAR_STRESS = 1,    /* (1 / V) dU / dstrain, rest of the cell fixed: - sum of mode_ab S_ab, S: jam_stress */
  JAM_SHEAR_PRESSURE = 2,  /* trace of the stress over d; hard spheres: 1 */
  JAM_SHEAR_ENERGY = 3,    /* U / n; hard spheres: 0 */
  JAM_SHEAR_PHI = 4,       /* packing fraction; hard spheres: phi_J */
  JAM_SHEAR_CONTACTS = 5,  /* of stable spheres */
  JAM_SHEAR_MADE = 6,      /* contacts that the row before does not have */
  JAM_SHEAR_BROKEN = 7,    /* contacts of the row before that are gone */
  JAM_SHEAR_NONAFFINE = 8, /* root mean square displacement beyond the affine one, of stable spheres, mean diameters */
  JAM_SHEAR_EVENT = 9,     /* 1: a plastic event between the row before and this one, else 0 */
  JAM_SHEAR_RATTLERS = 10, /* spheres not in the network */
  JAM_SHEAR_EVALUATIONS = 11,   /* of the forces since the row before; hard spheres: 0 */
  JAM_SHEAR_FACTORISATIONS = 12 /* since the row before */
} jam_shear_column;
#define JAM_SHEAR_COLUMNS 13
/* What jam_shear found. stress, pressure, peak_stress and peak_strain are NaN where nothing was rigid. */
typedef struct jam_shear_report {
  uint32_t struct_size;
  int32_t stop_reason; /* @enum jam_stop_reason: STRAIN at the last strain, else why before */
  int32_t rigid;       /* @bool contacts carry force at the end */
  int32_t reserved;
  double strain;                       /* reached: amplitude at the end */
  double stress, pressure;             /* at the end, as in the history */
  double energy, packing_fraction;     /* U, NaN without a first minimum; of the diameters, hard: phi_J */
  double first_event;                  /* strain before the first event, known to the resolution; NaN: none */
  double peak_stress, peak_strain;     /* largest |stress| of all rows, with its sign, and where */
  int64_t events, steps;               /* plastic events; minima, those of located events too */
  int64_t contacts, rattlers;          /* at the end; -1 without a first minimum */
  int64_t evaluations, factorisations; /* of the forces; of matrices */
  double seconds;                      /* wall time */
} jam_shear_report;
JAM_API jam_status jam_shear_options_init(jam_shear_options *o, size_t size);
/* Athermal quasi-static shear: after each strain step, minimises the energy of soft spheres (JAM_OVERLAP_ALLOW), or
 * jams hard spheres by a crunch, which minimises their volume. `mode` is the strain of amplitude 1, upper-triangular;
 * NULL: simple shear, x moves with y. A symmetric stress (d, d) may follow the mode: the free components of soft
 * spheres then hold it, with pressure = 0. At amplitude g positions are exp(g mode) times those of the start, plus
 * non-affine displacements. `turns`: amplitudes at which the direction turns, the last one ends the shear: {0.1}
 * forward, {0.05, -0.05, 0} a cycle. If the energy change of a step differs from the work of the mean stress by over V
 * |change of stress| |change of strain| / 5, the step is halved down to the resolution. If the packing does not return
 * when sheared back, the step is a plastic event. An event that releases less is not detected: a smaller `step` shows
 * it. A call that begins where another ended continues to the same bits, if the steps are the same. Status: JAM_OK: the
 * last strain or `until` was reached. JAM_LIMIT, JAM_NOT_CONVERGED, JAM_PRECISION: no minimum was found, or a strain
 * diverged under the stress; the last minimum is kept. JAM_NOT_JAMMED: hard spheres did not jam.
 * @shape turns (turns), mode (d or 2 d, d) @errors UNSUPPORTED (walls, Mari-Kurchan), SOLVER, TOO_FEW, OVERLAP */
JAM_API jam_status jam_shear(jam_system *sys, const jam_shear_options *o, const double *turns, size_t turns_len,
                             const double *mode, size_t mode_len, jam_shear_report *report);
/* Rows of the last shear. @shape table (rows, jam_shear_column) @errors STATE */
JAM_API jam_status jam_shear_history(const jam_system *sys, int32_t columns, double *table, size_t table_len,
                                     size_t *needed);

/* ------------------------------------------------------------------ contact network */
/* Row k of each array is the same contact. */

/* Contact pairs, i < j except for walls (j = -1 - w) and images of one sphere (i = j). Networks of hard spheres list
 * images of one sphere after a crunch with a free cell, or if no other contacts balance. Such a contact stands for two
 * opposite images and adds 2 to the coordination. @shape out (contacts, 2) @errors STATE (no crunch yet) */
JAM_API jam_status jam_contacts(const jam_system *sys, int32_t *out, size_t out_len, size_t *needed);
/* Unit vectors n = (r_i - r_j)/|r_i - r_j| of each pair. @shape out (contacts, d) @errors STATE */
JAM_API jam_status jam_contact_vectors(const jam_system *sys, double *out, size_t out_len, size_t *needed);
/* Gaps h of the contacts. After a polish they are rounding errors, 1e-14. Among tens of thousands of spheres a few weak
 * contacts may stay open by 2e-6, with sum f h < 3e-14 sum f; a log line reports them. @shape out (contacts)
 * @errors STATE */
JAM_API jam_status jam_contact_gaps(const jam_system *sys, double *out, size_t out_len, size_t *needed);
/* Contact forces, mean 1; times report.force_scale they are lambda r. With several states of self-stress
 * (excess_contacts > 0: crystals, disks of two sizes) they are not unique; a jammed packing then has the forces of
 * jam_stress_states. NaN after jam_contacts_by_distance. @shape out (contacts) @errors STATE */
JAM_API jam_status jam_forces(const jam_system *sys, double *out, size_t out_len, size_t *needed);
/* Number of contacts of each sphere; 0 for rattlers. @shape out (n) @errors STATE */
JAM_API jam_status jam_coordination(const jam_system *sys, int32_t *out, size_t out_len, size_t *needed);

/* ------------------------------------------------------------------ analysis of the contact network */
/* In this section N' = report.stable, n_c = report.contacts; rows and modes run over stable spheres only, in the order
 * of jam_hessian_map. Calls on a const handle are quick; others report JAM_PHASE_ANALYSE and can be cancelled. None
 * changes the packing. Calls with `@errors STATE` need a contact network: JAM_E_STATE before jam_crunch or
 * jam_contacts_from_geometry, JAM_NOT_JAMMED when it is empty. jam_contacts_by_distance lists the calls that need no
 * forces. */

/* ------------- Hessian, modes */
/* Stiffness k of a contact, 1 at the mean force. SOFT, after jam_relax or jam_decompress with crunch = 0: prestress is
 * then the share of the pre-stress f / r, 0 to 1; 1 gives the true Hessian. */
typedef enum jam_stiffness {
  JAM_STIFFNESS_HARMONIC = 0, /* k = 1 */
  JAM_STIFFNESS_POWER = 1,    /* energy |overlap|^alpha: k = f^((alpha-2)/(alpha-1)) */
  JAM_STIFFNESS_HARD = 2,     /* entropic force of hard spheres near jamming: k = f^2 */
  JAM_STIFFNESS_SOFT = 3      /* that of the energy that was minimised, in its units */
} jam_stiffness;
/* Options of all calls that use a Hessian. The block of a contact is
 * k n n^T - prestress f <sigma> / ((alpha-1) r) (1 - n n^T). */
typedef struct jam_hessian_options {
  uint32_t struct_size;
  int32_t stiffness; /* @enum jam_stiffness, default HARMONIC */
  double alpha;      /* POWER: > 1, default 2; stiffnesses 1e-60 .. 1e60 */
  double prestress;  /* overlap (HARD: gap) at the mean force over mean diameter, below 1, default 0; SOFT: a share */
} jam_hessian_options;
/* Which modes. */
typedef enum jam_modes_which {
  JAM_MODES_LOWEST = 0,  /* smallest eigenvalues, without the d translations */
  JAM_MODES_HIGHEST = 1, /* largest eigenvalues */
  JAM_MODES_NEAR = 2,    /* nearest to frequency^2, without translations */
  JAM_MODES_ALL = 3      /* all d N', translations among them; dense, 24 (d N')^2 bytes */
} jam_modes_which;
/* Options of jam_modes. */
typedef struct jam_modes_options {
  uint32_t struct_size;
  int32_t which;       /* @enum jam_modes_which, default LOWEST */
  int64_t count;       /* how many, >= 1, default 10; not used by ALL */
  double frequency;    /* NEAR: omega >= 0 */
  double tolerance;    /* relative, of Lanczos, in (0, 1), default 1e-10 */
  double memory_limit; /* bytes, default 2e9; a larger estimate gives JAM_E_MEMORY */
} jam_modes_options;
/* Columns of jam_modes, one row per mode. */
typedef enum jam_mode_column {
  JAM_MODE_LAMBDA = 0,       /* lambda = omega^2 */
  JAM_MODE_PARTICIPATION = 1 /* inverse participation ratio, sum |v_i|^4 / (sum |v_i|^2)^2 */
} jam_mode_column;
#define JAM_MODE_COLUMNS 2
JAM_API jam_status jam_hessian_options_init(jam_hessian_options *o, size_t size);
JAM_API jam_status jam_modes_options_init(jam_modes_options *o, size_t size);
/* The N' stable spheres, ascending: row d k + c is component c of sphere out[k]. @shape out (N') @errors STATE */
JAM_API jam_status jam_hessian_map(const jam_system *sys, int32_t *out, size_t out_len, size_t *needed);
/* Hessian in compressed rows, both triangles, *rows = entries. Unit: stiffness at the mean force. @shape row_start (d
 * N' + 1), column (entries), value (entries) @errors STATE */
JAM_API jam_status jam_hessian(const jam_system *sys, const jam_hessian_options *h, int32_t *row_start,
                               size_t row_start_len, int32_t *column, size_t column_len, double *value,
                               size_t value_len, size_t *rows);
/* Modes of the Hessian, *rows = their number m, lambda ascending, vector of unit length. Status: JAM_NOT_CONVERGED
 * (modes that did not converge are NaN). @shape table (m, jam_mode_column), vector (m, N', d) @errors STATE, SOLVER */
JAM_API jam_status jam_modes(jam_system *sys, const jam_hessian_options *h, const jam_modes_options *o, int32_t columns,
                             double *table, size_t table_len, double *vector, size_t vector_len, size_t *rows);
/* All d N' modes of the Hessian at the wave vector sum of wave[c] b_c, with a_c . b_e = 2 pi delta_ce: the copy of a
 * sphere at distance sum of s_c a_c moves by exp(2 pi i sum wave[c] s_c) times the sphere's displacement. lambda
 * ascending; vector: real and imaginary parts, unit length. Dense: 96 (d N')^2 bytes, 40 where all wave[c] are
 * multiples of 1/2; the memory limit holds for *rows alone too. Wave 0: modes of jam_modes; all wave[c] = k / count[c],
 * k < count: those of jam_tile. Along an axis with walls wave is 0. @shape wave (d), table (m, jam_mode_column), vector
 * (m, N', d, 2) @errors STATE, SOLVER, UNSUPPORTED (unlisted own images) */
JAM_API jam_status jam_bloch_modes(jam_system *sys, const jam_hessian_options *h, const double *wave, size_t wave_len,
                                   int32_t columns, double *table, size_t table_len, double *vector, size_t vector_len,
                                   size_t *rows);

/* ------------- network from geometry, states of self-stress */
/* jam_contacts_from_geometry finds the network of a packing that jam_crunch did not make. */

/* Options of jam_contacts_from_geometry. */
typedef struct jam_geometry_options {
  uint32_t struct_size;
  int32_t reserved;
  double tolerance; /* contacts have |h| <= tolerance; 0, the default: set at the largest jump of the sorted gaps */
  double window;    /* jumps are searched in |h| < window, in (0, 1], default 0.1 */
} jam_geometry_options;
/* What jam_contacts_from_geometry found. second_*: the next candidate, jump 1 and contacts -1 if none. */
typedef struct jam_geometry_report {
  uint32_t struct_size;
  int32_t self_contacts;       /* contacts with own images, omitted: no constraint in a fixed cell */
  double tolerance;            /* used */
  double gap_below, gap_above; /* largest |h| <= tolerance, rattlers included; least |h| above, or window */
  double jump;                 /* gap_above / max(gap_below, resolution) */
  double resolution;           /* of gaps: 1e-15, or far more after a file whose coordinates have few digits */
  double second_jump;          /* of the next candidate */
  double second_tolerance;     /* its tolerance */
  int64_t second_contacts;     /* its contacts */
  int64_t pairs_within;        /* pairs with |h| <= tolerance, rattlers included */
  int64_t contacts;            /* of stable spheres */
  int64_t excess_contacts;     /* contacts - (d (N'-1) + 1) */
  int64_t self_stresses;       /* dimension of the null space of S^T; a lower bound when zero_modes is cut off */
  int64_t zero_modes;          /* of S^T S, translations among them; no more than 256 others are counted */
  double force_residual;       /* largest |sum_j f_ij n_ij| over mean force */
  double min_force;            /* over the mean */
  int64_t clusters;            /* connected sets of stable spheres; with more than one, each has its own states */
} jam_geometry_report;
JAM_API jam_status jam_geometry_options_init(jam_geometry_options *o, size_t size);
/* Contact network and forces from positions, diameters and box alone, kept like those of jam_crunch; no sphere moves.
 * Rattlers carry no force. All contacts between stable spheres are listed, also those of force 0. Forces are the null
 * vector of S^T; with several states of self-stress, the analytic centre of the non-negative ones. `jammed` of the
 * stored report is the verdict of jam_rigidity, whatever the tolerance. Status, each with the network kept: JAM_OK: one
 * jump is clearly the largest, or only this candidate has a single state of self-stress. JAM_AMBIGUOUS: another
 * candidate fits (second_*); there are several states of self-stress; gaps above 1e-7 leave the verdict open; or
 * coordinates have too few digits for a no. JAM_NOT_JAMMED: not jammed with these contacts closed, or no contacts: a
 * tolerance above 0.01 needs a jump of 100. @errors SOLVER, OVERLAP */
JAM_API jam_status jam_contacts_from_geometry(jam_system *sys, const jam_geometry_options *o,
                                              jam_geometry_report *report);
/* Contacts by distance, of any packing: all pairs (every image) and walls with h < gap, 0 < gap <= 1. Balance is not
 * tested, so there are no forces, report or verdict: for beds under weight and friction. jam_contacts,
 * jam_contact_vectors, jam_contact_gaps, jam_coordination, jam_fabric_tensor, jam_gaps, jam_contact_dots and
 * jam_sphere_structure (not weighted), jam_write_contacts, jam_write_stl and jam_write_page accept these contacts;
 * jam_forces gives NaN, other calls JAM_E_STATE. jam_rigidity and the check test positions whatever these contacts are,
 * and jam_tile does not copy them. Status: JAM_NOT_JAMMED (none) */
JAM_API jam_status jam_contacts_by_distance(jam_system *sys, double gap);
/* States of self-stress of the network, *rows = their number m. force: mean 1, from the null space of S^T, not from LP
 * duals. basis: orthonormal. residual: one number, as force_residual. Status: JAM_AMBIGUOUS (m > 1: force is the
 * analytic centre of the non-negative states), JAM_NOT_JAMMED (m = 0 or no force of one sign). @shape force (n_c),
 * basis (m, n_c) @errors STATE, SOLVER */
JAM_API jam_status jam_stress_states(jam_system *sys, double *force, size_t force_len, double *basis, size_t basis_len,
                                     double *residual, size_t *rows);

/* ------------- jammed or not */
/* jam_check_packing is the call for users: the verdict on a packing, with its reason. jam_rigidity makes one of its
 * tests, jam_flex gives the motion of a packing that is not jammed, jam_bloch_rigidity tests copies of the cell. */

/* Which motions must not open contacts. */
typedef enum jam_rigidity_kind {
  JAM_RIGIDITY_COLLECTIVE = 0, /* all motions of the spheres in a fixed cell */
  JAM_RIGIDITY_STRICT = 1      /* also symmetric strains along axes without walls that do not enlarge the volume */
} jam_rigidity_kind;
/* Answer of a test. Compare it with YES: in a condition of C, UNTESTED and UNDECIDED are true. */
typedef enum jam_verdict {
  JAM_VERDICT_UNTESTED = -1, /* the test has not run */
  JAM_VERDICT_NO = 0,        /* not jammed, with a certificate in doubles: no balanced forces, or a flex */
  JAM_VERDICT_YES = 1,       /* jammed, with a certificate: positive forces that balance, and full rank */
  JAM_VERDICT_UNDECIDED = 2  /* double precision cannot decide */
} jam_verdict;
/* What jam_rigidity found. K+: the contacts that carry force in some state of balanced non-negative forces. B: their
 * spheres, N' in number. undecided_contacts also counts pairs that the digits of the coordinates cannot distinguish
 * from contacts. curvature_margin, if the curvature of a round wall blocks the flexes u: least -sum f b(u, u) for |u| =
 * 1, over the mean |f b|, with b the second derivative of the distance across a contact. */
typedef struct jam_rigidity_report {
  uint32_t struct_size;
  int32_t kind;                /* @enum jam_rigidity_kind that was tested */
  int32_t jammed;              /* @enum jam_verdict */
  int32_t stationary;          /* @enum jam_verdict: K+ is not empty: to first order no motion lets diameters grow */
  int64_t stable, contacts;    /* N'; those of K+ */
  int64_t contacts_needed;     /* collective d (N' - 1) + 1, strict d (N' - 1) + d (d + 1) / 2; -1: K+ empty */
  int64_t self_stresses;       /* independent states of balanced forces on K+, of any sign; -1: unknown */
  int64_t flexes;              /* motions beyond symmetries that keep K+ closed; 0 without K+; 512 or more: at least */
  int64_t undercoordinated;    /* spheres of B with d contacts of K+ or fewer */
  int64_t zero_force_contacts; /* closed pairs that are not in K+ */
  int64_t undecided_contacts;  /* pairs with gaps of 1e-10 to 1e-7 */
  double rigidity_margin;      /* least eigenvalue of S^T S on K+ (strict, own images: with E) but symmetries, flexes */
  double force_residual;       /* largest |sum_j f_ij n_ij| over the mean force, of the forces in the certificate */
  double curvature_margin;     /* see above; 0 if no flex is blocked in this way */
} jam_rigidity_report;
/* Tests whether the packing is jammed; changes only strictly_jammed of the stored crunch report. Overlaps are treated
 * as in jam_check_packing. Contacts are all pairs with gaps below 1e-10; no network is needed. If coordinates have few
 * digits, pairs within their rounding are undecided, and the answer is no only if spheres have too few such neighbours.
 * A contact of a sphere with its own image counts in the strict test. In the collective test it counts if the network
 * lists it, or if no other contacts balance and the forces on the cell do. A motion v opens contacts by S v, a strain
 * eps by E eps. Collectively jammed: S v >= 0 only for translations of B. Strictly jammed: S v + E eps >= 0 with tr eps
 * <= 0 only for these and eps = 0. Copies of the cell need jam_bloch_rigidity. Donev et al., J. Comput. Phys. 197, 139
 * (2004). Status: JAM_NOT_JAMMED, JAM_AMBIGUOUS (undecided). @enum kind jam_rigidity_kind @errors SOLVER, OVERLAP */
JAM_API jam_status jam_rigidity(jam_system *sys, int32_t kind, jam_rigidity_report *report);
/* A motion of an unjammed packing: displacements out, unit of the box, at most 1 mean diameter, and strain (collective:
 * 0). A small part of it keeps contacts closed or opens them. If no pair is near contact, one sphere moves. @shape out
 * (n, d), strain (d, d) @enum kind jam_rigidity_kind @errors SOLVER, OVERLAP, STATE (jammed, or undecided without a
 * motion) */
JAM_API jam_status jam_flex(jam_system *sys, int32_t kind, double *out, size_t out_len, double *strain,
                            size_t strain_len, size_t *needed);
/* Columns of jam_bloch_rigidity. */
typedef enum jam_bloch_column {
  JAM_BLOCH_FLEXES = 0, /* complex motions at this wave vector that keep K+ closed, without translations */
  JAM_BLOCH_MARGIN = 1  /* least eigenvalue of S^T S on K+ without translations and flexes; NaN: no K+ */
} jam_bloch_column;
#define JAM_BLOCH_COLUMNS 2
/* The collective test of jam_rigidity for count[c] copies along each cell vector (jam_tile), from one cell: one row per
 * wave vector of the copies, as in jam_bloch_modes; wave[0] runs fastest. K+ is that of one cell, where the copies'
 * mean forces balance; the copies have the flexes of all rows. Status: JAM_NOT_JAMMED, JAM_AMBIGUOUS (undecided).
 * @shape count (d), wave (m, d), table (m, jam_bloch_column) @errors SOLVER, OVERLAP, UNSUPPORTED (Mari-Kurchan
 * model, round walls) */
JAM_API jam_status jam_bloch_rigidity(jam_system *sys, const int32_t *count, size_t count_len, double *wave,
                                      size_t wave_len, int32_t columns, double *table, size_t table_len, size_t *rows);

/* Why jam_check_packing answers as it does. */
typedef enum jam_check_reason {
  JAM_CHECK_PROOF = 0,    /* jammed: positive forces balance, and the rank is full */
  JAM_CHECK_APART = 1,    /* not: no two spheres touch, and none touches a wall */
  JAM_CHECK_NO_FORCE = 2, /* not: no non-negative forces on the contacts balance */
  JAM_CHECK_FLEX = 3,     /* not: forces balance, but spheres can move (a saddle) */
  JAM_CHECK_DIGITS = 4,   /* undecided: the coordinates have too few digits to say which spheres touch */
  JAM_CHECK_OVERLAP = 5,  /* undecided: spheres overlap, so gaps are known no better than that */
  JAM_CHECK_GAPS = 6,     /* undecided: would or may be jammed if pairs open by 1e-10 or more were closed */
  JAM_CHECK_MARGIN = 7,   /* undecided: doubles do not resolve a flex from a soft mode, or a weak force from none */
  JAM_CHECK_SLIDE = 8     /* not: as FLEX, but parts only slide past each other, so diameters cannot grow */
} jam_check_reason;
/* Options of jam_check_packing. */
typedef struct jam_check_options {
  uint32_t struct_size;
  int32_t crunch;   /* @bool if undecided, crunch a copy and report the changes (crunch_*); default 1 */
  double wall_time; /* limit of the crunch of the copy */
  int32_t prove;    /* @bool a jammed packing is proved collectively jammed by jam_prove; default 0 */
  int32_t reserved;
} jam_check_options;
/* Verdict on a packing. Closed pairs have gaps below 1e-10. crunch_*: of the crunched copy. */
typedef struct jam_check_report {
  uint32_t struct_size;
  int32_t jammed;                 /* @enum jam_verdict: collectively jammed */
  int32_t strictly_jammed;        /* @enum jam_verdict; NO where jammed is NO; as jammed between walls on all axes */
  int32_t stationary;             /* @enum jam_verdict: non-negative forces balance */
  int32_t reason;                 /* @enum jam_check_reason of jammed */
  int32_t dim;                    /* d */
  int32_t digits;                 /* decimal digits that coordinates, diameters or cell seem to have; 0: all */
  int32_t crunch_jammed;          /* @enum jam_verdict; UNTESTED without a copy */
  int64_t n;                      /* number of spheres */
  int64_t contacts;               /* closed pairs that carry force */
  int64_t excess_contacts;        /* contacts - (d (N' - 1) + 1), 0 without contacts */
  int64_t rattlers;               /* n - N': spheres without force */
  int64_t closed_pairs;           /* also those of rattlers */
  int64_t zero_force_contacts;    /* tested pairs without force in every state of self-stress */
  int64_t undecided_contacts;     /* pairs that may be contacts or not, by rounding or for lack of digits */
  int64_t self_stresses;          /* independent states, -1: unknown; with more than one, forces are not unique */
  int64_t flexes, strict_flexes;  /* motions that keep contacts with force closed; with strains, 0 untested */
  int64_t crunch_contacts;        /* contacts of the copy */
  double packing_fraction;        /* of the packing as it is */
  double nearest_gap;             /* smallest gap of all pairs; negative: an overlap. Infinite: none below 1 */
  double min_gap;                 /* smallest gap of two stable spheres that are not in contact */
  double max_contact_gap;         /* largest |gap| of a contact with force */
  double force_residual;          /* largest |sum_j f_ij n_ij| over the mean force */
  double rigidity_margin;         /* as in jam_rigidity_report */
  double coordinate_step;         /* common divisor of the given numbers, unit of the box; 0: all digits are given */
  double resolution;              /* of gaps: from the digits of the coordinates, and from overlaps */
  double diameter_factor;         /* < 1: the test multiplied diameters by it, so that no pair overlaps */
  double crunch_packing_fraction; /* of the copy */
  double crunch_displacement_max; /* largest displacement of a sphere with contacts at the end */
  double crunch_displacement_rms; /* root mean square of these displacements */
  int32_t theorem, proof_cause; /* @enum jam_theorem, NONE without prove; @enum jam_proof_cause: why it is not EXACT */
  double proof_radius;          /* unit of the box: radius of EXACT, inner of TRAPPED (jam_proof_report), or infinite */
  double proof_value, proof_bound; /* the two numbers of the cause */
  double curvature_margin;         /* as in jam_rigidity_report */
  int64_t strict_excess_contacts;  /* with own images, minus d (N' - 1) + d (d + 1) / 2; walls: fewer strains */
} jam_check_report;
JAM_API jam_status jam_check_options_init(jam_check_options *o, size_t size);
/* Runs both tests of jam_rigidity on positions, diameters and cell, whatever the network; nothing on the handle
 * changes. Systems that may overlap are tested with diameters reduced until no pair overlaps. Status: JAM_NOT_JAMMED,
 * JAM_AMBIGUOUS (undecided); jam_last_error() then gives jam_check_text. @errors OVERLAP (above one half), SOLVER */
JAM_API jam_status jam_check_packing(jam_system *sys, const jam_check_options *o, jam_check_report *report);
/* The report of jam_check_packing as one paragraph: the verdict, its figures, how sure it is, and what was proved. ""
 * for NULL or a wrong struct_size. Valid until this thread's next call of it. */
JAM_API const char *jam_check_text(const jam_check_report *report);

/* ------------- proof */
/* jam_prove proves, jam_write_proof writes a file to check. jam_crunch and jam_check_packing have an option `prove`. */

/* What was proved. TRAPPED: apart from translations of all spheres, no motion without overlap takes a stable sphere
 * farther than inner, and no packing at least as dense lies at a distance between inner and outer. */
typedef enum jam_theorem {
  JAM_THEOREM_NONE = 0,    /* nothing: see cause */
  JAM_THEOREM_TRAPPED = 1, /* stable spheres cannot leave the radius inner without overlap */
  JAM_THEOREM_EXACT = 2    /* a packing that touches exactly in all contacts lies within radius: jammed, forces > 0 */
} jam_theorem;
/* Why a packing was not proved exact, with cause_value and cause_bound. */
typedef enum jam_proof_cause {
  JAM_CAUSE_NONE = 0,     /* it was proved exact */
  JAM_CAUSE_EXCESS = 1,   /* contacts, unknowns: no bound proves that more contacts than unknowns close */
  JAM_CAUSE_FORCE = 2,    /* least force and its error, over the mean force */
  JAM_CAUSE_GAP = 3,      /* least gap of a pair that is no contact, and the radius */
  JAM_CAUSE_SINGULAR = 4, /* smallest eigenvalue of the rows, and its rounding error */
  JAM_CAUSE_RATTLER = 5,  /* as GAP, for a pair with a rattler */
  JAM_CAUSE_IMAGES = 6,   /* a contact of a sphere with its own image */
  JAM_CAUSE_SADDLE = 7    /* least force over the mean, and largest relative gap: contacts do not close together */
} jam_proof_cause;
/* What jam_prove found. Bounds are rounded outward; NaN where they do not apply. The exact diameters are sqrt(Gamma)
 * ratio_i times the power of two at or below V^(1/d). Ratios are 1 or those given, times 2^k: ratio_0 is in [1, 2). */
typedef struct jam_proof_report {
  uint32_t struct_size;
  int32_t theorem; /* @enum jam_theorem */
  int32_t cause;   /* @enum jam_proof_cause: why theorem is not JAM_THEOREM_EXACT */
  int32_t reserved;
  int64_t stable, contacts;        /* spheres with contacts, N'; equations, for d (N' - 1) + 1 unknowns */
  double cause_value, cause_bound; /* see jam_proof_cause */
  double radius;                   /* unit of the box: no refined centre is farther from the exact one */
  double gamma, gamma_low;         /* Gamma is about the sum of both */
  double packing_fraction;         /* of the exact packing, rounded to double */
  double fraction_error;           /* relative error of phi_J from gamma + gamma_low */
  double least_force, force_error; /* over the mean force; of every force, over the mean force */
  double least_gap;                /* lower bound of relative gaps of pairs that are no contacts, <= 1e-3 */
  double inner, outer;             /* unit of the box: see jam_theorem */
  double singular;             /* bound below the smallest singular value of rows 2 r_c, in units of that power of 2 */
  double eigenvalue, rounding; /* estimate of singular^2; error bound subtracted from it */
} jam_proof_report;
/* Proves, despite rounding, that the packing is jammed, from the contacts and forces of the network. Newton steps
 * refine the centres to two doubles (jam_refined_positions), a factorisation with bounded rounding gives the smallest
 * singular value, and Kantorovich's theorem the rest: see the guide's page "Proofs". JAM_RIGIDITY_STRICT: the diameters
 * are fixed and the cell vectors are unknowns. EXACT then means strictly jammed, with the volume a strict local
 * minimum; TRAPPED holds for all motions and strains that do not enlarge the volume; lengths of the report include
 * entries of the cell vectors, and packing_fraction is that of the exact cell. ratio: exact ratios of the diameters, in
 * any unit, only with JAM_RIGIDITY_COLLECTIVE; NULL: the diameters as they are. Status: JAM_OK proved exact or trapped,
 * JAM_AMBIGUOUS not proved (jam_last_error names the cause). @shape ratio (n) @enum kind jam_rigidity_kind
 * @errors STATE (no network), UNSUPPORTED (Mari-Kurchan model, strict between walls) */
JAM_API jam_status jam_prove(const jam_system *sys, int32_t kind, const double *ratio, size_t ratio_len,
                             jam_proof_report *report);
/* What was proved, in a few words: "proved, radius 4e-31", "trapped within 3e-28, excess 130, 129", "not proved, force
 * 1e-12, 3e-11". Arguments as in the reports; "" for numbers that are no jam_theorem or jam_proof_cause. Valid until
 * the next call on this thread. @enum theorem jam_theorem, cause jam_proof_cause */
JAM_API const char *jam_proof_text(int32_t theorem, int32_t cause, double radius, double value, double bound);
/* Writes the exact numbers of the proof: refined centres, contacts, forces, and of JAM_RIGIDITY_STRICT the refined
 * cell. bindings/proof/jamproof.py checks such a file with integers alone, without libjam. kind, ratio: as for
 * jam_prove. Status: JAM_AMBIGUOUS (dependent contacts: centres are not refined). @shape ratio (n) @enum kind
 * jam_rigidity_kind @errors STATE, UNSUPPORTED, IO */
JAM_API jam_status jam_write_proof(const jam_system *sys, const char *path, int32_t kind, const double *ratio,
                                   size_t ratio_len);
/* Centres of the jammed packing as sums of two doubles, high + low, unit of the box: about 31 digits. Rattlers move
 * only to end overlaps. ratio: as for jam_prove. Status: JAM_AMBIGUOUS (dependent contacts, nothing is written).
 * @shape ratio (n), high (n, d), low (n, d) @errors STATE, UNSUPPORTED */
JAM_API jam_status jam_refined_positions(const jam_system *sys, const double *ratio, size_t ratio_len, double *high,
                                         size_t high_len, double *low, size_t low_len, size_t *needed);

/* ------------- gaps, classes and angles of contacts */
/* jam_gaps lists pairs near contact, jam_local_values the values of a distribution. */

/* Flags of a contact. A buckler is a stable sphere with d + 1 contacts. */
typedef enum jam_contact_class {
  JAM_CONTACT_LOCALISED = 1, /* touches a buckler; without it: extended */
  JAM_CONTACT_SMALLEST = 2,  /* has the smallest force of one of its spheres */
  JAM_CONTACT_MEDIAN = 4     /* has the (lower) median force of one of its spheres */
} jam_contact_class;
/* Gaps h of pairs (every image) and walls below h_max, without contacts, ascending; *rows = gaps. Without stable_only
 * rattlers count too and no network is needed. @shape gap (gaps), pair (gaps, 2) @bool stable_only @errors STATE */
JAM_API jam_status jam_gaps(const jam_system *sys, double h_max, int32_t stable_only, double *gap, size_t gap_len,
                            int32_t *pair, size_t pair_len, size_t *rows);
/* Flags (jam_contact_class) of every contact. @shape out (n_c) @errors STATE */
JAM_API jam_status jam_contact_classes(const jam_system *sys, int32_t *out, size_t out_len, size_t *needed);
/* c: C_i = sum_j n_ij, s: S_i = sum_{j<k} n_ij . n_ik, with f n for n when weighted; 0 for rattlers. *rows = n. @shape
 * c (n, d), s (n) @bool weighted @errors STATE */
JAM_API jam_status jam_sphere_structure(const jam_system *sys, int32_t weighted, double *c, size_t c_len, double *s,
                                        size_t s_len, size_t *rows);
/* n_ij . n_ik (f_ij f_ik times it when weighted) of every pair of contacts of a sphere, and that sphere; *rows = pairs.
 * @shape dot (pairs), sphere (pairs) @bool weighted @errors STATE */
JAM_API jam_status jam_contact_dots(const jam_system *sys, int32_t weighted, double *dot, size_t dot_len,
                                    int32_t *sphere, size_t sphere_len, size_t *rows);
/* Fabric tensor F_ab = <n_a n_b>, the mean over all contacts: symmetric, of trace 1; delta_ab / d when the contacts
 * have no preferred direction. Status: JAM_NOT_JAMMED (no contacts: NaN). @shape out (d, d) @errors STATE */
JAM_API jam_status jam_fabric_tensor(const jam_system *sys, double *out, size_t out_len, size_t *needed);
/* Stress tensor S_ab = sum of f r n_a n_b over contacts, over V: symmetric, positive in compression, trace d times the
 * pressure; r from centre to centre, or to the wall. Soft spheres (jam_relax): in epsilon / length^d. Hard ones: in
 * multiples of their pressure, trace d; multiply by the confining pressure. Status: JAM_NOT_JAMMED (no contacts: NaN).
 * @shape out (d, d) @errors STATE */
JAM_API jam_status jam_stress(const jam_system *sys, double *out, size_t out_len, size_t *needed);
/* Quantity of which jam_local_values takes the values. */
typedef enum jam_local_quantity {
  JAM_LOCAL_FORCE = 0,        /* contacts: f over its mean in the population */
  JAM_LOCAL_VECTOR_SUM = 1,   /* stable spheres: |C_i| */
  JAM_LOCAL_VECTOR_PAIRS = 2, /* stable spheres: S_i */
  JAM_LOCAL_VECTOR_DOT = 3,   /* pairs of contacts of a sphere: n_ij . n_ik */
  JAM_LOCAL_FORCE_SUM = 4,    /* stable spheres: sum_j f_ij */
  JAM_LOCAL_FORCE_PAIRS = 5,  /* stable spheres: S_i with f n for n */
  JAM_LOCAL_FORCE_DOT = 6,    /* pairs of contacts of a sphere: f_ij f_ik n_ij . n_ik */
  JAM_LOCAL_COORDINATION = 7  /* stable spheres: z_i */
} jam_local_quantity;
/* The contacts or spheres that count. */
typedef enum jam_population {
  JAM_POPULATION_ALL = 0,       /* all contacts, all stable spheres */
  JAM_POPULATION_LOCALISED = 1, /* contacts that touch a buckler; spheres and their pairs: the bucklers */
  JAM_POPULATION_EXTENDED = 2,  /* contacts that do not; spheres and their pairs: all other stable ones */
  JAM_POPULATION_SMALLEST = 3,  /* forces only: the smallest of one of its spheres */
  JAM_POPULATION_MEDIAN = 4     /* forces only: the (lower) median of one of its spheres */
} jam_population;
/* Values of a quantity in a population, in the order of contacts, spheres or jam_contact_dots. @shape out
 * (values) @enum quantity jam_local_quantity, population jam_population @errors STATE */
JAM_API jam_status jam_local_values(const jam_system *sys, int32_t quantity, int32_t population, double *out,
                                    size_t out_len, size_t *needed);
/* ------------- structure of the packing */
/* Options of jam_pair_correlation. Between walls more than 8 different diameters are grouped into 8 classes. */
typedef struct jam_correlation_options {
  uint32_t struct_size;
  int32_t a, b; /* labels of the spheres, default -1: any */
  int32_t reserved;
  double r_max; /* mean diameters, > 0, default 4 */
  int64_t bins; /* of equal width from 0 to r_max, 1 .. 1e8, default 200; edges are 1e-10 lower */
} jam_correlation_options;
JAM_API jam_status jam_correlation_options_init(jam_correlation_options *o, size_t size);
/* g_ab(r) of labels a, b in kind (or NULL). Between walls, d < 4: relative to evenly spread centres. @shape kind (n),
 * out (bins) @errors UNSUPPORTED (walls in d > 3, a cone, spheres as wide as the container) */
JAM_API jam_status jam_pair_correlation(const jam_system *sys, const jam_correlation_options *o, const int32_t *kind,
                                        size_t kind_len, double *out, size_t out_len, size_t *needed);
/* Shifts A_ij of the Mari-Kurchan model, unit of the box: r_ij = r_i - r_j + A_ij by nearest images, A_ji = -A_ij.
 * @shape pair (m, 2), out (m, d) @errors UNSUPPORTED (other model) */
JAM_API jam_status jam_mk_shifts(const jam_system *sys, const int32_t *pair, size_t pair_len, double *out,
                                 size_t out_len, size_t *needed);
/* Columns of jam_structure_factor. */
typedef enum jam_structure_column {
  JAM_STRUCTURE_Q = 0, /* |q| times the mean diameter, ascending */
  JAM_STRUCTURE_S = 1  /* S(q), its average over all q of this length */
} jam_structure_column;
#define JAM_STRUCTURE_COLUMNS 2
/* S(q) on the wave vectors of the cell (in a cube 2 pi n / box), along axes without walls, with |q| <= q_max. Lengths
 * within 5e-13 |q| are merged. @shape table (m, jam_structure_column) @errors UNSUPPORTED (no such axis) */
JAM_API jam_status jam_structure_factor(jam_system *sys, double q_max, int32_t columns, double *table, size_t table_len,
                                        size_t *needed);
/* Bond order Q_l of each sphere (d = 2: |psi_l|) over neighbours with |r| < cutoff sigma_ij; l in 1..64, cutoff in (0,
 * 3] (1.2 is usual). @shape out (n) */
JAM_API jam_status jam_bond_order(const jam_system *sys, int32_t l, double cutoff, double *out, size_t out_len,
                                  size_t *needed);
/* Packing fraction of each sphere in its radical Voronoi cell within the walls (a round one to 1e-5), d = 3. @shape out
 * (n) @errors UNSUPPORTED (d, no voro++, walls of a tilted cell) */
JAM_API jam_status jam_local_fraction(const jam_system *sys, double *out, size_t out_len, size_t *needed);

/* ------------- the pore space */
/* Solid and void inside the brick [0, a_00) x [0, a_11) x ..., which repeats as the cell does; spheres are cut at its
 * faces. The solid is the union of the spheres: volume that spheres share counts once. d = 2 and 3, no Mari-Kurchan
 * shifts: else JAM_E_UNSUPPORTED. What becomes of contacts in a mesh: */
typedef enum jam_mesh_contacts {
  JAM_MESH_KEPT = 0,   /* contacts of the network are common vertices; without a network touching is approximate */
  JAM_MESH_SHRUNK = 1, /* all diameters times `factor` */
  JAM_MESH_BRIDGED = 2 /* a cylinder along each contact of the network, or between pairs within `bridge_gap` */
} jam_mesh_contacts;
/* Walls in a mesh: triangles that face outwards, with planes that touch a round wall from outside. */
typedef enum jam_mesh_walls {
  JAM_MESH_SPHERES = 0,   /* nothing */
  JAM_MESH_AND_WALLS = 1, /* spheres and walls */
  JAM_MESH_WALLS = 2      /* the walls alone */
} jam_mesh_walls;
/* Options of jam_write_stl. */
typedef struct jam_mesh_options {
  uint32_t struct_size;
  int32_t contacts;  /* @enum jam_mesh_contacts; default KEPT */
  double edge;       /* of triangles, over the radius of the sphere: 0.03 .. 1, default 0.2 */
  double factor;     /* of SHRUNK, between 0 and 1, default 0.99 */
  double bridge;     /* of BRIDGED: radius of a cylinder over that of the smaller sphere, 0.02 .. 0.45, default 0.2 */
  double bridge_gap; /* of BRIDGED: bridges between all pairs with h < bridge_gap <= 1, as in jam_near_coordination,
                        which needs no network; default 0: along the contacts of the network */
  int32_t walls;     /* @enum jam_mesh_walls, default SPHERES */
  int32_t reserved;
} jam_mesh_options;
/* What jam_write_stl wrote. */
typedef struct jam_mesh_report {
  uint32_t struct_size;
  int32_t reserved;
  int64_t triangles, bridges, bytes; /* of the mesh; cylinders; of the file before compression */
  double volume, solid; /* enclosed by the mesh, unit^d; exact, of the spheres and cylinders it stands for */
} jam_mesh_report;
JAM_API jam_status jam_mesh_options_init(jam_mesh_options *o, size_t size);
/* Binary STL of the solid, d = 3, closed: each edge belongs to two triangles, which pass it in opposite directions. Two
 * spheres that overlap are joined along their common circle. The call names and refuses a third sphere there, a sphere
 * inside another, and cylinders that would meet, since the mesh would intersect itself. Walls get no cylinders. The
 * file is written as by jam_write; path NULL: no file, and an estimate of triangles and bytes. Status: JAM_NOT_JAMMED
 * (BRIDGED, and there is no bridge). @errors STATE (BRIDGED, no network), UNSUPPORTED, IO */
JAM_API jam_status jam_write_stl(const jam_system *sys, const char *path, const jam_mesh_options *o,
                                 jam_mesh_report *report);
/* Options of jam_voxels and jam_write_voxels. */
typedef struct jam_voxel_options {
  uint32_t struct_size;
  int32_t lines;      /* 0, the default: the centre of a voxel decides. Else: share of the voxel that is solid, from
                         lines^(d-1) lines along x, each with its exact length inside spheres; at most 64 */
  int32_t nx, ny, nz; /* voxels along the edges of the brick, 0, the default: from `size`. Disks: one layer */
  int32_t reserved;
  double size; /* wanted edge; rounded so that whole voxels fill the brick. 0, the default: box / 100 */
} jam_voxel_options;
/* The image that jam_voxels or jam_write_voxels makes. */
typedef struct jam_voxel_report {
  uint32_t struct_size;
  int32_t nx, ny, nz; /* voxels along each edge */
  int64_t bytes;      /* of a file, without its header */
  double porosity;    /* of the image: void over all inside the container; NaN before the work */
  double dx, dy, dz;  /* edges of a voxel */
} jam_voxel_report;
JAM_API jam_status jam_voxel_options_init(jam_voxel_options *o, size_t size);
/* Image of the solid: 0 or 1, or shares; -1 outside a round container. x is fastest. out NULL: the report gives size
 * and memory before the work. @shape out (voxels) */
JAM_API jam_status jam_voxels(const jam_system *sys, const jam_voxel_options *o, jam_voxel_report *report, double *out,
                              size_t out_len, size_t *needed);
/* Writes the image layer by layer: .npy (image[x, y, z]), .mha (MetaImage), .vti (VTK), as bytes 0 void, 1 solid, 2
 * outside; with lines as float. @errors UNSUPPORTED, IO */
JAM_API jam_status jam_write_voxels(const jam_system *sys, const char *path, const jam_voxel_options *o,
                                    jam_voxel_report *report);
/* Columns of jam_solid_profile. */
typedef enum jam_profile_column {
  JAM_PROFILE_LOW = 0,  /* where the bin begins: distance to the face of the cell, or to the centre or axis */
  JAM_PROFILE_HIGH = 1, /* where it ends */
  JAM_PROFILE_SOLID = 2 /* share of the bin (of its part in the container) inside spheres */
} jam_profile_column;
#define JAM_PROFILE_COLUMNS 3
/* Solid fraction in equal bins, exact also where spheres overlap or pass a wall. axis 0 .. d-1: slabs between the faces
 * that a_axis joins; d: shells of a ball or a cylinder (to 1e-12). @shape table (bins, jam_profile_column)
 * @errors UNSUPPORTED */
JAM_API jam_status jam_solid_profile(const jam_system *sys, int32_t axis, int32_t bins, int32_t columns, double *table,
                                     size_t table_len, size_t *needed);
/* For each sphere, the number of spheres (every image) with a gap h < h_max <= 1. Needs no crunch. @shape out (n) */
JAM_API jam_status jam_near_coordination(const jam_system *sys, double h_max, int32_t *out, size_t out_len,
                                         size_t *needed);
/* Columns of jam_pore_sizes. */
typedef enum jam_pore_column {
  JAM_PORE_X = 0,        /* of the point */
  JAM_PORE_Y = 1,        /* of the point */
  JAM_PORE_Z = 2,        /* of the point, NaN in d = 2 */
  JAM_PORE_DISTANCE = 3, /* to the nearest surface: radius of the largest sphere about the point */
  JAM_PORE_RADIUS = 4    /* of the largest sphere that contains the point and no solid */
} jam_pore_column;
#define JAM_PORE_COLUMNS 5
/* Pore sizes at random points of the void, exact; in a cylinder to 1e-9 of the spacing of spheres. The time grows with
 * the fourth power of the number of neighbours of a point: use it above packing fractions of about 0.4. @shape table
 * (points, jam_pore_column) @errors UNSUPPORTED */
JAM_API jam_status jam_pore_sizes(jam_system *sys, int64_t points, int64_t seed, int32_t columns, double *table,
                                  size_t table_len, size_t *needed);

/* ------------- floppy modes */
/* Columns of jam_floppy_modes, one row per mode; dr is its vector, and F the mean force. Openings
 * have the unit of positions: divide by the diameter to compare packings of different N. B = sum_k f_k |dr_perp|^2 /
 * r_k. S_RETURN is s* of R. Diaz Hernandez Rojas, PhD thesis, Sapienza 2021, whose index is twice stability. */
typedef enum jam_floppy_column {
  JAM_FLOPPY_MEDIAN = 0,    /* b = median |dr_i| / |dr|: far below 1/sqrt(N') when the mode is localised */
  JAM_FLOPPY_WEIGHT = 1,    /* W = f / median |dr_i|: f equals W times the displacement far away */
  JAM_FLOPPY_S_PLUS = 2,    /* opening at which, to first order, the next contact forms */
  JAM_FLOPPY_S_STAR = 3,    /* opening f / B at which, to second order, the diameters are least */
  JAM_FLOPPY_STABILITY = 4, /* s_star / s_plus = sigma f / (N c F s_plus), F the mean force, c = sigma B / (N F) */
  JAM_FLOPPY_S_RETURN = 5   /* opening 2 s_star at which, to second order, the diameters are back at their start */
} jam_floppy_column;
#define JAM_FLOPPY_COLUMNS 6
/* Floppy modes of the contacts with these indices (NULL: all), *rows = their number m. vector: displacement over s when
 * the contact opens by s. To first order the other contacts stay closed, diameters change by the factor 1 - s f / sum f
 * sigma, and no net translation occurs. Needs a single state of self-stress (JAM_E_STATE says how many there are).
 * @shape contact (k), table (m, jam_floppy_column), vector (m, N', d) @errors STATE, SOLVER */
JAM_API jam_status jam_floppy_modes(jam_system *sys, const int64_t *contact, size_t contact_len, int32_t columns,
                                    double *table, size_t table_len, double *vector, size_t vector_len, size_t *rows);

/* ------------- spectrum, moduli, comparison */
/* Options of jam_density_of_states. */
typedef struct jam_dos_options {
  uint32_t struct_size;
  int32_t moments;  /* Chebyshev moments, 8..1e6, default 512: resolution in omega about 1.6 omega_max / moments */
  int32_t vectors;  /* random vectors, 2..1e5, default 16 */
  int32_t points;   /* values of omega, default 200 */
  int64_t seed;     /* of the random vectors, default 1 */
  double low, high; /* omega of the first bin; end of the last, default NaN: those of the spectrum */
} jam_dos_options;
/* Elastic moduli, unit: stiffness at the mean force times length^(2-d). Affine: without the non-affine part. */
typedef struct jam_moduli_report {
  uint32_t struct_size;
  int32_t reserved;
  double bulk, bulk_affine;    /* K = -V dP/dV = c_aabb / d^2 + P (d-1)/d, P of the prestress; affine K */
  double shear, shear_affine;  /* G for simple shear, mean over the d (d-1) coordinate directions; affine G */
  double shear_min, shear_max; /* smallest G of a plane, mean of its two directions; largest */
} jam_moduli_report;
/* What jam_compare found between sys, a, and other, b. Contacts are -1 and overlaps NaN if either has no network. */
typedef struct jam_comparison_report {
  uint32_t struct_size;
  int32_t reserved;
  int64_t contacts_a, contacts_b;            /* of sys; of other */
  int64_t common_contacts;                   /* pairs in both */
  int64_t stable_in_both;                    /* spheres that are rattlers in neither */
  double overlap, overlap_a;                 /* common over union; common over contacts_a: sys as the reference */
  double packing_fraction_change;            /* phi of other minus phi of sys */
  double displacement_rms, displacement_max; /* of these, or of all if there are none, in mean diameters of sys */
} jam_comparison_report;
/* Columns of jam_density_of_states, one row per bin of the frequency omega. */
typedef enum jam_dos_column {
  JAM_DOS_OMEGA = 0,           /* middle of the bin */
  JAM_DOS_DENSITY = 1,         /* mean over the bin of the density of states D, integral 1 */
  JAM_DOS_ERROR = 2,           /* its standard error over the random vectors; smoothing is not in it */
  JAM_DOS_EDGE = 3,            /* upper end of the bin */
  JAM_DOS_CUMULATIVE = 4,      /* share of modes below the edge */
  JAM_DOS_CUMULATIVE_ERROR = 5 /* its standard error */
} jam_dos_column;
#define JAM_DOS_COLUMNS 6
JAM_API jam_status jam_dos_options_init(jam_dos_options *o, size_t size);
/* Density of states D(omega) and its integral by the kernel polynomial method: no modes are computed, translations are
 * omitted. With prestress omega starts below 0: unstable modes are listed at -sqrt(-lambda), and resolution is lower
 * near 0. @shape table (points, jam_dos_column) @errors STATE, SOLVER, TOO_FEW */
JAM_API jam_status jam_density_of_states(jam_system *sys, const jam_hessian_options *h, const jam_dos_options *o,
                                         int32_t columns, double *table, size_t table_len, size_t *needed);
/* Elastic moduli; JAM_E_STATE also when prestress makes the network unstable. With walls bulk is NaN, and shear is that
 * of planes of two axes without walls. @errors STATE, SOLVER, UNSUPPORTED (not two such axes; unlisted own images) */
JAM_API jam_status jam_moduli(jam_system *sys, const jam_hessian_options *h, jam_moduli_report *report);
/* Elastic tensor c_abcd: second derivative of the energy a volume by E_ab and E_cd of x -> (1 + E) x. Unit as in
 * jam_moduli, *needed = d^4. affine: spheres follow E; relaxed: after forces balance. With prestress c_abcd and c_bacd
 * differ, since rotations of stressed contacts cost energy. Components of axes with walls are NaN: walls do not strain.
 * @shape affine (d, d, d, d), relaxed (d, d, d, d) @errors STATE, SOLVER, UNSUPPORTED (only walled axes; own images) */
JAM_API jam_status jam_elastic_tensor(jam_system *sys, const jam_hessian_options *h, double *affine, size_t affine_len,
                                      double *relaxed, size_t relaxed_len, size_t *needed);
/* Compares two packings sphere by sphere. out: displacements from sys to other by nearest images, minus their mean over
 * the spheres stable in both (or over all if none is). n, dim, cell and model must agree. JAM_AMBIGUOUS: ratios of
 * diameters differ, or one of the two has no network. @shape out (n, d) */
JAM_API jam_status jam_compare(const jam_system *sys, const jam_system *other, jam_comparison_report *comparison,
                               double *out, size_t out_len, size_t *needed);

#ifdef __cplusplus
}
#endif

#endif /* JAM_JAM_H */
