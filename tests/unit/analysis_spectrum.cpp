// Density of states and moduli against lattices whose answers are known.
#include "analysis/modes.hpp"
#include "analysis/spectrum.hpp"
#include "analysis_networks.hpp"
#include "core/error.hpp"
#include "core/rng.hpp"
#include "test.h"

using namespace jam::inside;
using namespace jamtest;

namespace {

CASE(density_of_fcc) {
  const Case c = lattice(fcc_basis(), fcc_bonds(), 10);
  const RigidityMatrix g = make_rigidity_matrix(c.packing, c.network);
  jam_dos_options o = default_dos_options();
  o.points = 512;
  o.moments = 128;
  o.vectors = 32;
  const DensityOfStates dos = density_of_states(g, contact_weights(g, 1.0, default_hessian_options()), o);
  const std::vector<double> exact = bloch_spectrum(fcc_basis(), fcc_bonds(), 10);
  // Two integrals that smoothing and degenerate levels hardly touch, and the cumulative spectrum.
  double sum = 0.0, second = 0.0, worst = 0.0, trace = 0.0;
  const double step = dos.omega[1] - dos.omega[0], modes = static_cast<double>(exact.size()) - 3.0;
  for (double l : exact) trace += l / modes;
  for (size_t k = 0; k < dos.omega.size(); ++k) {
    sum += dos.density[k] * step;
    second += dos.density[k] * dos.omega[k] * dos.omega[k] * step;
    const double edge = dos.omega[k] + 0.5 * step;
    const auto below =
        static_cast<double>(std::upper_bound(exact.begin(), exact.end(), edge * edge) - exact.begin()) - 3.0;
    worst = std::max(worst, std::fabs(sum - below / modes));
    assert_true(dos.density[k] > -1e-9 && dos.density_error[k] >= 0.0);
  }
  for (size_t k = 1; k < dos.omega.size(); ++k) {  // each value is the mean of the density over its bin
    const double between = dos.cumulative[k] - dos.cumulative[k - 1];
    assert_true(std::fabs(dos.density[k] * dos.step - between) < 1e-13);
  }
  assert_true(std::fabs(dos.cumulative.back() - 1.0) < 1e-12);
  assert_true(std::fabs(sum - 1.0) < 1e-12);
  assert_true(std::fabs(second / trace - 1.0) < 0.01);
  assert_true(worst < 0.06);
}

CASE(density_with_prestress) {
  // A crystal that its pre-stress makes unstable: negative eigenvalues at negative omega, by Bloch's cumulative
  // spectrum.
  const double t = 0.3;
  const Case c = lattice(fcc_basis(), fcc_bonds(), 10);
  const RigidityMatrix g = make_rigidity_matrix(c.packing, c.network);
  jam_hessian_options h = default_hessian_options();
  h.prestress = t;
  jam_dos_options o = default_dos_options();
  o.points = 400;
  o.moments = 256;
  o.vectors = 32;
  const DensityOfStates dos = density_of_states(g, contact_weights(g, 1.0, h), o);
  const std::vector<double> exact = bloch_spectrum(fcc_basis(), fcc_bonds(), 10, t);
  const double modes = static_cast<double>(exact.size()) - 3.0;
  double worst = 0.0, negative = 0.0, sum = 0.0;
  for (size_t k = 0; k < dos.omega.size(); ++k) {
    const double edge = dos.omega[k] + 0.5 * dos.step, lambda = edge * std::fabs(edge);
    auto below = static_cast<double>(std::upper_bound(exact.begin(), exact.end(), lambda) - exact.begin());
    if (lambda > 0.0) below -= 3.0;
    if (std::fabs(edge) > 0.3) worst = std::max(worst, std::fabs(dos.cumulative[k] - below / modes));
    if (edge < -0.3) negative = dos.cumulative[k];
    sum += dos.density[k] * dos.step;
  }
  assert_true(exact[0] < -0.1 && negative > 0.02);
  assert_true(worst < 0.05);
  assert_true(std::fabs(sum - 1.0) < 1e-12);
}

// Bins that the caller gives lie where it says, whatever the spectrum is: the same values, 0 outside, and a share of
// the modes below each edge.
CASE(density_on_given_bins) {
  const Case c = lattice(fcc_basis(), fcc_bonds(), 6);
  const RigidityMatrix g = make_rigidity_matrix(c.packing, c.network);
  const ContactWeights w = contact_weights(g, 1.0, default_hessian_options());
  jam_dos_options o = default_dos_options();
  o.points = 100;
  o.moments = 64;
  const DensityOfStates own = density_of_states(g, w, o);
  const double last = own.omega.back() + 0.5 * own.step;
  o.low = -last, o.high = 2.0 * last, o.points = 300;
  const DensityOfStates wide = density_of_states(g, w, o);
  assert_true(std::fabs(wide.step - own.step) < 1e-14);
  for (size_t k = 0; k < 300; ++k) {
    const bool within = k >= 100 && k < 200;
    assert_true(std::fabs(wide.omega[k] - (-last + (static_cast<double>(k) + 0.5) * own.step)) < 1e-12);
    assert_true(std::fabs(wide.density[k] - (within ? own.density[k - 100] : 0.0)) < 1e-9);
    assert_true(std::fabs(wide.cumulative[k] - (within ? own.cumulative[k - 100] : k < 100 ? 0.0 : 1.0)) < 1e-9);
  }
  o.low = 0.0, o.high = 2.0 * last, o.points = 6;  // wide bins: means of narrow ones, whose sum is 1 as theirs is
  const DensityOfStates few = density_of_states(g, w, o);
  double sum = 0.0;
  for (size_t k = 0; k < 6; ++k) {
    sum += few.density[k] * few.step;
    if (k < 3) assert_true(std::fabs(few.cumulative[k] - (k < 2 ? own.cumulative[k == 0 ? 32 : 65] : 1.0)) < 0.02);
  }
  assert_true(std::fabs(sum - 1.0) < 1e-12);
  o.low = o.high = 1.0;
  try {
    density_of_states(g, w, o);
    assert_true(false);
  } catch (const Error &e) {
    assert_int_equal(e.code(), JAM_E_ARGUMENT);
  }
}

// E'' / V of the affine crystal by differences of its energy, each bond with its own rest length.
double strained(const Case &c, const std::vector<double> &f, double volume) {
  const int d = c.packing.dim;
  std::vector<double> r(d), s(d);
  double second = 0.0;
  const double step = 1e-4;
  for (int k = -1; k <= 1; ++k)
    for (size_t q = 0; q < c.network.size(); ++q) {
      const double length = std::sqrt(pair_vector(c.packing, c.network.pairs, q, r.data()));
      double l2 = 0.0;
      for (int x = 0; x < d; ++x) {
        s[x] = r[x];
        for (int y = 0; y < d; ++y) s[x] += k * step * f[x * d + y] * r[y];
        l2 += s[x] * s[x];
      }
      const double over = length + 0.05 - std::sqrt(l2);  // overlap 0.05 unstrained
      second += (k == 0 ? -2.0 : 1.0) * 0.5 * over * over;
    }
  return second / (step * step) / volume;
}

CASE(prestressed_moduli) {
  // Every site of a Bravais lattice is a centre of symmetry: no non-affine part, so differences of the energy give all.
  jam_hessian_options h = default_hessian_options();
  h.prestress = 0.05;
  const int cells = 4;
  Case c = lattice(fcc_basis(), fcc_bonds(), cells);
  const RigidityMatrix g = make_rigidity_matrix(c.packing, c.network);
  Packing box = c.packing;  // the cell of the lattice is no cube; its volume is what counts
  box.set_cube(3, std::cbrt(cells * cells * cells / std::sqrt(2.0)));
  const double volume = std::pow(box.cell.side(), 3);
  const jam_moduli_report m = elastic_moduli(box, g, contact_weights(g, 1.0, h));
  double shear = 0.0;
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b)
      if (a != b) {
        std::vector<double> f(9, 0.0);
        f[3 * a + b] = 1.0;
        shear += strained(c, f, volume) / 6.0;
      }
  assert_true(std::fabs(m.shear / shear - 1.0) < 1e-6 && std::fabs(m.shear_affine / m.shear - 1.0) < 1e-12);
  // K = -V dp/dV by differences of p = sum f r / (d V) under a stretch of all lengths
  auto pressure = [&](double stretch) {
    return 6.0 * 64 * (1.05 - stretch) * stretch / (3.0 * volume * std::pow(stretch, 3));
  };
  const double step = 1e-5, bulk = -(pressure(1 + step) - pressure(1 - step)) / (2 * step) / 3.0;
  assert_true(std::fabs(m.bulk / bulk - 1.0) < 1e-7);
  // The tensor along other gradients than simple shears.
  const ElasticTensor tensor = elastic_tensor(box, g, contact_weights(g, 1.0, h));
  Rng rng(3, Stream::analysis_start);
  for (int trial = 0; trial < 5; ++trial) {
    std::vector<double> f(9);
    for (double &x : f) x = rng.normal();
    double affine = 0.0, relaxed = 0.0;
    for (size_t e = 0; e < 81; ++e) {
      affine += f[e / 9] * f[e % 9] * tensor.affine[e];
      relaxed += f[e / 9] * f[e % 9] * tensor.relaxed[e];
    }
    assert_true(std::fabs(affine / strained(c, f, volume) - 1.0) < 1e-6 && std::fabs(relaxed / affine - 1.0) < 1e-12);
  }
  h.prestress = 0.3;
  jam_status code = JAM_OK;
  try {
    elastic_moduli(box, g, contact_weights(g, 1.0, h));
  } catch (const Error &e) {
    code = e.code();
  }
  assert_int_equal(code, JAM_E_STATE);  // unstable
}

CASE(relaxed_moduli) {
  // The non-affine part against the sum over all modes: E'' = du.B.du - sum (v.F)^2 / lambda, with and without
  // pre-stress.
  Case c = lattice(fcc_basis(), fcc_bonds(), 3);
  Rng rng(9, Stream::analysis_start);
  for (double &x : c.packing.position) x += 0.04 * rng.normal();
  Case moved;
  moved.packing = c.packing;
  for (size_t k = 0; k < c.network.size(); ++k)
    add_contact(moved, c.network.pairs.i[k], c.network.pairs.j[k],
                {c.network.pairs.offset[3 * k], c.network.pairs.offset[3 * k + 1], c.network.pairs.offset[3 * k + 2]},
                0.5 + rng.uniform());
  for (double e : {0.0, 0.03}) {
    jam_hessian_options h = default_hessian_options();
    h.prestress = e;
    const RigidityMatrix g = make_rigidity_matrix(moved.packing, moved.network);
    const ContactWeights w = contact_weights(g, 1.0, h);
    jam_modes_options o = default_modes_options();
    o.which = JAM_MODES_ALL;
    Monitor monitor;
    Modes modes;
    assert_int_equal(find_modes(g, w, o, monitor, modes), JAM_OK);
    const size_t n = g.unknowns();
    double total = 0.0;
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b < 3; ++b) {
        if (a == b) continue;
        std::vector<double> force(n, 0.0);
        for (size_t k = 0; k < g.contacts(); ++k) {
          const double *u = &g.normal[3 * k], t = e > 0.0 ? w.transverse[k] : 0.0, y = g.distance[k] * u[b];
          for (int x = 0; x < 3; ++x) {  // B du with du = y e_a
            const double f = (w.stiffness[k] + t) * u[x] * u[a] * y - (x == a ? t * y : 0.0);
            force[3 * static_cast<size_t>(g.a[k]) + x] += f;
            force[3 * static_cast<size_t>(g.b[k]) + x] -= f;
          }
          total += w.stiffness[k] * y * y * u[a] * u[a] - t * y * y * (1.0 - u[a] * u[a]);
        }
        for (size_t m = 0; m < n; ++m) {
          if (std::fabs(modes.lambda[m]) < 1e-9) continue;
          double dot = 0.0;
          for (size_t q = 0; q < n; ++q) dot += modes.vector[m * n + q] * force[q];
          total -= dot * dot / modes.lambda[m];
        }
      }
    const double volume = std::pow(moved.packing.cell.side(), 3);
    const jam_moduli_report m = elastic_moduli(moved.packing, g, w);
    assert_true(std::fabs(m.shear * 6.0 * volume / total - 1.0) < 1e-9);
    assert_true(m.shear < m.shear_affine && m.shear_min < m.shear_max);
  }
}

CASE(moduli_of_triangular) {
  // Springs k = 1 on a triangular lattice of spacing 1: Lame constants sqrt(3)/4 each, so G = sqrt(3)/4, K = sqrt(3)/2,
  // no non-affine part (every site is a centre of symmetry). The area is not box^2 here: cells^2 sqrt(3)/2.
  const int cells = 8;
  Case c = lattice(triangular_basis(), triangular_bonds(), cells);
  c.packing.set_cube(c.packing.dim, std::sqrt(cells * cells * std::sqrt(0.75)));
  const RigidityMatrix g = make_rigidity_matrix(c.packing, c.network);
  const jam_moduli_report m = elastic_moduli(c.packing, g, contact_weights(g, 1.0, default_hessian_options()));
  assert_true(std::fabs(m.shear - std::sqrt(3.0) / 4.0) < 1e-12);
  assert_true(std::fabs(m.bulk - std::sqrt(3.0) / 2.0) < 1e-12);
  assert_true(std::fabs(m.shear_affine - m.shear) < 1e-12 && std::fabs(m.bulk_affine - m.bulk) < 1e-12);
}

CASE(moduli_of_fcc) {
  // Nearest-neighbour springs on FCC, spacing 1: c11 = 2 c12 = 2 c44 = sqrt(2); K = (c11 + 2 c12) / 3.
  const int cells = 4;
  Case c = lattice(fcc_basis(), fcc_bonds(), cells);
  c.packing.set_cube(c.packing.dim, std::cbrt(cells * cells * cells / std::sqrt(2.0)));
  const RigidityMatrix g = make_rigidity_matrix(c.packing, c.network);
  const jam_moduli_report m = elastic_moduli(c.packing, g, contact_weights(g, 1.0, default_hessian_options()));
  assert_true(std::fabs(m.shear - std::sqrt(0.5)) < 1e-12);  // c44 in the cubic axes
  assert_true(std::fabs(m.bulk - 2.0 * std::sqrt(2.0) / 3.0) < 1e-12);
  assert_true(std::fabs(m.shear_max - m.shear_min) < 1e-12);
  const ElasticTensor tensor = elastic_tensor(c.packing, g, contact_weights(g, 1.0, default_hessian_options()));
  for (size_t i = 0; i < 81; ++i) {
    const size_t index[4] = {i / 27, i / 9 % 3, i / 3 % 3, i % 3};
    const auto same = [&](int x, int y) { return index[x] == index[y]; };
    const bool pairs = (same(0, 1) && same(2, 3)) || (same(0, 2) && same(1, 3)) || (same(0, 3) && same(1, 2));
    const double exact = same(0, 1) && same(1, 2) && same(2, 3) ? std::sqrt(2.0) : pairs ? std::sqrt(0.5) : 0.0;
    assert_true(std::fabs(tensor.affine[i] - exact) < 1e-12 && std::fabs(tensor.relaxed[i] - exact) < 1e-12);
  }
}

}  // namespace
