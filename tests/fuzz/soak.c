/* soak SECONDS [SEED]: random verbs on random handles on two threads. Without handles, memory and descriptors must stay
 * as they were after a tenth of the time. The calls are those of the fuzz target `calls`; here handles live on, and
 * both threads may meet on one.
 *
 * A handle is held alone for calls that change it and whose state is then checked. One call in four shares it: then
 * JAM_E_BUSY is an answer, and no thread reads views. */
#define _GNU_SOURCE
#include <dirent.h>
#include <malloc.h>
#include <pthread.h>
#include <time.h>
#include <unistd.h>
#include "calls.h"

#define HANDLES 8
#define INPUT 512

static jam_system *handle[HANDLES];
static pthread_rwlock_t lock[HANDLES];
static double end;
static long done[2], busy[2], seed = 1;

static uint64_t next(uint64_t *state) {
  uint64_t x = *state += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

/* What a thread may do to a handle that the other one may use. */
static jam_status shared_call(uint64_t which, jam_system *sys) {
  jam_run_options run;
  jam_crunch_options crunch;
  jam_system *copy = NULL;
  jam_status status;
  size_t needed;
  switch (which % 5) {
    case 0:
      jam_run_options_init(&run, sizeof run);
      run.wall_time = 0.01;
      return jam_run(sys, &run, NULL);
    case 1:
      jam_crunch_options_init(&crunch, sizeof crunch);
      crunch.wall_time = 0.01;
      return jam_crunch(sys, &crunch, NULL);
    case 2:
      return jam_gaps(sys, 0.1, 0, NULL, 0, NULL, 0, &needed);
    case 3:
      return jam_cancel(sys);
    default:
      status = jam_copy(sys, &copy);
      jam_destroy(copy);
      return status;
  }
}

static void *work(void *number) {
  const int me = *(int *)number;
  uint64_t state = 2 * (uint64_t)seed + (uint64_t)me;
  uint8_t bytes[INPUT];
  while (now() < end) {
    const int h = (int)(next(&state) % HANDLES);
    const uint64_t what = next(&state);
    size_t k;
    for (k = 0; k < INPUT; k += 8) {
      const uint64_t word = next(&state);
      memcpy(bytes + k, &word, 8);
    }
    {
      input in = {bytes, INPUT};
      if (what % 4 == 0) {
        pthread_rwlock_rdlock(&lock[h]);
        if (handle[h]) {
          const jam_status status = shared_call(what / 4, handle[h]);
          check_status(status);
          busy[me] += status == JAM_E_BUSY;
        }
      } else {
        pthread_rwlock_wrlock(&lock[h]);
        if (!handle[h] || what % 16 == 1) {
          jam_destroy(handle[h]);
          handle[h] = create(&in);
          if (handle[h]) limit(handle[h]);
        } else {
          any_call(&in, handle[h]);
        }
        if (handle[h]) check_state(handle[h]);
      }
      pthread_rwlock_unlock(&lock[h]);
    }
    ++done[me];
  }
  return NULL;
}

static long descriptors(void) {
  long count = 0;
  DIR *folder = opendir("/proc/self/fd");
  while (readdir(folder)) ++count;
  closedir(folder);
  return count;
}

/* Resident memory: with the pieces that malloc keeps, which grow until the largest calls have met. Printed only. */
static double megabytes(void) {
  long pages = 0, resident = 0;
  FILE *f;
  malloc_trim(0);
  f = fopen("/proc/self/statm", "r");
  demand(f && fscanf(f, "%ld %ld", &pages, &resident) == 2, "statm");
  fclose(f);
  return (double)resident * (double)sysconf(_SC_PAGESIZE) * 1e-6;
}

/* Two threads work until `until` and leave no handle. Returns the bytes in use then: what handles hold differs from
 * moment to moment. */
static double phase(double begin, double until) {
  int number[2] = {0, 1}, k;
  pthread_t thread[2];
  double used;
  end = until;
  for (k = 0; k < 2; ++k) pthread_create(&thread[k], NULL, work, &number[k]);
  for (k = 0; k < 2; ++k) pthread_join(thread[k], NULL);
  for (k = 0; k < HANDLES; ++k) jam_destroy(handle[k]), handle[k] = NULL;
  used = (double)(mallinfo2().uordblks + mallinfo2().hblkhd);
  printf("%6.0f s %9ld calls %7ld busy %10.0f bytes in use %7.1f MB resident %3ld descriptors\n", now() - begin,
         done[0] + done[1], busy[0] + busy[1], used, megabytes(), descriptors());
  fflush(stdout);
  return used;
}

int main(int argc, char **argv) {
  const double seconds = argc > 1 ? atof(argv[1]) : 3600.0;
  const double begin = now();
  double first, last = 0.0;
  long files;
  int k;
  if (argc > 2) seed = atol(argv[2]);
  for (k = 0; k < HANDLES; ++k) pthread_rwlock_init(&lock[k], NULL);
  first = phase(begin, begin + 0.1 * seconds);
  files = descriptors();
  for (k = 2; k <= 10; ++k) last = phase(begin, begin + 0.1 * k * seconds);
  demand(descriptors() <= files, "descriptors stay");
  /* malloc keeps up to 7 freed pieces of each of 64 sizes up to 1 kB for this thread: 0.24 MB that count as used */
  demand(last <= first + 3e5, "memory stays");
  return 0;
}
