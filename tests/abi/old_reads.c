/* Every report and every table as a program of another version of 1.x reads them. It is compiled with the recorded
 * header, and by other_versions.py with headers whose structs and tables are shorter or longer than the library's. What
 * it reads must be what it computes itself or finds elsewhere, and nothing may be written behind a struct. LONGER: the
 * members `later_real` and `later_whole` and a column more are unknown to the library.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jam/jam.h>

static int failures;
#define CHECK(truth) \
  if (!(truth)) printf("line %d: %s (%s)\n", __LINE__, #truth, jam_last_error()), ++failures

#ifdef LONGER
#define UNKNOWN_COLUMN(row, columns) isnan((row)[(columns)-1])
#define UNKNOWN(report) (isnan((report).later_real) && (report).later_whole == -1)
#else
#define UNKNOWN_COLUMN(row, columns) 1
#define UNKNOWN(report) 1
#endif
#define NEAR(a, b) (fabs((a) - (b)) <= 1e-9 * fabs(b))

/* A report with guarded bytes behind it. */
#define REPORT(type, name)     \
  union {                      \
    type is;                   \
    unsigned char bytes[4096]; \
  } name;                      \
  memset(&name, 0x5a, sizeof name), name.is.struct_size = sizeof(type)
#define INTACT(type, name) (name.is.struct_size == sizeof(type) && name.bytes[sizeof(type)] == 0x5a && UNKNOWN(name.is))

/* Options of this version, as its own init fills them; a later one's must be refused where the library does not know
 * it. */
#define OPTIONS(type, name) \
  type name;                \
  CHECK(type##_init(&name, sizeof name) == JAM_OK && name.struct_size == sizeof name)
#ifdef LONGER
#define LATER(name, call)             \
  CHECK(name.later_real == 0.0);      \
  name.later_real = 1.0;              \
  CHECK((call) == JAM_E_STRUCT_SIZE); \
  name.later_real = 0.0
#else
#define LATER(name, call) (void)0
#endif

enum { ROOM = 20000 };
static double table[ROOM], first[ROOM];
static size_t needed;

/* Rows of a table by as many columns as this version knows. `one` gives a single column: each row then has the same
 * first number. Columns behind those of the library are NaN. */
static size_t rows_of(int line, int32_t columns, jam_status status, jam_status one, size_t rows_of_one) {
  const size_t rows = needed / (size_t)columns;
  size_t k;
  int good = status >= 0 && one >= 0 && needed == rows * (size_t)columns && rows == rows_of_one && rows > 0;
  for (k = 0; good && k < rows; ++k) {
    const double *const row = table + k * (size_t)columns;
    good = row[0] == first[k] && UNKNOWN_COLUMN(row, columns);
  }
  if (!good)
    printf("line %d: table of %d columns: %d, %d, %zu numbers\n", line, columns, status, one, needed), ++failures;
  return good ? rows : 0;
}
/* READ(columns, rows, call(..., COLUMNS, TABLE)): the call with all columns, and with one. */
#define READ(count, rows, call)                                  \
  do {                                                           \
    int32_t columns = 1;                                         \
    double *out = first;                                         \
    jam_status status, one = (call);                             \
    const size_t rows_of_one = needed;                           \
    columns = (count), out = table;                              \
    status = (call);                                             \
    rows = rows_of(__LINE__, columns, status, one, rows_of_one); \
  } while (0)
#define TABLE columns, out, ROOM
#define AT(row, count, column) table[(row) * (size_t)(count) + (column)]

static jam_system *made(int dim, int64_t n, double fraction, int32_t walls, int32_t overlap) {
  jam_system *sys = NULL;
  double ratio[64];
  int64_t k;
  jam_start start;
  OPTIONS(jam_create_options, o);
  memset(&start, 0, sizeof start);
  for (k = 0; k < n; ++k) ratio[k] = k % 2 ? 1.0 : 1.4;
  start.struct_size = sizeof start, start.diameters = ratio, start.diameters_len = (size_t)n;
  o.dim = dim, o.n = n, o.packing_fraction = fraction, o.walls = walls, o.overlap = overlap, o.seed = 5;
  LATER(o, jam_create(&o, &start, &sys));
  CHECK(jam_create(&o, &start, &sys) == JAM_OK);
  CHECK(jam_create_options_init(&o, 1u << 20) == JAM_E_STRUCT_SIZE);
  return sys;
}

static void fluid(void) {
  jam_system *sys = made(3, 24, 0.2, 4, JAM_OVERLAP_REFUSE), *open = made(3, 24, 0.2, 0, JAM_OVERLAP_REFUSE);
  const double *sigma = NULL;
  size_t n = 0, rows = 0, k;
  double volume = 0.0;
  REPORT(jam_info, info);
  REPORT(jam_size_report, sizes);
  REPORT(jam_md_report, md);
  REPORT(jam_mesh_report, mesh);
  REPORT(jam_voxel_report, voxels);
  OPTIONS(jam_observe_options, observe);
  OPTIONS(jam_run_options, run);
  OPTIONS(jam_voxel_options, image);
  CHECK(jam_get_info(sys, &info.is) == JAM_OK && INTACT(jam_info, info));
  CHECK(info.is.dim == 3 && info.is.n == 24 && info.is.walls == 4 && NEAR(info.is.packing_fraction, 0.2));
  CHECK(jam_view(sys, JAM_VIEW_DIAMETERS, &sigma, &n) == JAM_OK && n == 24);
  for (k = 0; k < n; ++k) volume += 3.14159265358979323846 / 6.0 * sigma[k] * sigma[k] * sigma[k];
  CHECK(jam_get_size_report(3, sigma, n, &sizes.is) == JAM_OK && INTACT(jam_size_report, sizes));
  CHECK(sizes.is.n == 24 && NEAR(sizes.is.volume, volume) && NEAR(sizes.is.largest, 1.4 * sizes.is.least));
  READ(JAM_WALL_COLUMNS, rows, jam_walls(sys, TABLE, &needed));
  CHECK(rows == 2 && AT(0, JAM_WALL_COLUMNS, JAM_WALL_AXIS) == 2.0 && AT(1, JAM_WALL_COLUMNS, JAM_WALL_SIDE) == 1.0);
  CHECK(NEAR(AT(1, JAM_WALL_COLUMNS, JAM_WALL_AREA), 1.0) && AT(0, JAM_WALL_COLUMNS, JAM_WALL_GAP) > 0.0);
  observe.gap_bins = observe.r_bins = 8, observe.sample_every = 1.0, run.collisions_per_particle = 10.0;
  LATER(observe, jam_observe(open, &observe));
  CHECK(jam_observe(open, &observe) == JAM_OK);
  LATER(run, jam_run(open, &run, NULL));
  CHECK(jam_run(open, &run, &md.is) == JAM_OK && INTACT(jam_md_report, md));
  CHECK(md.is.stop_reason == JAM_STOP_COLLISIONS && md.is.collisions == 120 && NEAR(md.is.packing_fraction, 0.2));
  READ(JAM_SERIES_COLUMNS, rows, jam_observed_series(open, TABLE, &needed));
  CHECK(rows == 10 && AT(9, JAM_SERIES_COLUMNS, JAM_SERIES_COLLISIONS) == 10.0);
  CHECK(NEAR(AT(9, JAM_SERIES_COLUMNS, JAM_SERIES_FRACTION), 0.2) && NEAR(table[9 * JAM_SERIES_COLUMNS], md.is.time));
  READ(JAM_GAP_COLUMNS, rows, jam_observed_gaps(open, TABLE, &needed));
  CHECK(rows == 8 && AT(0, JAM_GAP_COLUMNS, JAM_GAP_LOW) == 0.0);
  CHECK(AT(1, JAM_GAP_COLUMNS, JAM_GAP_LOW) == AT(0, JAM_GAP_COLUMNS, JAM_GAP_HIGH));
  READ(JAM_CORRELATION_COLUMNS, rows, jam_observed_correlation(open, TABLE, &needed));
  CHECK(rows == 8 && NEAR(AT(7, JAM_CORRELATION_COLUMNS, JAM_CORRELATION_R), 3.75));
  READ(JAM_STRUCTURE_COLUMNS, rows, jam_structure_factor(open, 12.0, TABLE, &needed));
  for (k = 1; k < rows; ++k) CHECK(AT(k, JAM_STRUCTURE_COLUMNS, JAM_STRUCTURE_Q) > AT(k - 1, JAM_STRUCTURE_COLUMNS, 0));
  for (k = 0; k < rows; ++k) CHECK(AT(k, JAM_STRUCTURE_COLUMNS, JAM_STRUCTURE_S) >= 0.0);
  READ(JAM_PROFILE_COLUMNS, rows, jam_solid_profile(open, 0, 5, TABLE, &needed));
  for (volume = 0.0, k = 0; k < rows; ++k) volume += AT(k, JAM_PROFILE_COLUMNS, JAM_PROFILE_SOLID) / 5.0;
  CHECK(rows == 5 && NEAR(volume, 0.2) && NEAR(AT(4, JAM_PROFILE_COLUMNS, JAM_PROFILE_HIGH), 1.0));
  READ(JAM_PORE_COLUMNS, rows, jam_pore_sizes(open, 3, 1, TABLE, &needed));
  for (k = 0; k < rows; ++k)
    CHECK(AT(k, JAM_PORE_COLUMNS, JAM_PORE_RADIUS) >= AT(k, JAM_PORE_COLUMNS, JAM_PORE_DISTANCE));
  CHECK(jam_write_stl(open, NULL, NULL, &mesh.is) == JAM_OK && INTACT(jam_mesh_report, mesh) && mesh.is.triangles > 0);
  image.nx = image.ny = image.nz = 10;
  CHECK(jam_voxels(open, &image, &voxels.is, table, ROOM, NULL) == JAM_OK && INTACT(jam_voxel_report, voxels));
  CHECK(voxels.is.nx == 10 && NEAR(voxels.is.dx, 0.1) && fabs(voxels.is.porosity - 0.8) < 0.05);
  jam_destroy(sys), jam_destroy(open);
}

static void runs(void) {
  jam_system *sys = made(2, 20, 0.3, 0, JAM_OVERLAP_REFUSE);
  const double instant[2] = {1.0, 2.0};
  size_t rows = 0;
  REPORT(jam_monte_carlo_report, mc);
  REPORT(jam_isoconf_report, made_runs);
  OPTIONS(jam_monte_carlo_options, sweeps);
  OPTIONS(jam_isoconf_options, o);
  sweeps.sweeps = 20, o.runs = 2;
  LATER(sweeps, jam_monte_carlo(sys, &sweeps, NULL));
  CHECK(jam_monte_carlo(sys, &sweeps, &mc.is) == JAM_OK && INTACT(jam_monte_carlo_report, mc));
  CHECK(mc.is.sweeps == 20 && mc.is.acceptance > 0.0 && mc.is.acceptance <= 1.0);
  LATER(o, jam_isoconf(sys, &o, NULL, instant, 2, NULL, 0, NULL));
  CHECK(jam_isoconf(sys, &o, NULL, instant, 2, NULL, 0, &made_runs.is) == JAM_OK);
  CHECK(INTACT(jam_isoconf_report, made_runs) && made_runs.is.runs == 2 && made_runs.is.instants == 2);
  READ(JAM_ISOCONF_COLUMNS, rows, jam_isoconf_series(sys, -1, TABLE, &needed));
  CHECK(rows == 2 && AT(1, JAM_ISOCONF_COLUMNS, JAM_ISOCONF_MSD) > AT(0, JAM_ISOCONF_COLUMNS, JAM_ISOCONF_MSD) &&
        AT(1, JAM_ISOCONF_COLUMNS, JAM_ISOCONF_TIME) > AT(0, JAM_ISOCONF_COLUMNS, JAM_ISOCONF_TIME));
  jam_destroy(sys);
}

static void soft(void) {
  jam_system *sys = made(2, 20, 0.95, 0, JAM_OVERLAP_ALLOW);
  size_t rows = 0;
  REPORT(jam_relax_report, minimum);
  REPORT(jam_decompress_report, way);
  OPTIONS(jam_relax_options, relax);
  OPTIONS(jam_decompress_options, o);
  LATER(relax, jam_relax(sys, &relax, NULL));
  CHECK(jam_relax(sys, &relax, &minimum.is) == JAM_OK && INTACT(jam_relax_report, minimum));
  CHECK(minimum.is.converged == 1 && minimum.is.energy > 0.0 && minimum.is.stable + minimum.is.rattlers == 20);
  o.energy_factor = 1e-2, o.crunch = 0, o.pressure = 0.1 * minimum.is.pressure;
  LATER(o, jam_decompress(sys, &o, NULL));
  CHECK(jam_decompress(sys, &o, &way.is) == JAM_OK && INTACT(jam_decompress_report, way));
  CHECK(way.is.crunch_fraction != way.is.crunch_fraction && way.is.common_contacts == -1);
  READ(JAM_SOFT_COLUMNS, rows, jam_decompress_history(sys, TABLE, &needed));
  if (rows)
    CHECK(NEAR(AT(rows - 1, JAM_SOFT_COLUMNS, JAM_SOFT_PHI), way.is.packing_fraction) &&
          NEAR(AT(rows - 1, JAM_SOFT_COLUMNS, JAM_SOFT_PRESSURE), way.is.pressure));
  jam_destroy(sys);
}

/* What a callback is given. A shorter or longer struct than the library's is read as far as both know it. */
struct seen {
  int calls, wrong;
  double fraction;
};
static int32_t look(const jam_progress *p, void *user) {
  struct seen *s = (struct seen *)user;
  ++s->calls;
  s->wrong += (p->phase != JAM_PHASE_CRUNCH && p->phase != JAM_PHASE_POLISH) || !(p->fraction >= s->fraction) ||
              !(p->packing_fraction > 0.05 && p->packing_fraction < 0.9) || p->seconds < 0.0 || p->factorisations < 0;
  s->fraction = p->fraction;
  return 0;
}

static void network(void) {
  jam_system *sys = made(2, 30, 0.3, 0, JAM_OVERLAP_REFUSE);
  const int32_t two[2] = {2, 1};
  const double wave[2] = {0.5, 0.0};
  size_t rows = 0, m;
  double omega;
  struct seen s = {0, 0, 0.0};
  REPORT(jam_estimate_report, estimate);
  REPORT(jam_crunch_report, crunch);
  REPORT(jam_geometry_report, geometry);
  REPORT(jam_rigidity_report, rigid);
  REPORT(jam_check_report, check);
  REPORT(jam_proof_report, proof);
  REPORT(jam_moduli_report, moduli);
  REPORT(jam_comparison_report, same);
  OPTIONS(jam_crunch_options, o);
  OPTIONS(jam_modes_options, some);
  OPTIONS(jam_dos_options, dos);
  OPTIONS(jam_geometry_options, near_ones);
  OPTIONS(jam_check_options, checks);
  CHECK(jam_estimate_crunch(sys, &o, &estimate.is) == JAM_OK && INTACT(jam_estimate_report, estimate) &&
        estimate.is.pairs > 0);
  LATER(o, jam_crunch(sys, &o, NULL));
  CHECK(jam_set_progress(sys, look, &s) == JAM_OK);
  CHECK(jam_crunch(sys, &o, &crunch.is) == JAM_OK && INTACT(jam_crunch_report, crunch) && crunch.is.jammed == 1);
  CHECK(jam_set_progress(sys, NULL, NULL) == JAM_OK && s.calls > 0 && s.wrong == 0);
  CHECK(crunch.is.stop_reason == JAM_STOP_CONVERGED && crunch.is.strictly_jammed == JAM_VERDICT_UNTESTED);
  CHECK(!strcmp(jam_stop_string(JAM_STOP_CONVERGED), "converged"));
  CHECK(crunch.is.stable + crunch.is.rattlers == 30 && crunch.is.contacts == 2 * (crunch.is.stable - 1) + 1);
  READ(JAM_HISTORY_COLUMNS, rows, jam_crunch_history(sys, TABLE, &needed));
  CHECK(rows > 0 && NEAR(AT(rows - 1, JAM_HISTORY_COLUMNS, JAM_HISTORY_PHI), crunch.is.packing_fraction));
  m = (size_t)crunch.is.contacts;
  some.count = 3;
  LATER(some, jam_modes(sys, NULL, &some, 1, NULL, 0, NULL, 0, &needed));
  CHECK(jam_modes(sys, NULL, &some, JAM_MODE_COLUMNS, table, ROOM, NULL, 0, &needed) == JAM_OK && needed == 3);
  CHECK(AT(0, JAM_MODE_COLUMNS, JAM_MODE_LAMBDA) > 0.0 && AT(1, JAM_MODE_COLUMNS, JAM_MODE_LAMBDA) > table[0]);
  omega = AT(2, JAM_MODE_COLUMNS, JAM_MODE_PARTICIPATION);
  CHECK(omega > 0.0 && omega <= 1.0);
  CHECK(jam_bloch_modes(sys, NULL, wave, 2, JAM_MODE_COLUMNS, table, ROOM, NULL, 0, &rows) == JAM_OK);
  CHECK(rows == 2 * (size_t)crunch.is.stable && AT(rows - 1, JAM_MODE_COLUMNS, JAM_MODE_LAMBDA) > table[0]);
  CHECK(jam_bloch_rigidity(sys, two, 2, NULL, 0, JAM_BLOCH_COLUMNS, table, ROOM, &rows) >= 0 && rows == 2);
  CHECK(AT(0, JAM_BLOCH_COLUMNS, JAM_BLOCH_FLEXES) == 0.0 && AT(0, JAM_BLOCH_COLUMNS, JAM_BLOCH_MARGIN) > 0.0);
  CHECK(jam_floppy_modes(sys, NULL, 0, JAM_FLOPPY_COLUMNS, table, ROOM, NULL, 0, &rows) == JAM_OK);
  CHECK(rows == m && AT(0, JAM_FLOPPY_COLUMNS, JAM_FLOPPY_S_PLUS) > 0.0);
  CHECK(NEAR(AT(0, JAM_FLOPPY_COLUMNS, JAM_FLOPPY_S_RETURN), 2.0 * AT(0, JAM_FLOPPY_COLUMNS, JAM_FLOPPY_S_STAR)));
  dos.points = 7;
  LATER(dos, jam_density_of_states(sys, NULL, &dos, 1, NULL, 0, &needed));
  READ(JAM_DOS_COLUMNS, rows, jam_density_of_states(sys, NULL, &dos, TABLE, &needed));
  CHECK(rows == 7 && AT(6, JAM_DOS_COLUMNS, JAM_DOS_EDGE) > AT(6, JAM_DOS_COLUMNS, JAM_DOS_OMEGA));
  CHECK(jam_moduli(sys, NULL, &moduli.is) == JAM_OK && INTACT(jam_moduli_report, moduli) && moduli.is.bulk > 0.0);
  CHECK(jam_compare(sys, sys, &same.is, NULL, 0, NULL) == JAM_OK && INTACT(jam_comparison_report, same));
  CHECK(same.is.common_contacts == crunch.is.contacts && same.is.overlap == 1.0);
  CHECK(jam_rigidity(sys, JAM_RIGIDITY_COLLECTIVE, &rigid.is) == JAM_OK && INTACT(jam_rigidity_report, rigid));
  CHECK(rigid.is.jammed == JAM_VERDICT_YES && rigid.is.contacts == crunch.is.contacts);
  CHECK(jam_prove(sys, JAM_RIGIDITY_COLLECTIVE, NULL, 0, &proof.is) == JAM_OK && INTACT(jam_proof_report, proof));
  CHECK(proof.is.theorem == JAM_THEOREM_EXACT && proof.is.contacts == crunch.is.contacts);
  LATER(checks, jam_check_packing(sys, &checks, NULL));
  CHECK(jam_check_packing(sys, &checks, &check.is) == JAM_OK && INTACT(jam_check_report, check));
  CHECK(check.is.jammed == JAM_VERDICT_YES && check.is.contacts == crunch.is.contacts && check.is.dim == 2);
  CHECK(strstr(jam_check_text(&check.is), "ollectively jammed") != NULL);
  LATER(near_ones, jam_contacts_from_geometry(sys, &near_ones, NULL));
  CHECK(jam_contacts_from_geometry(sys, &near_ones, &geometry.is) == JAM_OK && INTACT(jam_geometry_report, geometry));
  CHECK(geometry.is.contacts == crunch.is.contacts && geometry.is.self_stresses == 1);
  jam_destroy(sys);
}

int main(void) {
  CHECK(jam_abi_version() == JAM_ABI);
  fluid();
  runs();
  soft();
  network();
  if (!failures) printf("libjam %s fills what this program reads\n", jam_version());
  return failures != 0;
}
