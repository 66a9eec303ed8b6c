// Energies of soft spheres: exact values, forces against finite differences, overlaps against Quad.
#include <cmath>
#include "test.h"

#include "core/double_double.hpp"
#include "core/rng.hpp"
#include "soft/soft_state.hpp"
#include "unit/random_packing.hpp"

using namespace jam::inside;

namespace {

// Two spheres at a known overlap, every scale and exponent by hand; nothing at h = 0 and above.
CASE(pair_values) {
  Packing p;
  p.set_cube(3, 1.0);
  p.position = {0.25, 0.5, 0.5, 0.5, 0.5, 0.5};
  p.diameter = {0.5, 0.25};  // sigma = 0.375, overlap 0.125
  std::vector<double> f;
  for (const double alpha : {1.01, 1.5, 2.0, 2.5, 4.0})
    for (int scale = JAM_SOFT_RELATIVE; scale <= JAM_SOFT_BARE; ++scale) {
      const double l = scale == JAM_SOFT_RELATIVE ? 0.375 : 1.0, c = scale == JAM_SOFT_BARE ? 1.0 : 1.0 / alpha;
      const double v = c * std::pow(0.125 / l, alpha), force = c * alpha * std::pow(0.125 / l, alpha - 1.0) / l;
      SoftState state(p, PairEnergy(alpha, scale), JAM_SOFT_REFERENCE);
      const SoftSums sums = state.evaluate(f);
      assert_int_equal(sums.contacts, 1);
      assert_true(std::fabs(sums.energy / v - 1.0) < 1e-14);
      assert_true(std::fabs(sums.force / force - 1.0) < 1e-14);
      assert_true(std::fabs(sums.virial / (force * 0.25) - 1.0) < 1e-14);
      assert_true(std::fabs(f[0] / -force - 1.0) < 1e-14 && f[1] == 0.0 && std::fabs(f[3] / force - 1.0) < 1e-14);
      const SoftContacts contacts = state.contacts();
      const double k = state.energy().stiffness(contacts.overlap[0], contacts.force[0]);
      assert_true(std::fabs(k / (force * (alpha - 1.0) / 0.125) - 1.0) < 1e-14);
    }
  p.diameter = {0.25, 0.25};  // touching exactly
  SoftState touching(p, PairEnergy(1.5, JAM_SOFT_RELATIVE), JAM_SOFT_REFERENCE);
  const SoftSums none = touching.evaluate(f);
  assert_true(none.contacts == 0 && none.energy == 0.0 && f[0] == 0.0);
  assert_int_equal(touching.contacts().size(), 0);
  p.diameter = {0.25 * (1.0 + 0x1p-52), 0.25};  // by one bit of a diameter
  SoftState bit(p, PairEnergy(2.0, JAM_SOFT_RELATIVE), JAM_SOFT_REFERENCE);
  assert_int_equal(bit.contacts().size(), 1);
  assert_true(std::fabs(bit.contacts().overlap[0] / 0x1p-55 - 1.0) < 1e-12);
}

// Minus the central difference of the energy, spheres of two sizes, small boxes with several images, shifted distances.
CASE(forces_are_gradients) {
  for (int dim = 2; dim <= 4; ++dim)
    for (const double alpha : {1.5, 2.0, 2.5, 3.0})
      for (int model = JAM_MODEL_EUCLID; model <= JAM_MODEL_MK; ++model) {
        Packing p = random_packing(dim, 12, 0.9, 7 + dim, true);
        p.model = model;
        SoftState state(p, PairEnergy(alpha, JAM_SOFT_RELATIVE), JAM_SOFT_REFERENCE);
        std::vector<double> f, unused;
        state.evaluate(f);
        const double step = 1e-6 * state.diameter_mean();
        double scale = 0.0;
        for (const double x : f) scale = std::max(scale, std::fabs(x));
        for (size_t k = 0; k < f.size(); k += 5) {
          SoftState moved = state;
          moved.displacement()[k] += step;
          const double up = moved.evaluate(unused).energy;
          moved.displacement()[k] -= 2.0 * step;
          const double down = moved.evaluate(unused).energy;
          // Contacts that open within the step change sqrt-like forces by sqrt(1e-6).
          assert_true(std::fabs(f[k] + (up - down) / (2.0 * step)) < (alpha < 2.0 ? 2e-3 : 1e-6) * scale);
        }
      }
}

#if defined(__SIZEOF_FLOAT128__)
using Quad = __float128;
#else
using Quad = long double;  // of 128 bits where processors have no other
#endif

Quad overlap_by_quad(const Packing &p, const PairList &pairs, size_t k, const std::vector<double> &u) {
  Quad r2 = 0;
  const size_t i = pairs.i[k], j = pairs.j[k], d = p.dim;
  for (size_t c = 0; c < d; ++c) {
    const Quad r = static_cast<Quad>(p.position[i * d + c]) + u[i * d + c] -
                   (static_cast<Quad>(p.position[j * d + c]) + u[j * d + c]) + pairs.offset[k * d + c];
    r2 += r * r;
  }
  Quad root = std::sqrt(static_cast<double>(r2));
  for (int step = 0; step < 4; ++step) root = (root + r2 / root) / 2;
  return (static_cast<Quad>(p.diameter[i]) + p.diameter[j]) / 2 - root;
}

// Overlaps keep 15 digits however small they are: diameters are set so that pairs overlap by 1e-6 ... 1e-14 of one.
CASE(overlaps_against_quad) {
  const Packing p = random_packing(3, 60, 0.9, 3, true);
  for (const double size : {1e-6, 1e-10, 1e-14}) {
    SoftState state(p, PairEnergy(2.0, JAM_SOFT_RELATIVE), JAM_SOFT_REFERENCE);
    const SoftContacts before = state.contacts();
    const size_t k = before.pair[before.size() / 2];
    const double wanted = (1.0 + size) * before.distance[before.size() / 2];
    state.scale_diameters(wanted / (before.distance[before.size() / 2] + before.overlap[before.size() / 2]));
    Rng rng(5, Stream::velocities);
    for (double &x : state.displacement()) x = 0.05 * size * (rng.uniform() - 0.5) * state.diameter_mean();
    const SoftContacts now = state.contacts();
    bool small = false;
    for (size_t q = 0; q < now.size(); ++q) {
      const Quad exact = overlap_by_quad(state.base(), state.pairs(), now.pair[q], state.displacement());
      assert_true(std::fabs(static_cast<double>((now.overlap[q] - exact) / exact)) < 2e-15);
      const size_t i = state.pairs().i[now.pair[q]];
      small = small || now.overlap[q] < 10.0 * size * state.base().diameter[i];
    }
    assert_true(small && k < p.n() * p.n());
    // Another origin of the displacements is the same packing.
    SoftState again = state;
    again.rebase();
    const SoftContacts same = again.contacts();
    assert_int_equal(same.size(), now.size());
    for (size_t q = 0; q < now.size(); ++q) assert_true(std::fabs(same.overlap[q] / now.overlap[q] - 1.0) < 2e-15);
  }
}

// Sums and products of two doubles in twice the digits, against quad precision.
CASE(double_double) {
  Rng rng(1, Stream::velocities);
  for (int k = 0; k < 1000; ++k) {
    const double a = rng.normal(), b = 1e-8 * rng.normal(), c = rng.normal();
    const DoubleDouble x = two_sum(a, b) * two_sum(c, a) - DoubleDouble(a) * DoubleDouble(c);
    const Quad exact =
        (static_cast<Quad>(a) + b) * (static_cast<Quad>(c) + a) - static_cast<Quad>(a) * static_cast<Quad>(c);
    const Quad error = static_cast<Quad>(x.high) + x.low - exact;
    assert_true(std::fabs(static_cast<double>(error)) < 1e-30 * (1.0 + a * a + c * c) * 4.0);
    // quotient and root, by the products that give the operands back
    const DoubleDouble divided = two_sum(a, b) / two_sum(c, a), root = square_root(two_sum(a, b) * two_sum(a, b));
    const Quad sum = static_cast<Quad>(a) + b, by = static_cast<Quad>(c) + a;
    const Quad quotient = static_cast<Quad>(divided.high) + divided.low;
    const Quad positive = static_cast<Quad>(root.high) + root.low;
    assert_true(std::fabs(static_cast<double>((quotient * by - sum) / sum)) < 1e-30);
    assert_true(std::fabs(static_cast<double>((positive * positive - sum * sum) / (sum * sum))) < 1e-30);
  }
}

}  // namespace
