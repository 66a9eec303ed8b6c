// Hessians and modes against lattices whose spectra are known in closed form (Bloch), finite differences, and
// identities.
#include "analysis/modes.hpp"
#include "analysis_networks.hpp"
#include "core/rng.hpp"
#include "test.h"

using namespace jam::inside;
using namespace jamtest;

namespace {

struct Solved {
  RigidityMatrix g;
  ContactWeights w;
  Modes modes;
  jam_status status;
};

Solved solve(const Case &c, int32_t which, int64_t count, double frequency = 0.0, double prestress = 0.0) {
  jam_hessian_options h = default_hessian_options();
  h.prestress = prestress;
  jam_modes_options o = default_modes_options();
  o.which = which;
  o.count = count;
  o.frequency = frequency;
  Solved s;
  s.g = make_rigidity_matrix(c.packing, c.network);
  s.w = contact_weights(s.g, 1.0, h);
  Monitor monitor;
  monitor.begin();
  s.status = find_modes(s.g, s.w, o, monitor, s.modes);
  return s;
}

double worst(const std::vector<double> &x, const std::vector<double> &y) {
  double w = x.size() == y.size() ? 0.0 : 1e300;
  for (size_t k = 0; k < std::min(x.size(), y.size()); ++k) w = std::max(w, std::fabs(x[k] - y[k]));
  return w;
}

// Largest |H v - lambda v| and departure from orthonormality.
double mode_error(const Solved &s) {
  const BlockMatrix h = make_hessian(s.g, s.w);
  const size_t n = s.g.unknowns(), m = s.modes.lambda.size();
  std::vector<double> y(n);
  double w = 0.0;
  for (size_t k = 0; k < m; ++k) {
    h.multiply(&s.modes.vector[k * n], y.data());
    for (size_t q = 0; q < n; ++q) w = std::max(w, std::fabs(y[q] - s.modes.lambda[k] * s.modes.vector[k * n + q]));
    for (size_t l = 0; l <= k; ++l) {
      double dot = 0.0;
      for (size_t q = 0; q < n; ++q) dot += s.modes.vector[k * n + q] * s.modes.vector[l * n + q];
      w = std::max(w, std::fabs(dot - (k == l ? 1.0 : 0.0)));
    }
  }
  return w;
}

CASE(more_than_one_panel) {
  // 648 rows: several panels of the reduction, two of the back transformation.
  const Solved s = solve(lattice(triangular_basis(), triangular_bonds(), 18), JAM_MODES_ALL, 1);
  assert_true(worst(s.modes.lambda, bloch_spectrum(triangular_basis(), triangular_bonds(), 18)) < 1e-10);
  assert_true(mode_error(s) < 1e-10);
}

CASE(prestressed_fcc_has_the_bloch_spectrum) {
  const Solved s = solve(lattice(fcc_basis(), fcc_bonds(), 4), JAM_MODES_ALL, 1, 0.0, 0.03);
  assert_true(worst(s.modes.lambda, bloch_spectrum(fcc_basis(), fcc_bonds(), 4, 0.03)) < 1e-10);
}

CASE(unstable_modes_come_first) {
  // Enough pre-stress makes the crystal buckle: negative eigenvalues, found by a shift that is large enough.
  const double t = 0.3;
  const Solved s = solve(lattice(fcc_basis(), fcc_bonds(), 6), JAM_MODES_LOWEST, 12, 0.0, t);
  std::vector<double> all = bloch_spectrum(fcc_basis(), fcc_bonds(), 6, t);
  for (int k = 0; k < 3; ++k)  // the translations are left out
    all.erase(std::min_element(all.begin(), all.end(), [](double x, double y) { return std::fabs(x) < std::fabs(y); }));
  assert_true(all[0] < -0.01);
  assert_true(worst(s.modes.lambda, {all.begin(), all.begin() + 12}) < 1e-9);
}

CASE(hard_sphere_weights) {
  // k = f^2: with all forces twice as large in one direction of bonds the Bloch matrix has that bond four times.
  Case c = lattice(triangular_basis(), triangular_bonds(), 6);
  for (size_t k = 0; k < c.network.size(); ++k) c.network.force[k] = k % 3 == 0 ? 2.0 : 1.0;  // bonds are laid in turn
  jam_hessian_options h = default_hessian_options();
  h.stiffness = JAM_STIFFNESS_HARD;
  const RigidityMatrix g = make_rigidity_matrix(c.packing, c.network);
  const ContactWeights w = contact_weights(g, 1.0, h);
  jam_modes_options o = default_modes_options();
  o.which = JAM_MODES_ALL;
  Monitor monitor;
  Modes modes;
  assert_int_equal(find_modes(g, w, o, monitor, modes), JAM_OK);
  const std::vector<std::vector<int>> bonds = {{1, 0}, {1, 0}, {1, 0}, {1, 0}, {0, 1}, {-1, 1}};
  assert_true(worst(modes.lambda, bloch_spectrum(triangular_basis(), bonds, 6)) < 1e-10);
}

CASE(square_has_floppy_lines) {
  // The square lattice shears row by row: every row and every column slides at no cost, 2 L zero modes.
  const Solved s = solve(lattice(square_basis(), square_bonds(), 7), JAM_MODES_ALL, 1);
  int zeros = 0;
  for (double l : s.modes.lambda) zeros += std::fabs(l) < 1e-10;
  assert_int_equal(zeros, 14);
  const Solved low = solve(lattice(square_basis(), square_bonds(), 7), JAM_MODES_LOWEST, 14);
  zeros = 0;
  for (double l : low.modes.lambda) zeros += std::fabs(l) < 1e-10;
  assert_int_equal(zeros, 12);  // both translations are left out
  assert_true(mode_error(low) < 1e-9);
}

// Degenerate spectra: every copy must be found although a Krylov space holds one vector of each eigenspace.
void few_of(const Vectors &basis, const std::vector<std::vector<int>> &bonds, int cells, int64_t count) {
  const Case c = lattice(basis, bonds, cells);
  std::vector<double> all = bloch_spectrum(basis, bonds, cells);
  const auto d = static_cast<std::ptrdiff_t>(basis.size());
  const Solved low = solve(c, JAM_MODES_LOWEST, count);
  assert_int_equal(low.status, JAM_OK);
  assert_true(worst(low.modes.lambda, {all.begin() + d, all.begin() + d + count}) < 1e-10);
  assert_true(mode_error(low) < 1e-7);
  const Solved high = solve(c, JAM_MODES_HIGHEST, count);
  assert_true(worst(high.modes.lambda, {all.end() - count, all.end()}) < 1e-10);
  const double target = 1.2345;
  const Solved near = solve(c, JAM_MODES_NEAR, count, std::sqrt(target));
  all.erase(all.begin(), all.begin() + d);
  std::sort(all.begin(), all.end(), [&](double x, double y) { return std::fabs(x - target) < std::fabs(y - target); });
  all.resize(static_cast<size_t>(count));
  std::vector<double> found;
  for (double l : near.modes.lambda) found.push_back(std::fabs(l - target));
  for (double &l : all) l = std::fabs(l - target);
  std::sort(found.begin(), found.end());
  assert_true(worst(found, all) < 1e-10);
}

// Modes nearest to a frequency that is one of a mode, that its neighbours with others share, or that makes a pivot
// vanish.
CASE(modes_near_the_frequency_of_a_mode) {
  Case c = lattice(triangular_basis(), triangular_bonds(), 16);
  const double pivot = std::sqrt(make_hessian(solve(c, JAM_MODES_ALL, 1).g, solve(c, JAM_MODES_ALL, 1).w).diag[0]);
  Rng rng(3, Stream::analysis_start);
  for (const double disorder : {0.0, 0.4}) {
    for (double &k : c.packing.position) k += 0.05 * disorder * rng.normal();
    const std::vector<double> all = solve(c, JAM_MODES_ALL, 1).modes.lambda;
    for (const double frequency :
         {pivot, std::sqrt(all[5]), std::sqrt(all[100]), std::sqrt(all[300]), std::sqrt(all[511])}) {
      const double target = frequency * frequency;
      const Solved near = solve(c, JAM_MODES_NEAR, 5, frequency);
      assert_int_equal(near.status, JAM_OK);
      assert_true(mode_error(near) < 1e-7);
      std::vector<double> found, best;
      for (const double l : near.modes.lambda) found.push_back(std::fabs(l - target));
      for (size_t k = 2; k < all.size(); ++k) best.push_back(std::fabs(all[k] - target));
      std::sort(found.begin(), found.end()), std::sort(best.begin(), best.end());
      best.resize(5);
      assert_true(worst(found, best) < 1e-8);
    }
  }
}

CASE(few_modes_of_the_triangular_lattice) { few_of(triangular_basis(), triangular_bonds(), 16, 20); }
CASE(few_modes_of_fcc) { few_of(fcc_basis(), fcc_bonds(), 6, 15); }

// Energy whose Hessian is meant: every contact has its own rest length, so that its overlap is e f^(1/(alpha-1)).
double energy(const Case &c, const std::vector<double> &x, const std::vector<double> &rest, double alpha, double e) {
  Packing p = c.packing;
  p.position = x;
  double sum = 0.0;
  std::vector<double> r(p.dim);
  for (size_t k = 0; k < c.network.size(); ++k) {
    const double over = rest[k] - std::sqrt(pair_vector(p, c.network.pairs, k, r.data()));
    sum += std::pow(over, alpha) / (alpha * (alpha - 1.0) * std::pow(e, alpha - 2.0));
  }
  return sum;
}

CASE(finite_differences) {
  Case c = lattice(fcc_basis(), fcc_bonds(), 2);
  Rng rng(7, Stream::analysis_start);
  for (double &x : c.packing.position) x += 0.05 * rng.normal();
  for (double &f : c.network.force) f = 0.5 + rng.uniform();
  for (double alpha : {1.5, 2.0, 2.5}) {
    const double e = 0.1;
    jam_hessian_options o = default_hessian_options();
    o.stiffness = JAM_STIFFNESS_POWER;
    o.alpha = alpha;
    o.prestress = e;
    const RigidityMatrix g = make_rigidity_matrix(c.packing, c.network);
    const CsrMatrix csr = to_csr(make_hessian(g, contact_weights(g, 1.0, o)));
    std::vector<double> rest(g.contacts());
    for (size_t k = 0; k < rest.size(); ++k) rest[k] = g.distance[k] + e * std::pow(g.force[k], 1.0 / (alpha - 1.0));
    const double step = 1e-3;
    for (size_t row = 0; row < 6; ++row)
      for (int32_t q = csr.start[row]; q < csr.start[row + 1]; ++q) {
        double second = 0.0;
        for (int sr : {-1, 1})
          for (int sc : {-1, 1}) {
            std::vector<double> x = c.packing.position;
            x[row] += sr * step;
            x[csr.column[q]] += sc * step;
            second += sr * sc * energy(c, x, rest, alpha, e);
          }
        assert_true(std::fabs(second / (4.0 * step * step) - csr.value[q]) < 2e-3);
      }
  }
}

CASE(spectra_of_both_products) {
  // S S^T and S^T S have the same eigenvalues but for zeros.
  Case c = lattice(triangular_basis(), triangular_bonds(), 4);
  Rng rng(5, Stream::analysis_start);
  for (double &x : c.packing.position) x += 0.1 * rng.normal();
  const RigidityMatrix g = make_rigidity_matrix(c.packing, c.network);
  const int m = static_cast<int>(g.contacts());
  std::vector<double> a(static_cast<size_t>(m) * m), unit(m, 0.0), force(g.unknowns());
  for (int k = 0; k < m; ++k) {
    unit[k] = 1.0;
    apply_equilibrium(g, unit.data(), force.data());
    apply_compatibility(g, force.data(), &a[static_cast<size_t>(k) * m]);
    unit[k] = 0.0;
  }
  const Solved s = solve(c, JAM_MODES_ALL, 1);
  const std::vector<double> &small = s.modes.lambda;
  const auto no_stop = [](double) { return false; };
  const std::function<bool(int, std::vector<double> &, std::vector<double> &)> solvers[] = {
      [&](int n, auto &v, auto &lambda) { return dense_eigen(n, v, lambda, no_stop); },
      [&](int n, auto &v, auto &lambda) { return dense_eigen_builtin(n, v, lambda, true, no_stop); },
      [&](int n, auto &v, auto &lambda) { return dense_eigen_builtin(n, v, lambda, false, no_stop); }};
  for (int which = 0; which < 3; ++which) {
    std::vector<double> v = a, big;
    assert_true(solvers[which](m, v, big));
    const size_t extra = big.size() - small.size();
    for (size_t k = 0; k < extra; ++k) assert_true(std::fabs(big[k]) < 1e-12);
    assert_true(worst({big.begin() + static_cast<std::ptrdiff_t>(extra), big.end()}, small) < 1e-12);
    for (int k = 0; which < 2 && k < m; ++k)  // A v = lambda v
      for (int i = 0; i < m; ++i) {
        double rest = -big[k] * v[static_cast<size_t>(k) * m + i];
        for (int j = 0; j < m; ++j) rest += a[static_cast<size_t>(j) * m + i] * v[static_cast<size_t>(k) * m + j];
        assert_true(std::fabs(rest) < 1e-12);
      }
  }
}

CASE(two_images_and_self_contact) {
  // Two spheres in a box of side 2 on a line of contacts through both images, and one touching its own image.
  Case c;
  c.packing.set_cube(2, 2.0);
  c.packing.diameter = {1.0, 1.0};
  c.packing.position = {0.5, 0.5, 1.5, 0.5};
  add_contact(c, 0, 1, {0.0, 0.0});
  add_contact(c, 0, 1, {2.0, 0.0});
  add_contact(c, 0, 0, {0.0, 1.0});
  const Solved s = solve(c, JAM_MODES_ALL, 1);
  assert_true(worst(s.modes.lambda, {0.0, 0.0, 0.0, 4.0}) <
              1e-14);  // both springs act on the relative coordinate: 2 k / (m/2)
}

int32_t stop_at_once(const jam_progress *, void *) { return 1; }
CASE(modes_can_be_cancelled) {
  const Case c = lattice(triangular_basis(), triangular_bonds(), 16);
  const RigidityMatrix g = make_rigidity_matrix(c.packing, c.network);
  for (int32_t which : {JAM_MODES_LOWEST, JAM_MODES_ALL}) {
    jam_modes_options o = default_modes_options();
    o.which = which;
    Monitor monitor;
    monitor.progress = stop_at_once;
    monitor.begin();
    Modes modes;
    assert_int_equal(find_modes(g, contact_weights(g, 1.0, default_hessian_options()), o, monitor, modes),
                     JAM_CANCELLED);
    assert_int_equal(modes.vector.size(), 0);
  }
}

}  // namespace
