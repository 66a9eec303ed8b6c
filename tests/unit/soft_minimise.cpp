// Minimisers: one minimum from one near start, balance beyond the digits of coordinates, rattlers, unjammed starts.
#include <cmath>
#include "test.h"

#include "core/call_scope.hpp"
#include "core/rng.hpp"
#include "soft/decompression.hpp"
#include "unit/random_packing.hpp"

using namespace jam::inside;

namespace {

SoftResult relaxed(const Packing &p, const jam_relax_options &o) {
  Monitor monitor;
  monitor.begin();
  return relax(p, o, monitor);
}

SoftResult relaxed(const Packing &p, int32_t minimiser, double alpha = 2.0, double tolerance = 1e-12,
                   int32_t precision = JAM_SOFT_REFERENCE) {
  jam_relax_options o = default_relax_options();
  o.minimiser = minimiser, o.alpha = alpha, o.force_tolerance = tolerance, o.precision = precision;
  o.max_evaluations = 200000;
  return relaxed(p, o);
}

DecompressionResult decompressed(const Packing &p, const jam_decompress_options &o) {
  Monitor monitor;
  monitor.begin();
  return decompress(p, o, monitor, nullptr);
}

// From a minimum that is shaken a little every method leads back to it.
CASE(one_minimum) {
  for (int dim = 2; dim <= 3; ++dim)
    for (const double alpha : {2.0, 2.5}) {
      const SoftResult start = relaxed(random_packing(dim, 80, dim == 2 ? 0.95 : 0.75, 2), JAM_MINIMISER_NEWTON, alpha);
      assert_int_equal(start.status, JAM_OK);
      assert_true(start.report.force_residual < 1e-12 && start.report.excess_contacts > 0);
      Packing shaken = start.packing;
      Rng rng(9, Stream::velocities);
      for (double &x : shaken.position) x = wrap(x + 1e-5 * (rng.uniform() - 0.5), 1.0);
      for (int32_t m = JAM_MINIMISER_NEWTON; m <= JAM_MINIMISER_LBFGS; ++m) {
        const SoftResult end = relaxed(shaken, m, alpha);
        assert_int_equal(end.status, JAM_OK);
        assert_int_equal(end.report.minimiser, m);
        assert_true(std::fabs(end.report.energy / start.report.energy - 1.0) < 1e-11);
        assert_true(end.contacts.pairs.i == start.contacts.pairs.i && end.contacts.pairs.j == start.contacts.pairs.j);
      }
    }
}

// Below alpha = 2 a contact that opens is ever stiffer.
CASE(contacts_that_stiffen) {
  for (int dim = 2; dim <= 3; ++dim) {
    const Packing start = random_packing(dim, 200, dim == 2 ? 0.92 : 0.7, 1);
    const SoftResult end = relaxed(start, JAM_MINIMISER_NEWTON, 1.5);
    assert_int_equal(end.status, JAM_OK);
    assert_true(end.report.force_residual < 1e-12 && end.report.evaluations < 20000);
  }
}

// FIRE does not converge for some of these.
CASE(wide_mixtures) {
  for (const double ratio : {3.0, 10.0, 30.0})
    for (int64_t seed = 1; seed <= 3; ++seed) {
      Packing start = random_packing(2, 200, 0.95, seed);
      for (size_t i = 0; i < start.n(); ++i)
        start.diameter[i] = std::pow(ratio, static_cast<double>(i) / static_cast<double>(start.n()));
      const double scale = std::sqrt(0.95 / packing_fraction(start));
      for (double &s : start.diameter) s *= scale;
      const SoftResult end = relaxed(start, JAM_MINIMISER_NEWTON);
      assert_int_equal(end.status, JAM_OK);
      assert_true(end.report.force_residual < 1e-12 && end.report.evaluations < 20000);
    }
}

// What is left of overlaps at rest is below their rounding: no spheres that jam.
CASE(steep_energies_below_jamming) {
  for (int32_t m = JAM_MINIMISER_NEWTON; m <= JAM_MINIMISER_LBFGS; ++m) {
    const SoftResult end = relaxed(random_packing(2, 30, 0.3, 947), m, 12.0);
    assert_int_equal(end.status, JAM_NOT_JAMMED);
    assert_int_equal(end.report.contacts, 0);
  }
}

// Near jamming, forces of the way there may balance to 1e-2 where spheres are not held yet: that is no saddle.
CASE(loose_tolerances) {
  jam_decompress_options o = default_decompress_options();
  o.distance = 1e-6, o.isostatic = 0, o.crunch = 0;
  for (int64_t seed = 1; seed <= 3; ++seed) {
    Packing shaken = decompressed(random_packing(3, 200, 0.7, seed), o).soft.packing;
    Rng rng(seed, Stream::velocities);
    for (double &x : shaken.position) x = wrap(x + 6e-7 * shaken.diameter[0] * (rng.uniform() - 0.5), 1.0);
    for (const double tolerance : {1e-2, 1e-3})
      for (int32_t m = JAM_MINIMISER_NEWTON; m <= JAM_MINIMISER_LBFGS; ++m) {
        const SoftResult end = relaxed(shaken, m, 2.0, tolerance);
        assert_int_equal(end.status, JAM_OK);
        assert_true(end.report.force_residual < tolerance);
      }
  }
}

// Near alpha = 1 the force of a contact jumps as it closes. Every method converges to what it reports, or says that it
// did not; a decompression keeps no minimum that does not balance.
CASE(alpha_near_one) {
  for (int dim = 2; dim <= 3; ++dim)
    for (const double alpha : {1.05, 1.1, 1.2}) {
      const Packing start = random_packing(dim, 40, dim == 2 ? 0.95 : 0.75, 1);
      for (int32_t m = JAM_MINIMISER_NEWTON; m <= JAM_MINIMISER_LBFGS; ++m) {
        jam_relax_options o = default_relax_options();
        o.minimiser = m, o.alpha = alpha, o.max_evaluations = 3000;
        const SoftResult end = relaxed(start, o);
        const bool balanced = end.report.contacts > 0 && end.report.force_residual < o.force_tolerance;
        assert_int_equal(end.report.converged, end.status == JAM_OK || end.status == JAM_NOT_JAMMED);
        if (end.status == JAM_OK) assert_true(balanced);
        if (end.status == JAM_NOT_JAMMED) assert_true(end.report.energy == 0.0);
        if (!end.report.converged) assert_true(end.status == JAM_LIMIT || end.status == JAM_NOT_CONVERGED);
        for (const double x : end.packing.position) assert_true(std::isfinite(x));
      }
      jam_decompress_options o = default_decompress_options();
      o.alpha = alpha, o.crunch = 0, o.max_evaluations = 3000;
      const DecompressionResult down = decompressed(start, o);
      for (const SoftRow &row : down.history) assert_true(row[JAM_SOFT_RESIDUAL] < o.force_tolerance);
      assert_true(down.status != JAM_OK || !down.history.empty());
    }
}

// What counts is the residual of the state that is handed out, after its positions are rounded anew.
CASE(converged_is_what_is_reported) {
  for (int64_t seed = 1; seed <= 4; ++seed)
    for (const double tolerance : {1e-15, 2e-15, 3e-15, 5e-15, 1e-14}) {
      jam_relax_options o = default_relax_options();
      o.force_tolerance = tolerance, o.max_evaluations = 4000;
      const SoftResult end = relaxed(random_packing(3, 40, 0.75, seed), o);
      assert_int_equal(end.report.converged, end.status == JAM_OK);
      if (end.report.converged) assert_true(end.report.force_residual < tolerance);
    }
}

// A tolerance that no sum of forces can meet ends a minimisation as PRECISION, not at the limit of evaluations.
CASE(forces_at_rounding) {
  for (int dim = 2; dim <= 3; ++dim)
    for (const double alpha : {1.5, 2.0, 2.5})
      for (int32_t m = JAM_MINIMISER_NEWTON; m <= JAM_MINIMISER_LBFGS; ++m) {
        const SoftResult end = relaxed(random_packing(dim, 40, dim == 2 ? 0.95 : 0.75, 1), m, alpha, 1e-20);
        print_message("d %d alpha %g minimiser %d: residual %.1e, %lld evaluations\n", dim, alpha, m,
                      end.report.force_residual, static_cast<long long>(end.report.evaluations));
        assert_int_equal(end.status, JAM_PRECISION);
        assert_int_equal(end.report.stop_reason, JAM_STOP_PRECISION);
        assert_false(end.report.converged);
        assert_true(end.report.force_residual < 1e-13);
      }
  // PRECISION also where a weak contact is stiff, as below alpha = 2, or rounded positions balance a little worse.
  for (int64_t seed = 1; seed <= 3; ++seed)
    for (const double alpha : {1.5, 1.8}) {
      const SoftResult end = relaxed(random_packing(3, 64, 0.7, seed), JAM_MINIMISER_NEWTON, alpha, 1e-15);
      print_message("alpha %g, seed %d: %s, residual %.1e\n", alpha, static_cast<int>(seed),
                    jam_status_string(end.status), end.report.force_residual);
      assert_true(end.status == (end.report.converged ? JAM_OK : JAM_PRECISION));
    }
}

// Steps that change no diameter end a decompression.
CASE(steps_at_rounding) {
  jam_decompress_options o = default_decompress_options();
  o.isostatic = 0, o.energy_factor = 1.0 - 0x1p-53;
  const DecompressionResult end = decompressed(random_packing(3, 40, 0.75, 1), o);
  assert_int_equal(end.status, JAM_PRECISION);
  assert_int_equal(end.report.steps, 1);
}

// Forces balance to 1e-12 where overlaps are 1e-9 of a diameter; in plain doubles they cannot.
CASE(balance_at_tiny_overlaps) {
  jam_decompress_options o = default_decompress_options();
  o.isostatic = o.crunch = 0, o.distance = 1e-9;
  const DecompressionResult end = decompressed(random_packing(3, 80, 0.75, 4), o);
  assert_int_equal(end.status, JAM_OK);
  assert_true(end.soft.report.distance <= 1e-9 && end.soft.report.force_residual < 1e-12);
  assert_true(end.soft.report.excess_contacts >= 0 && end.soft.report.stable > 60);
  const SoftResult plain = relaxed(end.soft.packing, JAM_MINIMISER_NEWTON, 2.0, 1e-12, JAM_SOFT_DOUBLE);
  assert_int_equal(plain.status, JAM_PRECISION);
  assert_true(plain.report.force_residual > 1e-10);
  const SoftResult exact = relaxed(end.soft.packing, JAM_MINIMISER_NEWTON);
  assert_int_equal(exact.status, JAM_OK);
  assert_true(exact.report.force_residual < 1e-12);
}

// The forces of a crystal balance at once, and the test for a saddle is all that takes time.
CASE(tests_for_saddles_can_be_stopped) {
  Packing p;
  p.set_cube(3, 4.0);
  for (int k = 0; k < 256; ++k)
    for (int c = 0; c < 3; ++c) {
      const int corner = k % 4, cell = k / 4 / (c == 0 ? 1 : c == 1 ? 4 : 16) % 4;
      p.position.push_back(cell + (corner > 0 && corner != c + 1 ? 0.5 : 0.0));
    }
  p.diameter.assign(256, 1.02 * std::sqrt(0.5));
  p.overlap_allowed = true;
  Monitor monitor;
  monitor.begin();
  const CallScope scope(1e9, &monitor);
  SoftState state = first_state(p, PairEnergy(2.0, JAM_SOFT_RELATIVE), JAM_SOFT_REFERENCE);
  Effort effort;
  effort.monitor = &monitor;
  effort.allow(1000);
  Relaxation r(state, effort);
  SoftResult out;
  assert_true(minimise_and_measure(r, JAM_MINIMISER_LBFGS, 1e-9, false, out) == DescentEnd::balanced);
  monitor.cancel();
  assert_true(minimise_and_measure(r, JAM_MINIMISER_LBFGS, 1e-9, false, out) == DescentEnd::interrupted);
  assert_int_equal(out.report.contacts, 6 * 256);  // what was measured stays
}

// A rattler against its cage goes to where its nearest neighbours are farther.
CASE(rattlers_are_centred) {
  Packing p;  // a small sphere inside a cube of eight large ones that overlap along the edges
  p.set_cube(3, 1.0);
  for (int k = 0; k < 8; ++k)
    for (int c = 0; c < 3; ++c) p.position.push_back(0.25 + 0.5 * ((k >> c) & 1));
  p.diameter.assign(8, 0.51);
  p.position.insert(p.position.end(), {0.56, 0.5, 0.47});
  p.diameter.push_back(0.3);
  p.velocity.assign(27, 0.0);
  SoftState state(p, PairEnergy(2.0, JAM_SOFT_RELATIVE), JAM_SOFT_REFERENCE);
  centre_rattlers(state);
  state.rebase();
  const std::vector<double> &x = state.base().position;
  for (int c = 0; c < 24; ++c) assert_true(x[c] == p.position[c]);
  double least = 1.0;
  for (int k = 0; k < 8; ++k) {
    double r2 = 0.0;
    for (int c = 0; c < 3; ++c) r2 += std::pow(x[24 + c] - x[3 * k + c], 2);
    least = std::min(least, std::sqrt(r2) - 0.405);
  }
  assert_true(least > 0.02);  // sqrt(3)/4 - 0.405 = 0.028 in the middle; -0.017 before
}

}  // namespace
