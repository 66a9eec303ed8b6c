// The engine against a naive one (all pairs, all images, long double) in cells of any shape, and its invariants on
// awkward systems.
#include <cstddef>
#include <cstring>

#include "dynamics/event_driven/engine.hpp"
#include "dynamics/event_driven/kernel/pair_kernel.hpp"
#include "dynamics/event_driven/run.hpp"
#include "naive_dynamics.hpp"

using namespace jam::inside;
using namespace jamtest;

namespace {

const double h = std::sqrt(0.75);
const std::vector<double> cube,
    oblique = {1.0, 0.0, 0.45, 0.8}, slender = {0.6, 0.0, -0.25, 2.5},
    monoclinic = {1.0, 0.0, 0.0, 0.0, 1.2, 0.0, 0.35, 0.0, 0.9},
    rhombic = {1.0, 0.0, 0.0, 0.5, h, 0.0, 0.5, h / 3.0, std::sqrt(2.0 / 3.0)},
    slab = {2.0, 0.0, 0.0, 0.7, 1.9, 0.0, 0.2, -0.1, 0.5},
    four = {1, 0, 0, 0, 0.3, 1.1, 0, 0, -0.4, 0.2, 0.9, 0, 0.1, 0.5, -0.3, 1.2},
    five = {1, 0, 0, 0, 0, 0.5, 1, 0, 0, 0, 0.5, -0.3, 1, 0.0, 0.0, 0.1, 0, 0, 0.8, 0.0, -0.5, 0.25, 0, 0.1, 1.3};

// Small boxes (several images of one pair) among them. From 40 spheres in three dimensions on cells alone hold in a
// cube, whether they are the choice at that density or not.
CASE(agrees_with_naive_engine) {
  const struct {
    const std::vector<double> &rows;
    int dim, n, reach;
    double fraction, ratio, growth;
    int collisions;
    double non_additivity = 0.0;
  } cases[] = {{cube, 3, 40, 1, 0.04, 1.0, 0.0, 60},       {cube, 3, 40, 1, 0.06, 1.5, 0.05, 60},
               {cube, 2, 40, 1, 0.1, 2.0, 0.02, 60},       {cube, 4, 40, 1, 0.004, 1.0, 0.01, 20},
               {cube, 3, 24, 1, 0.25, 1.0, 0.0, 60},       {cube, 3, 24, 1, 0.25, 1.0, 0.05, 60},
               {cube, 2, 16, 1, 0.35, 3.0, 0.02, 40},      {cube, 3, 2, 1, 0.3, 1.0, 0.0, 10},
               {cube, 2, 2, 1, 0.4, 1.0, 0.01, 10},        {cube, 3, 3, 1, 0.3, 1.5, 0.02, 12},
               {cube, 4, 10, 1, 0.12, 1.0, 0.0, 25},       {cube, 5, 6, 1, 0.05, 1.0, 0.01, 10},
               {cube, 3, 24, 1, 0.2, 1.4, 0.02, 60, 0.2},  {cube, 2, 12, 1, 0.35, 1.4, 0.0, 40, -0.2},
               {cube, 2, 2, 1, 0.3, 1.4, 0.02, 10, 0.1},   {cube, 3, 40, 1, 0.03, 1.4, 0.02, 60, 0.3},
               {oblique, 2, 16, 2, 0.3, 1.0, 0.0, 40},     {oblique, 2, 12, 2, 0.3, 2.0, 0.02, 40},
               {oblique, 2, 2, 2, 0.3, 1.0, 0.01, 12},     {slender, 2, 3, 20, 0.25, 1.4, 0.02, 12},
               {monoclinic, 3, 24, 1, 0.25, 1.0, 0.0, 60}, {monoclinic, 3, 24, 1, 0.25, 1.5, 0.05, 60},
               {rhombic, 3, 3, 2, 0.25, 1.0, 0.02, 12},    {rhombic, 3, 40, 1, 0.06, 1.4, 0.02, 60, 0.2},
               {slab, 3, 10, 4, 0.25, 1.0, 0.02, 30},      {slab, 3, 60, 2, 0.2, 1.0, 0.0, 40},
               {four, 4, 10, 1, 0.1, 1.0, 0.01, 25},       {five, 5, 6, 1, 0.05, 1.0, 0.01, 10}};
  for (const auto &c : cases) {
    const Packing start = random_packing(c.dim, c.n, c.fraction, c.ratio, 5, c.non_additivity, JAM_MODEL_EUCLID,
                                         c.rows.empty() ? nullptr : c.rows.data());
    Packing expected = start;
    naive(expected, c.collisions, c.growth / (diameter_mean(start) / start.cell.side()), c.reach);
    for (const int64_t cells : {-1, 1}) {
      Packing p = start;
      EngineOptions o;
      o.growth = c.growth;
      o.cells = c.rows.empty() ? cells : 0;
      const auto engine = agrees(p, expected, o, c.collisions, 1e-7);
      if (c.rows.empty()) assert_true(engine->cells_alone() == (cells == 1 && c.n == 40));
    }
  }
}

// Dilute systems are on cells, dense ones on lists, and a compression goes over from one to the other.
CASE(engine_follows_the_density) {
  EngineOptions growing;
  growing.growth = 0.1;
  auto engine = make_engine(random_packing(3, 500, 0.05, 1.0, 3), growing);
  assert_true(engine->cells_alone());
  while (engine->packing_fraction() < 0.4) assert_int_equal(engine->advance(1000, begun()), Halt::window);
  assert_true(!engine->cells_alone() && engine->max_overlap < 1e-14);
}

CASE(never_overlaps) {
  const struct {
    const std::vector<double> &rows;
    int dim, n;
    double fraction, ratio, growth, pressure, non_additivity = 0.0;
    int32_t model = JAM_MODEL_EUCLID;
  } cases[] = {{cube, 3, 300, 0.2, 10.0, 0.05, 1e4},     {cube, 2, 200, 0.4, 10.0, 0.1, 1e3},
               {cube, 3, 2, 0.2, 1.0, 0.1, 1e6},         {cube, 3, 12, 0.2, 1.4, 0.05, 1e5},
               {cube, 6, 40, 0.01, 1.0, 0.3, 1e3},       {cube, 3, 200, 0.2, 1.0, 20.0, 1e3},
               {cube, 6, 64, 0.02, 1.4, 0.1, 1e13},  // pairs in contact through two images at once
               {cube, 3, 300, 0.2, 1.4, 0.05, 1e4, 0.2}, {cube, 3, 300, 0.2, 1.4, 0.05, 1e4, -0.2},
               {oblique, 2, 200, 0.3, 10.0, 0.1, 1e3},   {oblique, 2, 2, 0.2, 1.0, 0.1, 1e6},
               {slender, 2, 12, 0.3, 1.4, 0.1, 1e6},     {monoclinic, 3, 300, 0.2, 3.0, 0.05, 1e4},
               {slab, 3, 100, 0.2, 1.0, 0.1, 1e4},       {four, 4, 40, 0.1, 1.0, 0.1, 1e4},
               {five, 5, 300, 0.03, 1.0, 0.3, 1e3},      {monoclinic, 3, 60, 0.5, 1.0, 0.1, 1e3, 0.0, JAM_MODEL_MK},
               {rhombic, 3, 100, 0.2, 1.0, 20.0, 1e3}};
  for (const auto &c : cases)
    grows_without_overlap(random_packing(c.dim, c.n, c.fraction, c.ratio, 7, c.non_additivity, c.model,
                                         c.rows.empty() ? nullptr : c.rows.data()),
                          c.growth, c.pressure);
}

// report.max_overlap looks at listed pairs at every event, so it sees what has healed by the end. Fast growth: many
// events in the bucket at hand, whose order must hold (else overlaps of 1e-9 to 1e-3).
CASE(fast_growth_keeps_the_order_of_events) {
  for (double growth : {1.0, 3.0, 30.0})
    for (int64_t seed = 1; seed < 4; ++seed) {
      Packing p = random_packing(3, 64, 0.2, 1.0, seed);
      jam_md_report report{};
      const jam_status status = run_stage(p, {growth, 1e8, never, 1e3, 20.0}, begun(), report);
      if (!(report.max_overlap < 1e-14))
        print_error("growth %g seed %d: overlap %g\n", growth, static_cast<int>(seed), report.max_overlap);
      assert_true(status == JAM_OK || report.stop_reason == JAM_STOP_COLLISIONS);
      assert_true(report.max_overlap < 1e-14);
    }
}

// 0 and 1 overlap and part; 2 hits 1 from behind, which is the only event. No list is made in between.
CASE(an_overlap_between_lists_is_seen) {
  Packing p = random_packing(2, 3, 0.02, 1.0, 1);
  const double sigma = p.diameter[0], x[] = {0.5, 0.5 + sigma * (1.0 - 1e-5), 0.5 + sigma * (2.0 + 1e-3)},
               v[] = {-1e-3, 0.0, -1.0};
  for (int i = 0; i < 3; ++i) {
    p.position[2 * i] = x[i], p.velocity[2 * i] = v[i];
    p.position[2 * i + 1] = 0.5, p.velocity[2 * i + 1] = 0.0;
  }
  auto engine = make_engine(p, EngineOptions{});
  assert_true(std::fabs(engine->max_overlap - 1e-5) < 1e-12);  // of the start
  engine->max_overlap = 0.0;
  assert_int_equal(engine->advance(1, begun()), Halt::window);
  assert_true(std::fabs(engine->max_overlap - (1e-5 - 1e-6)) < 2e-8);  // 0 has gone 1e-3 of the way of 2
}

// A few spheres fly far between collisions: no path may lead from the image that a list knows to another one.
CASE(few_spheres_meet_the_right_image) {
  for (int dim : {2, 3})
    for (int n : {3, 8, 24, 64})
      for (double fraction : {0.03, 0.05, 0.1, 0.15, 0.2, 0.3}) {
        Packing p = random_packing(dim, n, fraction, 1.0, 2);
        jam_md_report report{};
        assert_int_equal(run_stage(p, {0.0, 0.0, 0.0, 200.0, 1e9}, begun(), report), JAM_OK);
        if (!(report.max_overlap < 1e-14))
          print_error("d=%d n=%d fraction=%g: overlap %g\n", dim, n, fraction, report.max_overlap);
        assert_true(report.max_overlap < 1e-14);
      }
}

// Pressure is measured from what a window adds, however much has gone before: growth ends for want of digits, and says
// so.
CASE(ends_where_the_digits_end) {
  Packing p = random_packing(3, 64, 0.2, 1.0, 1);
  jam_md_report report{};
  assert_int_equal(run_stage(p, {0.1, 1e18, never, 1e5, 60.0}, begun(), report), JAM_PRECISION);
  assert_int_equal(report.stop_reason, JAM_STOP_PRECISION);
  assert_true(report.pressure > 5e15 && report.max_overlap < 1e-14);
}

// Every instruction set of this processor, in fluids, under fast growth (pairs that growth drives together), near
// contact, with images and shifts, and in cells of many more spheres than a block holds.
CASE(instruction_sets_give_the_same_bits) {
  struct {
    int dim, n;
    double fraction, ratio, growth, non_additivity;
    int64_t cells;
    int32_t model = JAM_MODEL_EUCLID;
    const double *rows = nullptr;
  } const cases[] = {{2, 500, 0.4, 1.0, 0.1, 0.0, 0},
                     {3, 500, 0.2, 1.0, 0.1, 0.0, 0},
                     {3, 500, 0.2, 1.0, 30.0, 0.0, 0},
                     {4, 300, 0.1, 1.4, 0.1, 0.0, 0},
                     {5, 300, 0.05, 1.0, 0.1, 0.0, 0},
                     {6, 200, 0.02, 1.0, 0.1, 0.0, 0},
                     {7, 200, 0.01, 1.0, 0.1, 0.0, 0},
                     {8, 200, 0.004, 1.0, 0.1, 0.0, 0},
                     {3, 2000, 0.2, 20.0, 0.1, 0.0, 0},
                     {3, 500, 0.2, 1.4, 0.1, 0.2, 0},
                     {3, 12, 0.2, 1.0, 0.1, 0.0, 0},
                     {3, 500, 0.1, 1.0, 0.0, 0.0, 1},
                     {3, 300, 0.3, 1.0, 0.1, 0.0, 0, JAM_MODEL_MK},
                     {3, 500, 0.3, 1.4, 0.1, 0.0, 0, JAM_MODEL_EUCLID, monoclinic.data()}};
  for (const auto &c : cases) {
    Packing start = random_packing(c.dim, c.n, c.fraction, c.ratio, 3, c.non_additivity, c.model, c.rows), first;
    for (InstructionSet set : {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512}) {
      if (!has_instruction_set(set)) continue;
      Packing p = start;
      EngineOptions o;
      o.growth = c.growth;
      o.cells = c.cells;
      o.instruction_set = set;
      auto engine = make_engine(p, o);
      Halt halt = engine->advance(30 * c.n, begun());
      assert_true(halt == Halt::window || halt == Halt::needs_images);
      engine->write_state(p);
      assert_true(engine->max_overlap < 1e-13);
      if (set == InstructionSet::portable) first = p;
      assert_memory_equal(p.position.data(), first.position.data(), p.position.size() * sizeof(double));
      assert_memory_equal(p.velocity.data(), first.velocity.data(), p.velocity.size() * sizeof(double));
      assert_memory_equal(p.diameter.data(), first.diameter.data(), p.diameter.size() * sizeof(double));
    }
  }
}

// As at a collision: the earliest event and any other get new times together.
CASE(calendar_keeps_order_when_two_change) {
  const int n = 300;
  for (double width : {1e-3, 1e-2, 0.0}) {
    Calendar calendar(n);
    Rng rng(2, Stream::velocities, 78);
    for (int i = 0; i < n; ++i) calendar.time(i) = rng.uniform() * rng.uniform();
    calendar.rebuild(0.0, width);
    for (int step = 0; step < 3000; ++step) {
      int32_t i = calendar.top();
      if (i < 0) {
        double first = never;
        for (int k = 0; k < n; ++k) first = std::fmin(first, calendar.time(k));
        calendar.rebuild(first, width);
        i = calendar.top();
      }
      for (int k = 0; k < n; ++k) assert_true(calendar.time(k) >= calendar.time(i));
      const auto other = (i + 1 + static_cast<int32_t>(rng.bits() % (n - 1))) % n;
      const double now = calendar.time(i);
      calendar.take_out(i);
      calendar.take_out(other);
      calendar.time(i) = now + 0.1 * rng.uniform() * rng.uniform();
      calendar.time(other) = now + 0.1 * rng.uniform() * rng.uniform();
      calendar.put_in(i);
      calendar.put_in(other);
    }
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

// Stages of an earlier form have a plain phase. They are named, and no bytes of them are taken for others.
CASE(stages_of_another_version_are_refused) {
  for (const int32_t phase : {JAM_PHASE_RUN, JAM_PHASE_COMPRESS, JAM_PHASE_MONTE_CARLO}) {
    std::string bytes(reinterpret_cast<const char *>(&phase), sizeof phase), why;
    try {
      read_dynamics(random_packing(2, 50, 0.3, 1.0, 5), bytes);
    } catch (const Error &e) {
      why = e.what();
    }
    assert_true(why.find("another version") != std::string::npos);
  }
}

}  // namespace
