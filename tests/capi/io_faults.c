/* Every call that a write makes of the system fails once, and writers are killed at random moments: the old file or the
 * new one stands there whole, and nothing is left beside it. */
#define _GNU_SOURCE
#include <fcntl.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include "io_helpers.h"

/* The library finds these in the program before it looks in libc. */
enum { calls_write, calls_fsync, calls_rename, calls_open, calls_close, kinds };
static long until_failure[kinds] = {-1, -1, -1, -1, -1}; /* calls that still succeed; -1: all */
static int halves;                                       /* a write that fails first writes half of what it was given */

static int fails(int kind) {
  if (until_failure[kind] < 0) return 0;
  if (until_failure[kind]-- > 0) return 0;
  errno = EIO;
  return 1;
}
ssize_t write(int fd, const void *data, size_t size) {
  if (fails(calls_write)) {
    if (halves) return syscall(SYS_write, fd, data, size / 2); /* short: the rest must follow */
    return -1;
  }
  return syscall(SYS_write, fd, data, size);
}
int fsync(int fd) { return fails(calls_fsync) ? -1 : (int)syscall(SYS_fsync, fd); }
int rename(const char *from, const char *to) {
  return fails(calls_rename) ? -1 : (int)syscall(SYS_renameat2, AT_FDCWD, from, AT_FDCWD, to, 0);
}
int open(const char *path, int flags, ...) {
  mode_t mode = 0;
  if (fails(calls_open)) return -1;
  if (flags & O_CREAT) {
    va_list rest;
    va_start(rest, flags);
    mode = (mode_t)va_arg(rest, int);
    va_end(rest);
  }
  return (int)syscall(SYS_openat, AT_FDCWD, path, flags, mode);
}
int close(int fd) {
  const int failed = fails(calls_close), result = (int)syscall(SYS_close, fd);
  if (failed) errno = EIO;
  return failed ? -1 : result;
}

typedef jam_status (*writer)(const jam_system *sys, const char *path);
static jam_status write_text(const jam_system *sys, const char *path) { return jam_write(sys, path, 0); }

static void each_failure(writer save, const char *name) {
  OWNED jam_system *old = some_packing(3, 40, 1.4, 1.0), *sys = some_packing(3, 4000, 1.0, 1.0);
  const char *path = in_scratch(name);
  size_t before_size, after_size;
  assert_int_equal(save(sys, path), JAM_OK);
  char *after = get_bytes(path, &after_size);
  assert_int_equal(save(old, path), JAM_OK);
  char *before = get_bytes(path, &before_size);
  int files = count_files();
  for (int kind = 0; kind < kinds; ++kind)
    for (halves = 0; halves < (kind == calls_write ? 2 : 1); ++halves)
      for (long k = 0;; ++k) {
        until_failure[kind] = k;
        jam_status status = save(sys, path);
        int reached = until_failure[kind] < 0;
        until_failure[kind] = -1;
        assert_int_equal(count_files(), files);
        if (status == JAM_OK) {
          assert_bytes(path, after, after_size);
          assert_int_equal(save(old, path), JAM_OK);
        } else {
          SAYS(status, JAM_E_IO, strerror(EIO));
          assert_bytes(path, before, before_size);
        }
        if (!reached) break;
        /* All but what only makes things tidy or safe against a fall of the machine are told. */
        if (kind == calls_rename || (kind == calls_write && !halves) || (k == 0 && kind != calls_close && !halves))
          assert_int_equal(status, JAM_E_IO);
      }
  free(before), free(after);
}

CASE(every_system_call) {
  each_failure(write_text, "faults.dat");
  each_failure(jam_write_checkpoint, "faults.jam");
}

/* One writer after the other is killed; some are caught amid a write. */
CASE(kills) {
  const int times = 150;
  jam_system *sys = some_packing(3, 3000, 1.4, 1.0), *back = NULL;
  const char *path = in_scratch("killed.jam");
  int orphans = 0;
  unsigned random = 12345;
  assert_int_equal(jam_write_checkpoint(sys, path), JAM_OK);
  int files = count_files();
  for (int k = 0; k < times; ++k) {
    const pid_t child = fork();
    assert_true(child >= 0);
    if (child == 0)
      for (;;) jam_write_checkpoint(sys, path);
    random = random * 1664525u + 1013904223u;
    usleep(500 + (random >> 16) % 4000);
    kill(child, SIGKILL);
    waitpid(child, NULL, 0);
    assert_int_equal(jam_read_checkpoint(path, NULL, NULL, &back), JAM_OK);
    assert_same_bits(sys, back);
    jam_destroy(back);
    orphans += count_files() - files;
    assert_true(count_files() - files <= 1); /* each writer removes what the one before left */
  }
  assert_int_equal(jam_write_checkpoint(sys, path), JAM_OK);
  assert_int_equal(count_files(), files);
  print_message("%d of %d kills left a file, which the next writer removed\n", orphans, times);
  jam_destroy(sys);
}

/* How many files beside `path` begin with its name and ".part-". */
static int count_parts(void) {
  int count = 0;
  struct dirent *entry;
  DIR *folder = opendir(scratch);
  while ((entry = readdir(folder)) != NULL) count += strstr(entry->d_name, ".part-") != NULL;
  closedir(folder);
  return count;
}

/* Not an orphan: another process still writes it, or a user made it, whatever its name ends in. */
CASE(files_of_others_stay) {
  OWNED jam_system *sys = some_packing(2, 20000, 1.0, 1.0);
  char path[256];
  const char *users[] = {"mine.dat.part-00", "mine.dat.part-1-2", "mine.dat.part-2024-01-15", "mine.dat.part-old",
                         "mine.dat.part-12-345678-0123456789abcdef"};
  const int count = (int)(sizeof users / sizeof *users);
  int parts = count;
  strcpy(path, in_scratch("mine.dat"));
  for (int k = 0; k < count; ++k) put_bytes(in_scratch(users[k]), "x", 1);
  pid_t child = fork();
  if (child == 0) /* a writer at work */
    for (;;) jam_write(sys, path, 0);
  while (parts == count) { /* stopped amid a file */
    kill(child, SIGCONT);
    usleep(2000);
    kill(child, SIGSTOP);
    usleep(1000);
    parts = count_parts();
  }
  assert_int_equal(jam_write(sys, path, 0), JAM_OK);
  assert_int_equal(count_parts(), count + 1);
  kill(child, SIGKILL);
  waitpid(child, NULL, 0);
  assert_int_equal(jam_write(sys, path, 0), JAM_OK);
  assert_int_equal(count_parts(), count);
  for (int k = 0; k < count; ++k) assert_int_equal(access(in_scratch(users[k]), F_OK), 0);
}

/* The longest names that a file may have, also where the cut falls amid a character of several bytes. */
CASE(long_names) {
  jam_system *sys = some_packing(2, 10, 1.0, 1.0), *back = NULL;
  char name[256], path[512];
  int files;
  for (size_t length = 230; length <= 255; ++length) {
    memset(name, 'a', length);
    for (size_t k = length % 2; k + 1 < length - 4; k += 2) name[k] = '\xc3', name[k + 1] = '\xa4';
    memcpy(name + length - 4, ".dat", 5);
    snprintf(path, sizeof path, "%s/%s", scratch, name);
    files = count_files();
    assert_int_equal(jam_write(sys, path, 0), JAM_OK);
    assert_int_equal(count_files(), files + 1);
    assert_int_equal(jam_read(path, NULL, NULL, NULL, &back), JAM_OK);
    assert_same_bits(sys, back);
    jam_destroy(back);
    assert_int_equal(unlink(path), 0);
  }
  jam_destroy(sys);
}

FIXTURE(make_scratch, remove_scratch)
