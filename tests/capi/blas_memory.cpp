// OpenBLAS asks the system for the same buffer again and again when there is no address space for it. libjam asks
// first: a call that finds none ends with JAM_E_MEMORY, also the first of the process and the first on two threads.
// Full spectra call it where CMake found it (JAM_LAPACK), crunches with JAM_BLAS=openblas alone.
#include <jam/jam.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "steps.h"

namespace {

constexpr unsigned long mega = 1ul << 20;

jam_status crunch(jam_system *sys, int threads) {
  DEFAULTS(crunch, o);
  o.threads = threads;
  return jam_crunch(sys, &o, nullptr);
}
jam_status crunch(int threads) {
  OWNED jam_system *sys = random_spheres(3, 100, 0.2, 1);
  return crunch(sys, threads);
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

// What OpenBLAS computes in this build: crunches, whose kernel has its name then (another library has a path), and
// full spectra.
bool crunches_by_openblas() {
  const char *const kernel = jam_blas_kernel();
  return kernel[0] != '/' && std::strcmp(kernel, "builtin") != 0;
}
#ifdef JAM_TEST_OPENBLAS
constexpr bool spectra_by_openblas = true;
#else
constexpr bool spectra_by_openblas = false;
#endif

// Runs part() in a process of its own, which a hang does not outlive.
int status_of(int (*part)()) {
  std::fflush(stdout);
  const pid_t child = fork();
  if (child == 0) {
    alarm(300);  // an emulator on a busy machine takes a minute
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
int spectrum_with(unsigned long bytes) {
  jam_system *sys = random_spheres(3, 100, 0.2, 1);
  DEFAULTS(modes, o);
  o.which = JAM_MODES_ALL;
  size_t rows = 0;
  static double table[2 * 300];
  if (crunch(sys, 1) != JAM_OK) return JAM_E_STATE;
  leave_address_space(bytes);
  return jam_modes(sys, nullptr, &o, 2, table, sizeof table / sizeof *table, nullptr, 0, &rows);
}
int spectrum() { return spectrum_with(64 * mega); }
int spectrum_with_enough() { return spectrum_with(512 * mega); }

CASE(a_call_without_room_for_a_buffer_says_so) {
#ifdef JAM_SANITIZED
  skip();  // they map terabytes
#endif
  // Other libraries and the loops of libjam itself take no such buffer, so that their calls have room enough.
  const jam_status without_room = crunches_by_openblas() ? JAM_E_MEMORY : JAM_OK;
  assert_int_equal(status_of(first_call), without_room);
  assert_int_equal(status_of(first_call_on_two_threads), without_room);
  assert_int_equal(status_of(enough), JAM_OK);
  // Where crunches call OpenBLAS, that before the spectrum has made the buffer.
  assert_int_equal(status_of(spectrum), spectra_by_openblas && !crunches_by_openblas() ? JAM_E_MEMORY : JAM_OK);
  assert_int_equal(status_of(spectrum_with_enough), JAM_OK);
}

}  // namespace
