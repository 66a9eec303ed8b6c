/* All calls of the table tests/calls.def on one handle from several threads, while others set its callbacks: each ends
 * in a status, none as an internal error or with a bad file, and a callback that jam_set_log has replaced is not called
 * again. Meant for ThreadSanitizer too. */
#include <pthread.h>

#include "calls.h"
#include "systems.h"

enum { THREADS = 3, ROUNDS = 2, SETTINGS = 400 };

/* jam_notes points into the handle until jam_add_note; the setters of positions and velocities read a view, which
 * another thread may not do while a call moves the spheres. */
static int may_run_beside(const struct call_entry *entry) {
  static const char *const alone[] = {"jam_notes",   "jam_set_positions", "jam_set_velocities",
                                      "jam_destroy", "jam_set_log",       "jam_set_progress"};
  for (size_t k = 0; k < sizeof alone / sizeof *alone; ++k)
    if (!strcmp(entry->name, alone[k])) return 0;
  return entry->start != NONE && entry->start != STEP;
}

static jam_system *shared;
static int ended; /* under `count`, as is wrong */
static char wrong[200];
static pthread_mutex_t count = PTHREAD_MUTEX_INITIALIZER;

static void *call_all(void *first) {
  for (int round = 0; round < ROUNDS; ++round)
    for (int k = 0; k < CALLS; ++k) {
      const struct call_entry *const entry = &every_call[(k + 23 * *(const int *)first) % CALLS];
      if (!may_run_beside(entry)) continue;
      jam_set_error(NULL);
      jam_status status = entry->call(NULL, shared);
      if (status != JAM_E_INTERNAL && status != JAM_E_NULL && status != JAM_E_FORMAT &&
          (status == JAM_OK || jam_last_error()[0]))
        continue;
      pthread_mutex_lock(&count);
      snprintf(wrong, sizeof wrong, "%s gives %d: %s", entry->name, status, jam_last_error());
      pthread_mutex_unlock(&count);
    }
  remove(call_file()), remove(call_image());
  pthread_mutex_lock(&count);
  ++ended;
  pthread_mutex_unlock(&count);
  return NULL;
}

/* One callback after the other; which may be called is known to the setter alone. */
static struct told { int held, late; } told[SETTINGS];
static pthread_mutex_t holding = PTHREAD_MUTEX_INITIALIZER;

static void on_log(int32_t level, const char *line, void *user) {
  struct told *const mine = user;
  (void)level, (void)line;
  pthread_mutex_lock(&holding);
  if (!mine->held) mine->late = 1;
  pthread_mutex_unlock(&holding);
}

static void set_held(int k, int held) {
  pthread_mutex_lock(&holding);
  if (k >= 0) told[k].held = held;
  pthread_mutex_unlock(&holding);
}

static void *set_logs(void *unused) {
  int before = -1, k, over = 0;
  (void)unused;
  for (k = 0; k < SETTINGS && !over;) {
    set_held(k, 1); /* before the library has it */
    if (jam_set_log(shared, on_log, JAM_LOG_DEBUG, &told[k]) == JAM_OK) {
      set_held(before, 0); /* the library has let it go */
      before = k++;
    }
    pthread_mutex_lock(&count);
    over = ended == THREADS;
    pthread_mutex_unlock(&count);
  }
  return NULL;
}

CASE(every_call_from_several_threads) {
  static const int first[THREADS] = {0, 1, 2};
  pthread_t threads[THREADS], setter;
  shared = system_for(NETWORK);
  assert_non_null(shared);
  assert_int_equal(pthread_create(&setter, NULL, set_logs, NULL), 0);
  for (int k = 0; k < THREADS; ++k) assert_int_equal(pthread_create(&threads[k], NULL, call_all, (void *)&first[k]), 0);
  for (int k = 0; k < THREADS; ++k) assert_int_equal(pthread_join(threads[k], NULL), 0);
  assert_int_equal(pthread_join(setter, NULL), 0);
  if (wrong[0]) fail_msg("%s", wrong);
  for (int k = 0; k < SETTINGS; ++k) assert_int_equal(told[k].late, 0);
  info_of(shared); /* nobody is left inside */
  assert_int_equal(jam_set_log(shared, NULL, 0, NULL), JAM_OK);
  jam_destroy(shared);
}
