// Who may enter a handle: while a verb runs, other threads get JAM_E_BUSY from every call, and the callback's own
// thread may read. Meant for ThreadSanitizer too. (thread_calls: any mix of calls on several threads.)
#include <jam/jam.h>
#include <unistd.h>

#include <cstdio>
#include <cstring>
#include <functional>
#include <string>
#include <thread>
#include <vector>

#include "steps.h"

namespace {

std::string file_name() { return "thread_gate." + std::to_string(getpid()) + ".jam"; }

// Every const call that other threads were seen to crash with, and some more.
std::vector<jam_status> const_calls(jam_system *sys, const char *path) {
  const double *view = nullptr;
  size_t len = 0, needed = 0;
  OWNED jam_system *copy = nullptr;
  SIZED(jam_info, info);
  std::vector<jam_status> out{jam_get_info(sys, &info),
                              jam_view(sys, JAM_VIEW_POSITIONS, &view, &len),
                              jam_view(sys, JAM_VIEW_DIAMETERS, &view, &len),
                              jam_copy(sys, &copy),
                              jam_write_checkpoint(sys, path),
                              jam_gaps(sys, 0.1, 0, nullptr, 0, nullptr, 0, &needed)};
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
  OWNED jam_system *sys = random_spheres(3, 100, 0.2, 1);
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
    OWNED jam_system *read = nullptr;
    assert_int_equal(jam_read_checkpoint(path.c_str(), nullptr, nullptr, &read), JAM_OK);
    std::remove(path.c_str());
  }
  for (const jam_status status : const_calls(sys, good.c_str())) assert_int_equal(status, JAM_OK);
  std::remove(good.c_str());
}

}  // namespace
