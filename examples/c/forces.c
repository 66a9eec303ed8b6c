/* The contact network: pairs, unit vectors and forces, and the check that they balance on every sphere. */
#include <jam/jam.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

int main(void) {
  jam_create_options o;
  jam_system *sys = NULL;
  size_t pairs = 0, vectors = 0, contacts = 0, k;
  int32_t *pair, c, d = 3;
  double *n, *f, *sum, worst = 0.0;

  jam_create_options_init(&o, sizeof o);
  o.n = 128;
  o.dim = d;
  if (jam_create(&o, NULL, &sys) < 0 || jam_compress(sys, NULL, NULL) < 0 || jam_crunch(sys, NULL, NULL) < 0) {
    fprintf(stderr, "%s\n", jam_last_error());
    jam_destroy(sys);
    return 1;
  }
  /* get the sizes, then fill */
  jam_contacts(sys, NULL, 0, &pairs);
  jam_contact_vectors(sys, NULL, 0, &vectors);
  jam_forces(sys, NULL, 0, &contacts);
  pair = malloc((pairs + 1) * sizeof *pair);
  n = malloc((vectors + 1) * sizeof *n);
  f = malloc((contacts + 1) * sizeof *f);
  sum = calloc((size_t)(o.n * d), sizeof *sum);
  if (!pair || !n || !f || !sum || jam_contacts(sys, pair, pairs, NULL) < 0 ||
      jam_contact_vectors(sys, n, vectors, NULL) < 0 || jam_forces(sys, f, contacts, NULL) < 0)
    return 1;
  for (k = 0; k < contacts; ++k)
    for (c = 0; c < d; ++c) { /* n points from j to i: i is pushed along it, j against it */
      sum[pair[2 * k] * d + c] += f[k] * n[k * (size_t)d + (size_t)c];
      sum[pair[2 * k + 1] * d + c] -= f[k] * n[k * (size_t)d + (size_t)c];
    }
  for (k = 0; k < (size_t)(o.n * d); ++k) worst = fmax(worst, fabs(sum[k]));
  printf("%zu contacts, mean force 1, largest component of the net force on a sphere %.1e\n", contacts, worst);
  free(pair);
  free(n);
  free(f);
  free(sum);
  jam_destroy(sys);
  return contacts > 0 && worst > 1e-8;
}
