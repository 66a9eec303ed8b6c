/* A crunched packing with the arrays of its network, as tests of the analysis use it. */
#ifndef JAM_TESTS_NETWORK_H
#define JAM_TESTS_NETWORK_H

#include <stdlib.h>

#include "systems.h"

enum { ROOM = 40000 };

struct network {
  jam_system *sys;
  int d;
  int64_t n, stable, contacts;
  int32_t *pair, *map;    /* contacts, 2; stable */
  double *normal, *force; /* contacts, d; contacts */
  double *diameter;
  int32_t *node; /* sphere -> row, -1 */
};

static inline jam_system *crunched_model(int model, int dim, int64_t n, double phi, int bidisperse,
                                         jam_crunch_report *report) {
  double *d = malloc((size_t)n * sizeof *d);
  int64_t k;
  DEFAULTS(create, o);
  o.model = model;
  o.dim = dim;
  o.n = n;
  o.packing_fraction = phi;
  for (k = 0; k < n; ++k) d[k] = bidisperse && k % 2 ? 1.4 : 1.0;
  jam_system *s = created_from(&o, NULL, 0, d, (size_t)n);
  free(d);
  report->struct_size = sizeof *report;
  assert_int_equal(jam_crunch(s, NULL, report), JAM_OK);
  return s;
}

static inline jam_system *crunched(int dim, int64_t n, double phi, int bidisperse, jam_crunch_report *report) {
  return crunched_model(JAM_MODEL_EUCLID, dim, n, phi, bidisperse, report);
}

static inline struct network open_network(jam_system *s) {
  struct network w;
  jam_info info = {.struct_size = sizeof(jam_info)};
  size_t m;
  const double *diameters;
  int64_t k;
  w.sys = s;
  assert_int_equal(jam_get_info(s, &info), JAM_OK);
  w.d = info.dim;
  w.n = info.n;
  w.pair = malloc(ROOM * sizeof *w.pair);
  w.map = malloc(ROOM * sizeof *w.map);
  w.node = malloc(ROOM * sizeof *w.node);
  w.normal = malloc(ROOM * sizeof *w.normal);
  w.force = malloc(ROOM * sizeof *w.force);
  w.diameter = malloc(ROOM * sizeof *w.diameter);
  assert_int_equal(jam_contacts(s, w.pair, ROOM, &m), JAM_OK);
  w.contacts = (int64_t)m / 2;
  assert_int_equal(jam_contact_vectors(s, w.normal, ROOM, &m), JAM_OK);
  assert_int_equal(jam_forces(s, w.force, ROOM, &m), JAM_OK);
  assert_int_equal(jam_hessian_map(s, w.map, ROOM, &m), JAM_OK);
  w.stable = (int64_t)m;
  for (k = 0; k < w.n; ++k) w.node[k] = -1;
  for (k = 0; k < w.stable; ++k) w.node[w.map[k]] = (int32_t)k;
  assert_int_equal(jam_view(s, JAM_VIEW_DIAMETERS, &diameters, &m), JAM_OK);
  for (k = 0; k < w.n; ++k) w.diameter[k] = diameters[k];
  return w;
}

static inline void close_network(struct network *w) {
  free(w->pair), free(w->map), free(w->node), free(w->normal), free(w->force), free(w->diameter);
  jam_destroy(w->sys);
}

static inline double sigma(const struct network *w, int64_t k) {
  return 0.5 * (w->diameter[w->pair[2 * k]] + w->diameter[w->pair[2 * k + 1]]);
}

#endif /* JAM_TESTS_NETWORK_H */
