// Density of states and moduli against lattices whose answers are known.
#include "analysis/spectrum.hpp"
#include "analysis_networks.hpp"
// Last: cmocka defines a macro `fail`.
extern "C" {
#include <stdarg.h>
#include <stddef.h>
#include <setjmp.h>
#include <stdint.h>
#include <cmocka.h>
}

using namespace jam;
using namespace jamtest;

namespace {

void density_of_fcc(void **) {
  const Case c = lattice(fcc_basis(), fcc_bonds(), 10);
  const StableGraph g = make_graph(c.packing, c.network);
  jam_dos_options o = default_dos_options();
  o.points = 512;
  o.moments = 128;
  o.vectors = 32;
  Monitor monitor;
  DensityOfStates dos;
  assert_int_equal(density_of_states(g, make_hessian(g, contact_weights(g, 1.0, default_hessian_options())), o, monitor, dos), JAM_OK);
  const std::vector<double> exact = bloch_spectrum(fcc_basis(), fcc_bonds(), 10);
  // Two integrals that smoothing and degenerate levels hardly touch, and the cumulative spectrum.
  double sum = 0.0, second = 0.0, worst = 0.0, trace = 0.0;
  const double step = dos.omega[1] - dos.omega[0], modes = static_cast<double>(exact.size()) - 3.0;
  for (double l : exact) trace += l / modes;
  for (size_t k = 0; k < dos.omega.size(); ++k) {
    sum += dos.density[k] * step;
    second += dos.density[k] * dos.omega[k] * dos.omega[k] * step;
    const double edge = dos.omega[k] + 0.5 * step;
    const auto below = static_cast<double>(std::upper_bound(exact.begin(), exact.end(), edge * edge) - exact.begin()) - 3.0;
    worst = std::max(worst, std::fabs(sum - below / modes));
    assert_true(dos.density[k] > -1e-9 && dos.error[k] >= 0.0);
  }
  assert_true(std::fabs(sum - 1.0) < 1e-3);
  assert_true(std::fabs(second / trace - 1.0) < 0.01);
  assert_true(worst < 0.06);
}

void moduli_of_triangular(void **) {
  // Springs k = 1 on a triangular lattice of spacing 1: Lame constants sqrt(3)/4 each, so G = sqrt(3)/4, K = sqrt(3)/2, no
  // non-affine part (every site is a centre of symmetry). The area is not box^2 here: cells^2 sqrt(3)/2.
  const int cells = 8;
  Case c = lattice(triangular_basis(), triangular_bonds(), cells);
  c.packing.box = std::sqrt(cells * cells * std::sqrt(0.75));
  const StableGraph g = make_graph(c.packing, c.network);
  const jam_moduli m = elastic_moduli(c.packing, g, contact_weights(g, 1.0, default_hessian_options()));
  assert_true(std::fabs(m.shear - std::sqrt(3.0) / 4.0) < 1e-12);
  assert_true(std::fabs(m.bulk - std::sqrt(3.0) / 2.0) < 1e-12);
  assert_true(std::fabs(m.shear_affine - m.shear) < 1e-12 && std::fabs(m.bulk_affine - m.bulk) < 1e-12);
}

void moduli_of_fcc(void **) {
  // Nearest-neighbour springs on FCC, spacing 1: c11 = 2 c12 = 2 c44 = sqrt(2); K = (c11 + 2 c12) / 3.
  const int cells = 4;
  Case c = lattice(fcc_basis(), fcc_bonds(), cells);
  c.packing.box = std::cbrt(cells * cells * cells / std::sqrt(2.0));
  const StableGraph g = make_graph(c.packing, c.network);
  const jam_moduli m = elastic_moduli(c.packing, g, contact_weights(g, 1.0, default_hessian_options()));
  assert_true(std::fabs(m.shear - std::sqrt(0.5)) < 1e-12);  // c44 in the cubic axes
  assert_true(std::fabs(m.bulk - 2.0 * std::sqrt(2.0) / 3.0) < 1e-12);
  assert_true(std::fabs(m.shear_max - m.shear_min) < 1e-12);
}

}  // namespace

int main() {
  const struct CMUnitTest tests[] = {cmocka_unit_test(density_of_fcc), cmocka_unit_test(moduli_of_triangular), cmocka_unit_test(moduli_of_fcc)};
  return cmocka_run_group_tests_name("analysis_spectrum", tests, nullptr, nullptr);
}
