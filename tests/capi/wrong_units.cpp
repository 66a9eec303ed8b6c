// Numbers in the wrong unit: diameters of the box in place of small ones, radii of boxes in place of diameters. Each
// call ends at once, with an error that says why or with a valid state.
#include <jam/jam.h>

#include <cmath>
#include <cstring>
#include <vector>

#include "start.h"
#include "test.h"

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

CASE(diameters_of_the_box) {
  const std::vector<double> x = many_points(20000);
  for (const double diameter : {0.3, 0.99}) {
    jam_system *sys = nullptr;
    SAYS(create(x, diameter, JAM_OVERLAP_REFUSE, JAM_MODEL_EUCLID, &sys), JAM_E_OVERLAP, "spheres");
    // Shrunk until the closest pair touches: as from small diameters.
    jam_system *small = nullptr;
    assert_int_equal(create(x, diameter, JAM_OVERLAP_SHRINK, JAM_MODEL_EUCLID, &sys), JAM_OK);
    assert_int_equal(create(x, 0.01, JAM_OVERLAP_SHRINK, JAM_MODEL_EUCLID, &small), JAM_OK);
    const double *a = nullptr, *b = nullptr;
    size_t len = 0;
    jam_view(sys, JAM_VIEW_DIAMETERS, &a, &len), jam_view(small, JAM_VIEW_DIAMETERS, &b, &len);
    assert_true(std::fabs(a[0] - b[0]) < 1e-12 * b[0]);
    jam_destroy(sys), jam_destroy(small);
  }
}

CASE(radii_of_boxes) {
  DEFAULTS(create, o);
  o.n = 20000, o.packing_fraction = 0.2;
  jam_system *sys = nullptr;
  assert_int_equal(jam_create(&o, nullptr, &sys), JAM_OK);
  size_t needed = 0;
  SAYS(jam_gaps(sys, 900.0, 0, nullptr, 0, nullptr, 0, &needed), JAM_E_MEMORY, "pairs");
  jam_destroy(sys);
}

// Velocities slower by a power of two give the same path bit for bit; what times would not resolve is refused.
CASE(slow_velocities) {
  std::vector<double> ends[2];
  for (int k = 0; k < 2; ++k) {
    DEFAULTS(create, o);
    DEFAULTS(run, r);
    o.dim = 2, o.n = 32, o.packing_fraction = 0.5;
    jam_system *sys = nullptr;
    assert_int_equal(jam_create(&o, nullptr, &sys), JAM_OK);
    r.collisions_per_particle = 20.0;
    assert_int_equal(jam_run(sys, &r, nullptr), JAM_OK);
    const double *view = nullptr;
    size_t len = 0;
    jam_view(sys, JAM_VIEW_VELOCITIES, &view, &len);
    std::vector<double> v(view, view + len);
    for (double &c : v) c = std::ldexp(c, -29 * k);
    assert_int_equal(jam_set_velocities(sys, v.data(), len), JAM_OK);
    assert_int_equal(jam_run(sys, &r, nullptr), JAM_OK);
    jam_view(sys, JAM_VIEW_POSITIONS, &view, &len);
    ends[k].assign(view, view + len);
    v.assign(len, 0.0);
    v[14] = 1e-300;
    SAYS(jam_set_velocities(sys, v.data(), len), JAM_E_ARGUMENT, "from 1e-09");
    v[14] = 0.0;  // all at rest
    assert_int_equal(jam_set_velocities(sys, v.data(), len), JAM_OK);
    DEFAULTS(isoconf, runs);
    const double instant = 1.0;
    runs.temperature = 1e-40;
    SAYS(jam_isoconf(sys, &runs, nullptr, &instant, 1, nullptr, 0, nullptr), JAM_E_ARGUMENT, "temperature");
    jam_destroy(sys);
  }
  assert_memory_equal(ends[0].data(), ends[1].data(), ends[0].size() * sizeof(double));
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
    jam_system *sys = nullptr;
    assert_int_equal(create_from(&o, x.data(), x.size(), &diameter, 1, &sys), JAM_OK);
    std::vector<double> phi(40);
    size_t needed = 0;
    const jam_status status = jam_local_fraction(sys, phi.data(), phi.size(), &needed);
    jam_destroy(sys);
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
