/* Crunches that end at a finite duality gap: it tells the density of the jamming point, forces balance, contacts that
 * are not counted as undecided are right, and another call goes on to the jamming point. */
#include <math.h>

#include "systems.h"
#include "verdicts.h"

enum { n = 256, most = 3000 };

static jam_system *grown(int dim, int64_t seed) {
  double sizes[n]; /* two of disks, as equal ones come near to a crystal, which LPs end at once */
  for (int k = 0; k < n; ++k) sizes[k] = dim == 2 && k % 2 ? 1.4 : 1.0;
  DEFAULTS(create, o);
  DEFAULTS(compress, md);
  o.n = n, o.dim = dim, o.seed = seed;
  md.growth_rate = 1e-2, md.pressure = 1e4;
  jam_system *sys = created_from(&o, NULL, 0, sizes, n);
  assert_int_equal(jam_compress(sys, &md, NULL), JAM_OK);
  return sys;
}

static jam_crunch_report crunch_to(jam_system *sys, double gap, jam_status expected) {
  DEFAULTS(crunch, o);
  o.duality_gap = gap;
  return crunch(sys, &o, expected);
}

static size_t pairs_of(const jam_system *sys, int32_t *pair) {
  size_t needed = 0;
  assert_int_equal(jam_contacts(sys, pair, 2 * most, &needed), JAM_OK);
  return needed / 2;
}

/* Pairs of the first list that the second lacks; both are sorted, and no pair has two images here. */
static int64_t missing(const int32_t *a, size_t count_a, const int32_t *b, size_t count_b) {
  int64_t count = 0;
  size_t q;
  for (size_t k = 0; k < count_a; ++k) {
    for (q = 0; q < count_b && (a[2 * k] != b[2 * q] || a[2 * k + 1] != b[2 * q + 1]);) ++q;
    count += q == count_b;
  }
  return count;
}

CASE(the_gap_tells_the_density) {
  static int32_t named[2 * most], exact[2 * most];
  int within = 0;
  for (int dim = 2; dim <= 4; ++dim)
    for (int64_t seed = 1; seed <= 2; ++seed) {
      OWNED jam_system *sys = grown(dim, seed);
      const jam_crunch_report r = crunch_to(sys, 1e-7, JAM_OK);
      assert_int_equal(r.stop_reason, JAM_STOP_DUALITY_GAP);
      assert_true(r.stationary == 1 && r.duality_gap > 0.0 && r.duality_gap <= 1e-7 * (1.0 + 1e-2));
      assert_true(r.force_residual < 1e-10 && r.min_force > 0.0 && r.max_overlap == 0.0);
      assert_true(r.contacts > 0 && r.rattlers + r.stable == n && r.undecided_contacts < r.contacts / 2);
      size_t count = pairs_of(sys, named);
      assert_int_equal(count, r.contacts);
      jam_crunch_report done = crunch_to(sys, 0.0, JAM_OK);
      assert_true(done.jammed && done.stop_reason == JAM_STOP_CONVERGED);
      size_t count_exact = pairs_of(sys, exact);
      int64_t wrong = missing(named, count, exact, count_exact) + missing(exact, count_exact, named, count);
      /* phi_J = phi (1 + e)^(d/2) but for squares of motions, a part of 1e-4 to 1e-3 of e here. A path that leaves a
       * saddle moves farther, to a larger phi_J; that is rare here. */
      double expected = 0.5 * dim * log1p(r.duality_gap);
      double gained = log1p((done.packing_fraction - r.packing_fraction) / r.packing_fraction);
      assert_true(gained > 0.99 * expected);
      if (gained < 1.01 * expected) {
        assert_true(wrong <= r.undecided_contacts);
        ++within;
      }
    }
  assert_true(within >= 5);
}

/* A smaller gap decides more pairs, on the way of one and the same path. */
CASE(a_smaller_gap_decides_more) {
  OWNED jam_system *sys = grown(3, 4);
  jam_crunch_report r;
  double gap;
  jam_crunch_report last = crunch_to(sys, 1e-6, JAM_OK);
  for (gap = 1e-8; gap > 1e-11; gap *= 1e-2) {
    r = crunch_to(sys, gap, JAM_OK);
    assert_int_equal(r.stop_reason, JAM_STOP_DUALITY_GAP);
    assert_true(r.duality_gap < last.duality_gap && r.undecided_contacts < last.undecided_contacts);
    assert_true(r.packing_fraction > last.packing_fraction && r.method == JAM_CRUNCH_BARRIER_PATH);
    last = r;
  }
}

/* LPs know the jamming point of a jammed packing at once: there is no path, and the certificate is the exact one. */
CASE(a_jammed_packing_stays_jammed) {
  OWNED jam_system *sys = grown(3, 1);
  crunch_to(sys, 0.0, JAM_OK);
  jam_crunch_report r = crunch_to(sys, 1e-3, JAM_OK);
  assert_true(r.jammed && r.stop_reason == JAM_STOP_CONVERGED && r.force_residual < 1e-13);
}
