/* Tables of the jammed network as text: what jam-pack and Python write. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include "pack.h"
#include "system.h"

static jam_status no_memory(void) {
  jam_set_error("out of memory for the text of a table");
  return JAM_E_MEMORY;
}

static jam_status finished(FILE *f, char **text, size_t *length) {
  return close_text(f, text, length) ? no_memory() : JAM_OK;
}

jam_status jam_pack_modes(const double *mode, size_t mode_len, char **text) {
  size_t length, k;
  FILE *f = open_text(text, &length);
  if (!f) return no_memory();
  fputs("mode,lambda,omega,participation\n", f);
  for (k = 0; k < mode_len / 2 && isfinite(mode[2 * k + JAM_MODE_LAMBDA]); ++k) {
    const double lambda = mode[2 * k + JAM_MODE_LAMBDA];
    fprintf(f, "%zu,%.17g,%.17g,%.17g\n", k, lambda, sqrt(fmax(lambda, 0)), mode[2 * k + JAM_MODE_PARTICIPATION]);
  }
  return finished(f, text, &length);
}

/* Contacts of each sphere; the caller frees *z. */
static jam_status coordination(const jam_system *sys, size_t n, int32_t **z) {
  *z = malloc((n + 1) * sizeof **z);
  return *z ? jam_coordination(sys, *z, n, NULL) : no_memory();
}

static jam_status info_of(const jam_system *sys, jam_info *info) {
  info->struct_size = sizeof *info;
  return jam_get_info(sys, info);
}

jam_status jam_pack_gaps(const jam_system *sys, double h_max, char **text) {
  jam_info info;
  size_t m = 0, k, length;
  double *gap = NULL;
  int32_t *pair = NULL, *z = NULL;
  FILE *f = NULL;
  jam_status status = info_of(sys, &info);
  if (status == JAM_OK) status = coordination(sys, (size_t)info.n, &z);
  if (status == JAM_OK) status = jam_gaps(sys, h_max, 0, NULL, 0, NULL, 0, &m);
  if (status == JAM_OK) {
    gap = malloc((m + 1) * sizeof *gap);
    pair = malloc((2 * m + 1) * sizeof *pair);
    status = gap && pair ? jam_gaps(sys, h_max, 0, gap, m, pair, 2 * m, NULL) : no_memory();
  }
  if (status == JAM_OK && !(f = open_text(text, &length))) status = no_memory();
  if (status == JAM_OK) {
    fputs("i,j,gap,stable\n", f);
    for (k = 0; k < m; ++k) {
      const int i = (int)pair[2 * k], j = (int)pair[2 * k + 1];
      fprintf(f, "%d,%d,%.17g,%d\n", i, j, gap[k], z[i] > 0 && (j < 0 || z[j] > 0));
    }
    status = finished(f, text, &length);
  }
  free(gap), free(pair), free(z);
  return status;
}

/* Columns: sphere,z,class,c1..cd,s,fs,q6,phi; phi is left empty where there is no Voronoi cell to take it from, class
 * and fs where contacts are by distance. */
static void print_structure(FILE *f, const jam_info *info, const int32_t *z, const double *c, const double *phi,
                            int has_forces) {
  const size_t n = (size_t)info->n, d = (size_t)info->dim;
  const double *const s = c + d * n, *const fs = s + n, *const q = fs + n;
  size_t i, x;
  fputs("sphere,z,class", f);
  for (x = 0; x < d; ++x) fprintf(f, ",c%zu", x + 1);
  fputs(",s,fs,q6,phi\n", f);
  for (i = 0; i < n; ++i) {
    fprintf(f, "%zu,%d,", i, (int)z[i]);
    if (has_forces) fputs(z[i] == 0 ? "rattler" : z[i] == info->dim + 1 ? "buckler" : "stable", f);
    for (x = 0; x < d; ++x) fprintf(f, ",%.17g", c[d * i + x]);
    fprintf(f, ",%.17g,", s[i]);
    if (has_forces) fprintf(f, "%.17g", fs[i]);
    fprintf(f, ",%.17g,", q[i]);
    if (phi) fprintf(f, "%.17g", phi[i]);
    fputc('\n', f);
  }
}

jam_status jam_pack_structure(const jam_system *sys, char **text) {
  jam_info info;
  size_t n, d, length;
  double *c = NULL, *s, *phi;
  int32_t *z = NULL;
  FILE *f = NULL;
  int has_phi = 0, has_forces;
  jam_status status = info_of(sys, &info);
  if (status != JAM_OK) return status;
  n = (size_t)info.n, d = (size_t)info.dim;
  status = coordination(sys, n, &z);
  c = malloc((d + 4) * n * sizeof *c);
  if (!c && status == JAM_OK) status = no_memory();
  has_forces = !isfinite(info.contact_gap); /* else contacts by distance */
  s = c + d * n, phi = s + 3 * n;
  if (status == JAM_OK) {
    const jam_status found = jam_local_fraction(sys, phi, n, NULL);
    has_phi = found == JAM_OK;
    if (found > 0) status = found;
  }
  if (status == JAM_OK) status = jam_sphere_structure(sys, 0, c, d * n, s, n, NULL);
  if (status == JAM_OK && has_forces) status = jam_sphere_structure(sys, 1, NULL, 0, s + n, n, NULL);
  if (status == JAM_OK) status = jam_bond_order(sys, 6, 1.2, s + 2 * n, n, NULL);
  if (status == JAM_OK && !(f = open_text(text, &length))) status = no_memory();
  if (status == JAM_OK) {
    print_structure(f, &info, z, c, has_phi ? phi : NULL, has_forces);
    status = finished(f, text, &length);
  }
  free(c), free(z);
  return status;
}
