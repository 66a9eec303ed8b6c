/* Grains of a sieve curve in millimetre, grown to a porosity of 0.42 in a cell of 8 x 8 x 8. */
#include <jam/jam.h>
#include <stdio.h>
#include <stdlib.h>

static int failed(const char *what) {
  fprintf(stderr, "%s: %s\n", what, jam_last_error());
  return 1;
}

int main(void) {
  static const double curve[] = {0.5, 0, 0.71, 12, 1.0, 38, 1.4, 71, 2.0, 100}; /* size, per cent that passes */
  const size_t curve_len = sizeof curve / sizeof *curve;
  jam_diameters_options law;
  jam_create_options create;
  jam_compress_options compress;
  jam_md_report md = {.struct_size = sizeof md};
  jam_size_report sizes = {.struct_size = sizeof sizes};
  jam_start start = {.struct_size = sizeof start};
  jam_system *sys = NULL;
  double *diameters;
  size_t n;

  jam_diameters_options_init(&law, sizeof law);
  law.law = JAM_SIZES_SIEVE;
  law.cell_volume = 8.0 * 8.0 * 8.0;
  law.packing_fraction = 1.0 - 0.42; /* the number of grains follows */
  if (jam_diameters(&law, curve, curve_len, NULL, 0, &n) < 0) return failed("sizes");
  diameters = malloc(n * sizeof *diameters);
  if (!diameters || jam_diameters(&law, curve, curve_len, diameters, n, &n) < 0) return failed("sizes");
  if (jam_get_size_report(3, diameters, n, &sizes) < 0) return failed("report");
  printf("%zu grains, D10 %.3f, D50 %.3f, D90 %.3f mm, jamming near a porosity of %.3f\n", n, sizes.d10, sizes.d50,
         sizes.d90, 1.0 - sizes.jammed_fraction);

  jam_create_options_init(&create, sizeof create);
  create.box = 8.0;
  start.diameters = diameters;
  start.diameters_len = n;
  if (jam_create(&create, &start, &sys) < 0) return failed("start"); /* smaller, at random */
  jam_compress_options_init(&compress, sizeof compress);
  compress.packing_fraction = 1.0 - 0.42;
  if (jam_compress(sys, &compress, &md) < 0) return failed("growth");
  printf("porosity %.15f\n", 1.0 - md.packing_fraction);
  if (jam_write(sys, "sand.xyz", JAM_FORMAT_AUTO) < 0) return failed("file");
  jam_destroy(sys);
  free(diameters);
  return md.stop_reason != JAM_STOP_PACKING_FRACTION;
}
