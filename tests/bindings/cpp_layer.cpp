// jam.hpp: ownership, views, exceptions through C frames. Links the shared library only.
#include <cmath>
#include <csetjmp>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <numeric>
#include <stdexcept>
#include "jam/jam.hpp"
#include "test.h"

namespace {

std::vector<double> two_sizes(int n) {
  std::vector<double> s(static_cast<std::size_t>(n), 1.0);
  for (std::size_t k = 0; k < s.size(); k += 2) s[k] = 1.4;
  return s;
}

template <class E, class F>
bool throws(F &&f) {
  try {
    f();
  } catch (const E &) {
    return true;
  }
  return false;
}

CASE(test_ownership) {
  jam::System a = jam::System::random(50, 2, 7, 0.3);
  const double *where = a.positions().data();
  jam::System b = std::move(a);
  assert_true(b.positions().data() == where);
  assert_true(throws<std::logic_error>([&] { a.info(); }));  // NOLINT: the use after move is the test
  jam::System c = b.copy();
  assert_true(c.positions().data() != where);
  assert_int_equal(c.positions().rows(), 50);
  assert_true(c.positions()(49, 1) == b.positions()(49, 1));
  c = std::move(b);
  assert_true(c.positions().data() == where);
}

CASE(test_cell) {
  const std::vector<double> cell = {2.0, 0.0, 0.5, 1.5};
  const jam::System s = jam::System::from_arrays(2, {0.5, 0.5}, {1.0}, cell);
  const std::vector<double> got = s.cell();
  for (std::size_t k = 0; k < 4; ++k) assert_true(got[k] == cell[k]);
  assert_true(throws<jam::Error>([] { jam::System::from_arrays(2, {0.5, 0.5}, {1.0}, {1.0, 2.0, 3.0}); }));
}

CASE(test_checkpoint) {
  jam::System a = jam::System::random(64, 3, 7);
  a.run(10);
  a.checkpoint("cpp_layer.state");
  jam::System b = jam::System::from_checkpoint("cpp_layer.state");
  std::remove("cpp_layer.state");
  a.run(10);
  b.run(10);
  for (std::size_t k = 0; k < 64; ++k) assert_true(a.positions()(k, 2) == b.positions()(k, 2));
  assert_true(throws<jam::Error>([] { jam::System::from_checkpoint("/does/not/exist"); }));
}

CASE(test_errors) {
  try {
    jam::System::random(50, 9);
    fail_msg("dim 9 was taken");
  } catch (const jam::Error &e) {
    assert_int_equal(e.status(), JAM_E_DIMENSION);
    assert_non_null(strstr(e.what(), "9"));
  }
  assert_true(throws<jam::Error>([] { jam::System::read("/does/not/exist"); }));
  jam_create_options o = jam::create_options();
  o.overlap = JAM_OVERLAP_SHRINK;
  assert_string_equal(jam::System::random(10).notes().c_str(), "");
  const jam::System shrunk(o, {0.1, 0.5, 0.5, 0.4, 0.5, 0.5}, {0.4});
  assert_non_null(strstr(shrunk.notes().c_str(), "warning: all diameters were multiplied by 0.7"));
  assert_true(throws<std::invalid_argument>([] { jam::System bad(nullptr); }));
  assert_true(throws<jam::Error>([] { jam::System::random(10).forces(); }));
}

CASE(test_crunch_and_forces) {
  jam::System s = jam::System::random(60, 2, 3, 0.3, two_sizes(60));
  const jam_crunch_report r = s.crunch();
  assert_int_equal(s.status(), JAM_OK);
  assert_int_equal(r.jammed, 1);
  assert_int_equal(s.last_report().contacts, r.contacts);
  const auto pairs = s.contacts();
  const auto normals = s.contact_vectors();  // d = 2 numbers a contact, as pairs have
  const auto force = s.forces();
  assert_int_equal(pairs.size(), 2 * force.size());
  const auto coordination = s.coordination();
  assert_int_equal(coordination.size(), 60);
  assert_int_equal(std::accumulate(coordination.begin(), coordination.end(), 0), pairs.size());
  assert_int_equal(normals.size(), pairs.size());
  double mean = 0;
  for (double f : force) mean += f / static_cast<double>(force.size());
  assert_true(std::fabs(mean - 1) < 1e-12);
  assert_int_equal(s.array<std::int32_t>(jam_hessian_map).size(), static_cast<std::size_t>(r.stable));
}

CASE(test_cell_check_and_modes) {
  jam::System s = jam::System::random(60, 2, 3, 0.0, two_sizes(60));
  assert_true(s.cell() == (std::vector<double>{1, 0, 0, 1}));
  assert_int_equal(s.check_packing().jammed, JAM_VERDICT_NO);
  s.crunch();
  const jam_check_report sure = s.check_packing();
  assert_int_equal(sure.jammed, JAM_VERDICT_YES);
  assert_non_null(std::strstr(jam_check_text(&sure), "jammed"));
  jam_modes_options o = jam::modes_options();
  o.count = 4;
  const jam::System::Modes found = s.modes(o);
  const std::size_t unknowns = 2 * s.array<std::int32_t>(jam_hessian_map).size();
  assert_int_equal(found.table.size(), 8);
  assert_int_equal(found.vectors.size(), 4 * unknowns);
  jam_create_options dense = jam::create_options();
  dense.n = 60, dense.dim = 2, dense.packing_fraction = 0.95, dense.overlap = JAM_OVERLAP_ALLOW;
  jam::System soft(dense);
  assert_true(soft.relax().pressure > 0.0);  // denser than disks can lie apart
  assert_int_equal(soft.status(), JAM_OK);
  jam::System loose = jam::System::random(20, 2);
  assert_true(throws<jam::Error>([&] { loose.modes(); }));
}

CASE(test_callbacks) {
  jam::System s = jam::System::random(300, 3, 1, 0.3);
  int calls = 0;
  s.on_progress([&](const jam_progress &) -> bool {
    ++calls;
    throw std::domain_error("from the callback");
  });
  assert_true(throws<std::domain_error>([&] { s.crunch(); }));
  assert_int_equal(calls, 1);
  jam::System moved = std::move(s);  // the callbacks move along
  assert_true(throws<std::domain_error>([&] { moved.crunch(); }));
  moved.on_progress([](const jam_progress &) { return true; });
  moved.crunch();
  assert_int_equal(moved.status(), JAM_CANCELLED);
  moved.on_progress(nullptr);
  int lines = 0;
  moved.on_log([&](int, const char *line) { lines += line != nullptr; }, JAM_LOG_DEBUG);
  moved.cancel();
  moved.crunch();
  assert_int_equal(moved.status(), JAM_CANCELLED);
}

}  // namespace
