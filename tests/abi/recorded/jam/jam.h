/* Made by tests/abi/abi.py: jam.h as programs were compiled with. */
#ifndef JAM_JAM_H
#define JAM_JAM_H
#include <stddef.h>
#include <stdint.h>
#if defined(__GNUC__) && !defined(SWIG)
#define JAM_API __attribute__((visibility("default")))
#else
#define JAM_API
#endif
#if defined(__GNUC__) && !defined(SWIG)
#define JAM_DEPRECATED(instead) __attribute__((deprecated("use " instead)))
#else
#define JAM_DEPRECATED(instead)
#endif
#ifdef __cplusplus
extern "C" {
#endif
#define JAM_ABI 1
#define JAM_MAX_DIM 8
typedef int32_t jam_status;
typedef enum jam_status_code { JAM_OK = 0, JAM_CANCELLED = 1, JAM_LIMIT = 2, JAM_NOT_CONVERGED = 3, JAM_PRECISION = 4,
  JAM_NOT_JAMMED = 5, JAM_AMBIGUOUS = 6, JAM_E_NULL = -1, JAM_E_STRUCT_SIZE = -2, JAM_E_ARGUMENT = -3, JAM_E_DIMENSION
  = -4, JAM_E_NONFINITE = -5, JAM_E_OVERLAP = -6, JAM_E_UNPLACEABLE = -7, JAM_E_BUFFER = -8, JAM_E_MEMORY = -9,
  JAM_E_IO = -10, JAM_E_FORMAT = -11, JAM_E_STATE = -12, JAM_E_SOLVER = -13, JAM_E_TOO_FEW = -14, JAM_E_BUSY = -15,
  JAM_E_UNSUPPORTED = -16, JAM_E_INTERNAL = -17 } jam_status_code;
typedef enum jam_stop_reason { JAM_STOP_NONE = 0, JAM_STOP_PRESSURE = 1, JAM_STOP_PACKING_FRACTION = 2,
  JAM_STOP_COLLISIONS = 3, JAM_STOP_WALL_TIME = 4, JAM_STOP_CANCELLED = 5, JAM_STOP_STALLED = 6, JAM_STOP_PRECISION =
  7, JAM_STOP_CONVERGED = 8, JAM_STOP_LP_LIMIT = 9, JAM_STOP_SOLVER = 10, JAM_STOP_UNJAMMED = 11, JAM_STOP_TIME = 12,
  JAM_STOP_EVALUATIONS = 13, JAM_STOP_STEPS = 14, JAM_STOP_SADDLE = 15, JAM_STOP_DUALITY_GAP = 16, JAM_STOP_STRAIN =
  17, JAM_STOP_EVENT = 18, JAM_STOP_JAMMED = 19 } jam_stop_reason;
JAM_API const char *jam_version(void);
JAM_API const char *jam_commit(void);
JAM_API int32_t jam_abi_version(void);
JAM_API const char *jam_blas_kernel(void);
JAM_API const char *jam_status_string(jam_status code);
JAM_API const char *jam_stop_string(int32_t reason);
JAM_API const char *jam_last_error(void);
JAM_API void jam_set_error(const char *text);
typedef enum jam_phase { JAM_PHASE_RUN = 1, JAM_PHASE_COMPRESS = 2, JAM_PHASE_CRUNCH = 3, JAM_PHASE_POLISH = 4,
  JAM_PHASE_ANALYSE = 5, JAM_PHASE_RELAX = 6, JAM_PHASE_DECOMPRESS = 7, JAM_PHASE_MONTE_CARLO = 8, JAM_PHASE_ISOCONF =
  9, JAM_PHASE_CREATE = 10, JAM_PHASE_SHEAR = 11 } jam_phase;
typedef struct jam_progress { uint32_t struct_size; int32_t phase; double packing_fraction; double pressure; double
  gain; double max_step; double seconds; double fraction; int64_t collisions; int64_t steps, factorisations; int64_t
  snapshot; double seconds_left; double seconds_left_spread; } jam_progress;
typedef int32_t (*jam_progress_fn)(const jam_progress *progress, void *user);
typedef struct jam_system jam_system;
typedef enum jam_overlap_policy { JAM_OVERLAP_REFUSE = 0, JAM_OVERLAP_SHRINK = 1, JAM_OVERLAP_ALLOW = 2 }
  jam_overlap_policy;
typedef enum jam_model { JAM_MODEL_EUCLID = 0, JAM_MODEL_MK = 1 } jam_model;
typedef enum jam_masses { JAM_MASSES_EQUAL = 0, JAM_MASSES_VOLUME = 1 } jam_masses;
typedef enum jam_container { JAM_CONTAINER_BRICK = 0, JAM_CONTAINER_CYLINDER = 1, JAM_CONTAINER_BALL = 2,
  JAM_CONTAINER_CONE = 3 } jam_container;
typedef struct jam_create_options { uint32_t struct_size; int32_t dim; int64_t n, seed; double box; double
  packing_fraction; int32_t overlap, model; double mk_zeta; int32_t masses, container; int32_t walls, reserved; double
  non_additivity; double wall_time; double memory_limit; int64_t frame; double shrink_min; } jam_create_options;
JAM_API jam_status jam_create_options_init(jam_create_options *o, size_t size);
typedef struct jam_start { uint32_t struct_size; int32_t reserved; const double *positions; size_t positions_len;
  const double *diameters; size_t diameters_len; const double *cell; size_t cell_len; jam_progress_fn progress; void
  *user; } jam_start;
JAM_API jam_status jam_create(const jam_create_options *o, const jam_start *start, jam_system **out);
JAM_API jam_status jam_copy(const jam_system *src, jam_system **out);
JAM_API void jam_destroy(jam_system *sys);
typedef struct jam_info { uint32_t struct_size; int32_t dim; int64_t n, seed; double box; double packing_fraction;
  double diameter_mean; double pressure; int32_t model; int32_t monodisperse; int32_t masses; int32_t paused; double
  non_additivity; int32_t container, walls; double volume; double contact_gap; } jam_info;
JAM_API jam_status jam_get_info(const jam_system *sys, jam_info *info);
typedef enum jam_view_array { JAM_VIEW_POSITIONS = 0, JAM_VIEW_DIAMETERS = 1, JAM_VIEW_VELOCITIES = 2 }
  jam_view_array;
JAM_API jam_status jam_view(const jam_system *sys, int32_t array, const double **view, size_t *view_len);
JAM_API jam_status jam_set_positions(jam_system *sys, const double *positions, size_t positions_len);
JAM_API jam_status jam_set_velocities(jam_system *sys, const double *velocities, size_t velocities_len);
JAM_API jam_status jam_scale_diameters(jam_system *sys, double factor);
typedef enum jam_wall_column { JAM_WALL_AXIS = 0, JAM_WALL_SIDE = 1, JAM_WALL_AREA = 2, JAM_WALL_PRESSURE = 3,
  JAM_WALL_GAP = 4, JAM_WALL_STRESS = 5 } jam_wall_column;
#define JAM_WALL_COLUMNS 6
JAM_API jam_status jam_walls(const jam_system *sys, int32_t columns, double *table, size_t table_len, size_t *needed);
JAM_API jam_status jam_get_cell(const jam_system *sys, double *out, size_t out_len, size_t *needed);
JAM_API jam_status jam_set_cell(jam_system *sys, const double *cell, size_t cell_len, int64_t *transform, size_t
  transform_len, double *rotation, size_t rotation_len, size_t *rows);
JAM_API jam_status jam_strain(jam_system *sys, const double *strain, size_t strain_len);
JAM_API jam_status jam_tile(const jam_system *src, const int32_t *count, size_t count_len, jam_system **out);
typedef enum jam_size_law { JAM_SIZES_EQUAL = 0, JAM_SIZES_LIST = 1, JAM_SIZES_UNIFORM = 2, JAM_SIZES_NORMAL = 3,
  JAM_SIZES_LOGNORMAL = 4, JAM_SIZES_POWER = 5, JAM_SIZES_WEIBULL = 6, JAM_SIZES_SIEVE = 7 } jam_size_law;
typedef enum jam_size_share { JAM_SHARE_USUAL = 0, JAM_SHARE_NUMBER = 1, JAM_SHARE_VOLUME = 2 } jam_size_share;
typedef enum jam_size_draw { JAM_DRAW_QUANTILES = 0, JAM_DRAW_RANDOM = 1 } jam_size_draw;
typedef struct jam_diameters_options { uint32_t struct_size; int32_t law, share; int32_t draw, dim; int32_t reserved;
  int64_t n, seed; double mean, deviation; double low, high; double exponent; double scale, shape; double cell_volume;
  double packing_fraction; } jam_diameters_options;
JAM_API jam_status jam_diameters_options_init(jam_diameters_options *o, size_t size);
JAM_API jam_status jam_diameters(const jam_diameters_options *o, const double *curve, size_t curve_len, double *out,
  size_t out_len, size_t *needed);
JAM_API jam_status jam_parse_diameters(const char *text, jam_diameters_options *o, double *curve, size_t curve_len,
  size_t *needed);
typedef enum jam_reach_source { JAM_REACH_FARR_GROOT = 1, JAM_REACH_MEASURED = 2, JAM_REACH_CRYSTAL = 3 }
  jam_reach_source;
typedef struct jam_size_report { uint32_t struct_size; int32_t source; int64_t n; double mean, deviation; double
  polydispersity; double least, largest; double d10, d50, d90; double volume; double largest_share; double
  sequential_fraction; double jammed_fraction; } jam_size_report;
JAM_API jam_status jam_get_size_report(int32_t dim, const double *diameters, size_t diameters_len, jam_size_report
  *report);
JAM_API jam_status jam_set_progress(jam_system *sys, jam_progress_fn callback, void *user);
typedef enum jam_log_level { JAM_LOG_NONE = 0, JAM_LOG_WARNING = 1, JAM_LOG_INFO = 2, JAM_LOG_DEBUG = 3 }
  jam_log_level;
typedef void (*jam_log_fn)(int32_t level, const char *line, void *user);
JAM_API jam_status jam_set_log(jam_system *sys, jam_log_fn callback, int32_t level, void *user);
JAM_API jam_status jam_cancel(jam_system *sys);
JAM_API jam_status jam_set_memory_limit(jam_system *sys, double bytes);
typedef enum jam_format { JAM_FORMAT_AUTO = 0, JAM_FORMAT_PLAIN = 1, JAM_FORMAT_XYZ = 2, JAM_FORMAT_LAMMPS = 3,
  JAM_FORMAT_VTP = 4 } jam_format;
JAM_API const char *jam_formats(void);
JAM_API jam_status jam_read(const char *path, const jam_create_options *o, jam_progress_fn callback, void *user,
  jam_system **out);
JAM_API jam_status jam_read_as(const char *path, const char *layout, const jam_create_options *o, jam_progress_fn
  callback, void *user, jam_system **out);
JAM_API const char *jam_notes(const jam_system *sys);
JAM_API jam_status jam_add_note(jam_system *sys, const char *text);
JAM_API jam_status jam_write(const jam_system *sys, const char *path, int32_t format);
JAM_API jam_status jam_write_scaled(const jam_system *sys, const char *path, int32_t format, double scale, double
  density);
typedef enum jam_contact_format { JAM_CONTACTS_AUTO = 0, JAM_CONTACTS_CSV = 1, JAM_CONTACTS_DUMP = 2, JAM_CONTACTS_VTP
  = 3 } jam_contact_format;
JAM_API jam_status jam_write_contacts(const jam_system *sys, const char *path, int32_t format);
JAM_API jam_status jam_write_page(const jam_system *sys, const char *path, const char *title, int32_t small, const
  char *names, const double *values, size_t values_len);
typedef struct jam_run_options { uint32_t struct_size; int32_t resume; double collisions_per_particle; double
  wall_time; double time; } jam_run_options;
typedef enum jam_growth_law { JAM_GROWTH_DIAMETER = 0, JAM_GROWTH_DENSITY = 1 } jam_growth_law;
typedef struct jam_compress_options { uint32_t struct_size; int32_t resume; double growth_rate; double pressure;
  double packing_fraction; double collisions_per_particle; double wall_time; double time; double growth_rate_end;
  int32_t growth_law; int32_t reserved; } jam_compress_options;
typedef struct jam_md_report { uint32_t struct_size; int32_t stop_reason; int64_t collisions, events; double
  collisions_per_second; double pressure; double pressure_error; double packing_fraction; double time; double
  energy_drift; double max_overlap; double seconds; double growth_rate; } jam_md_report;
JAM_API jam_status jam_run_options_init(jam_run_options *o, size_t size);
JAM_API jam_status jam_compress_options_init(jam_compress_options *o, size_t size);
JAM_API jam_status jam_run(jam_system *sys, const jam_run_options *o, jam_md_report *report);
JAM_API jam_status jam_compress(jam_system *sys, const jam_compress_options *o, jam_md_report *report);
JAM_API jam_status jam_write_checkpoint(const jam_system *sys, const char *path);
JAM_API jam_status jam_read_checkpoint(const char *path, jam_progress_fn callback, void *user, jam_system **out);
typedef struct jam_observe_options { uint32_t struct_size; int32_t collisions; int32_t gap_bins, r_bins; double
  sample_every; double gap_min, gap_max; double r_max; double snapshot_every; double snapshot_factor; }
  jam_observe_options;
JAM_API jam_status jam_observe_options_init(jam_observe_options *o, size_t size);
JAM_API jam_status jam_observe(jam_system *sys, const jam_observe_options *o);
JAM_API jam_status jam_stop_observing(jam_system *sys);
typedef enum jam_series_column { JAM_SERIES_TIME = 0, JAM_SERIES_COLLISIONS = 1, JAM_SERIES_FRACTION = 2,
  JAM_SERIES_PRESSURE = 3, JAM_SERIES_ERROR = 4, JAM_SERIES_MSD = 5 } jam_series_column;
#define JAM_SERIES_COLUMNS 6
JAM_API jam_status jam_observed_series(const jam_system *sys, int32_t columns, double *table, size_t table_len, size_t
  *needed);
JAM_API jam_status jam_observed_stress(const jam_system *sys, double *out, size_t out_len, size_t *needed);
JAM_API jam_status jam_observed_spheres(const jam_system *sys, int64_t *collisions, size_t collisions_len, double
  *displacement, size_t displacement_len, size_t *rows);
JAM_API jam_status jam_observed_pairs(const jam_system *sys, int32_t *pair, size_t pair_len, int64_t *collisions,
  size_t collisions_len, double *momentum, size_t momentum_len, double *time, size_t *rows);
typedef enum jam_gap_column { JAM_GAP_LOW = 0, JAM_GAP_HIGH = 1, JAM_GAP_DENSITY = 2, JAM_GAP_ERROR = 3 }
  jam_gap_column;
#define JAM_GAP_COLUMNS 4
JAM_API jam_status jam_observed_gaps(const jam_system *sys, int32_t columns, double *table, size_t table_len, size_t
  *needed);
typedef enum jam_correlation_column { JAM_CORRELATION_R = 0, JAM_CORRELATION_G = 1 } jam_correlation_column;
#define JAM_CORRELATION_COLUMNS 2
JAM_API jam_status jam_observed_correlation(const jam_system *sys, int32_t columns, double *table, size_t table_len,
  size_t *needed);
typedef enum jam_energy_unit { JAM_ENERGY_LENGTH = 0, JAM_ENERGY_RELATIVE = 1 } jam_energy_unit;
typedef struct jam_monte_carlo_options { uint32_t struct_size; int32_t resume; int32_t energy_unit; int32_t reserved;
  double alpha, energy_scale; double temperature; double step; double acceptance; double swap_share; int64_t sweeps;
  int64_t run; int64_t first_sweep; double wall_time; } jam_monte_carlo_options;
typedef struct jam_monte_carlo_report { uint32_t struct_size; int32_t stop_reason; int64_t sweeps, next_sweep; double
  acceptance, swap_acceptance; double step; double energy, energy_error; double pressure, pressure_error; double msd;
  double trials_per_second, seconds; } jam_monte_carlo_report;
JAM_API jam_status jam_monte_carlo_options_init(jam_monte_carlo_options *o, size_t size);
JAM_API jam_status jam_monte_carlo(jam_system *sys, const jam_monte_carlo_options *o, jam_monte_carlo_report *report);
typedef enum jam_clock { JAM_CLOCK_COLLISIONS = 0, JAM_CLOCK_TIME = 1 } jam_clock;
typedef struct jam_isoconf_options { uint32_t struct_size; int32_t threads; int32_t clock; int32_t resume; int64_t
  first_run, runs; int64_t block; double density_ratio; double temperature; double wave_number; double overlap_length;
  double memory_limit; double wall_time; } jam_isoconf_options;
typedef struct jam_isoconf_report { uint32_t struct_size; int32_t stop_reason; int64_t first_run, runs; int64_t
  blocks, instants; double energy_drift, max_overlap; double step, acceptance; double seconds; } jam_isoconf_report;
typedef enum jam_isoconf_column { JAM_ISOCONF_TIME = 0, JAM_ISOCONF_TIME2 = 1, JAM_ISOCONF_MSD = 2, JAM_ISOCONF_MSD2 =
  3, JAM_ISOCONF_SCATTERING = 4, JAM_ISOCONF_SCATTERING2 = 5, JAM_ISOCONF_OVERLAP = 6, JAM_ISOCONF_OVERLAP2 = 7,
  JAM_ISOCONF_ENERGY = 8, JAM_ISOCONF_ENERGY2 = 9, JAM_ISOCONF_VELOCITY = 10, JAM_ISOCONF_COLLISIONS = 11,
  JAM_ISOCONF_PRESSURE = 12, JAM_ISOCONF_RUNS = 13 } jam_isoconf_column;
#define JAM_ISOCONF_COLUMNS 14
JAM_API jam_status jam_isoconf_options_init(jam_isoconf_options *o, size_t size);
JAM_API jam_status jam_isoconf(jam_system *sys, const jam_isoconf_options *o, const jam_monte_carlo_options *m, const
  double *instant, size_t instant_len, const int32_t *kept, size_t kept_len, jam_isoconf_report *report);
JAM_API jam_status jam_get_isoconf_report(const jam_system *sys, jam_isoconf_report *report);
JAM_API jam_status jam_isoconf_series(const jam_system *sys, int64_t block, int32_t columns, double *table, size_t
  table_len, size_t *needed);
JAM_API jam_status jam_isoconf_displacements(const jam_system *sys, int64_t block, double *displacement, size_t
  displacement_len, double *square, size_t square_len, size_t *rows);
JAM_API jam_status jam_isoconf_distances(const jam_system *sys, int64_t block, double *distance2, size_t
  distance2_len, double *distance4, size_t distance4_len, size_t *rows);
JAM_API jam_status jam_isoconf_kept(const jam_system *sys, int32_t instant, double *out, size_t out_len, size_t
  *needed);
typedef enum jam_lp_solver { JAM_LP_IPM = 0, JAM_LP_CLP = 1 } jam_lp_solver;
typedef enum jam_crunch_method { JAM_CRUNCH_BARRIER_PATH = 0, JAM_CRUNCH_SEQUENTIAL_LP = 1 } jam_crunch_method;
typedef enum jam_free_strain { JAM_STRAIN_NONE = 0, JAM_STRAIN_EDGES = 1, JAM_STRAIN_TILTS = 2, JAM_STRAIN_FREE = 3,
  JAM_STRAIN_VOLUME = 4, JAM_STRAIN_EDGES_VOLUME = 5, JAM_STRAIN_TILTS_VOLUME = 6, JAM_STRAIN_ALL = 7 }
  jam_free_strain;
typedef struct jam_crunch_options { uint32_t struct_size; int32_t lp_solver; int32_t method; int32_t polish; int32_t
  max_lps; int32_t threads; double gain_tolerance; double step_tolerance; double lp_tolerance; double
  neighbour_radius; double step_bound; double wall_time; int32_t steps; int32_t full_lps; int32_t strain; int32_t
  keep_steps; double duality_gap; int32_t prove; int32_t reserved; } jam_crunch_options;
typedef struct jam_crunch_report { uint32_t struct_size; int32_t jammed; int32_t stop_reason; int32_t lp_solver;
  int32_t method; int32_t stationary; int32_t strictly_jammed; int32_t reserved; double packing_fraction; double
  diameter_mean; int64_t contacts; int64_t rattlers, stable; int64_t bucklers; int64_t isostatic_contacts; int64_t
  excess_contacts; int64_t flexes; int64_t zero_force_contacts; int64_t undecided_contacts; int64_t undercoordinated;
  int64_t strict_contacts_needed; double rigidity_margin; int64_t lp_solves, factorisations; double gain; double
  max_step; double max_overlap; double force_residual; double gamma_residual; double min_force; double min_gap; double
  max_contact_gap; double duality_gap; double force_scale; double seconds, seconds_factor; double seconds_assemble,
  seconds_solve; int32_t status; int32_t decompressions; double packing_fraction_start; double displacement_max,
  displacement_rms; double displacement_max_stable, displacement_rms_stable; int64_t contacts_start; int64_t
  contacts_kept; int32_t theorem, proof_cause; double proof_radius; double proof_value, proof_bound; }
  jam_crunch_report;
JAM_API jam_status jam_crunch_options_init(jam_crunch_options *o, size_t size);
JAM_API jam_status jam_crunch(jam_system *sys, const jam_crunch_options *o, jam_crunch_report *report);
typedef struct jam_estimate_report { uint32_t struct_size; int32_t reserved; int64_t pairs; double bytes; double
  factor_bytes; double flops; double factorisations; double step_seconds; double seconds; double seconds_low,
  seconds_high; } jam_estimate_report;
JAM_API jam_status jam_estimate_crunch(const jam_system *sys, const jam_crunch_options *o, jam_estimate_report
  *report);
JAM_API jam_status jam_get_crunch_report(const jam_system *sys, jam_crunch_report *report);
typedef enum jam_step_phase { JAM_STEP_PATH = 1, JAM_STEP_LP = 2, JAM_STEP_POLISH = 3 } jam_step_phase;
typedef enum jam_history_column { JAM_HISTORY_PHASE = 0, JAM_HISTORY_GAIN = 1, JAM_HISTORY_PHI = 2,
  JAM_HISTORY_STEP_MAX = 3, JAM_HISTORY_STEP_MSD = 4, JAM_HISTORY_TOTAL_MAX = 5, JAM_HISTORY_TOTAL_MSD = 6,
  JAM_HISTORY_CONTACTS = 7, JAM_HISTORY_EXCESS = 8, JAM_HISTORY_RATTLERS = 9, JAM_HISTORY_SECONDS = 10,
  JAM_HISTORY_ITERATIONS = 11, JAM_HISTORY_FACTORISATIONS = 12, JAM_HISTORY_DUALITY_GAP = 13, JAM_HISTORY_PAIRS = 14,
  JAM_HISTORY_HELD = 15, JAM_HISTORY_PART = 16, JAM_HISTORY_BOUND = 17, JAM_HISTORY_STEP_MSD_STABLE = 18,
  JAM_HISTORY_TOTAL_MSD_STABLE = 19 } jam_history_column;
#define JAM_HISTORY_COLUMNS 20
JAM_API jam_status jam_crunch_history(const jam_system *sys, int32_t columns, double *table, size_t table_len, size_t
  *needed);
JAM_API jam_status jam_crunch_step(const jam_system *sys, double *displacement, size_t displacement_len, int32_t
  *pair, size_t pair_len, double *vector, size_t vector_len, double *dual, size_t dual_len, size_t *rows);
typedef struct jam_radii_options { uint32_t struct_size; int32_t threads; double radius_min, radius_max; double room;
  int64_t max_steps; double wall_time; int64_t moments; double exponent_1, exponent_2, exponent_3, exponent_4; int32_t
  strain; int32_t reserved; } jam_radii_options;
typedef struct jam_radii_report { uint32_t struct_size; int32_t stop_reason; int32_t maximum; int32_t saddles; double
  value; int64_t contacts, rattlers; int64_t at_bounds; int64_t excess; double balance_residual; double
  max_contact_gap, min_gap; double min_force; double radius_smallest, radius_largest, polydispersity; double
  packing_fraction; int64_t steps, factorisations; double seconds; double multiplier_1, multiplier_2, multiplier_3,
  multiplier_4; double moment_residual; } jam_radii_report;
JAM_API jam_status jam_radii_options_init(jam_radii_options *o, size_t size);
JAM_API jam_status jam_maximise_radii(jam_system *sys, const jam_radii_options *o, const double *weights, size_t
  weights_len, jam_radii_report *report);
typedef enum jam_soft_scale { JAM_SOFT_RELATIVE = 0, JAM_SOFT_ABSOLUTE = 1, JAM_SOFT_BARE = 2 } jam_soft_scale;
typedef enum jam_minimiser { JAM_MINIMISER_NEWTON = 0, JAM_MINIMISER_FIRE = 1, JAM_MINIMISER_LBFGS = 2 }
  jam_minimiser;
typedef enum jam_soft_precision { JAM_SOFT_REFERENCE = 0, JAM_SOFT_DOUBLE = 1 } jam_soft_precision;
typedef struct jam_relax_options { uint32_t struct_size; int32_t minimiser; int32_t scale; int32_t precision; double
  alpha; double force_tolerance; int64_t max_evaluations; double wall_time; int32_t strain; int32_t reserved; double
  pressure; int64_t components; } jam_relax_options;
typedef struct jam_relax_report { uint32_t struct_size; int32_t converged; int32_t stop_reason; int32_t minimiser;
  double force_residual; double energy, pressure; double packing_fraction; double distance; double jammed_fraction;
  double coordination; double mean_overlap, max_overlap; int64_t contacts, excess_contacts; int64_t stable, rattlers;
  int64_t evaluations, factorisations; double seconds; double stress_residual; } jam_relax_report;
JAM_API jam_status jam_relax_options_init(jam_relax_options *o, size_t size);
JAM_API jam_status jam_relax(jam_system *sys, const jam_relax_options *o, jam_relax_report *report);
typedef struct jam_decompress_options { uint32_t struct_size; int32_t minimiser; int32_t scale; int32_t precision;
  double alpha; double force_tolerance; double energy_factor; double pressure, distance; int32_t isostatic; int32_t
  crunch; int32_t max_steps; int32_t reserved; int64_t max_evaluations; double wall_time; } jam_decompress_options;
typedef struct jam_decompress_report { uint32_t struct_size; int32_t stop_reason; int32_t isostatic; int32_t
  same_network; double force_residual; double energy, pressure; double packing_fraction; double distance; double
  jammed_fraction, crunch_fraction; double force_difference; double coordination; int64_t contacts, excess_contacts;
  int64_t common_contacts; int64_t rattlers; int64_t steps, restored; int64_t evaluations, factorisations; double
  seconds, seconds_crunch; } jam_decompress_report;
typedef enum jam_soft_column { JAM_SOFT_PHI = 0, JAM_SOFT_PRESSURE = 1, JAM_SOFT_ENERGY = 2, JAM_SOFT_COORDINATION =
  3, JAM_SOFT_DISTANCE = 4, JAM_SOFT_EXCESS = 5, JAM_SOFT_RATTLERS = 6, JAM_SOFT_RESIDUAL = 7, JAM_SOFT_EVALUATIONS =
  8, JAM_SOFT_FACTORISATIONS = 9, JAM_SOFT_SECONDS = 10 } jam_soft_column;
#define JAM_SOFT_COLUMNS 11
JAM_API jam_status jam_decompress_options_init(jam_decompress_options *o, size_t size);
JAM_API jam_status jam_decompress(jam_system *sys, const jam_decompress_options *o, jam_decompress_report *report);
JAM_API jam_status jam_decompress_history(const jam_system *sys, int32_t columns, double *table, size_t table_len,
  size_t *needed);
typedef enum jam_shear_until { JAM_UNTIL_STRAIN = 0, JAM_UNTIL_EVENT = 1, JAM_UNTIL_JAMMED = 2, JAM_UNTIL_UNJAMMED = 3
  } jam_shear_until;
typedef struct jam_shear_options { uint32_t struct_size; int32_t minimiser; int32_t scale; int32_t precision; double
  alpha; double force_tolerance; int64_t max_evaluations; double wall_time; double step; double resolution; int64_t
  max_steps; int32_t until; int32_t strain; double pressure; int64_t components; } jam_shear_options;
typedef enum jam_shear_column { JAM_SHEAR_STRAIN = 0, JAM_SHEAR_STRESS = 1, JAM_SHEAR_PRESSURE = 2, JAM_SHEAR_ENERGY =
  3, JAM_SHEAR_PHI = 4, JAM_SHEAR_CONTACTS = 5, JAM_SHEAR_MADE = 6, JAM_SHEAR_BROKEN = 7, JAM_SHEAR_NONAFFINE = 8,
  JAM_SHEAR_EVENT = 9, JAM_SHEAR_RATTLERS = 10, JAM_SHEAR_EVALUATIONS = 11, JAM_SHEAR_FACTORISATIONS = 12 }
  jam_shear_column;
#define JAM_SHEAR_COLUMNS 13
typedef struct jam_shear_report { uint32_t struct_size; int32_t stop_reason; int32_t rigid; int32_t reserved; double
  strain; double stress, pressure; double energy, packing_fraction; double first_event; double peak_stress,
  peak_strain; int64_t events, steps; int64_t contacts, rattlers; int64_t evaluations, factorisations; double seconds;
  } jam_shear_report;
JAM_API jam_status jam_shear_options_init(jam_shear_options *o, size_t size);
JAM_API jam_status jam_shear(jam_system *sys, const jam_shear_options *o, const double *turns, size_t turns_len, const
  double *mode, size_t mode_len, jam_shear_report *report);
JAM_API jam_status jam_shear_history(const jam_system *sys, int32_t columns, double *table, size_t table_len, size_t
  *needed);
JAM_API jam_status jam_contacts(const jam_system *sys, int32_t *out, size_t out_len, size_t *needed);
JAM_API jam_status jam_contact_vectors(const jam_system *sys, double *out, size_t out_len, size_t *needed);
JAM_API jam_status jam_contact_gaps(const jam_system *sys, double *out, size_t out_len, size_t *needed);
JAM_API jam_status jam_forces(const jam_system *sys, double *out, size_t out_len, size_t *needed);
JAM_API jam_status jam_coordination(const jam_system *sys, int32_t *out, size_t out_len, size_t *needed);
typedef enum jam_stiffness { JAM_STIFFNESS_HARMONIC = 0, JAM_STIFFNESS_POWER = 1, JAM_STIFFNESS_HARD = 2,
  JAM_STIFFNESS_SOFT = 3 } jam_stiffness;
typedef struct jam_hessian_options { uint32_t struct_size; int32_t stiffness; double alpha; double prestress; }
  jam_hessian_options;
typedef enum jam_modes_which { JAM_MODES_LOWEST = 0, JAM_MODES_HIGHEST = 1, JAM_MODES_NEAR = 2, JAM_MODES_ALL = 3 }
  jam_modes_which;
typedef struct jam_modes_options { uint32_t struct_size; int32_t which; int64_t count; double frequency; double
  tolerance; double memory_limit; } jam_modes_options;
typedef enum jam_mode_column { JAM_MODE_LAMBDA = 0, JAM_MODE_PARTICIPATION = 1 } jam_mode_column;
#define JAM_MODE_COLUMNS 2
JAM_API jam_status jam_hessian_options_init(jam_hessian_options *o, size_t size);
JAM_API jam_status jam_modes_options_init(jam_modes_options *o, size_t size);
JAM_API jam_status jam_hessian_map(const jam_system *sys, int32_t *out, size_t out_len, size_t *needed);
JAM_API jam_status jam_hessian(const jam_system *sys, const jam_hessian_options *h, int32_t *row_start, size_t
  row_start_len, int32_t *column, size_t column_len, double *value, size_t value_len, size_t *rows);
JAM_API jam_status jam_modes(jam_system *sys, const jam_hessian_options *h, const jam_modes_options *o, int32_t
  columns, double *table, size_t table_len, double *vector, size_t vector_len, size_t *rows);
JAM_API jam_status jam_bloch_modes(jam_system *sys, const jam_hessian_options *h, const double *wave, size_t wave_len,
  int32_t columns, double *table, size_t table_len, double *vector, size_t vector_len, size_t *rows);
typedef struct jam_geometry_options { uint32_t struct_size; int32_t reserved; double tolerance; double window; }
  jam_geometry_options;
typedef struct jam_geometry_report { uint32_t struct_size; int32_t self_contacts; double tolerance; double gap_below,
  gap_above; double jump; double resolution; double second_jump; double second_tolerance; int64_t second_contacts;
  int64_t pairs_within; int64_t contacts; int64_t excess_contacts; int64_t self_stresses; int64_t zero_modes; double
  force_residual; double min_force; int64_t clusters; } jam_geometry_report;
JAM_API jam_status jam_geometry_options_init(jam_geometry_options *o, size_t size);
JAM_API jam_status jam_contacts_from_geometry(jam_system *sys, const jam_geometry_options *o, jam_geometry_report
  *report);
JAM_API jam_status jam_contacts_by_distance(jam_system *sys, double gap);
JAM_API jam_status jam_stress_states(jam_system *sys, double *force, size_t force_len, double *basis, size_t
  basis_len, double *residual, size_t *rows);
typedef enum jam_rigidity_kind { JAM_RIGIDITY_COLLECTIVE = 0, JAM_RIGIDITY_STRICT = 1 } jam_rigidity_kind;
typedef enum jam_verdict { JAM_VERDICT_UNTESTED = -1, JAM_VERDICT_NO = 0, JAM_VERDICT_YES = 1, JAM_VERDICT_UNDECIDED =
  2 } jam_verdict;
typedef struct jam_rigidity_report { uint32_t struct_size; int32_t kind; int32_t jammed; int32_t stationary; int64_t
  stable, contacts; int64_t contacts_needed; int64_t self_stresses; int64_t flexes; int64_t undercoordinated; int64_t
  zero_force_contacts; int64_t undecided_contacts; double rigidity_margin; double force_residual; double
  curvature_margin; } jam_rigidity_report;
JAM_API jam_status jam_rigidity(jam_system *sys, int32_t kind, jam_rigidity_report *report);
JAM_API jam_status jam_flex(jam_system *sys, int32_t kind, double *out, size_t out_len, double *strain, size_t
  strain_len, size_t *needed);
typedef enum jam_bloch_column { JAM_BLOCH_FLEXES = 0, JAM_BLOCH_MARGIN = 1 } jam_bloch_column;
#define JAM_BLOCH_COLUMNS 2
JAM_API jam_status jam_bloch_rigidity(jam_system *sys, const int32_t *count, size_t count_len, double *wave, size_t
  wave_len, int32_t columns, double *table, size_t table_len, size_t *rows);
typedef enum jam_check_reason { JAM_CHECK_PROOF = 0, JAM_CHECK_APART = 1, JAM_CHECK_NO_FORCE = 2, JAM_CHECK_FLEX = 3,
  JAM_CHECK_DIGITS = 4, JAM_CHECK_OVERLAP = 5, JAM_CHECK_GAPS = 6, JAM_CHECK_MARGIN = 7, JAM_CHECK_SLIDE = 8 }
  jam_check_reason;
typedef struct jam_check_options { uint32_t struct_size; int32_t crunch; double wall_time; int32_t prove; int32_t
  reserved; } jam_check_options;
typedef struct jam_check_report { uint32_t struct_size; int32_t jammed; int32_t strictly_jammed; int32_t stationary;
  int32_t reason; int32_t dim; int32_t digits; int32_t crunch_jammed; int64_t n; int64_t contacts; int64_t
  excess_contacts; int64_t rattlers; int64_t closed_pairs; int64_t zero_force_contacts; int64_t undecided_contacts;
  int64_t self_stresses; int64_t flexes, strict_flexes; int64_t crunch_contacts; double packing_fraction; double
  nearest_gap; double min_gap; double max_contact_gap; double force_residual; double rigidity_margin; double
  coordinate_step; double resolution; double diameter_factor; double crunch_packing_fraction; double
  crunch_displacement_max; double crunch_displacement_rms; int32_t theorem, proof_cause; double proof_radius; double
  proof_value, proof_bound; double curvature_margin; int64_t strict_excess_contacts; } jam_check_report;
JAM_API jam_status jam_check_options_init(jam_check_options *o, size_t size);
JAM_API jam_status jam_check_packing(jam_system *sys, const jam_check_options *o, jam_check_report *report);
JAM_API const char *jam_check_text(const jam_check_report *report);
typedef enum jam_theorem { JAM_THEOREM_NONE = 0, JAM_THEOREM_TRAPPED = 1, JAM_THEOREM_EXACT = 2 } jam_theorem;
typedef enum jam_proof_cause { JAM_CAUSE_NONE = 0, JAM_CAUSE_EXCESS = 1, JAM_CAUSE_FORCE = 2, JAM_CAUSE_GAP = 3,
  JAM_CAUSE_SINGULAR = 4, JAM_CAUSE_RATTLER = 5, JAM_CAUSE_IMAGES = 6, JAM_CAUSE_SADDLE = 7 } jam_proof_cause;
typedef struct jam_proof_report { uint32_t struct_size; int32_t theorem; int32_t cause; int32_t reserved; int64_t
  stable, contacts; double cause_value, cause_bound; double radius; double gamma, gamma_low; double packing_fraction;
  double fraction_error; double least_force, force_error; double least_gap; double inner, outer; double singular;
  double eigenvalue, rounding; } jam_proof_report;
JAM_API jam_status jam_prove(const jam_system *sys, int32_t kind, const double *ratio, size_t ratio_len,
  jam_proof_report *report);
JAM_API const char *jam_proof_text(int32_t theorem, int32_t cause, double radius, double value, double bound);
JAM_API jam_status jam_write_proof(const jam_system *sys, const char *path, int32_t kind, const double *ratio, size_t
  ratio_len);
JAM_API jam_status jam_refined_positions(const jam_system *sys, const double *ratio, size_t ratio_len, double *high,
  size_t high_len, double *low, size_t low_len, size_t *needed);
typedef enum jam_contact_class { JAM_CONTACT_LOCALISED = 1, JAM_CONTACT_SMALLEST = 2, JAM_CONTACT_MEDIAN = 4 }
  jam_contact_class;
JAM_API jam_status jam_gaps(const jam_system *sys, double h_max, int32_t stable_only, double *gap, size_t gap_len,
  int32_t *pair, size_t pair_len, size_t *rows);
JAM_API jam_status jam_contact_classes(const jam_system *sys, int32_t *out, size_t out_len, size_t *needed);
JAM_API jam_status jam_sphere_structure(const jam_system *sys, int32_t weighted, double *c, size_t c_len, double *s,
  size_t s_len, size_t *rows);
JAM_API jam_status jam_contact_dots(const jam_system *sys, int32_t weighted, double *dot, size_t dot_len, int32_t
  *sphere, size_t sphere_len, size_t *rows);
JAM_API jam_status jam_fabric_tensor(const jam_system *sys, double *out, size_t out_len, size_t *needed);
JAM_API jam_status jam_stress(const jam_system *sys, double *out, size_t out_len, size_t *needed);
typedef enum jam_local_quantity { JAM_LOCAL_FORCE = 0, JAM_LOCAL_VECTOR_SUM = 1, JAM_LOCAL_VECTOR_PAIRS = 2,
  JAM_LOCAL_VECTOR_DOT = 3, JAM_LOCAL_FORCE_SUM = 4, JAM_LOCAL_FORCE_PAIRS = 5, JAM_LOCAL_FORCE_DOT = 6,
  JAM_LOCAL_COORDINATION = 7 } jam_local_quantity;
typedef enum jam_population { JAM_POPULATION_ALL = 0, JAM_POPULATION_LOCALISED = 1, JAM_POPULATION_EXTENDED = 2,
  JAM_POPULATION_SMALLEST = 3, JAM_POPULATION_MEDIAN = 4 } jam_population;
JAM_API jam_status jam_local_values(const jam_system *sys, int32_t quantity, int32_t population, double *out, size_t
  out_len, size_t *needed);
typedef struct jam_correlation_options { uint32_t struct_size; int32_t a, b; int32_t reserved; double r_max; int64_t
  bins; } jam_correlation_options;
JAM_API jam_status jam_correlation_options_init(jam_correlation_options *o, size_t size);
JAM_API jam_status jam_pair_correlation(const jam_system *sys, const jam_correlation_options *o, const int32_t *kind,
  size_t kind_len, double *out, size_t out_len, size_t *needed);
JAM_API jam_status jam_mk_shifts(const jam_system *sys, const int32_t *pair, size_t pair_len, double *out, size_t
  out_len, size_t *needed);
typedef enum jam_structure_column { JAM_STRUCTURE_Q = 0, JAM_STRUCTURE_S = 1 } jam_structure_column;
#define JAM_STRUCTURE_COLUMNS 2
JAM_API jam_status jam_structure_factor(jam_system *sys, double q_max, int32_t columns, double *table, size_t
  table_len, size_t *needed);
JAM_API jam_status jam_bond_order(const jam_system *sys, int32_t l, double cutoff, double *out, size_t out_len, size_t
  *needed);
JAM_API jam_status jam_local_fraction(const jam_system *sys, double *out, size_t out_len, size_t *needed);
typedef enum jam_mesh_contacts { JAM_MESH_KEPT = 0, JAM_MESH_SHRUNK = 1, JAM_MESH_BRIDGED = 2 } jam_mesh_contacts;
typedef enum jam_mesh_walls { JAM_MESH_SPHERES = 0, JAM_MESH_AND_WALLS = 1, JAM_MESH_WALLS = 2 } jam_mesh_walls;
typedef struct jam_mesh_options { uint32_t struct_size; int32_t contacts; double edge; double factor; double bridge;
  double bridge_gap; int32_t walls; int32_t reserved; } jam_mesh_options;
typedef struct jam_mesh_report { uint32_t struct_size; int32_t reserved; int64_t triangles, bridges, bytes; double
  volume, solid; } jam_mesh_report;
JAM_API jam_status jam_mesh_options_init(jam_mesh_options *o, size_t size);
JAM_API jam_status jam_write_stl(const jam_system *sys, const char *path, const jam_mesh_options *o, jam_mesh_report
  *report);
typedef struct jam_voxel_options { uint32_t struct_size; int32_t lines; int32_t nx, ny, nz; int32_t reserved; double
  size; } jam_voxel_options;
typedef struct jam_voxel_report { uint32_t struct_size; int32_t nx, ny, nz; int64_t bytes; double porosity; double dx,
  dy, dz; } jam_voxel_report;
JAM_API jam_status jam_voxel_options_init(jam_voxel_options *o, size_t size);
JAM_API jam_status jam_voxels(const jam_system *sys, const jam_voxel_options *o, jam_voxel_report *report, double
  *out, size_t out_len, size_t *needed);
JAM_API jam_status jam_write_voxels(const jam_system *sys, const char *path, const jam_voxel_options *o,
  jam_voxel_report *report);
typedef enum jam_profile_column { JAM_PROFILE_LOW = 0, JAM_PROFILE_HIGH = 1, JAM_PROFILE_SOLID = 2 }
  jam_profile_column;
#define JAM_PROFILE_COLUMNS 3
JAM_API jam_status jam_solid_profile(const jam_system *sys, int32_t axis, int32_t bins, int32_t columns, double
  *table, size_t table_len, size_t *needed);
JAM_API jam_status jam_near_coordination(const jam_system *sys, double h_max, int32_t *out, size_t out_len, size_t
  *needed);
typedef enum jam_pore_column { JAM_PORE_X = 0, JAM_PORE_Y = 1, JAM_PORE_Z = 2, JAM_PORE_DISTANCE = 3, JAM_PORE_RADIUS
  = 4 } jam_pore_column;
#define JAM_PORE_COLUMNS 5
JAM_API jam_status jam_pore_sizes(jam_system *sys, int64_t points, int64_t seed, int32_t columns, double *table,
  size_t table_len, size_t *needed);
typedef enum jam_floppy_column { JAM_FLOPPY_MEDIAN = 0, JAM_FLOPPY_WEIGHT = 1, JAM_FLOPPY_S_PLUS = 2,
  JAM_FLOPPY_S_STAR = 3, JAM_FLOPPY_STABILITY = 4, JAM_FLOPPY_S_RETURN = 5 } jam_floppy_column;
#define JAM_FLOPPY_COLUMNS 6
JAM_API jam_status jam_floppy_modes(jam_system *sys, const int64_t *contact, size_t contact_len, int32_t columns,
  double *table, size_t table_len, double *vector, size_t vector_len, size_t *rows);
typedef struct jam_dos_options { uint32_t struct_size; int32_t moments; int32_t vectors; int32_t points; int64_t seed;
  double low, high; } jam_dos_options;
typedef struct jam_moduli_report { uint32_t struct_size; int32_t reserved; double bulk, bulk_affine; double shear,
  shear_affine; double shear_min, shear_max; } jam_moduli_report;
typedef struct jam_comparison_report { uint32_t struct_size; int32_t reserved; int64_t contacts_a, contacts_b; int64_t
  common_contacts; int64_t stable_in_both; double overlap, overlap_a; double packing_fraction_change; double
  displacement_rms, displacement_max; } jam_comparison_report;
typedef enum jam_dos_column { JAM_DOS_OMEGA = 0, JAM_DOS_DENSITY = 1, JAM_DOS_ERROR = 2, JAM_DOS_EDGE = 3,
  JAM_DOS_CUMULATIVE = 4, JAM_DOS_CUMULATIVE_ERROR = 5 } jam_dos_column;
#define JAM_DOS_COLUMNS 6
JAM_API jam_status jam_dos_options_init(jam_dos_options *o, size_t size);
JAM_API jam_status jam_density_of_states(jam_system *sys, const jam_hessian_options *h, const jam_dos_options *o,
  int32_t columns, double *table, size_t table_len, size_t *needed);
JAM_API jam_status jam_moduli(jam_system *sys, const jam_hessian_options *h, jam_moduli_report *report);
JAM_API jam_status jam_elastic_tensor(jam_system *sys, const jam_hessian_options *h, double *affine, size_t
  affine_len, double *relaxed, size_t relaxed_len, size_t *needed);
JAM_API jam_status jam_compare(const jam_system *sys, const jam_system *other, jam_comparison_report *comparison,
  double *out, size_t out_len, size_t *needed);
#ifdef __cplusplus
}
#endif
#endif
