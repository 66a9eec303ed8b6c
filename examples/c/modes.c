/* Vibrational modes of a jammed packing, how far they spread, and its elastic moduli. */
#include <jam/jam.h>
#include <math.h>
#include <stdio.h>

static int failed(jam_system *sys) {
  fprintf(stderr, "%s\n", jam_last_error());
  jam_destroy(sys);
  return 1;
}

int main(void) {
  enum { N = 200, K = 8 };
  jam_create_options o;
  jam_modes_options choose;
  jam_moduli_report moduli;
  jam_start start = {.struct_size = sizeof start};
  jam_system *sys = NULL;
  double size[N], mode[K][2];
  size_t m = 0, spheres = 0, k;

  for (k = 0; k < N; ++k) size[k] = k < N / 2 ? 1.0 : 1.4; /* two sizes, so that disks do not crystallise */
  start.diameters = size;
  start.diameters_len = N;
  jam_create_options_init(&o, sizeof o);
  o.n = N;
  o.dim = 2;
  if (jam_create(&o, &start, &sys) < 0 || jam_crunch(sys, NULL, NULL) < 0) return failed(sys);

  jam_modes_options_init(&choose, sizeof choose);
  choose.which = JAM_MODES_LOWEST;
  choose.count = K;
  /* NULL: the harmonic Hessian, stiffness 1 at the mean force. The vectors (K, N', d) are not requested here. */
  if (jam_modes(sys, NULL, &choose, JAM_MODE_COLUMNS, &mode[0][0], K * 2, NULL, 0, &m) < 0) return failed(sys);
  jam_hessian_map(sys, NULL, 0, &spheres);
  printf("lowest modes of %zu stable spheres\n  omega    participation (1/N' = all, 1 = one sphere)\n", spheres);
  for (k = 0; k < m; ++k)
    printf("  %.5f  %.4f\n", sqrt(fmax(mode[k][JAM_MODE_LAMBDA], 0.0)), mode[k][JAM_MODE_PARTICIPATION]);

  moduli.struct_size = sizeof moduli;
  if (jam_moduli(sys, NULL, &moduli) < 0) return failed(sys);
  printf("bulk modulus %.4f (%.4f were all displacements affine), shear modulus %.4f\n", moduli.bulk,
         moduli.bulk_affine, moduli.shear);
  jam_destroy(sys);
  return m == K && mode[0][JAM_MODE_LAMBDA] > 0 ? 0 : 1;
}
