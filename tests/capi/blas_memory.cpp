// OpenBLAS asks the system for the same buffer again and again when there is no address space for it. libjam asks
// first: a call that finds none ends with JAM_E_MEMORY, also the first of the process and the first on two threads.
#include <jam/jam.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "test.h"

namespace {

constexpr unsigned long mega = 1ul << 20;

jam_system *start() {
  jam_create_options o;
  jam_create_options_init(&o, sizeof o);
  o.n = 100, o.packing_fraction = 0.2;
  jam_system *sys = nullptr;
  if (jam_create(&o, nullptr, &sys) != JAM_OK) std::abort();
  return sys;
}
jam_status crunch(int threads) {
  jam_system *sys = start();
  jam_crunch_options o;
  jam_crunch_options_init(&o, sizeof o);
  o.threads = threads, o.wall_time = 20.0;
  const jam_status status = jam_crunch(sys, &o, nullptr);
  jam_destroy(sys);
  return status;
}
void leave_address_space(unsigned long bytes) {
  unsigned long pages = 0;
  std::FILE *const file = std::fopen("/proc/self/statm", "r");
  if (!file || std::fscanf(file, "%lu", &pages) != 1) std::abort();
  std::fclose(file);
  const unsigned long limit = pages * static_cast<unsigned long>(sysconf(_SC_PAGESIZE)) + bytes;
  const rlimit both{limit, limit};
  if (setrlimit(RLIMIT_AS, &both) != 0) std::abort();
}

// Where another library computes, its name is a path.
bool openblas_computes() {
  const char *const kernel = jam_blas_kernel();
  return kernel[0] != '/' && std::strcmp(kernel, "builtin") != 0;
}

// Runs part() in a process of its own, which a hang does not outlive.
int status_of(int (*part)()) {
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    alarm(60);
    _exit(-part());
  }
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFSIGNALED(status)) fail_msg("ended by signal %d", WTERMSIG(status));
  return -static_cast<int>(WEXITSTATUS(status));
}

int first_call() {
  leave_address_space(64 * mega);
  return crunch(1);
}
int first_call_on_two_threads() {
  if (crunch(1) != JAM_OK) return JAM_E_STATE;
  leave_address_space(64 * mega);
  if (crunch(1) != JAM_OK) return JAM_E_STATE;  // its buffer is there
  return crunch(2);
}
int enough() {
  leave_address_space(512 * mega);
  return crunch(1) ? crunch(1) : crunch(2);
}

void a_call_without_room_for_a_buffer_says_so(void **) {
#ifdef JAM_SANITIZED
  skip();  // they map terabytes
#endif
  // Other libraries and the loops of libjam itself take no such buffer, so that their crunches have room enough.
  const jam_status without_room = openblas_computes() ? JAM_E_MEMORY : JAM_OK;
  assert_int_equal(status_of(first_call), without_room);
  assert_int_equal(status_of(first_call_on_two_threads), without_room);
  assert_int_equal(status_of(enough), JAM_OK);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(a_call_without_room_for_a_buffer_says_so)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
