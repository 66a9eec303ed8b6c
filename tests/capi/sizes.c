/* Named laws of diameters: what each needs, exact densities, seeds, and errors before any work. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include "steps.h"

static jam_diameters_options options(int32_t law) {
  DEFAULTS(diameters, o);
  o.law = law;
  return o;
}

static double *draw(const jam_diameters_options *o, const double *curve, size_t curve_len, size_t *n) {
  double *s;
  if (jam_diameters(o, curve, curve_len, NULL, 0, n)) fail_msg("%s", jam_last_error());
  s = malloc(*n * sizeof *s);
  assert_non_null(s);
  assert_int_equal(jam_diameters(o, curve, curve_len, s, *n, n), JAM_OK);
  return s;
}

static void refused(const jam_diameters_options *o, const double *curve, size_t curve_len, jam_status status,
                    const char *word) {
  size_t n;
  const jam_status got = jam_diameters(o, curve, curve_len, NULL, 0, &n);
  if (got != status || !strstr(jam_last_error(), word)) fail_msg("%d: %s; not %s", (int)got, jam_last_error(), word);
}

static double volume(const double *s, size_t n, int dim) {
  double sum = 0;
  for (size_t k = n; k--;) sum += (dim == 2 ? acos(-1.0) / 4 : acos(-1.0) / 6) * pow(s[k], dim);
  return sum;
}

static const double curve[] = {0.5, 0, 1, 10, 2, 50, 4, 100};

/* Sums of volume at the ends of each sphere's share of the number are those of the curve. */
CASE(passing_curve_of_few_spheres_is_the_one_asked_for) {
  jam_diameters_options o = options(JAM_SIZES_SIEVE);
  size_t n;
  double sum = 0;
  o.n = 200;
  double *s = draw(&o, curve, 8, &n);
  assert_int_equal(n, 200);
  double all = volume(s, n, 3);
  for (size_t k = 0; k + 1 < n; ++k) {
    const double here = sqrt(s[k] * s[k + 1]); /* between both */
    double asked = 0;
    sum += volume(s + k, 1, 3);
    assert_true(s[k] <= s[k + 1] * (1 + 1e-12) && s[k] >= 0.5 && s[k] <= 4);
    for (size_t row = 0; row < 3; ++row) {
      const double low = curve[2 * row], high = curve[2 * row + 2];
      const double part = here <= low ? 0 : here >= high ? 1 : log(here / low) / log(high / low);
      asked += part * (curve[2 * row + 3] - curve[2 * row + 1]) / 100;
    }
    /* the end of the share lies between both spheres, so the curves differ by less than one sphere */
    assert_true(fabs(sum / all - asked) <= volume(s + k + 1, 1, 3) / all);
  }
  free(s);
}

CASE(density_is_exact_and_n_follows) {
  static const int32_t laws[] = {JAM_SIZES_EQUAL, JAM_SIZES_NORMAL, JAM_SIZES_LOGNORMAL, JAM_SIZES_UNIFORM,
                                 JAM_SIZES_SIEVE};
  for (size_t law = 0; law < sizeof laws / sizeof *laws; ++law)
    for (int dim = 2; dim <= 3; ++dim)
      for (int way = 0; way < 2; ++way) {
        jam_diameters_options o = options(laws[law]);
        const int sieve = o.law == JAM_SIZES_SIEVE;
        size_t n;
        double least = INFINITY, most = 0;
        o.dim = dim;
        o.draw = way;
        if (o.law == JAM_SIZES_NORMAL || o.law == JAM_SIZES_LOGNORMAL) o.deviation = 0.2, o.high = 1.8;
        if (o.law == JAM_SIZES_UNIFORM) o.low = 0.7, o.high = 1.3;
        o.cell_volume = sieve ? 3000 : 300;
        o.packing_fraction = 0.6;
        double *s = draw(&o, sieve ? curve : NULL, sieve ? 8 : 0, &n);
        /* whole spheres of one size miss it by half a sphere at most */
        if (!(fabs(volume(s, n, dim) / o.cell_volume - 0.6) <
              (o.law == JAM_SIZES_EQUAL ? 0.5 * volume(s, 1, dim) / o.cell_volume * (1 + 1e-12) : 1e-12)))
          fail_msg("law %d, d = %d: %g", (int)o.law, dim, volume(s, n, dim) / o.cell_volume - 0.6);
        for (size_t k = 0; k < n; ++k) least = fmin(least, s[k]), most = fmax(most, s[k]);
        if (o.law == JAM_SIZES_EQUAL) {
          assert_true(least == 1 && most == 1);
        } else if (sieve) {
          assert_true(most <= 4 * (1 + 1e-12) && s[n - 1] <= 4);
        } else {
          assert_true(most <= 1.8);
        }
        double *again = draw(&o, sieve ? curve : NULL, sieve ? 8 : 0, &n);
        assert_memory_equal(s, again, n * sizeof *s);
        if (way == JAM_DRAW_RANDOM && o.law == JAM_SIZES_LOGNORMAL) {
          free(again);
          o.seed = 2;
          again = draw(&o, NULL, 0, &n);
          assert_true(again[0] != s[0]);
        }
        free(s);
        free(again);
      }
}

/* Quantiles ascend, and lie in the range of the law, however narrow it is. */
CASE(quantiles_by_volume_ascend_in_their_range) {
  static const double widths[] = {1e-6, 1e-4, 1e-3, 0.01, 3.0};
  for (int law = 0; law < 2; ++law)
    for (size_t q = 0; q < sizeof widths / sizeof *widths; ++q) {
      jam_diameters_options o = options(law ? JAM_SIZES_LOGNORMAL : JAM_SIZES_UNIFORM);
      size_t n;
      o.n = 100000, o.share = JAM_SHARE_VOLUME, o.low = 1.0, o.high = 1.0 + widths[q];
      if (law) o.mean = 1.0, o.deviation = widths[q], o.low = 1.0 - widths[q] / 4.0, o.high = INFINITY;
      double *s = draw(&o, NULL, 0, &n);
      assert_true(s[0] >= o.low && s[n - 1] <= o.high);
      for (size_t k = 1; k < n; ++k) assert_true(s[k] >= s[k - 1]);
      free(s);
    }
}

/* A law that is cut far from its mean is the law still, or is refused by name: never one size. */
CASE(laws_by_volume_may_be_cut_far_from_the_mean) {
  for (double deviation = 3.0; deviation < 60.0; deviation *= 1.3) {
    jam_diameters_options o = options(JAM_SIZES_LOGNORMAL);
    size_t n;
    o.n = 1000, o.share = JAM_SHARE_VOLUME, o.mean = 1.0, o.deviation = deviation, o.low = 0.1, o.high = 10.0;
    double *s = draw(&o, NULL, 0, &n), number = 0.0, all = 0.0;
    /* The mean of s^3: by volume, ln s has the density exp(-(x - mu)^2 / 2 w^2); by number s^-3 times that. */
    const double w2 = log1p(deviation * deviation), mu = -0.5 * w2, a = log(0.1), b = log(10.0);
    for (int k = 0; k < 100000; ++k) {
      const double x = a + (b - a) * (k + 0.5) / 1e5, f = exp(-(x - mu) * (x - mu) / (2.0 * w2));
      all += f, number += f * exp(-3.0 * x);
    }
    assert_float_equal(volume(s, n, 3) / (acos(-1.0) / 6.0 * 1000.0), all / number, 1e-4 * all / number);
    free(s);
  }
}

/* A list keeps its sizes too, whatever the density asked for. */
CASE(few_sizes_stay_whole) {
  const double rows[] = {1.0, 0.5, 1.7, 0.3, 2.5, 0.2};
  double fraction;
  for (fraction = 0.3; fraction < 0.6; fraction += 0.037) {
    jam_diameters_options o = options(JAM_SIZES_LIST);
    size_t n;
    o.cell_volume = 2000, o.packing_fraction = fraction;
    double *s = draw(&o, rows, 6, &n);
    for (size_t k = 0; k < n; ++k) assert_true(s[k] == 1.0 || s[k] == 1.7 || s[k] == 2.5);
    assert_true(fabs(volume(s, n, 3) - fraction * 2000) <= volume(s + n - 1, 1, 3));
    free(s);
  }
}

/* The mean of equal diameters is that diameter, to the last bit. */
CASE(mean_of_equal_diameters_is_exact) {
  static const double of[] = {0.8, 0.1, 1.4, 1e-7, 3e5};
  static double s[1000000];
  for (size_t q = 0; q < sizeof of / sizeof *of; ++q)
    for (size_t n = 7; n <= sizeof s / sizeof *s; n = n == 7 ? 999983 : n + 17) {
      jam_size_report r = {.struct_size = sizeof r};
      for (size_t k = 0; k < n; ++k) s[k] = of[q];
      assert_int_equal(jam_get_size_report(3, s, n, &r), JAM_OK);
      assert_true(r.mean == of[q] && r.deviation == 0.0 && r.polydispersity == 0.0);
    }
}

CASE(bad_laws_are_refused_by_name) {
  static const double falls[] = {1, 0, 2, 60, 3, 40, 4, 100}, short_of[] = {1, 0, 2, 87}, begins[] = {1, 5, 2, 100},
                      back[] = {1, 0, 3, 50, 2, 100}, zero_share[] = {1, 0.5, 2, 0}, one_large[] = {1, 0.9, 2, 0.1},
                      negative[] = {-1, 0.5, 2, 0.5}, nan_size[] = {NAN, 0, 2, 1};
#define BY(kind, set, rows, rows_len, status, words)     \
  do {                                                   \
    jam_diameters_options o = options(JAM_SIZES_##kind); \
    set;                                                 \
    refused(&o, rows, rows_len, status, words);          \
  } while (0)
#define SIEVE(rows, len, words) BY(SIEVE, o.n = 10, rows, len, JAM_E_ARGUMENT, words)
  SIEVE(falls, 8, "row 2 (3, 40): the sieve curve falls");
  SIEVE(short_of, 4, "must end at 1, or at 100");
  SIEVE(begins, 4, "must begin at 0");
  SIEVE(back, 6, "must rise");
  SIEVE(negative, 4, "above 0");
  SIEVE(curve, 3, "rows of two");
  SIEVE(NULL, 0, "needs a curve");
  BY(SIEVE, o.n = 10, nan_size, 4, JAM_E_NONFINITE, "curve row 0");
  BY(LIST, o.n = 10, zero_share, 4, JAM_E_ARGUMENT, "row 1 (2, 0): a share must be above 0");
#define LARGE(set, words) BY(LIST, set, one_large, 4, JAM_E_ARGUMENT, words)
  LARGE(o.n = 3, "n is 3, and no sphere has the diameter 2, whose share of the number is 0.1: 10 have one");
  LARGE((o.n = 20, o.share = JAM_SHARE_VOLUME), "n is 20, and no sphere has the diameter 2"); /* by number 0.0137 */
  LARGE((o.share = JAM_SHARE_VOLUME, o.cell_volume = 20, o.packing_fraction = 0.4), "no sphere has the diameter 2");
#define LOGNORMAL(set, status, words) BY(LOGNORMAL, (o.n = 10, set), NULL, 0, status, words)
  LOGNORMAL(o.deviation = NAN, JAM_E_ARGUMENT, "needs deviation");
  LOGNORMAL(o.deviation = -0.1, JAM_E_ARGUMENT, "deviation is -0.1");
  LOGNORMAL(o.deviation = INFINITY, JAM_E_NONFINITE, "deviation");
  LOGNORMAL((o.deviation = 0.1, o.mean = NAN), JAM_E_NONFINITE, "mean");
  LOGNORMAL((o.deviation = 0.1, o.shape = 2), JAM_E_ARGUMENT, "lognormal has no such field");
  LOGNORMAL((o.deviation = 0.1, o.low = 5, o.high = 4), JAM_E_ARGUMENT, "low must be below high");
  LOGNORMAL((o.deviation = 0.1, o.low = 50, o.high = 60), JAM_E_ARGUMENT, "keep a share");
  BY(WEIBULL, (o.n = 10, o.shape = 1.5), NULL, 0, JAM_E_ARGUMENT, "fines without end");
#define EQUAL(set, words) BY(EQUAL, set, NULL, 0, JAM_E_ARGUMENT, words)
  EQUAL(o.law = 99, "not a jam_size_law");
  EQUAL((void)o, "n is 0");
  EQUAL((o.n = 100, o.cell_volume = 10), "add up to a volume of 52.");
  EQUAL((o.n = 100, o.cell_volume = 10, o.packing_fraction = 0.5), "from which n follows");
  EQUAL(o.packing_fraction = 0.5, "needs cell_volume");
  EQUAL((o.packing_fraction = 0.5, o.cell_volume = 1e-9), "too small");
  EQUAL((o.packing_fraction = 0.5, o.cell_volume = 1e12), "2^31-1");
  EQUAL((o.packing_fraction = 1.5, o.cell_volume = 1000), "below 1");
  BY(EQUAL, (o.cell_volume = 1000, o.packing_fraction = 0.72), NULL, 0, JAM_E_UNPLACEABLE, "jam near 0.643");
  assert_non_null(strstr(jam_last_error(), "random sequential addition ends near 0.384"));
}

CASE(laws_are_read_from_text) {
  static const char *const bad[] = {"gauss",          "lognormal:width=3", "lognormal:0.3", "lognormal:deviation=",
                                    "sieve:none.csv", "equal:share=mass",  "equal:,",       NULL};
  jam_diameters_options o = options(JAM_SIZES_EQUAL);
  double rows[4];
  size_t needed;
  assert_int_equal(jam_parse_diameters("lognormal: deviation=0.3, share=volume,draw=random", &o, NULL, 0, &needed),
                   JAM_OK);
  assert_true(o.law == JAM_SIZES_LOGNORMAL && o.deviation == 0.3 && o.share == JAM_SHARE_VOLUME);
  assert_true(o.draw == JAM_DRAW_RANDOM && needed == 0);
  assert_int_equal(jam_parse_diameters("list:1=0.75,1.4=2.5e-1", &o, rows, 4, &needed), JAM_OK);
  assert_true(o.law == JAM_SIZES_LIST && needed == 4 && rows[0] == 1 && rows[3] == 0.25);
  o = options(JAM_SIZES_EQUAL);
  assert_int_equal(jam_parse_diameters("list:1=0.75,1.4=2.5e-1", &o, rows, 3, &needed), JAM_E_BUFFER);
  assert_true(o.law == JAM_SIZES_EQUAL && needed == 4); /* a failure changes no option */
  for (size_t k = 0; bad[k]; ++k)
    if (jam_parse_diameters(bad[k], &o, NULL, 0, &needed) >= 0) fail_msg("%s was taken", bad[k]);
}

/* Test sheets list the coarse sieve first: the same curve, the same spheres. */
CASE(curves_may_begin_at_either_end) {
  static const double turned[] = {4, 100, 2, 50, 1, 10, 0.5, 0}, mixed[] = {4, 100, 1, 10, 2, 50, 0.5, 0};
  jam_diameters_options o = options(JAM_SIZES_SIEVE);
  size_t n, m;
  o.n = 500;
  double *a = draw(&o, curve, 8, &n);
  double *b = draw(&o, turned, 8, &m);
  assert_int_equal(n, m);
  assert_memory_equal(a, b, n * sizeof *a);
  refused(&o, mixed, 8, JAM_E_ARGUMENT, "row 1 (1, 10): the sieve curve falls");
  free(a);
  free(b);
}

/* What libjam reads from a file of this text. */
static jam_status parsed(const char *text, double *rows, size_t rows_len, size_t *needed) {
  const char *const name = "jam_curve.csv";
  jam_diameters_options o = options(JAM_SIZES_EQUAL);
  FILE *file = fopen(name, "w");
  assert_non_null(file);
  fputs(text, file);
  fclose(file);
  const jam_status status = jam_parse_diameters("sieve:jam_curve.csv", &o, rows, rows_len, needed);
  remove(name);
  return status;
}

CASE(curves_are_read_from_files) {
  static const char *const good[] = {"# grading of a sand\nsize,passing\n0.5, 0\n1, 40 # half\n2, 100\n",
                                     "Sieve size (mm),Passing (%)\n0.5,0\n1,40\n2,100\n"};
  double rows[6];
  size_t needed;
  for (int k = 0; k < 2; ++k) {
    assert_int_equal(parsed(good[k], rows, 6, &needed), JAM_OK);
    assert_true(needed == 6 && rows[2] == 1 && rows[3] == 40 && rows[5] == 100);
  }
  SAYS(parsed("0.5 0\n1 40 7\n", NULL, 0, &needed), JAM_E_FORMAT, "line 2");
  SAYS(parsed("size passing\n0.5 0\n,40\n2 100\n", NULL, 0, &needed), JAM_E_FORMAT, "line 3: column 1 is empty");
  /* a row that lost its first number, and no heading */
  SAYS(parsed("fine 0\n1 40\n", NULL, 0, &needed), JAM_E_FORMAT, "line 1");
}

CASE(fluids_do_not_begin_to_grow_beyond_their_reach) {
  DEFAULTS(compress, o);
  SIZED(jam_md_report, r);
  OWNED jam_system *sys = random_spheres(3, 1000, 0.0, 1);
  o.packing_fraction = 0.70;
  SAYS(jam_compress(sys, &o, &r), JAM_E_UNPLACEABLE, "Farr and Groot");
  o.packing_fraction = 0.45;
  assert_int_equal(jam_compress(sys, &o, &r), JAM_OK);
  assert_true(fabs(r.packing_fraction - 0.45) < 1e-12);
}
