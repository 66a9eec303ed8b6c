/* jam_estimate_crunch: memory against what a child process really takes, the log line, errors. */
#include <sys/resource.h>
#include <sys/wait.h>

#include "steps.h"

static jam_estimate_report estimated(const jam_system *sys, const jam_crunch_options *o) {
  SIZED(jam_estimate_report, e);
  assert_int_equal(jam_estimate_crunch(sys, o, &e), JAM_OK);
  return e;
}

/* Factorisations, not calls: on a slow machine calls come while the first one is prepared, which takes no memory yet.
 */
static int32_t stop_after(const jam_progress *p, void *factorisations) {
  return p->factorisations >= *(const int *)factorisations;
}

static double peak(void) {
  struct rusage u;
  getrusage(RUSAGE_SELF, &u);
  return 1024.0 * (double)u.ru_maxrss;
}

typedef struct measured {
  double estimate, taken;
} measured;

/* The whole life of a packing in a fresh process: how much its peak grows while it crunches. The longest lists come
 * early. */
static measured life(int64_t n, double phi, double pressure, int factorisations, int32_t threads) {
  jam_system *small = random_spheres(3, 200, 0.3, 1);
  measured m;
  assert_int_equal(jam_crunch(small, NULL, NULL), JAM_OK); /* code and buffers of all libraries are in memory now */
  jam_destroy(small);
  OWNED jam_system *sys = random_spheres(3, n, phi, 1);
  DEFAULTS(compress, c);
  c.growth_rate = 1e-2, c.pressure = pressure;
  if (pressure > 0.0) jam_compress(sys, &c, NULL);
  DEFAULTS(crunch, o);
  o.steps = 1; /* the callback hears of each */
  o.threads = threads;
  m.estimate = estimated(sys, &o).bytes;
  m.taken = peak();
  jam_set_progress(sys, stop_after, &factorisations);
  m.taken = jam_crunch(sys, &o, NULL) >= 0 ? peak() - m.taken : -1.0;
  return m;
}

/* Floats take half of what the estimate says: it is for the end, where factors of all sizes are doubles. */
static void memory(int64_t n, double phi, double pressure, int factorisations, int32_t threads, double share) {
  int ends[2], status = -1;
  measured m = {0.0, 0.0};
  assert_int_equal(pipe(ends), 0);
  pid_t child = fork();
  if (child == 0) {
    m = life(n, phi, pressure, factorisations, threads);
    _exit(write(ends[1], &m, sizeof m) != sizeof m);
  }
  close(ends[1]);
  assert_true(read(ends[0], &m, sizeof m) == sizeof m);
  close(ends[0]);
  assert_true(waitpid(child, &status, 0) == child && status == 0);
  print_message("n %d: estimate %.1f MB, taken %.1f MB\n", (int)n, m.estimate / 1e6, m.taken / 1e6);
#ifdef JAM_SANITIZED /* which keeps what was freed */
  (void)share;
#else
  assert_true(m.taken > share * m.estimate / 1.5 && m.taken < 1.5 * share * m.estimate);
#endif
  assert_true(m.taken > 0.0);
}

CASE(memory_estimate_is_good_to_a_half) {
  memory(4096, 0.3, 0.0, 2, 1, 0.5);        /* two factors in floats */
  memory(1200, 0.3, 500.0, 100000, 1, 1.0); /* to the verdict, which has a factor of its own */
  memory(1200, 0.3, 500.0, 100000, 2, 1.0);
}

/* Twice the spheres: pairs double, flops more than double; more threads need no less memory. */
CASE(estimates_scale_with_the_number_of_spheres) {
  OWNED jam_system *small = random_spheres(3, 300, 0.3, 1), *large = random_spheres(3, 600, 0.3, 1);
  jam_estimate_report a, b;
  a = estimated(small, NULL), b = estimated(large, NULL);
  assert_true(b.pairs > 1.8 * (double)a.pairs && b.pairs < 2.2 * (double)a.pairs);
  assert_true(b.flops > 2.0 * a.flops && b.bytes > 1.9 * a.bytes);
  assert_true(a.seconds == a.factorisations * a.step_seconds && a.step_seconds > 0.0);
  assert_true(0.0 < a.seconds_low && a.seconds_low < a.seconds && a.seconds < a.seconds_high);
  DEFAULTS(crunch, o);
  o.threads = 2;
  jam_estimate_report two = estimated(large, &o);
  assert_true(two.bytes >= b.bytes && two.flops == b.flops);
  o.threads = 8;
  assert_true(estimated(large, &o).bytes >= two.bytes);
}

/* Small spheres roam in holes: the path meets saddles, and makes a list a step. */
CASE(wide_mixtures_take_more_steps) {
  double sizes[256], before = 0.0;
  for (int ratio = 1; ratio <= 100; ratio *= 10) {
    DEFAULTS(create, o);
    o.n = 256;
    for (int i = 0; i < 256; ++i) sizes[i] = i < 128 ? 1.0 : ratio;
    OWNED jam_system *sys = created_from(&o, NULL, 0, sizes, 256);
    const jam_estimate_report e = estimated(sys, NULL);
    assert_true(e.factorisations > 1.3 * before && e.seconds == e.factorisations * e.step_seconds);
    before = e.factorisations;
  }
}

/* Crunches of equal disks took up to 705 times the estimate, those of crystals 100 times: the path says nothing of
 * their decompressions and narrow linear programs. Crunches of mixtures stay within a factor of 5. */
CASE(equal_disks_and_crystals_have_a_wide_range) {
  static const struct {
    int32_t dim;
    int touching;              /* 16 x 16 disks of a square lattice */
    double ratio, least, most; /* of the highest time over the estimate */
  } cases[] = {{2, 0, 1.0, 100, 1000}, {2, 1, 1.0, 50, 1000}, {2, 0, 1.4, 2, 10}, {3, 0, 1.0, 2, 10}};
  double sizes[256], x[512];
  for (size_t k = 0; k < sizeof cases / sizeof *cases; ++k) {
    OWNED jam_system *sys = NULL;
    DEFAULTS(create, o);
    for (int i = 0; i < 256; ++i) {
      sizes[i] = (i % 2 ? cases[k].ratio : 1.0) / 16;
      x[2 * i] = (i % 16) / 16.0, x[2 * i + 1] = (double)(i / 16) / 16.0;
    }
    o.dim = cases[k].dim, o.n = 256;
    assert_int_equal(create_from(&o, cases[k].touching ? x : NULL, cases[k].touching ? 512 : 0, sizes, 256, &sys),
                     JAM_OK);
    const jam_estimate_report e = estimated(sys, NULL);
    assert_true(e.seconds_high > cases[k].least * e.seconds && e.seconds_high < cases[k].most * e.seconds);
  }
}

/* The path couples pairs near contact; an LP couples those too that its step bound lets close. */
CASE(the_path_factorises_fewer_pairs_than_the_lps) {
  OWNED jam_system *sys = random_spheres(3, 300, 0.3, 1);
  DEFAULTS(compress, c);
  c.growth_rate = 0.1, c.pressure = 1e4;
  assert_int_equal(jam_compress(sys, &c, NULL), JAM_OK);
  DEFAULTS(crunch, o);
  SIZED(jam_estimate_report, none);
  o.neighbour_radius = 0.9; /* shorter than a contact */
  SAYS(jam_estimate_crunch(sys, &o, &none), JAM_E_ARGUMENT, "below the largest diameter, 1 ");
  o.neighbour_radius = 1.5;
  jam_estimate_report path = estimated(sys, &o);
  assert_true(path.seconds_high < 10 * path.seconds); /* as many contacts as unknowns make no crystal */
  o.method = JAM_CRUNCH_SEQUENTIAL_LP;
  jam_estimate_report lps = estimated(sys, &o);
  assert_true((double)path.pairs >
              0.95 * (double)lps.pairs); /* the list of the LPs may be for slightly larger diameters */
  assert_true(path.flops < lps.flops && path.step_seconds < lps.step_seconds);
  o.neighbour_radius = 2.0; /* far pairs are rows, but stay out of the matrix */
  jam_estimate_report wide = estimated(sys, &o);
  assert_true((double)wide.pairs > 2.0 * (double)lps.pairs && wide.flops < 1.2 * lps.flops);
}

static void keep_estimate(int32_t level, const char *line, void *user) {
  if (level == JAM_LOG_INFO && !strncmp(line, "estimate: ", 10)) snprintf(user, 400, "%s", line);
}

/* The first line of a crunch that is logged. */
CASE(the_estimate_is_logged_first) {
  OWNED jam_system *sys = random_spheres(3, 60, 0.3, 1);
  char line[400] = "", expected[40];
  jam_estimate_report e = estimated(sys, NULL);
  jam_set_log(sys, keep_estimate, JAM_LOG_INFO, line);
  assert_int_equal(jam_crunch(sys, NULL, NULL), JAM_OK);
  snprintf(expected, sizeof expected,
           e.bytes < 999.5e3 ? "estimate: %.3g kB, %d pairs," : "estimate: %.3g MB, %d pairs,",
           e.bytes / (e.bytes < 999.5e3 ? 1e3 : 1e6), (int)e.pairs);
  assert_int_equal(strncmp(line, expected, strlen(expected)), 0);
}

CASE(bad_calls_are_refused) {
  OWNED jam_system *sys = random_spheres(3, 60, 0.3, 1), *one = random_spheres(3, 1, 0.1, 1);
  SIZED(jam_estimate_report, e);
  assert_int_equal(jam_estimate_crunch(sys, NULL, NULL), JAM_E_NULL);
  assert_int_equal(jam_estimate_crunch(one, NULL, &e), JAM_E_TOO_FEW);
}
