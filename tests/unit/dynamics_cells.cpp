// Molecular dynamics in cells of any shape: against exact times and the naive engine, against the cube, no overlaps.
#include <algorithm>
#include <cstddef>
#include <cstring>

#include "core/pairs.hpp"
#include "dynamics/event_driven/engine.hpp"
#include "dynamics/event_driven/lattice.hpp"
#include "dynamics/event_driven/options.hpp"
#include "naive_dynamics.hpp"

using namespace jam::inside;
using namespace jamtest;

namespace {

const double h = std::sqrt(0.75);
const std::vector<double> oblique = {1.0, 0.0, 0.45, 0.8}, slender = {0.6, 0.0, -0.25, 2.5},
                          monoclinic = {1.0, 0.0, 0.0, 0.0, 1.2, 0.0, 0.35, 0.0, 0.9},
                          rhombic = {1.0, 0.0, 0.0, 0.5, h, 0.0, 0.5, h / 3.0, std::sqrt(2.0 / 3.0)},
                          slab = {2.0, 0.0, 0.0, 0.7, 1.9, 0.0, 0.2, -0.1, 0.5},
                          four = {1, 0, 0, 0, 0.3, 1.1, 0, 0, -0.4, 0.2, 0.9, 0, 0.1, 0.5, -0.3, 1.2},
                          five = {1,   0,   0,   0, 0, 0.5, 1,   0,    0,    0, 0.5, -0.3, 1,
                                  0.0, 0.0, 0.1, 0, 0, 0.8, 0.0, -0.5, 0.25, 0, 0.1, 1.3};

CASE(lattice_vectors) {
  for (const auto *rows : {&oblique, &slender}) {
    const Cell cell = Cell::from_triangle(2, rows->data());
    const Units<Offsets::listed> units(cell);
    const Lattice<2> lattice(cell, units.scale);
    Rng rng(1, Stream::rsa_positions);
    for (int k = 0; k < 200; ++k) {
      std::array<uint64_t, 2> x;
      std::array<int64_t, 2> r;
      double dx[2], s[2];
      for (int c = 0; c < 2; ++c) {
        dx[c] = 6.0 * rng.uniform() - 3.0;
        r[c] = std::llrint(dx[c] * units.scale), x[c] = static_cast<uint64_t>(r[c]);
        dx[c] *= cell.side();
      }
      std::vector<double> found, expect;
      const auto length = [](double a, double b) { return std::sqrt(a * a + b * b); };
      lattice.images(r, 1.7 * units.scale, [&](const std::array<int64_t, 2> &shift) {
        found.push_back(length(static_cast<double>(r[0] + shift[0]), static_cast<double>(r[1] + shift[1])) *
                        units.unit * cell.side());
      });
      cell.images(dx, 1.7 * cell.side(),
                  [&](const double *shift) { expect.push_back(length(dx[0] + shift[0], dx[1] + shift[1])); });
      std::sort(found.begin(), found.end()), std::sort(expect.begin(), expect.end());
      assert_int_equal(found.size(), expect.size());
      for (size_t e = 0; e < found.size(); ++e) assert_true(std::fabs(found[e] - expect[e]) < 1e-14);
      lattice.wrap(x);
      lattice.fraction(x, s);
      for (int c = 0; c < 2; ++c) {
        assert_true(s[c] > -1e-15 && s[c] <= 1.0);
        dx[c] -= static_cast<double>(static_cast<int64_t>(x[c])) * units.unit * cell.side();
      }
      cell.fraction(dx, s);  // a lattice vector was taken off
      for (double part : s) assert_true(std::fabs(part - std::nearbyint(part)) < 1e-13);
    }
  }
}

// Two disks fly apart along a cell vector and meet each other's images.
CASE(two_disks_meet_through_the_face) {
  Packing p = random_packing(2, 2, 0.05, 1.0, 1, 0.0, JAM_MODEL_EUCLID, oblique.data());
  const double *a = p.cell.row(1), length = std::hypot(a[0], a[1]), sigma = p.diameter[0], start = 0.4;
  for (int c = 0; c < 2; ++c) {
    p.position[c] = 0.1, p.position[2 + c] = 0.1 + start * a[c];
    p.velocity[c] = 0.0, p.velocity[2 + c] = a[c] / p.cell.side();  // the vector in a unit of time
  }
  wrap_positions(p);
  const auto engine = make_engine(p, EngineOptions{});
  assert_true(engine->with_images());
  assert_int_equal(engine->advance(1, begun()), Halt::window);
  assert_true(std::fabs(engine->elapsed() - (1.0 - start - sigma / length)) < 1e-14);
  engine->write_state(p);
  assert_true(std::fabs(p.velocity[3]) < 1e-14 && std::fabs(p.velocity[1] - a[1] / p.cell.side()) < 1e-14);
  // It comes round to the other side of the one at rest.
  assert_int_equal(engine->advance(1, begun()), Halt::window);
  assert_true(std::fabs(engine->elapsed() - (2.0 - start - 3.0 * sigma / length)) < 1e-13);
}

CASE(agrees_with_naive_engine) {
  const struct {
    const std::vector<double> &rows;
    int dim, n, reach;
    double fraction, ratio, growth;
    int collisions;
    double non_additivity;
  } cases[] = {{oblique, 2, 16, 2, 0.3, 1.0, 0.0, 40, 0.0},     {oblique, 2, 12, 2, 0.3, 2.0, 0.02, 40, 0.0},
               {oblique, 2, 2, 2, 0.3, 1.0, 0.01, 12, 0.0},     {slender, 2, 3, 20, 0.25, 1.4, 0.02, 12, 0.0},
               {monoclinic, 3, 24, 1, 0.25, 1.0, 0.0, 60, 0.0}, {monoclinic, 3, 24, 1, 0.25, 1.5, 0.05, 60, 0.0},
               {rhombic, 3, 3, 2, 0.25, 1.0, 0.02, 12, 0.0},    {rhombic, 3, 40, 1, 0.06, 1.4, 0.02, 60, 0.2},
               {slab, 3, 10, 4, 0.25, 1.0, 0.02, 30, 0.0},      {slab, 3, 60, 2, 0.2, 1.0, 0.0, 40, 0.0},
               {four, 4, 10, 1, 0.1, 1.0, 0.01, 25, 0.0},       {five, 5, 6, 1, 0.05, 1.0, 0.01, 10, 0.0}};
  for (const auto &c : cases) {
    Packing p = random_packing(c.dim, c.n, c.fraction, c.ratio, 5, c.non_additivity, JAM_MODEL_EUCLID, c.rows.data()),
            q = p;
    naive(q, c.collisions, c.growth / (diameter_mean(q) / q.cell.side()), c.reach);
    EngineOptions o;
    o.growth = c.growth;
    const auto engine = make_engine(p, o);
    assert_int_equal(engine->advance(c.collisions, begun()), Halt::window);
    engine->write_state(p);
    const double distance = furthest(p, q);
    if (!(distance < 1e-7)) print_error("d=%d n=%d growth=%g: %g\n", c.dim, c.n, c.growth, distance);
    assert_true(distance < 1e-7);
    assert_true(std::fabs(diameter_mean(p) / diameter_mean(q) - 1.0) < 1e-9);
  }
}

// A cell that is a cube but for a tilt of 1e-13: other code, the same collisions, as long as rounding is not amplified.
CASE(a_cube_in_disguise) {
  for (const int n : {12, 400, 3000}) {
    Packing p = random_packing(3, n, 0.3, 1.3, 5), q = p;
    const double rows[9] = {1, 0, 0, 1e-13, 1, 0, 0, 0, 1};
    q.cell = Cell::from_triangle(3, rows);
    EngineOptions o;
    o.growth = 0.01;
    Packing *const state[2] = {&p, &q};
    double time[2];
    for (int k = 0; k < 2; ++k) {
      const auto engine = make_engine(*state[k], o);
      assert_true(k == 0 || engine->with_images());
      assert_int_equal(engine->advance(2 * n, begun()), Halt::window);
      engine->write_state(*state[k]);
      time[k] = engine->elapsed();
    }
    assert_true(std::fabs(time[0] - time[1]) < 1e-9 * time[0]);
    assert_true(furthest(p, q) < 1e-6);
  }
}

// All images of all pairs are looked at when it is over.
CASE(never_overlaps) {
  const struct {
    const std::vector<double> &rows;
    int dim, n;
    double fraction, ratio, growth, pressure;
    int32_t model;
  } cases[] = {{oblique, 2, 200, 0.3, 10.0, 0.1, 1e3, JAM_MODEL_EUCLID},
               {oblique, 2, 2, 0.2, 1.0, 0.1, 1e6, JAM_MODEL_EUCLID},
               {slender, 2, 12, 0.3, 1.4, 0.1, 1e6, JAM_MODEL_EUCLID},
               {monoclinic, 3, 300, 0.2, 3.0, 0.05, 1e4, JAM_MODEL_EUCLID},
               {rhombic, 3, 2, 0.2, 1.0, 0.1, 1e5, JAM_MODEL_EUCLID},
               {slab, 3, 100, 0.2, 1.0, 0.1, 1e4, JAM_MODEL_EUCLID},
               {slab, 3, 40, 0.15, 1.3, 0.1, 1e4, JAM_MODEL_EUCLID},
               {four, 4, 40, 0.1, 1.0, 0.1, 1e4, JAM_MODEL_EUCLID},
               {five, 5, 300, 0.03, 1.0, 0.3, 1e3, JAM_MODEL_EUCLID},
               {monoclinic, 3, 60, 0.5, 1.0, 0.1, 1e3, JAM_MODEL_MK},
               {rhombic, 3, 100, 0.2, 1.0, 20.0, 1e3, JAM_MODEL_EUCLID}};
  for (const auto &c : cases) {
    Packing p = random_packing(c.dim, c.n, c.fraction, c.ratio, 7, 0.0, c.model, c.rows.data());
    jam_md_report report{};
    const jam_status status = run_stage(p, {c.growth, c.pressure, never, 1e4, 300.0}, begun(), report);
    const double gap = closest_pair(p).gap;
    if (status != JAM_OK || !(gap > -1e-14) || !(report.max_overlap < 1e-13))
      print_error("d=%d n=%d: status %d, p %g, gap %g, %g\n", c.dim, c.n, status, report.pressure, gap,
                  report.max_overlap);
    assert_int_equal(status, JAM_OK);
    assert_true(gap > -1e-14);
    assert_true(report.max_overlap < 1e-13);
    assert_true(report.pressure >= c.pressure);
  }
}

// The kernels get offsets as in small cubes.
CASE(instruction_sets_give_the_same_bits) {
  const Packing start = random_packing(3, 500, 0.3, 1.4, 3, 0.0, JAM_MODEL_EUCLID, monoclinic.data());
  Packing first;
  for (InstructionSet set : {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512}) {
    if (!has_instruction_set(set)) continue;
    Packing p = start;
    EngineOptions o;
    o.growth = 0.1;
    o.instruction_set = set;
    const auto engine = make_engine(p, o);
    assert_int_equal(engine->advance(20000, begun()), Halt::window);
    engine->write_state(p);
    if (set == InstructionSet::portable) first = p;
    assert_memory_equal(p.position.data(), first.position.data(), p.position.size() * sizeof(double));
  }
}

CASE(archives_hold_nothing_else) {
  // The body of a disk is a line of the cache, whose last bytes have no meaning.
  const size_t n = 50;
  {
    std::vector<Body<2>> used_before(n);
    volatile char *bytes = reinterpret_cast<char *>(used_before.data());
    for (size_t k = 0; k < n * sizeof(Body<2>); ++k) bytes[k] = 0x55;
  }
  const auto engine = make_engine(random_packing(2, static_cast<int>(n), 0.3, 1.0, 5), EngineOptions{});
  Archive a;
  engine->archive(a);
  const size_t bodies =
      sizeof(MdSums) + sizeof(double) + sizeof(EngineOptions) + 2 * sizeof(uint64_t) + n * sizeof(int32_t);
  Body<2> first;
  std::memcpy(static_cast<void *>(&first), &a.bytes()[bodies], sizeof first);
  assert_true(first.radius > 0 && first.time == 0.0);  // here they are
  const size_t used = offsetof(Body<2>, radius) + sizeof first.radius;
  for (size_t i = 0; i < n; ++i)
    for (size_t at = used; at < sizeof first; ++at) assert_int_equal(a.bytes()[bodies + i * sizeof first + at], 0);
}

}  // namespace
