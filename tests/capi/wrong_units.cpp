// Numbers in the wrong unit: diameters of the box in place of small ones, radii of boxes in place of diameters. Each
// call ends at once, with an error that says why or with a valid state.
#include <jam/jam.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "steps.h"

namespace {

std::vector<double> many_points(size_t n) {
  std::vector<double> x(3 * n);
  uint64_t state = 1;
  for (double &v : x) {
    state = state * 6364136223846793005ull + 1442695040888963407ull;
    v = static_cast<double>(state >> 11) * 0x1.0p-53;
  }
  return x;
}

jam_status create(const std::vector<double> &x, double diameter, int32_t overlap, int32_t model, jam_system **out) {
  DEFAULTS(create, o);
  o.n = static_cast<int64_t>(x.size() / 3), o.overlap = overlap, o.model = model;
  o.shrink_min = 0.0;  // by any factor
  return create_from(&o, x.data(), x.size(), &diameter, 1, out);
}

jam_system *soft_disks(double box, double packing_fraction) {
  DEFAULTS(create, o);
  o.dim = 2, o.n = 40, o.box = box, o.packing_fraction = packing_fraction, o.overlap = JAM_OVERLAP_ALLOW;
  return created(&o);
}

CASE(diameters_of_the_box) {
  const std::vector<double> x = many_points(20000);
  for (const double diameter : {0.3, 0.99}) {
    OWNED jam_system *sys = nullptr;
    SAYS(create(x, diameter, JAM_OVERLAP_REFUSE, JAM_MODEL_EUCLID, &sys), JAM_E_OVERLAP, "spheres");
    // Shrunk until the closest pair touches: as from small diameters.
    OWNED jam_system *small = nullptr;
    assert_int_equal(create(x, diameter, JAM_OVERLAP_SHRINK, JAM_MODEL_EUCLID, &sys), JAM_OK);
    assert_int_equal(create(x, 0.01, JAM_OVERLAP_SHRINK, JAM_MODEL_EUCLID, &small), JAM_OK);
    const double *const a = view_of(sys, JAM_VIEW_DIAMETERS), *const b = view_of(small, JAM_VIEW_DIAMETERS);
    assert_true(std::fabs(a[0] - b[0]) < 1e-12 * b[0]);
  }
}

// Velocities slower by a power of two give the same path bit for bit; what times would not resolve is refused.
CASE(slow_velocities) {
  std::vector<double> ends[2];
  for (int k = 0; k < 2; ++k) {
    constexpr size_t len = 64;
    OWNED jam_system *sys = random_spheres(2, 32, 0.5, 1);
    run(sys, 20.0);
    const double *view = view_of(sys, JAM_VIEW_VELOCITIES);
    std::vector<double> v(view, view + len);
    for (double &c : v) c = std::ldexp(c, -29 * k);
    assert_int_equal(jam_set_velocities(sys, v.data(), len), JAM_OK);
    run(sys, 20.0);
    view = view_of(sys, JAM_VIEW_POSITIONS);
    ends[k].assign(view, view + len);
    v.assign(len, 0.0);
    v[14] = 1e-300;
    SAYS(jam_set_velocities(sys, v.data(), len), JAM_E_ARGUMENT, "from 1e-09");
    v[14] = 0.0;  // all at rest
    assert_int_equal(jam_set_velocities(sys, v.data(), len), JAM_OK);
  }
  assert_memory_equal(ends[0].data(), ends[1].data(), ends[0].size() * sizeof(double));
}

// A cell that deforms at fixed volume has the size of before but for rounding, also at the limits of a box.
CASE(free_cells_of_the_largest_and_smallest_box) {
  for (const double box : {1e30, 1e-30})
    for (int seed = 1; seed < 4; ++seed) {
      DEFAULTS(create, c);
      c.dim = 2, c.n = 12, c.box = box, c.seed = seed, c.packing_fraction = 0.3;
      OWNED jam_system *sys = created(&c);
      DEFAULTS(crunch, o);
      o.strain = JAM_STRAIN_FREE;
      if (jam_crunch(sys, &o, nullptr) < 0) fail_msg("box %g: %s", box, jam_last_error());
      OWNED jam_system *again = from_checkpoint(sys);
      assert_non_null(again);
    }
}

// Random numbers, lists and decisions of Monte Carlo do not depend on the unit of energy.
CASE(energies_in_any_unit) {
  std::vector<double> ends[3];
  double energy[3];
  for (int k = 0; k < 3; ++k) {
    const double unit = std::ldexp(1.0, 300 * (k - 1));
    OWNED jam_system *sys = soft_disks(1.0, 0.9);
    DEFAULTS(monte_carlo, o);
    SIZED(jam_monte_carlo_report, report);
    o.alpha = 2.5, o.energy_scale = 1024.0 * unit, o.temperature = unit, o.sweeps = 50;
    assert_int_equal(jam_monte_carlo(sys, &o, &report), JAM_OK);
    energy[k] = report.energy / unit;
    const double *const x = view_of(sys, JAM_VIEW_POSITIONS);
    ends[k].assign(x, x + 80);
  }
  assert_true(energy[0] == energy[1] && energy[2] == energy[1]);
  assert_true(ends[0] == ends[1] && ends[2] == ends[1]);
}

// The stiffness of soft spheres has a unit, so that no number stands for zero.
CASE(soft_modes_in_any_box) {
  std::vector<double> lambda[3];
  for (int k = 0; k < 3; ++k) {
    const double box = std::ldexp(1.0, 60 * (k - 1));
    OWNED jam_system *sys = soft_disks(box, 1.0);
    assert_int_equal(jam_relax(sys, nullptr, nullptr), JAM_OK);
    DEFAULTS(hessian, h);
    DEFAULTS(modes, o);
    h.stiffness = JAM_STIFFNESS_SOFT, h.prestress = 1.0;
    double table[20];
    size_t rows = 0;
    assert_int_equal(jam_modes(sys, &h, &o, 2, table, 20, nullptr, 0, &rows), JAM_OK);
    for (size_t m = 0; m < rows; ++m) lambda[k].push_back(table[2 * m] * box * box);
  }
  assert_true(lambda[1][0] > 1e-6);  // no translation
  for (const auto &other : lambda)
    for (size_t m = 0; m < lambda[1].size(); ++m) assert_true(std::fabs(other[m] - lambda[1][m]) < 1e-12);
}

CASE(soft_numbers) {
  OWNED jam_system *sys = soft_disks(1.0, 1.0);
  const double turn = 1e-3, loads[] = {0, 1, 0, 0, 1e300, 0, 0, 1e300};
  DEFAULTS(shear, s);
  s.strain = JAM_STRAIN_ALL;
  SAYS(jam_shear(sys, &s, &turn, 1, loads, 8, nullptr), JAM_E_ARGUMENT, "stress");
  const double heavy[] = {0, 1, 0, 0, 1e5, 0, 0, 1e5};  // the cell got narrower than a sphere
  SAYS(jam_shear(sys, &s, &turn, 1, heavy, 8, nullptr), JAM_E_OVERLAP, "shortest period");
  jam_destroy(sys);
  sys = soft_disks(0x1p-98, 1.0);
  DEFAULTS(relax, o);
  o.scale = JAM_SOFT_ABSOLUTE, o.alpha = 6.0;
  SAYS(jam_relax(sys, &o, nullptr), JAM_E_ARGUMENT, "alpha");
}

CASE(sizes_in_any_unit) {
  std::vector<double> sizes[3];
  for (int k = 0; k < 3; ++k) {
    const double unit = std::ldexp(1.0, 100 * (k - 1));
    DEFAULTS(diameters, o);
    o.law = JAM_SIZES_SIEVE, o.n = 20;
    const double curve[] = {unit, 0.0, 2 * unit, 0.5, 3 * unit, 1.0};
    sizes[k].resize(20);
    size_t needed = 0;
    assert_int_equal(jam_diameters(&o, curve, 6, sizes[k].data(), 20, &needed), JAM_OK);
    for (double &s : sizes[k]) s /= unit;
  }
  for (size_t i = 0; i < 20; ++i)
    assert_true(std::fabs(sizes[0][i] - sizes[1][i]) < 1e-13 && std::fabs(sizes[2][i] - sizes[1][i]) < 1e-13);
  DEFAULTS(diameters, o);
  const double curve[] = {1e-200, 0.0, 2e-200, 0.5, 3e-200, 1.0}, wide[] = {1e160, 2e160};
  size_t needed = 0;
  double out[20];
  o.law = JAM_SIZES_SIEVE, o.n = 20;
  SAYS(jam_diameters(&o, curve, 6, out, 20, &needed), JAM_E_ARGUMENT, "curve");
  SIZED(jam_size_report, report);
  SAYS(jam_get_size_report(3, wide, 2, &report), JAM_E_ARGUMENT, "diameter");
}

CASE(fractions_in_any_box) {
  const std::vector<double> unit = many_points(40);
  std::vector<double> expected(40);
  for (const double box : {1.0, 1e-5, 1e-7, 1e-20, 1e20}) {
    std::vector<double> x = unit;
    for (double &v : x) v *= box;
    DEFAULTS(create, o);
    o.n = 40, o.box = box, o.overlap = JAM_OVERLAP_SHRINK;
    const double diameter = 0.1 * box;
    OWNED jam_system *sys = created_from(&o, x.data(), x.size(), &diameter, 1);
    std::vector<double> phi(40);
    size_t needed = 0;
    const jam_status status = jam_local_fraction(sys, phi.data(), phi.size(), &needed);
    if (status == JAM_E_UNSUPPORTED) skip();  // built without voro++
    assert_int_equal(status, JAM_OK);
    if (box == 1.0) expected = phi;
    for (size_t i = 0; i < 40; ++i) assert_true(std::fabs(phi[i] - expected[i]) < 1e-9 * expected[i]);
  }
}

// A device without an end is no checkpoint.
CASE(endless_file) {
  jam_system *sys = nullptr;
  assert_int_equal(jam_read_checkpoint("/dev/zero", nullptr, nullptr, &sys), JAM_E_FORMAT);
  assert_null(sys);
}

}  // namespace
