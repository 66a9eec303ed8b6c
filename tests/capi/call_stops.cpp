// Calls that take no options can be stopped too: setters, const calls, and those that make a system from a file, an
// array or a checkpoint. All pairs of 20000 Mari-Kurchan spheres take many seconds; the callback or jam_cancel ends the
// call long before, and nothing has changed.
#include <jam/jam.h>

#include <algorithm>
#include <chrono>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "io_helpers.h"
#include "start.h"

namespace {

constexpr int64_t n = 20000;

jam_create_options quenched() {
  DEFAULTS(create, o);
  o.n = n, o.packing_fraction = 1e-6, o.model = JAM_MODEL_MK, o.mk_zeta = 0.0;  // a random start is quick
  return o;
}

jam_system *make(const jam_create_options &o) { return created(&o); }

int32_t stop_at_once(const jam_progress *, void *user) {
  if (user) ++*static_cast<int *>(user);
  return 1;
}

std::vector<double> numbers(const jam_system *sys, int32_t kind) {
  const double *view = nullptr;
  size_t len = 0;
  jam_view(sys, kind, &view, &len);
  return {view, view + len};
}
std::vector<double> positions(const jam_system *sys) { return numbers(sys, JAM_VIEW_POSITIONS); }
std::vector<double> diameters(const jam_system *sys) { return numbers(sys, JAM_VIEW_DIAMETERS); }

const double tilted[9] = {1, 0, 0, 0.25, 1, 0, 0, 0.25, 1};

// By the callback, and by a cancel of another thread while the call runs. That one is answered: the next verb runs.
CASE(setters_are_stopped) {
  OWNED jam_system *sys = make(quenched());
  const std::vector<double> x = positions(sys), s = diameters(sys);
  std::vector<double> other = x;
  for (double &v : other) v = 1.0 - v;
  const double shear[9] = {0, 0.01, 0, 0, 0, 0, 0, 0, 0};
  const std::function<jam_status()> calls[] = {
      [&] { return jam_set_positions(sys, other.data(), other.size()); },
      [&] { return jam_scale_diameters(sys, 1.0 + 1e-9); },
      [&] { return jam_set_cell(sys, tilted, 9, nullptr, 0, nullptr, 0, nullptr); },
      [&] { return jam_strain(sys, shear, 9); }};
  for (const bool by_callback : {true, false})
    for (const auto &call : calls) {
      jam_set_progress(sys, by_callback ? stop_at_once : nullptr, nullptr);
      std::thread other_thread([&] {
        if (by_callback) return;
        std::this_thread::sleep_for(std::chrono::milliseconds(100));
        jam_cancel(sys);
      });
      const jam_status status = call();
      other_thread.join();
      assert_int_equal(status, JAM_CANCELLED);
      assert_true(positions(sys) == x && diameters(sys) == s);
    }
  jam_set_progress(sys, nullptr, nullptr);
  size_t rows = 0;
  assert_int_equal(jam_structure_factor(sys, 7.0 * s[0], JAM_STRUCTURE_COLUMNS, nullptr, 0, &rows), JAM_OK);
}

// Each of them by the callback, those with options by the limit of time too.
CASE(makers_are_stopped) {
  const jam_create_options o = quenched();
  jam_create_options timed = o;
  timed.wall_time = 0.05;
  jam_system *sys = make(o), *made = nullptr;
  const std::vector<double> x = positions(sys), s = diameters(sys);
  const std::string file = in_scratch("packing.dat"), checkpoint = in_scratch("packing.chk");
  assert_int_equal(jam_write(sys, file.c_str(), 0), JAM_OK);
  assert_int_equal(jam_write_checkpoint(sys, checkpoint.c_str()), JAM_OK);
  jam_destroy(sys);
  const auto in_cell = [&](const jam_create_options &options, jam_progress_fn callback) {
    jam_start start = start_at(x.data(), x.size(), s.data(), s.size());
    start.cell = tilted, start.cell_len = 9, start.progress = callback;
    return jam_create(&options, &start, &made);
  };
  const auto read = [&](jam_create_options options, jam_progress_fn callback) {
    DEFAULTS(create, plain);
    options.packing_fraction = plain.packing_fraction;  // the file's own
    return jam_read(file.c_str(), &options, callback, nullptr, &made);
  };
  const auto expect = [&](jam_status status, jam_status wanted) {
    assert_int_equal(status, wanted);
    assert_null(made);
  };
  expect(in_cell(o, stop_at_once), JAM_CANCELLED);
  expect(in_cell(timed, nullptr), JAM_LIMIT);
  expect(read(o, stop_at_once), JAM_CANCELLED);
  expect(read(timed, nullptr), JAM_LIMIT);
  expect(jam_read_checkpoint(checkpoint.c_str(), stop_at_once, nullptr, &made), JAM_CANCELLED);
}

// Const calls that compare many pairs. One that a callback makes does not call it again. A cancel that came before
// waits for the next verb.
CASE(const_calls_are_stopped) {
  DEFAULTS(create, o);
  o.n = n;
  OWNED jam_system *sys = make(o);
  std::vector<double> out(n);
  size_t rows = 0;
  int calls = 0;
  jam_estimate_report e;
  e.struct_size = sizeof e;
  DEFAULTS(crunch, wide);
  wide.neighbour_radius = 4.0;
  DEFAULTS(correlation, far);
  far.r_max = 8.0, far.bins = 10;
  const std::function<jam_status()> const_calls[] = {
      [&] { return jam_bond_order(sys, 64, 3.0, out.data(), out.size(), &rows); },
      [&] { return jam_gaps(sys, 6.0, 0, nullptr, 0, nullptr, 0, &rows); },
      [&] { return jam_pair_correlation(sys, &far, nullptr, 0, out.data(), out.size(), &rows); },
      [&] { return jam_estimate_crunch(sys, &wide, &e); }};
  for (const auto &call : const_calls) {
    jam_set_progress(sys, stop_at_once, &calls);
    calls = 0;
    assert_int_equal(call(), JAM_CANCELLED);
    assert_int_equal(calls, 1);
    jam_set_progress(sys, nullptr, nullptr);
    std::thread other_thread([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
      jam_cancel(sys);
    });
    const jam_status status = call();
    other_thread.join();
    assert_int_equal(status, JAM_CANCELLED);
  }
  assert_int_equal(jam_cancel(sys), JAM_OK);
  assert_int_equal(jam_gaps(sys, 0.1, 0, nullptr, 0, nullptr, 0, &rows), JAM_OK);
  DEFAULTS(run, run);
  run.collisions_per_particle = 0.1;
  assert_int_equal(jam_run(sys, &run, nullptr), JAM_CANCELLED);
  assert_int_equal(jam_run(sys, &run, nullptr), JAM_OK);
}

struct Nested {
  jam_system *sys = nullptr;
  int depth = 0, deepest = 0;
};
int32_t look_inside(const jam_progress *, void *user) {
  Nested &nested = *static_cast<Nested *>(user);
  nested.deepest = std::max(nested.deepest, ++nested.depth);
  size_t rows = 0;
  assert_int_equal(jam_gaps(nested.sys, 2.0, 0, nullptr, 0, nullptr, 0, &rows), JAM_OK);
  --nested.depth;
  return 1;
}

CASE(callbacks_do_not_nest) {
  DEFAULTS(create, o);
  o.n = n;
  Nested nested;
  nested.sys = make(o);
  jam_set_progress(nested.sys, look_inside, &nested);
  std::vector<double> out(n);
  size_t rows = 0;
  assert_int_equal(jam_bond_order(nested.sys, 64, 3.0, out.data(), out.size(), &rows), JAM_CANCELLED);
  assert_int_equal(jam_run(nested.sys, nullptr, nullptr), JAM_CANCELLED);
  assert_int_equal(nested.deepest, 1);
  jam_destroy(nested.sys);
}

}  // namespace

FIXTURE(make_scratch, remove_scratch)
