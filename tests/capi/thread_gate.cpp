// Who may enter a handle: while a verb runs, other threads get JAM_E_BUSY from every call, and the callback's own
// thread may read. No mix of calls on several threads crashes or leaves a bad file. Meant for ThreadSanitizer too.
#include <jam/jam.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstring>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "test.h"

namespace {

jam_system *start(int64_t n, double fraction) {
  DEFAULTS(create, o);
  o.n = n, o.packing_fraction = fraction;
  jam_system *sys = nullptr;
  assert_int_equal(jam_create(&o, nullptr, &sys), JAM_OK);
  return sys;
}

std::string file_name() { return "thread_gate." + std::to_string(getpid()) + ".jam"; }

jam_status info_of(const jam_system *sys) {
  jam_info info;
  std::memset(&info, 0, sizeof info);
  info.struct_size = sizeof info;
  return jam_get_info(sys, &info);
}

// Every const call that other threads were seen to crash with, and some more.
std::vector<jam_status> const_calls(jam_system *sys, const char *path) {
  const double *view = nullptr;
  size_t len = 0, needed = 0;
  jam_system *copy = nullptr;
  std::vector<jam_status> out{info_of(sys),
                              jam_view(sys, JAM_VIEW_POSITIONS, &view, &len),
                              jam_view(sys, JAM_VIEW_DIAMETERS, &view, &len),
                              jam_copy(sys, &copy),
                              jam_write_checkpoint(sys, path),
                              jam_gaps(sys, 0.1, 0, nullptr, 0, nullptr, 0, &needed)};
  jam_destroy(copy);
  return out;
}

struct Visit {
  jam_system *sys;
  std::string path;
  std::function<void()> elsewhere;
  int calls;
};

int32_t on_progress(const jam_progress *, void *user) {
  auto *visit = static_cast<Visit *>(user);
  if (visit->calls++ > 0) return 0;
  for (const jam_status status : const_calls(visit->sys, visit->path.c_str())) assert_int_equal(status, JAM_OK);
  std::thread other(visit->elsewhere);
  other.join();
  return 0;
}

CASE(only_the_callback_reads_during_a_verb) {
  jam_system *sys = start(100, 0.2);
  std::vector<jam_status> seen;
  Visit visit{sys, file_name(), nullptr, 0};
  const std::string good = visit.path + ".good";
  assert_int_equal(jam_write_checkpoint(sys, good.c_str()), JAM_OK);
  visit.elsewhere = [&] {
    seen = const_calls(sys, good.c_str());
    seen.push_back(jam_run(sys, nullptr, nullptr));
    seen.push_back(jam_scale_diameters(sys, 0.9));
  };
  assert_int_equal(jam_set_progress(sys, on_progress, &visit), JAM_OK);
  DEFAULTS(run, o);
  o.collisions_per_particle = 100.0;
  assert_int_equal(jam_run(sys, &o, nullptr), JAM_OK);
  assert_true(visit.calls > 0);
  assert_int_equal(seen.size(), 8);
  for (const jam_status status : seen) assert_int_equal(status, JAM_E_BUSY);
  for (const std::string &path : {visit.path, good}) {
    jam_system *read = nullptr;
    assert_int_equal(jam_read_checkpoint(path.c_str(), nullptr, nullptr, &read), JAM_OK);
    jam_destroy(read);
    std::remove(path.c_str());
  }
  for (const jam_status status : const_calls(sys, good.c_str())) assert_int_equal(status, JAM_OK);
  std::remove(good.c_str());
  jam_destroy(sys);
}

CASE(races_end_in_a_status) {
  jam_system *sys = start(60, 0.3);
  const std::string path = file_name();
  std::atomic<bool> stop{false};
  std::atomic<int> failures{0}, refused{0}, done{0};
  const auto reader = [&](const std::string &mine) {
    while (!stop) {
      for (const jam_status status : const_calls(sys, mine.c_str())) {
        if (status == JAM_E_BUSY) ++refused;
        if (status != JAM_OK && status != JAM_E_BUSY) ++failures;
        if (status == JAM_OK) ++done;
      }
      jam_system *read = nullptr;
      const jam_status status = jam_read_checkpoint(mine.c_str(), nullptr, nullptr, &read);
      if (status != JAM_OK && status != JAM_E_IO) ++failures;  // no file was written yet
      jam_destroy(read);
    }
  };
  std::thread first(reader, path), second(reader, path + "2");
  DEFAULTS(run, o);
  o.collisions_per_particle = 20.0;
  int runs = 0;
  for (int turn = 0; turn < 4000 && runs < 40; ++turn) {
    const jam_status status = turn % 2 ? jam_run(sys, &o, nullptr) : jam_scale_diameters(sys, turn % 4 ? 0.99 : 1.0);
    if (status == JAM_OK) ++runs;
    if (status != JAM_OK && status != JAM_E_BUSY) ++failures;
    if (status == JAM_E_BUSY) std::this_thread::yield();
  }
  while (done == 0) std::this_thread::yield();  // the handle is free now: readers get in
  stop = true;
  first.join(), second.join();
  assert_int_equal(failures, 0);
  assert_int_equal(info_of(sys), JAM_OK);  // nobody is left inside
  assert_int_equal(jam_run(sys, &o, nullptr), JAM_OK);
  assert_true(done > 0);
  std::remove(path.c_str()), std::remove((path + "2").c_str());
  jam_destroy(sys);
}

}  // namespace
