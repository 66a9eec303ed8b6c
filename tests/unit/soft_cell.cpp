// Soft spheres in a free cell: forces and stresses against differences of the enthalpy, one minimum by every method,
// lattices exactly, unjammed starts, calls that are cut short.
#include <cmath>
#include "test.h"

#include "core/call_scope.hpp"
#include "core/create.hpp"
#include "core/rng.hpp"
#include "soft/decompression.hpp"
#include "unit/random_packing.hpp"

using namespace jam::inside;

namespace {

jam_relax_options options(int32_t minimiser, int32_t strain, double pressure) {
  jam_relax_options o = default_relax_options();
  o.minimiser = minimiser, o.strain = strain, o.pressure = pressure;
  o.max_evaluations = 300000;
  return o;
}

SoftResult relaxed(const Packing &p, const jam_relax_options &o) {
  Monitor monitor;
  monitor.begin();
  return relax(p, o, monitor);
}

// At some finite strain, by central differences of 1e-5, whose error is some 1e-9 of the stiffness.
CASE(forces_are_slopes) {
  const PairEnergy energy(2.5, JAM_SOFT_RELATIVE);
  for (int dim = 2; dim <= 4; ++dim)
    for (const int32_t strain : {3, 4, 5, 7}) {
      SoftState state(random_packing(dim, 30, dim == 2 ? 0.95 : dim == 3 ? 0.8 : 0.6, dim), energy, JAM_SOFT_REFERENCE);
      FreeCell cell = free_cell_of(dim, strain, -1, strain >= JAM_STRAIN_VOLUME ? 0.3 : 0.0);
      if (strain == JAM_STRAIN_FREE || strain == JAM_STRAIN_ALL) {  // with loads of their own for all components
        std::vector<double> stress(static_cast<size_t>(dim) * dim, 0.02);
        for (int c = 0; c < dim; ++c) stress[c * (dim + 1)] = 0.3 + 0.05 * c;
        hold_stress(cell, strain, stress.data());
      }
      state.free_cell(cell);
      Rng rng(4, Stream::velocities);
      const size_t strained = state.spheres() + state.strains();
      for (size_t k = 0; k < strained; ++k)
        state.displacement()[k] = (k < state.spheres() ? 1e-3 : 3e-2) * (rng.uniform() - 0.5) * state.diameter_mean();
      std::vector<double> force, other;
      const SoftSums sums = state.evaluate(force);
      const double h = 1e-5 * state.diameter_mean(), size = sums.force;
      for (const size_t k : {size_t{0}, state.spheres() / 2, state.spheres(), strained - 1}) {
        double side[2];
        for (int s = 0; s < 2; ++s) {
          state.displacement()[k] += s == 0 ? h : -2.0 * h;
          side[s] = state.evaluate(other).enthalpy();
        }
        state.displacement()[k] += h;
        assert_true(std::fabs(force[k] + (side[0] - side[1]) / (2.0 * h)) < 1e-6 * size);
      }
      // Taking the strain into the cell changes neither energy nor enthalpy nor forces on spheres.
      state.rebase();
      const SoftSums after = state.evaluate(other);
      assert_true(std::fabs(after.enthalpy() - sums.enthalpy()) < 1e-13 * (sums.energy + std::fabs(sums.work)));
      for (size_t k = 0; k < state.spheres(); ++k) assert_true(std::fabs(other[k] - force[k]) < 1e-12 * size);
    }
}

// One sphere a cell from a distorted face-centred cubic one, two disks from a distorted rectangle: the close-packed
// lattices, with P = -dU / dV = z h / (2 sigma dV / dr).
CASE(lattices_are_exact) {
  for (int32_t m = JAM_MINIMISER_NEWTON; m <= JAM_MINIMISER_LBFGS; ++m) {
    Packing one;
    const double fcc[] = {1.0, 0.0, 0.0, 0.51, 0.85, 0.0, 0.48, 0.30, 0.83};
    one.dim = 3, one.cell = Cell::from_triangle(3, fcc);
    one.position = {0.1, 0.2, 0.3}, one.velocity.assign(3, 0.0), one.diameter = {1.05};
    const SoftResult a = relaxed(one, options(m, JAM_STRAIN_ALL, 0.1));
    assert_int_equal(a.status, JAM_OK);
    assert_int_equal(a.report.contacts, 6);
    const double r = std::cbrt(a.packing.cell.volume() * std::sqrt(2.0));
    assert_true(std::fabs(6.0 * (1.0 - r / 1.05) / (1.05 * 3.0 * r * r / std::sqrt(2.0)) / 0.1 - 1.0) < 1e-11);
    for (size_t k = 0; k < 6; ++k) assert_true(std::fabs(1.05 * (1.0 + a.contacts.gap[k]) / r - 1.0) < 1e-12);

    Packing two;
    const double rectangle[] = {1.0, 0.0, 0.04, 1.71};
    two.dim = 2, two.cell = Cell::from_triangle(2, rectangle);
    two.position = {0.1, 0.1, 0.61, 0.94}, two.velocity.assign(4, 0.0), two.diameter = {1.05, 1.05};
    const SoftResult b = relaxed(two, options(m, JAM_STRAIN_ALL, 0.1));
    assert_int_equal(b.status, JAM_OK);
    assert_int_equal(b.report.contacts, 6);
    const double s = std::sqrt(b.packing.cell.volume() / std::sqrt(3.0));
    assert_true(std::fabs(6.0 * (1.0 - s / 1.05) / (1.05 * 2.0 * std::sqrt(3.0) * s) / 0.1 - 1.0) < 1e-11);
    for (size_t k = 0; k < 6; ++k) assert_true(std::fabs(1.05 * (1.0 + b.contacts.gap[k]) / s - 1.0) < 1e-12);
  }
}

// Parts of the strain: what may not change does not, and components choose among them.
CASE(parts_of_the_strain) {
  const Packing start = random_packing(3, 40, 0.75, 3);
  jam_relax_options o = options(JAM_MINIMISER_NEWTON, JAM_STRAIN_VOLUME, 0.05);
  assert_true(relaxed(start, o).packing.cell.cube());
  o.strain = JAM_STRAIN_EDGES_VOLUME, o.components = 1 << 4;  // (1, 1): uniaxial
  const Cell uniaxial = relaxed(start, o).packing.cell;
  assert_true(std::fabs(uniaxial.edge(0) - 1.0) < 1e-14 && std::fabs(uniaxial.edge(2) - 1.0) < 1e-14);
  assert_true(std::fabs(uniaxial.edge(1) - 1.0) > 1e-3 && uniaxial.row(1)[0] == 0.0);
  o = options(JAM_MINIMISER_NEWTON, JAM_STRAIN_TILTS, 0.0), o.components = 1 << 2;  // (0, 2): x along z
  const Cell sheared = relaxed(start, o).packing.cell;
  assert_true(sheared.row(2)[0] != 0.0 && sheared.row(1)[0] == 0.0 && sheared.row(2)[1] == 0.0);
  assert_true(std::fabs(sheared.volume() - 1.0) < 1e-13);
}

// Unjammed starts are told; a pressure compresses them.
CASE(statuses) {
  for (int32_t m = JAM_MINIMISER_NEWTON; m <= JAM_MINIMISER_LBFGS; ++m) {
    const Packing start = random_packing(3, 60, 0.4, 5);
    const SoftResult end = relaxed(start, options(m, JAM_STRAIN_FREE, 0.0));
    assert_int_equal(end.status, JAM_NOT_JAMMED);
    assert_int_equal(end.report.stop_reason, JAM_STOP_UNJAMMED);
    assert_true(end.report.energy == 0.0 && end.report.stress_residual == 0.0);
    const SoftResult pressed = relaxed(start, options(m, JAM_STRAIN_ALL, 0.01));
    assert_int_equal(pressed.status, JAM_OK);
    assert_true(std::fabs(pressed.report.pressure / 0.01 - 1.0) < 1e-11 && pressed.report.packing_fraction > 0.55);
  }
}

// Starts far below and far above a pressure: a gas, overlapping points, and minima at other pressures. Minimised at the
// pressure at once, the starts above it use up max_evaluations.
CASE(pressures_far_from_the_start) {
  for (const int32_t m : {JAM_MINIMISER_NEWTON, JAM_MINIMISER_LBFGS})
    for (const double alpha : {2.0, 2.5})
      for (const double fraction : {0.05, 0.9}) {
        jam_relax_options o = options(m, JAM_STRAIN_ALL, 1e-2);
        o.alpha = alpha;
        const Packing start = random_packing(2, 60, fraction, 9);
        const SoftResult hard = relaxed(start, o);
        o.pressure = 1e-7;
        for (const Packing *p : {&start, &hard.packing}) {
          const SoftResult a = relaxed(*p, o);
          assert_int_equal(a.status, JAM_OK);
          assert_true(std::fabs(a.report.pressure / 1e-7 - 1.0) < 1e-11 && a.report.excess_contacts >= 0);
          o.pressure = 1e-2;  // and back
          const SoftResult b = relaxed(a.packing, o);
          assert_int_equal(b.status, JAM_OK);
          assert_true(std::fabs(b.report.pressure / 1e-2 - 1.0) < 1e-11);
          o.pressure = 1e-7;
        }
      }
  jam_relax_options o = options(JAM_MINIMISER_NEWTON, JAM_STRAIN_EDGES_VOLUME, 1e-4);
  o.components = 1 << 3;  // (1, 1): one edge alone is free
  const Cell piston = relaxed(random_packing(2, 60, 0.3, 9), o).packing.cell;
  assert_true(std::fabs(piston.edge(0) - 1.0) < 1e-14 && piston.edge(1) < 0.5);
  o.strain = JAM_STRAIN_ALL, o.components = 1 << 1;  // (0, 1): a tilt alone, on which no pressure works
  assert_int_equal(relaxed(random_packing(2, 60, 0.3, 9), o).status, JAM_NOT_JAMMED);
}

// Cut short anywhere, before and after the cell is free, the state is valid and a second call ends as one would.
CASE(cut_short) {
  const Packing start = random_packing(2, 60, 0.95, 7);
  for (int32_t m = JAM_MINIMISER_NEWTON; m <= JAM_MINIMISER_LBFGS; ++m) {
    jam_relax_options o = options(m, JAM_STRAIN_ALL, 0.02);
    const SoftResult whole = relaxed(start, o);
    assert_int_equal(whole.status, JAM_OK);
    int freed = 0;
    for (int part = 1; part < 8; ++part) {
      o.max_evaluations = whole.report.evaluations * part / 8;
      const SoftResult cut = relaxed(start, o);
      assert_int_equal(cut.status, JAM_LIMIT);
      assert_int_equal(cut.report.stop_reason, JAM_STOP_EVALUATIONS);
      assert_true(cut.report.converged == 0 && cut.packing.cell.volume() > 0.5);
      for (const double x : cut.packing.position) assert_true(std::isfinite(x) && x >= 0.0);
      freed += !cut.packing.cell.cube();
      o.max_evaluations = 300000;
      const SoftResult end = relaxed(cut.packing, o);
      assert_int_equal(end.status, JAM_OK);
      assert_true(std::fabs(end.report.pressure / 0.02 - 1.0) < 1e-11);
    }
    assert_true(freed > 0);
  }
  jam_relax_options o = options(JAM_MINIMISER_FIRE, JAM_STRAIN_ALL, 0.02);
  o.wall_time = 1e-9;
  const SoftResult at_once = relaxed(start, o);
  assert_true(at_once.status == JAM_LIMIT && at_once.report.stop_reason == JAM_STOP_WALL_TIME);
  Monitor monitor;
  monitor.begin();
  monitor.cancel();
  assert_int_equal(relax(start, options(0, JAM_STRAIN_ALL, 0.02), monitor).status, JAM_CANCELLED);
}

// Walls hold one edge, and a steep energy bears no pressure: the cell collapses. A descent ends before the period falls
// to a thousandth of a diameter, where each sphere would have thousands of own images in reach.
CASE(a_cell_that_collapses) {
  jam_create_options slab = default_create_options();
  slab.dim = 2, slab.n = 8, slab.seed = 1, slab.packing_fraction = 0.05, slab.walls = 1;
  slab.overlap = JAM_OVERLAP_ALLOW;
  const Packing p = make_packing(slab, nullptr, 0, nullptr, 0, nullptr);
  for (int32_t m = JAM_MINIMISER_NEWTON; m <= JAM_MINIMISER_LBFGS; ++m) {
    jam_relax_options o = options(m, JAM_STRAIN_EDGES_VOLUME, 0.1);
    o.alpha = 8.0, o.scale = JAM_SOFT_ABSOLUTE;
    const SoftResult end = relaxed(p, o);
    assert_int_equal(end.status, JAM_NOT_CONVERGED);
    assert_true(end.packing.cell.shortest() > 1e-3 * p.diameter[0]);
  }
}

// Cancelled as the cell is freed or fixed, in the search for pairs, the state is what it was before.
CASE(cancelled_in_a_search) {
  const FreeCell free = free_cell_of(2, JAM_STRAIN_ALL, -1, 0.1), fixed;
  SoftState state(random_packing(2, 20, 0.9, 7), PairEnergy(2.0, JAM_SOFT_RELATIVE), JAM_SOFT_REFERENCE);
  Monitor monitor;
  monitor.begin();
  monitor.cancel();
  const CallScope scope(1e12, &monitor);
  for (const FreeCell *cell : {&free, &fixed}) {
    std::vector<double> before, after;
    const double energy = state.evaluate(before).energy;
    bool thrown = false;
    try {
      const CancellableScope leaves;
      state.free_cell(*cell);
    } catch (const Cancelled &) {
      thrown = true;
    }
    assert_true(thrown && state.evaluate(after).energy == energy && before == after);
    assert_true(state.displacement().size() == before.size());
    state.free_cell(*cell);
  }
}

}  // namespace
