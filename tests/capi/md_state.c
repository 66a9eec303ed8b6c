/* Checkpoints, equations of state, the fit of the glass branch. */
#include <jam/jam.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#include "test.h"

static const char *path = "md_state_checkpoint.bin";

static jam_system *make(int32_t model) {
  jam_create_options o;
  jam_system *sys = NULL;
  jam_create_options_init(&o, sizeof o);
  o.n = 120;
  o.model = model;
  o.packing_fraction = model == JAM_MODEL_MK ? 1.5 : 0.3;
  assert_int_equal(jam_create(&o, NULL, &sys), JAM_OK);
  return sys;
}

static void same(const jam_system *a, const jam_system *b) {
  jam_status (*const views[])(const jam_system *, const double **, size_t *) = {jam_view_positions, jam_view_diameters,
                                                                                jam_view_velocities};
  int k;
  for (k = 0; k < 3; ++k) {
    const double *x, *y;
    size_t n, m;
    views[k](a, &x, &n);
    views[k](b, &y, &m);
    assert_int_equal(n, m);
    assert_memory_equal(x, y, n * sizeof(double));
  }
}

static void resumes_to_the_same_bits(void **state) {
  int32_t model;
  (void)state;
  for (model = JAM_MODEL_EUCLID; model <= JAM_MODEL_MK; ++model) {
    jam_system *a = make(model), *b = NULL;
    jam_compress_options c;
    jam_compress_options_init(&c, sizeof c);
    assert_int_equal(jam_run(a, NULL, NULL), JAM_OK);
    assert_int_equal(jam_write_checkpoint(a, path), JAM_OK);
    assert_int_equal(jam_read_checkpoint(path, NULL, NULL, &b), JAM_OK);
    same(a, b);
    assert_int_equal(jam_run(a, NULL, NULL), JAM_OK);
    assert_int_equal(jam_run(b, NULL, NULL), JAM_OK);
    same(a, b);
    assert_int_equal(jam_compress(a, &c, NULL), JAM_OK);
    assert_int_equal(jam_compress(b, &c, NULL), JAM_OK);
    same(a, b);
    jam_destroy(a);
    jam_destroy(b);
  }
  remove(path);
}

static void refuses_what_is_no_checkpoint(void **state) {
  jam_system *sys = make(JAM_MODEL_MK), *out = NULL;
  unsigned char data[200000];
  size_t size, cut;
  FILE *f;
  (void)state;
  assert_int_equal(jam_write_checkpoint(NULL, path), JAM_E_NULL);
  assert_int_equal(jam_write_checkpoint(sys, NULL), JAM_E_NULL);
  assert_int_equal(jam_read_checkpoint(NULL, NULL, NULL, &out), JAM_E_NULL);
  assert_int_equal(jam_read_checkpoint("no such file", NULL, NULL, &out), JAM_E_IO);
  assert_int_equal(jam_write_checkpoint(sys, "no such folder/x"), JAM_E_IO);
  assert_int_equal(jam_write_checkpoint(sys, path), JAM_OK);
  f = fopen(path, "rb");
  size = fread(data, 1, sizeof data, f);
  fclose(f);
  for (cut = 0; cut < size; cut += size / 17) { /* truncated anywhere */
    f = fopen(path, "wb");
    fwrite(data, 1, cut, f);
    fclose(f);
    assert_int_equal(jam_read_checkpoint(path, NULL, NULL, &out), JAM_E_FORMAT);
  }
  for (cut = 0; cut < size; cut += size / 23) { /* a bit changed anywhere */
    f = fopen(path, "wb");
    data[cut] ^= 4;
    fwrite(data, 1, size, f);
    data[cut] ^= 4;
    fclose(f);
    assert_int_equal(jam_read_checkpoint(path, NULL, NULL, &out), JAM_E_FORMAT);
  }
  assert_null(out);
  remove(path);
  jam_destroy(sys);
}

static double eos(int32_t form, int32_t dim, double f) {
  double p = -1.0;
  assert_int_equal(jam_eos(form, dim, f, 0.64, &p), JAM_OK);
  return p;
}

/* B_3 / B_2^2 = 2 I_{3/4}((d + 1) / 2, 1 / 2), exact in every d (Luban and Baram, J. Chem. Phys. 76, 3233 (1982)). The
 * incomplete beta function I is the integral of cos^d from pi / 6 over that from 0 to pi / 2; by Simpson's rule. */
static double third_virial(int32_t d) {
  const int steps = 2000; /* even */
  double part[2] = {0, 0};
  for (int q = 0; q < 2; ++q) {
    const double low = q ? 0.0 : M_PI / 6.0, h = (M_PI / 2.0 - low) / steps;
    for (int k = 0; k <= steps; ++k)
      part[q] += (k == 0 || k == steps ? 1.0 : k % 2 ? 4.0 : 2.0) * pow(cos(low + h * k), d) * h / 3.0;
  }
  return 2.0 * part[0] / part[1];
}

static void liquid_of_every_dimension(void) {
  double p = -1.0;
  for (int32_t d = 2; d <= JAM_MAX_DIM; ++d) {
    const double x = 1e-3, f = ldexp(x, 1 - d); /* x = B_2 rho */
    const double a = (eos(JAM_EOS_PADE, d, f) - 1.0) / x - 1.0, b = (eos(JAM_EOS_PADE, d, 2 * f) - 1.0) / (2 * x) - 1.0;
    assert_true(eos(JAM_EOS_PADE, d, 0.0) == 1.0);
    assert_true(fabs(a) < 1e-3);                                           /* B_2 = 2^(d-1) */
    assert_true(fabs((4.0 * a - b) / (2.0 * x) - third_virial(d)) < 1e-5); /* without the term of B_4 */
    assert_int_equal(jam_eos(JAM_EOS_PADE, d, 1.0, 0, &p), JAM_E_ARGUMENT);
  }
  /* The closed forms of d = 2 and 3 are good to 0.5 % up to freezing. */
  assert_true(fabs(eos(JAM_EOS_PADE, 2, 0.5) / eos(JAM_EOS_HENDERSON, 2, 0.5) - 1.0) < 0.005);
  assert_true(fabs(eos(JAM_EOS_PADE, 3, 0.49) / eos(JAM_EOS_CARNAHAN_STARLING, 3, 0.49) - 1.0) < 0.005);
  /* It ends at its pole (d = 2 to 4) or its maximum, both beyond freezing (0.70, 0.494, 0.288, 0.174, 0.105 in d = 2 to
   * 6), and rises before. */
  const double freezing[] = {0.70, 0.494, 0.288, 0.174, 0.105, 0.06, 0.035};
  for (int32_t d = 2; d <= JAM_MAX_DIM; ++d) {
    double before = 0.99, end = 0.0;
    for (double f = 0.0; f < 1.0 && end == 0.0; f += 0.0005) {
      if (jam_eos(JAM_EOS_PADE, d, f, 0, &p) == JAM_E_ARGUMENT)
        end = f;
      else
        assert_true(p > before), before = p;
    }
    assert_true(end > 1.3 * freezing[d - 2]);
    char number[16];
    snprintf(number, sizeof number, "in d = %d", d);
    assert_non_null(strstr(jam_last_error(), number));
  }
}

static void equations_of_state(void **state) {
  double p = -1.0;
  int32_t form;
  (void)state;
  for (form = JAM_EOS_CARNAHAN_STARLING; form <= JAM_EOS_VIRIAL; ++form) {
    assert_true(eos(form, 3, 0.0) == 1.0);
    /* Second and third virial coefficients 4 and 10. */
    assert_true(fabs((eos(form, 3, 1e-4) - 1.0) / 1e-4 - 4.0 - 10.0e-4) < 1e-6);
    assert_int_equal(jam_eos(form, 2, 0.3, 0, &p), JAM_E_UNSUPPORTED);
  }
  assert_true(fabs(eos(JAM_EOS_CARNAHAN_STARLING, 3, 0.5) - 13.0) < 1e-12);
  assert_true(fabs(eos(JAM_EOS_VIRIAL, 3, 0.1) - eos(JAM_EOS_CARNAHAN_STARLING, 3, 0.1)) < 1e-3);
  assert_true(eos(JAM_EOS_MK, 3, 0.5) == 3.0 && eos(JAM_EOS_MK, 4, 0.5) == 5.0);
  assert_true(fabs(eos(JAM_EOS_FREE_VOLUME, 3, 0.32) - 6.0) < 1e-12);
  /* Disks: second virial coefficient 2, third 3.125 in this form (exact 3.128). */
  assert_true(eos(JAM_EOS_HENDERSON, 2, 0.0) == 1.0);
  assert_true(fabs((eos(JAM_EOS_HENDERSON, 2, 1e-4) - 1.0) / 1e-4 - 2.0 - 3.125e-4) < 1e-7);
  assert_int_equal(jam_eos(JAM_EOS_HENDERSON, 3, 0.3, 0, &p), JAM_E_UNSUPPORTED);
  assert_int_equal(jam_eos(JAM_EOS_HENDERSON, 2, 1.0, 0, &p), JAM_E_ARGUMENT);
  p = -7.0;
  liquid_of_every_dimension();
  assert_int_equal(jam_eos(JAM_EOS_FREE_VOLUME, 3, 0.7, 0.64, &p), JAM_E_ARGUMENT);
  assert_int_equal(jam_eos(99, 3, 0.3, 0, &p), JAM_E_ARGUMENT);
  assert_int_equal(jam_eos(0, 1, 0.3, 0, &p), JAM_E_DIMENSION);
  assert_int_equal(jam_eos(0, 3, NAN, 0, &p), JAM_E_ARGUMENT);
  assert_int_equal(jam_eos(0, 3, 0.3, 0, NULL), JAM_E_NULL);
  assert_true(p == -7.0);
}

static void glass_fit(void **state) {
  double f[40], p[40];
  jam_glass g;
  int k;
  (void)state;
  g.struct_size = sizeof g;
  for (k = 0; k < 40; ++k) {
    p[k] = pow(10.0, 5.0 + 0.1 * k);
    f[k] = 0.643 * (1.0 - 3.1 / p[k]);
  }
  assert_int_equal(jam_glass_fit(f, 40, p, 40, &g), JAM_OK);
  assert_true(fabs(g.jammed_fraction - 0.643) < 1e-12);
  assert_true(fabs(g.dimension - 3.1) < 1e-6 && g.r_squared > 0.999999);
  assert_true(g.jammed_error < 1e-12 && g.dimension_error < 1e-6);
  for (k = 0; k < 40; ++k) p[k] *= 1.0 + 0.05 * sin(7.0 * k);
  assert_int_equal(jam_glass_fit(f, 40, p, 40, &g), JAM_OK);
  assert_true(fabs(g.dimension - 3.1) < 4.0 * g.dimension_error && g.dimension_error > 1e-4);
  assert_true(fabs(g.jammed_fraction - 0.643) < 4.0 * g.jammed_error);
  assert_int_equal(jam_glass_fit(f, 39, p, 40, &g), JAM_E_ARGUMENT);
  assert_int_equal(jam_glass_fit(f, 2, p, 2, &g), JAM_E_TOO_FEW);
  p[3] = -1.0;
  assert_int_equal(jam_glass_fit(f, 40, p, 40, &g), JAM_E_ARGUMENT);
  g.struct_size = 1;
  assert_int_equal(jam_glass_fit(f, 40, p, 40, &g), JAM_E_STRUCT_SIZE);
  assert_int_equal(jam_glass_fit(NULL, 0, p, 40, &g), JAM_E_NULL);
}

/* Errors against the covariance matrix of least squares, y = a + c phi: d' = 1 / a and phi_J = -a / c, to first order.
 */
static void glass_fit_errors(void **state) {
  static const double ranges[3][2] = {{0.60, 0.63}, {0.50, 0.60}, {0.40, 0.55}};
  double f[9], p[9];
  int range, k;
  (void)state;
  for (range = 0; range < 3; ++range) {
    jam_glass g;
    double m = 9.0, sx = 0.0, sxx = 0.0, sy = 0.0, sxy = 0.0, rest = 0.0, a, c, det, va, vc, vac;
    g.struct_size = sizeof g;
    for (k = 0; k < 9; ++k) {
      f[k] = ranges[range][0] + (ranges[range][1] - ranges[range][0]) * k / 8.0;
      p[k] = 1.0 / ((1.0 - f[k] / 0.64) / 2.9 + 1e-5 * sin(5.0 * k + range));
      sx += f[k], sxx += f[k] * f[k], sy += 1.0 / p[k], sxy += f[k] / p[k];
    }
    det = m * sxx - sx * sx, c = (m * sxy - sx * sy) / det, a = (sy - c * sx) / m;
    for (k = 0; k < 9; ++k) rest += pow(1.0 / p[k] - a - c * f[k], 2.0);
    rest /= m - 2.0, va = rest * sxx / det, vc = rest * m / det, vac = -rest * sx / det;
    assert_int_equal(jam_glass_fit(f, 9, p, 9, &g), JAM_OK);
    assert_true(fabs(g.dimension * a - 1.0) < 1e-9 && fabs(g.jammed_fraction * c / a + 1.0) < 1e-9);
    assert_true(fabs(g.dimension_error * a * a / sqrt(va) - 1.0) < 1e-6);
    assert_true(fabs(g.jammed_error / sqrt(va / (c * c) + a * a * vc / pow(c, 4.0) - 2.0 * a * vac / pow(c, 3.0)) -
                     1.0) < 1e-6);
  }
}

int main(void) {
  const struct CMUnitTest tests[] = {
      cmocka_unit_test(resumes_to_the_same_bits), cmocka_unit_test(refuses_what_is_no_checkpoint),
      cmocka_unit_test(equations_of_state), cmocka_unit_test(glass_fit), cmocka_unit_test(glass_fit_errors)};
  return cmocka_run_group_tests(tests, NULL, NULL);
}
