// Density of states and moduli against lattices whose answers are known.
#include "analysis/modes.hpp"
#include "analysis_networks.hpp"
#include "core/error.hpp"
#include "test.h"

using namespace jam::inside;
using namespace jamtest;

namespace {

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

CASE(unstable_crystals_have_no_moduli) {
  jam_hessian_options h = default_hessian_options();
  h.prestress = 0.3;
  const Case c = lattice(fcc_basis(), fcc_bonds(), 4);
  const RigidityMatrix g = make_rigidity_matrix(c.packing, c.network);
  jam_status code = JAM_OK;
  try {
    elastic_moduli(c.packing, g, contact_weights(g, 1.0, h));
  } catch (const Error &e) {
    code = e.code();
  }
  assert_int_equal(code, JAM_E_STATE);
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
