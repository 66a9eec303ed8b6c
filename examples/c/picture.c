/* A picture of a two-dimensional packing and its forces as SVG, which every browser shows.  usage: picture
 * [PICTURE.svg] */
#include <jam/jam.h>
#include <stdio.h>
#include <stdlib.h>

static int failed(const char *text) {
  fprintf(stderr, "%s\n", text);
  return 1;
}

int main(int argc, char **argv) {
  enum { N = 200 };
  jam_create_options o;
  jam_start start = {.struct_size = sizeof start};
  jam_system *sys = NULL;
  const double *x = NULL, *sigma = NULL;
  double size[N], *f, *n;
  int32_t *pair, z[N], side, up;
  size_t length, contacts = 0, k;
  FILE *svg;

  for (k = 0; k < N; ++k) size[k] = k < N / 2 ? 1.0 : 1.4;
  start.diameters = size;
  start.diameters_len = N;
  jam_create_options_init(&o, sizeof o);
  o.n = N;
  o.dim = 2;
  if (jam_create(&o, &start, &sys) < 0 || jam_crunch(sys, NULL, NULL) < 0) return failed(jam_last_error());
  jam_forces(sys, NULL, 0, &contacts);
  f = malloc((contacts + 1) * sizeof *f);
  n = malloc((2 * contacts + 1) * sizeof *n);
  pair = malloc((2 * contacts + 1) * sizeof *pair);
  if (!f || !n || !pair) return failed("out of memory");
  if (jam_forces(sys, f, contacts, NULL) < 0 || jam_contact_vectors(sys, n, 2 * contacts, NULL) < 0 ||
      jam_contacts(sys, pair, 2 * contacts, NULL) < 0 || jam_coordination(sys, z, N, NULL) < 0)
    return failed(jam_last_error());
  jam_view(sys, JAM_VIEW_POSITIONS, &x, &length); /* no copy: the library's own memory */
  jam_view(sys, JAM_VIEW_DIAMETERS, &sigma, &length);

  svg = fopen(argc > 1 ? argv[1] : "picture.svg", "w");
  if (!svg) return failed("cannot write the picture");
  fprintf(svg, "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 1 1\" width=\"800\" height=\"800\">\n");
  for (side = -1; side <= 1; ++side) /* the box is periodic: copies on all sides, cut at its edge */
    for (up = -1; up <= 1; ++up) {
      fprintf(svg, "<g transform=\"translate(%d %d)\" stroke=\"black\" stroke-linecap=\"round\">\n", (int)side,
              (int)up);
      for (k = 0; k < N; ++k) /* orange: bucklers, grey: rattlers */
        fprintf(svg, "<circle cx=\"%.6f\" cy=\"%.6f\" r=\"%.6f\" fill=\"%s\" stroke=\"none\"/>\n", x[2 * k],
                x[2 * k + 1], sigma[k] / 2,
                z[k] == 0   ? "#c8c8c8"
                : z[k] == 3 ? "#f2a541"
                            : "#4c78a8");
      for (k = 0; k < contacts; ++k) { /* from the first centre to the second; n points the other way */
        const double *a = x + 2 * pair[2 * k], r = (sigma[pair[2 * k]] + sigma[pair[2 * k + 1]]) / 2;
        fprintf(svg, "<path d=\"M%.6f %.6f l%.6f %.6f\" stroke-width=\"%.5f\"/>\n", a[0], a[1], -r * n[2 * k],
                -r * n[2 * k + 1], 0.004 * f[k]);
      }
      fprintf(svg, "</g>\n");
    }
  fprintf(svg, "</svg>\n");
  printf("%d disks, %zu forces\n", N, contacts);
  free(f);
  free(n);
  free(pair);
  jam_destroy(sys);
  return fclose(svg) ? failed("cannot write the picture") : 0;
}
