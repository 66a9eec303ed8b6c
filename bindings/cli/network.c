/* What --spectrum, --gaps and --structure write: tables of the jammed network, one header line, 17 digits. */
#define _XOPEN_SOURCE 700
#include <math.h>
#include <stdlib.h>
#include "jam-pack.h"

static int refused(const char *path) {
  complain("cannot write %s: %s", path, jam_last_error());
  return -1;
}
static int no_memory(const char *path) {
  complain("cannot write %s: out of memory", path);
  return -1;
}

/* 0 when a call has filled its arrays; else -1, or 1 where it was stopped, after a message. */
static int missing(jam_status status, const char *path) {
  if (status < 0) return refused(path);
  if (status != JAM_CANCELLED) return 0;
  complain("%s is not written: Ctrl-C or --wall-time came before it was computed", path);
  return 1;
}

static int write_spectrum(jam_system *sys, int64_t count, const char *path) {
  jam_modes_options o;
  size_t m = 0, k;
  double *mode;
  output out;
  int bad;
  jam_modes_options_init(&o, sizeof o);
  if (count == 0) o.which = JAM_MODES_ALL;
  o.count = count < 0 ? 100 : count;
  bad = missing(jam_modes(sys, NULL, &o, NULL, 0, NULL, 0, &m), path);
  if (bad) return bad;
  mode = malloc((2 * m + 1) * sizeof *mode);
  if (!mode) return no_memory(path);
  bad = missing(jam_modes(sys, NULL, &o, mode, 2 * m, NULL, 0, &m), path);
  if (!bad && (bad = open_output(&out, path)) == 0) {
    fputs("mode,lambda,omega,participation\n", out.file);
    for (k = 0; k < m && isfinite(mode[2 * k + JAM_MODE_LAMBDA]); ++k) {
      const double lambda = mode[2 * k + JAM_MODE_LAMBDA];
      fprintf(out.file, "%zu,%.17g,%.17g,%.17g\n", k, lambda, sqrt(fmax(lambda, 0)),
              mode[2 * k + JAM_MODE_PARTICIPATION]);
    }
    bad = close_output(&out);
  }
  free(mode);
  return bad;
}

static int write_gaps(const jam_system *sys, const int32_t *z, const char *path) {
  size_t m = 0, k;
  double *gap;
  int32_t *pair;
  output out;
  int bad;
  bad = missing(jam_gaps(sys, 1.0, 0, NULL, 0, NULL, 0, &m), path);
  if (bad) return bad;
  gap = malloc((m + 1) * sizeof *gap);
  pair = malloc((2 * m + 1) * sizeof *pair);
  if (!gap || !pair)
    bad = no_memory(path);
  else if ((bad = missing(jam_gaps(sys, 1.0, 0, gap, m, pair, 2 * m, NULL), path)) == 0 &&
           (bad = open_output(&out, path)) == 0) {
    fputs("i,j,gap,stable\n", out.file);
    for (k = 0; k < m; ++k) {
      const int i = (int)pair[2 * k], j = (int)pair[2 * k + 1];
      fprintf(out.file, "%d,%d,%.17g,%d\n", i, j, gap[k], z[i] > 0 && z[j] > 0);
    }
    bad = close_output(&out);
  }
  free(gap);
  free(pair);
  return bad;
}

/* Columns: sphere,z,class,c1..cd,s,fs,q6,phi; phi is left empty where there is no Voronoi cell to take it from. */
static int write_structure(const jam_system *sys, const jam_info *info, const int32_t *z, const char *path) {
  const size_t n = (size_t)info->n, d = (size_t)info->dim;
  double *const c = malloc((d + 4) * n * sizeof *c);
  double *const s = c + d * n, *const fs = s + n, *const q = fs + n, *const phi = q + n;
  size_t i, x;
  output out;
  int bad, has_phi;
  if (!c) return no_memory(path);
  has_phi = jam_local_fraction(sys, phi, n, NULL);
  bad = has_phi == JAM_CANCELLED ? missing(has_phi, path) : 0;
  has_phi = has_phi >= 0;
  if (!bad) bad = missing(jam_sphere_structure(sys, 0, c, d * n, s, n, NULL), path);
  if (!bad) bad = missing(jam_sphere_structure(sys, 1, NULL, 0, fs, n, NULL), path);
  if (!bad) bad = missing(jam_bond_order(sys, 6, 1.2, q, n, NULL), path);
  if (!bad && (bad = open_output(&out, path)) == 0) {
    fputs("sphere,z,class", out.file);
    for (x = 0; x < d; ++x) fprintf(out.file, ",c%zu", x + 1);
    fputs(",s,fs,q6,phi\n", out.file);
    for (i = 0; i < n; ++i) {
      fprintf(out.file, "%zu,%d,%s", i, (int)z[i],
              z[i] == 0               ? "rattler"
              : z[i] == info->dim + 1 ? "buckler"
                                      : "stable");
      for (x = 0; x < d; ++x) fprintf(out.file, ",%.17g", c[d * i + x]);
      fprintf(out.file, ",%.17g,%.17g,%.17g,", s[i], fs[i], q[i]);
      if (has_phi) fprintf(out.file, "%.17g", phi[i]);
      fputc('\n', out.file);
    }
    bad = close_output(&out);
  }
  free(c);
  return bad;
}

int write_network(jam_system *sys, const options *o, const jam_info *info) {
  int32_t *z;
  int worst = 0, bad[3] = {0, 0, 0}, k;
  if (!o->spectrum && !o->gaps && !o->structure) return 0;
  z = malloc((size_t)info->n * sizeof *z);
  if (!z) return no_memory(o->gaps ? o->gaps : o->spectrum ? o->spectrum : o->structure);
  if (jam_coordination(sys, z, (size_t)info->n, NULL) < 0) {
    complain("%s", jam_last_error());
    worst = -1;
  } else {
    if (o->gaps) bad[0] = write_gaps(sys, z, o->gaps);
    if (o->structure) bad[1] = write_structure(sys, info, z, o->structure);
    if (o->spectrum) bad[2] = write_spectrum(sys, o->modes, o->spectrum);
  }
  free(z);
  for (k = 0; k < 3; ++k)
    if (bad[k] && worst >= 0) worst = bad[k];
  return worst;
}
