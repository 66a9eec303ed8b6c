/* A program of the time when the interface was recorded: it is compiled with recorded/jam/jam.h, linked with that
 * time's names, and runs with the library of now. Options that it sets must act, and numbers that it reads must be
 * those that it computes itself: a member, a value or a column that moved shows. Written anew with a new JAM_ABI alone.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <jam/jam.h>

static int failures;
#define CHECK(truth) \
  if (!(truth)) printf("line %d: %s (%s)\n", __LINE__, #truth, jam_last_error()), ++failures

static const double pi = 3.14159265358979323846;
static int near(double a, double b, double relative) { return fabs(a - b) <= relative * fabs(b); }

struct seen {
  int calls, wrong;
  double fraction;
};
static int32_t look(const jam_progress *p, void *user) {
  struct seen *s = (struct seen *)user;
  ++s->calls;
  s->wrong += p->struct_size < sizeof *p || (p->phase != JAM_PHASE_CRUNCH && p->phase != JAM_PHASE_POLISH) ||
              !(p->fraction >= s->fraction) || !(p->packing_fraction > 0.05 && p->packing_fraction < 0.9) ||
              p->seconds < 0.0 || p->factorisations < 0;
  s->fraction = p->fraction;
  return 0;
}

/* Fraction of disks in a box of area 4, from the diameters alone. */
static double fraction_of(const jam_system *sys) {
  const double *sigma = NULL;
  size_t n = 0, i;
  double area = 0.0;
  CHECK(jam_view(sys, JAM_VIEW_DIAMETERS, &sigma, &n) == JAM_OK && n == 40);
  for (i = 0; i < n; ++i) area += 0.25 * pi * sigma[i] * sigma[i];
  return area / 4.0;
}

static jam_system *made(void) {
  jam_create_options o;
  jam_start start;
  jam_info info;
  jam_system *sys = NULL;
  double ratio[40];
  int i;
  for (i = 0; i < 40; ++i) ratio[i] = i % 2 ? 1.0 : 1.4;
  CHECK(jam_create_options_init(&o, sizeof o) == JAM_OK);
  CHECK(o.dim == 3 && o.n == 0 && o.seed == 1 && o.box == 1.0 && isinf(o.mk_zeta) && o.frame == -1 &&
        o.shrink_min == 1e-3);
  memset(&start, 0, sizeof start);
  start.struct_size = sizeof start;
  start.diameters = ratio, start.diameters_len = 40;
  o.dim = 2, o.n = 40, o.seed = 9, o.box = 2.0, o.packing_fraction = 0.3;
  CHECK(jam_create(&o, &start, &sys) == JAM_OK);
  memset(&info, 0, sizeof info);
  info.struct_size = sizeof info;
  CHECK(jam_get_info(sys, &info) == JAM_OK);
  CHECK(info.dim == 2 && info.n == 40 && info.seed == 9 && info.box == 2.0 && info.model == JAM_MODEL_EUCLID);
  CHECK(info.monodisperse == 0 && info.paused == 0 && info.non_additivity == 0.0 && near(info.volume, 4.0, 1e-15));
  CHECK(near(info.packing_fraction, 0.3, 1e-12) && near(fraction_of(sys), 0.3, 1e-12) && isnan(info.pressure));
  return sys;
}

static void grown(jam_system *sys) {
  jam_compress_options o;
  jam_md_report r;
  CHECK(jam_compress_options_init(&o, sizeof o) == JAM_OK && o.pressure == 1e6 && o.growth_law == 0 && o.resume == 0);
  o.growth_rate = 1e-2, o.pressure = 1e4;
  memset(&r, 0, sizeof r);
  r.struct_size = sizeof r;
  CHECK(jam_compress(sys, &o, &r) == JAM_OK && r.stop_reason == JAM_STOP_PRESSURE);
  CHECK(r.collisions > 1000 && r.events >= r.collisions && r.pressure >= 1e4 && r.pressure < 1e6);
  CHECK(near(r.packing_fraction, fraction_of(sys), 1e-10) && r.time > 0.0 && r.max_overlap >= 0.0 &&
        r.max_overlap < 1e-6);
}

/* The certificate, computed anew: contacts touch, their forces balance, and numbers of the report count them. */
static void crunched(jam_system *sys) {
  jam_crunch_options o;
  jam_crunch_report r;
  const double *x = NULL, *sigma = NULL;
  int32_t pairs[2 * 200];
  double force[200], sum[80] = {0.0}, mean = 0.0, least = INFINITY, residual = 0.0;
  int touched[40] = {0}, network = 0;
  size_t needed = 0, len = 0, k, i;
  jam_modes_options m;
  struct seen s = {0, 0, 0.0};
  CHECK(jam_set_progress(sys, look, &s) == JAM_OK);
  CHECK(jam_crunch_options_init(&o, sizeof o) == JAM_OK);
  memset(&r, 0, sizeof r);
  r.struct_size = sizeof r;
  CHECK(jam_crunch(sys, &o, &r) == JAM_OK && r.status == JAM_OK && r.jammed == 1 &&
        r.stop_reason == JAM_STOP_CONVERGED);
  CHECK(jam_set_progress(sys, NULL, NULL) == JAM_OK && s.calls > 0 && s.wrong == 0);
  CHECK(jam_contacts(sys, pairs, 2 * 200, &needed) == JAM_OK && needed == 2 * (size_t)r.contacts);
  CHECK(jam_forces(sys, force, 200, &needed) == JAM_OK && needed == (size_t)r.contacts);
  CHECK(jam_view(sys, JAM_VIEW_POSITIONS, &x, &len) == JAM_OK && len == 80);
  CHECK(jam_view(sys, JAM_VIEW_DIAMETERS, &sigma, &len) == JAM_OK);
  if (failures) return;
  for (k = 0; k < needed; ++k) {
    const int32_t a = pairs[2 * k], b = pairs[2 * k + 1];
    double d[2], distance;
    int c;
    for (c = 0; c < 2; ++c) d[c] = x[2 * a + c] - x[2 * b + c], d[c] -= 2.0 * floor(d[c] / 2.0 + 0.5);
    distance = sqrt(d[0] * d[0] + d[1] * d[1]);
    CHECK(near(distance, 0.5 * (sigma[a] + sigma[b]), 1e-11));
    for (c = 0; c < 2; ++c) sum[2 * a + c] += force[k] * d[c] / distance, sum[2 * b + c] -= force[k] * d[c] / distance;
    touched[a] = touched[b] = 1;
    mean += force[k] / (double)needed, least = fmin(least, force[k]);
  }
  for (i = 0; i < 40; ++i) network += touched[i], residual = fmax(residual, hypot(sum[2 * i], sum[2 * i + 1]));
  CHECK(r.rattlers == 40 - network && r.isostatic_contacts == 2 * (network - 1) + 1);
  CHECK(r.excess_contacts == r.contacts - r.isostatic_contacts && r.strict_contacts_needed == 2 * (network - 1) + 3);
  CHECK(residual < 1e-9 * mean && r.force_residual < 1e-9 && near(r.min_force, least / mean, 1e-9));
  CHECK(near(r.packing_fraction, fraction_of(sys), 1e-12) && r.packing_fraction_start < r.packing_fraction);
  CHECK(r.strictly_jammed == JAM_VERDICT_UNTESTED && r.theorem == JAM_THEOREM_NONE && r.max_overlap < 1e-12);
  CHECK(jam_modes_options_init(&m, sizeof m) == JAM_OK);
  m.which = JAM_MODES_ALL;
  CHECK(jam_modes(sys, NULL, &m, JAM_MODE_COLUMNS, NULL, 0, NULL, 0, &needed) == JAM_OK &&
        needed == 2 * (size_t)network);
}

int main(void) {
  jam_system *sys;
  jam_create_options o;
  CHECK(jam_abi_version() == JAM_ABI);
  CHECK(jam_create_options_init(&o, 1u << 20) == JAM_E_STRUCT_SIZE);
  CHECK(!strcmp(jam_stop_string(JAM_STOP_CONVERGED), "converged"));
  sys = made();
  if (!failures) grown(sys);
  if (!failures) crunched(sys);
  jam_destroy(sys);
  if (!failures) printf("libjam %s runs what was compiled with interface %d\n", jam_version(), JAM_ABI);
  return failures != 0;
}
