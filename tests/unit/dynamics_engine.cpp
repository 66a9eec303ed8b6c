// The engine against a naive one (all pairs, all images, long double), and its invariants on awkward systems.
#include <cmath>
#include <vector>

#include "core/create.hpp"
#include "core/pair_rule.hpp"
#include "core/pairs.hpp"
#include "core/rng.hpp"
#include "dynamics/event_driven/engine.hpp"
#include "dynamics/event_driven/options.hpp"
#include "naive_dynamics.hpp"

#include "test.h"

using namespace jam::inside;
using namespace jamtest;

namespace {

GrowthStage nve(double collisions_per_particle) { return {0.0, 0.0, 0.0, collisions_per_particle, 1e9}; }

struct Case {
  int dim, n;
  double fraction, ratio, growth;
  int collisions;
  double non_additivity = 0.0;
};

CASE(agrees_with_naive_engine) {
  // Small boxes (several images of one pair) among them.
  // From 40 spheres in three dimensions on cells alone hold, whether they are the choice at that density or not.
  const Case cases[] = {
      {3, 40, 0.04, 1.0, 0.0, 60},      {3, 40, 0.06, 1.5, 0.05, 60},      {2, 40, 0.1, 2.0, 0.02, 60},
      {4, 40, 0.004, 1.0, 0.01, 20},    {3, 24, 0.25, 1.0, 0.0, 60},       {3, 24, 0.25, 1.0, 0.05, 60},
      {2, 16, 0.35, 3.0, 0.02, 40},     {3, 2, 0.3, 1.0, 0.0, 10},         {2, 2, 0.4, 1.0, 0.01, 10},
      {3, 3, 0.3, 1.5, 0.02, 12},       {4, 10, 0.12, 1.0, 0.0, 25},       {5, 6, 0.05, 1.0, 0.01, 10},
      {3, 24, 0.2, 1.4, 0.02, 60, 0.2}, {2, 12, 0.35, 1.4, 0.0, 40, -0.2}, {2, 2, 0.3, 1.4, 0.02, 10, 0.1},
      {3, 40, 0.03, 1.4, 0.02, 60, 0.3}};
  for (const Case &c : cases) {
    const Packing start = random_packing(c.dim, c.n, c.fraction, c.ratio, 5, c.non_additivity);
    Packing q = start;
    naive(q, c.collisions, c.growth > 0.0 ? c.growth / diameter_mean(q) : 0.0L);
    for (int64_t cells : {-1, 1}) {
      Packing p = start;
      EngineOptions o;
      o.growth = c.growth;
      o.cells = cells;
      auto engine = make_engine(p, o);
      assert_int_equal(engine->advance(c.collisions, begun()), Halt::window);
      engine->write_state(p);
      const double distance = furthest(p, q);
      if (engine->cells_alone() != (cells == 1 && c.n == 40))
        print_error("d=%d n=%d fraction=%g: cells alone %d\n", c.dim, c.n, c.fraction, engine->cells_alone());
      if (!(distance < 1e-7))
        print_error("d=%d n=%d growth=%g cells=%d: %g\n", c.dim, c.n, c.growth, static_cast<int>(cells), distance);
      assert_true(distance < 1e-7);
      assert_true(std::fabs(diameter_mean(p) / diameter_mean(q) - 1.0) < 1e-9);
      assert_true(engine->cells_alone() == (cells == 1 && c.n == 40));
    }
  }
}

// Dilute systems are on cells, dense ones on lists, and a compression goes over from one to the other. Both give one
// pressure.
CASE(engine_follows_the_density) {
  for (double fraction : {0.05, 0.1}) {
    double pressure[2], error = 0.0;
    for (int k = 0; k < 2; ++k) {
      EngineOptions o;
      o.cells = k - 1;
      auto engine = make_engine(random_packing(3, 500, fraction, 1.0, 3), o);
      assert_true(engine->cells_alone() == (k == 1));
      std::vector<double> p;
      for (int block = 0; block < 20; ++block) {
        const double virial = engine->sums.of_pressure.virial,
                     kinetic_integral = engine->sums.of_pressure.kinetic_integral;
        assert_int_equal(engine->advance(10000, begun()), Halt::window);
        p.push_back((engine->sums.of_pressure.virial - virial) /
                    (engine->sums.of_pressure.kinetic_integral - kinetic_integral));
      }
      double mean = 0.0, square = 0.0;
      for (double x : p) mean += x / 20.0;
      for (double x : p) square += (x - mean) * (x - mean) / (19.0 * 20.0);
      pressure[k] = mean;
      error += square;
      assert_true(engine->max_overlap < 1e-14);
    }
    print_message("phi %g: p - 1 = %.4f on lists, %.4f on cells, error %.4f\n", fraction, pressure[0], pressure[1],
                  std::sqrt(error));
    assert_true(std::fabs(pressure[1] - pressure[0]) < 4.0 * std::sqrt(error) && std::sqrt(error) < 0.01 * pressure[0]);
  }
  EngineOptions growing;
  growing.growth = 0.1;
  auto engine = make_engine(random_packing(3, 500, 0.05, 1.0, 3), growing);
  assert_true(engine->cells_alone());
  while (engine->packing_fraction() < 0.4) assert_int_equal(engine->advance(1000, begun()), Halt::window);
  assert_true(!engine->cells_alone() && engine->max_overlap < 1e-14);
}

// No pair of any image may overlap, lists or not.
CASE(never_overlaps) {
  struct {
    int dim, n;
    double fraction, ratio, growth, pressure, non_additivity = 0.0;
  } const cases[] = {{3, 300, 0.2, 10.0, 0.05, 1e4},     {2, 200, 0.4, 10.0, 0.1, 1e3},
                     {3, 2, 0.2, 1.0, 0.1, 1e6},         {3, 3, 0.1, 2.0, 0.1, 1e6},
                     {3, 12, 0.2, 1.4, 0.05, 1e5},       {4, 40, 0.1, 1.0, 0.1, 1e4},
                     {6, 40, 0.01, 1.0, 0.3, 1e3},       {3, 200, 0.2, 1.0, 20.0, 1e3},
                     {6, 64, 0.02, 1.4, 0.1, 1e13},  // pairs in contact through two images at once
                     {3, 300, 0.2, 1.4, 0.05, 1e4, 0.2}, {3, 300, 0.2, 1.4, 0.05, 1e4, -0.2}};
  for (const auto &c : cases) {
    Packing p = random_packing(c.dim, c.n, c.fraction, c.ratio, 7, c.non_additivity);
    jam_md_report report{};
    const jam_status status = run_stage(p, {c.growth, c.pressure, never, 1e4, 300.0}, begun(), report);
    const double gap = closest_pair(p).gap;
    if (status != JAM_OK || !(gap > -1e-14))
      print_error("d=%d n=%d ratio=%g: status %d, p %g, gap %g\n", c.dim, c.n, c.ratio, status, report.pressure, gap);
    assert_int_equal(status, JAM_OK);
    assert_true(gap > -1e-14);
    assert_true(report.max_overlap < 1e-13);
    assert_true(report.pressure >= c.pressure);
  }
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
        assert_int_equal(run_stage(p, nve(200.0), begun(), report), JAM_OK);
        if (!(report.max_overlap < 1e-14))
          print_error("d=%d n=%d fraction=%g: overlap %g\n", dim, n, fraction, report.max_overlap);
        assert_true(report.max_overlap < 1e-14);
      }
}

CASE(stops_inside_a_dense_fluid_without_overlap) {
  Packing p = random_packing(3, 400, 0.3, 10.0, 3);
  for (int k = 0; k < 20; ++k) {
    jam_md_report report{};
    assert_int_equal(run_stage(p, nve(3.7), begun(), report), JAM_OK);
    assert_true(closest_pair(p).gap > -1e-14);
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

CASE(same_bits_twice) {
  for (int k = 0; k < 2; ++k) {
    Packing p = random_packing(3, 100, 0.3, 1.4, 11), q = p;
    jam_md_report report{};
    const GrowthStage stage = k == 0 ? nve(50.0) : GrowthStage{0.01, 1e4, never, never, never};
    run_stage(p, stage, begun(), report);
    run_stage(q, stage, begun(), report);
    assert_memory_equal(p.position.data(), q.position.data(), p.position.size() * sizeof(double));
    assert_memory_equal(p.velocity.data(), q.velocity.data(), p.velocity.size() * sizeof(double));
  }
}

// Every instruction set of this processor, in fluids, under fast growth (pairs that growth drives together), near
// contact, with images and shifts, and in cells of many more spheres than a block holds.
CASE(instruction_sets_give_the_same_bits) {
  struct {
    int dim, n;
    double fraction, ratio, growth, non_additivity;
    int64_t cells;
    int32_t model;
  } const cases[] = {
      {2, 500, 0.4, 1.0, 0.1, 0.0, 0, JAM_MODEL_EUCLID},   {3, 500, 0.2, 1.0, 0.1, 0.0, 0, JAM_MODEL_EUCLID},
      {3, 500, 0.2, 1.0, 30.0, 0.0, 0, JAM_MODEL_EUCLID},  {4, 300, 0.1, 1.4, 0.1, 0.0, 0, JAM_MODEL_EUCLID},
      {5, 300, 0.05, 1.0, 0.1, 0.0, 0, JAM_MODEL_EUCLID},  {6, 200, 0.02, 1.0, 0.1, 0.0, 0, JAM_MODEL_EUCLID},
      {7, 200, 0.01, 1.0, 0.1, 0.0, 0, JAM_MODEL_EUCLID},  {8, 200, 0.004, 1.0, 0.1, 0.0, 0, JAM_MODEL_EUCLID},
      {3, 2000, 0.2, 20.0, 0.1, 0.0, 0, JAM_MODEL_EUCLID}, {3, 500, 0.2, 1.4, 0.1, 0.2, 0, JAM_MODEL_EUCLID},
      {3, 12, 0.2, 1.0, 0.1, 0.0, 0, JAM_MODEL_EUCLID},    {3, 500, 0.1, 1.0, 0.0, 0.0, 1, JAM_MODEL_EUCLID},
      {3, 300, 0.3, 1.0, 0.1, 0.0, 0, JAM_MODEL_MK}};
  for (const auto &c : cases) {
    Packing start = random_packing(c.dim, c.n, c.fraction, c.ratio, 3, c.non_additivity, c.model), first;
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

// The kernel alone against long doubles: pairs in contact to the last bit, apart by one unit, overlapping, receding,
// outrun by growth, and two entries with the same time, of which the first counts.
CASE(kernel_at_contact) {
  constexpr int count = 12;
  const double s = 0x1p62;  // contact distance: a quarter of the box
  for (InstructionSet set : {InstructionSet::portable, InstructionSet::avx2, InstructionSet::avx512}) {
    if (!has_instruction_set(set)) continue;
    const PairKernel<3> kernel = pair_kernel<3>(set);
    Body<3> body[count + 1] = {};
    int32_t list[count];
    std::vector<double> event_time(count + 1, never);
    for (int k = 0; k <= count; ++k) {
      body[k].radius = int64_t{1} << 61;
      if (k == 0) continue;
      body[k].x[0] = uint64_t{1} << 63;  // half the box away: never met
      list[k - 1] = k;
    }
    const auto at = [&](int entry, uint64_t distance, double v) {
      body[entry + 1].x[0] = distance;
      body[entry + 1].v[0] = v;
    };
    const auto run = [&](double rate, Earliest found, uint64_t *left_out = nullptr) {
      const PairBatch<3> pairs{body, body, list, count, nullptr, 0, event_time.data(), 0.0, rate, 0.0};
      const uint64_t bits = kernel.collisions(pairs, found);
      if (left_out) *left_out = bits;
      return found;
    };
    const uint64_t contact = uint64_t{1} << 62;
    const Earliest nothing{1e300, -1};
    assert_int_equal(run(0.0, nothing).entry, -1);
    at(5, contact, -s);
    assert_true(run(0.0, nothing).entry == 5 && run(0.0, nothing).time == 0.0);  // touches and approaches
    at(5, contact, s);
    assert_int_equal(run(0.0, nothing).entry, -1);  // touches and recedes
    at(5, contact + 1, -s);
    // One unit of 2^-64 of the box: no double of the distance holds it, but the time is right to rounding.
    assert_true(std::fabs(run(0.0, nothing).time * s - 1.0) < 1e-14);
    at(9, contact + 1, -s);
    assert_int_equal(run(0.0, nothing).entry, 5);  // of two at one time the first
    event_time[6] = 0.0;                           // whose sphere has an earlier event: the second
    assert_int_equal(run(0.0, nothing).entry, 9);
    assert_int_equal(run(0.0, {0.5 / s, -1}).entry, -1);  // none before what is known
    uint64_t left_out = 0;
    at(2, contact - (contact >> 40), -s);  // overlaps by 1e-12
    run(0.0, nothing, &left_out);
    assert_int_equal(left_out, 1u << 2);
    at(2, 2 * contact, 0.0);
    for (int k = 0; k < count; ++k) body[k + 1].v[0] = 0.0;
    run(1.0, nothing, &left_out);  // growth outruns all: the caller computes them
    assert_int_equal(left_out, (1u << count) - 1);
  }
}

CASE(calendar_gives_events_in_order) {
  const int n = 200;
  Calendar calendar(n);
  Rng rng(1, Stream::velocities, 77);
  for (int i = 0; i < n; ++i) calendar.time(i) = rng.uniform() * rng.uniform();
  calendar.rebuild(0.0, 1e-3);
  double last = 0.0;
  int seen = 0;
  for (int step = 0; step < 5000; ++step) {
    int32_t i = calendar.top();
    if (i < 0) {
      calendar.rebuild(last, 1e-3);
      i = calendar.top();
    }
    assert_true(i >= 0);
    for (int k = 0; k < n; ++k) assert_true(calendar.time(k) >= calendar.time(i));
    assert_true(calendar.time(i) >= last);
    last = calendar.time(i);
    calendar.time(i) = last + 0.1 * rng.uniform() * rng.uniform();
    calendar.update(i);
    const auto other = static_cast<int32_t>(rng.bits() % n);
    calendar.time(other) = last + 0.3 * rng.uniform();
    calendar.update(other);
    ++seen;
  }
  assert_int_equal(seen, 5000);
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

}  // namespace
