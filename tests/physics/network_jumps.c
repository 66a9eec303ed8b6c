/* Networks from geometry alone: which jump of the gaps ends the contacts. */
#include <math.h>
#include <stdlib.h>

#include <jam/jam.h>
#include "physics/network.h"

/* Spheres pushed about by a part of the smallest gap: contacts and near misses are no longer told apart by a clear
 * jump. The status says so, and the right network is one of the two that it names. */
static void unclear_jump_of(double part) {
  jam_crunch_report report;
  OWNED jam_system *s = crunched(3, 80, 0.2, 0, &report);
  jam_geometry_report g = {.struct_size = sizeof(jam_geometry_report)};
  const double *x;
  double *y;
  size_t m;
  const double size = part * report.min_gap * report.diameter_mean;
  assert_int_equal(jam_view(s, JAM_VIEW_POSITIONS, &x, &m), JAM_OK);
  y = malloc(m * sizeof *y);
  for (size_t k = 0; k < m; ++k) y[k] = x[k] + 0.2 * size * sin(1.0 + (double)(k * k));
  assert_int_equal(jam_scale_diameters(s, 1.0 - part * report.min_gap), JAM_OK);
  assert_int_equal(jam_set_positions(s, y, m), JAM_OK);
  assert_int_equal(jam_contacts_from_geometry(s, NULL, &g), JAM_AMBIGUOUS);
  assert_true(g.jump < 100.0 && g.second_contacts > 0);
  assert_true(g.contacts == report.contacts || g.second_contacts == report.contacts);
  free(y);
}

CASE(an_unclear_gap_jump_is_ambiguous) {
  unclear_jump_of(0.1);  /* the next jump is nearly as large */
  unclear_jump_of(0.02); /* one jump stands out, but by less than two decades */
}

/* Three disks that touch each other: places relative to the first, and numbers; 0 when there are none. */
static int touching_three(const struct network *w, double place[3][2], int32_t who[3]) {
  for (int64_t k = 0; k < w->contacts; ++k)
    for (int64_t l = 0; l < w->contacts; ++l) {
      if (l == k || w->pair[2 * l] != w->pair[2 * k]) continue;
      for (int64_t m = 0; m < w->contacts; ++m) {
        const int32_t a = w->pair[2 * m], b = w->pair[2 * m + 1], p = w->pair[2 * k + 1], q = w->pair[2 * l + 1];
        if (!((a == p && b == q) || (a == q && b == p))) continue;
        who[0] = w->pair[2 * k], who[1] = p, who[2] = q;
        for (int c = 0; c < 2; ++c) {
          place[0][c] = 0.0;
          place[1][c] = -sigma(w, k) * w->normal[2 * k + c];
          place[2][c] = -sigma(w, l) * w->normal[2 * l + c];
        }
        return 1;
      }
    }
  return 0;
}

/* The disk in the hole between three, at the same relative gap from each: Newton's method for its place and radius. */
static void fill_hole(double place[3][2], const double *radius, double gap, double *p, double *r) {
  p[0] = (place[1][0] + place[2][0]) / 3.0, p[1] = (place[1][1] + place[2][1]) / 3.0;
  *r = 0.2 * radius[0];
  for (int it = 0; it < 50; ++it) {
    double j[3][4], det;
    for (int a = 0; a < 3; ++a) {
      const double x = p[0] - place[a][0], y = p[1] - place[a][1], l = sqrt(x * x + y * y);
      j[a][0] = x / l, j[a][1] = y / l, j[a][2] = -(1.0 + gap), j[a][3] = (1.0 + gap) * (*r + radius[a]) - l;
    }
    for (int c = 0; c < 3; ++c) /* elimination: the matrix is far from singular inside the triangle */
      for (int a = 0; a < 3; ++a)
        if (a != c) {
          det = j[a][c] / j[c][c];
          for (int q = c; q < 4; ++q) j[a][q] -= det * j[c][q];
        }
    p[0] += j[0][3] / j[0][0], p[1] += j[1][3] / j[1][1], *r += j[2][3] / j[2][2];
  }
}

/* A rattler that nearly touches its neighbours gives a second candidate network, with one contact more than isostatic.
 * The null space shows that the first one is the network, although the second jump is nearly as wide. */
CASE(the_null_space_decides_between_two_jumps) {
  jam_crunch_report report;
  struct network w = open_network(crunched(2, 80, 0.3, 1, &report));
  jam_geometry_report g = {.struct_size = sizeof(jam_geometry_report)};
  jam_system *s = NULL;
  double place[3][2], radius[3], p[2], r, x[162], d[81], gap, digits, smallest = INFINITY;
  int32_t who[3] = {0, 0, 0};
  assert_int_equal(report.excess_contacts, 0);
  assert_true(touching_three(&w, place, who));
  for (int k = 0; k < 3; ++k) radius[k] = 0.5 * w.diameter[who[k]];
  for (int k = 0; k < 80; ++k) smallest = fmin(smallest, w.diameter[k]);
  /* The wider jump is to be that below the gaps of the rattler, gap / digits, and less than the square of the next,
   * above / gap. */
  assert_int_equal(jam_copy(w.sys, &s), JAM_OK);
  assert_int_equal(jam_contacts_from_geometry(s, NULL, &g), JAM_OK);
  jam_destroy(s);
  fill_hole(place, radius, 0.0, p, &r);
  digits = fmax(g.resolution * smallest / (2.0 * r), g.gap_below);
  gap = sqrt(sqrt(digits * g.gap_above) * cbrt(digits * g.gap_above * g.gap_above));
  fill_hole(place, radius, gap, p, &r);
  assert_true(r > 0.0 && r < radius[0]);
  const double *old = view_of(w.sys, JAM_VIEW_POSITIONS);
  for (int k = 0; k < 160; ++k) x[k] = old[k];
  for (int k = 0; k < 80; ++k) d[k] = w.diameter[k];
  for (int k = 0; k < 2; ++k) x[160 + k] = old[2 * who[0] + k] + p[k];
  d[80] = 2.0 * r;
  DEFAULTS(create, o);
  o.dim = 2, o.n = 81;
  assert_int_equal(create_from(&o, x, 162, d, 81, &s), JAM_OK);
  assert_int_equal(jam_contacts_from_geometry(s, NULL, &g), JAM_OK);
  assert_int_equal(g.contacts, report.contacts);
  assert_int_equal(g.second_contacts, report.contacts + 3);
  assert_true(g.self_stresses == 1 && g.jump < g.second_jump * g.second_jump);
  jam_destroy(s);
  close_network(&w);
}
