/* Pipes and open files: signals do not end a read, limits end a silent one, and what is open is written in place. */
#include <fcntl.h>
#include <signal.h>
#include <sys/time.h>
#include <sys/wait.h>
#include "io_helpers.h"
#include "steps.h"

static void ignore_signal(int number) { (void)number; }

static void ring(suseconds_t every) {
  struct itimerval timer = {{0, every}, {0, every}};
  struct sigaction action = {0};
  action.sa_handler = ignore_signal; /* without SA_RESTART, as those of Python */
  sigaction(SIGALRM, &action, NULL);
  setitimer(ITIMER_REAL, &timer, NULL);
}

/* Feeds a file into a pipe: its first bytes alone, then some thousands at a time; several times a read is amid one of
 * zlib's blocks. */
static pid_t feed(const char *file, const char *fifo, size_t first) {
  const pid_t child = fork();
  size_t size;
  if (child) return child;
  char *bytes = get_bytes(file, &size);
  int fd = open(fifo, O_WRONLY);
  for (size_t at = 0, part = first; at < size; at += part, part = 7000) {
    if (write(fd, bytes + at, size - at < part ? size - at : part) < 0) _exit(1);
    usleep(3000);
  }
  _exit(0);
}

CASE(signals_do_not_end_a_read) {
  jam_system *sys = some_packing(3, 3000, 1.4, 1.0), *back = NULL;
  const char *names[] = {"plain.dat", "packed.xyz.gz", "plain.xyz", "state.chk", "state.chk.gz"};
  char fifo[256];
  strcpy(fifo, in_scratch("fifo"));
  assert_int_equal(mkfifo(fifo, 0600), 0);
  for (int k = 0; k < 5; ++k) {
    const char *name = in_scratch(names[k]);
    assert_int_equal(k > 2 ? jam_write_checkpoint(sys, name) : jam_write(sys, name, 0), JAM_OK);
    pid_t child = feed(name, fifo, 5); /* "3000\n" of plain.xyz: one line does not show a format */
    ring(1000);
    assert_int_equal(k > 2 ? jam_read_checkpoint(fifo, NULL, NULL, &back) : jam_read(fifo, NULL, NULL, NULL, &back),
                     JAM_OK);
    ring(0);
    assert_same_bits(sys, back);
    jam_destroy(back);
    waitpid(child, NULL, 0);
  }
  jam_destroy(sys);
}

/* Nobody writes: the limit of time and the callback end the call. */
CASE(silent_pipes_are_left) {
  jam_system *sys = NULL;
  char fifo[256];
  strcpy(fifo, in_scratch("silent"));
  assert_int_equal(mkfifo(fifo, 0600), 0);
  DEFAULTS(create, o);
  o.wall_time = 0.1;
  assert_int_equal(jam_read(fifo, &o, NULL, NULL, &sys), JAM_LIMIT);
  assert_int_equal(jam_read_checkpoint(fifo, stop_at_once, NULL, &sys), JAM_CANCELLED);
  int writer = open(fifo, O_RDWR); /* connected, and still silent */
  assert_int_equal(jam_read(fifo, &o, NULL, NULL, &sys), JAM_LIMIT);
  close(writer);
  assert_null(sys);
}

/* A compressed file, made by a shell command whose output is its text. */
static void pack(const char *text, const char *path, int append) {
  char command[600];
  snprintf(command, sizeof command, "( %s ) | gzip -1 %s '%s'", text, append ? ">>" : ">", path);
  assert_int_equal(system(command), 0);
}

/* A small compressed file can hold much: blank lines, or spheres. */
CASE(reading_keeps_to_its_limits) {
  jam_create_options o;
  jam_system *sys = NULL;
  const char *path = in_scratch("much.dat.gz");
  pack("printf '3\\n1\\n0.1\\n'; yes '' | head -c 300000000; echo 0 0 0", path, 0);
  assert_int_equal(jam_create_options_init(&o, sizeof o), JAM_OK);
  o.wall_time = 0.1;
  assert_int_equal(jam_read(path, &o, NULL, NULL, &sys), JAM_LIMIT);
  assert_int_equal(jam_read(path, NULL, stop_at_once, NULL, &sys), JAM_CANCELLED);

  pack("printf '3\\n200000\\n1e-5\\n'; yes '0 0 0' | head -n 200000", path, 0);
  assert_int_equal(jam_create_options_init(&o, sizeof o), JAM_OK);
  o.memory_limit = 1e6;
  SAYS(jam_read(path, &o, NULL, NULL, &sys), JAM_E_MEMORY, "much.dat.gz");

  /* A negative frame keeps all those behind it. */
  pack(
      "for k in $(seq 100); do printf '4000\nLattice=\"1 0 0 0 1 0 0 0 1\" Properties=pos:R:3:radius:R:1\n'; "
      "yes '0 0 0 1e-9' | head -n 4000; done",
      path, 0);
  o.frame = -100;
  SAYS(jam_read(path, &o, NULL, NULL, &sys), JAM_E_MEMORY, "the frames of ");
  assert_null(sys);
}

/* Members of gzip's format behind each other are one text; what else stands behind them is refused. */
CASE(gzip_members) {
  jam_system *sys = NULL;
  const char *path = in_scratch("members.dat.gz");
  FILE *more;
  pack("printf '1\\n'", path, 0); /* this line alone is no packing */
  pack("printf 'Lattice=\"1 0 0 0 1 0 0 0 1\" Properties=pos:R:3:radius:R:1\\n0.25 0.'", path, 1);
  pack("printf '5 0.75 0.1\\n'", path, 1);
  assert_int_equal(jam_read(path, NULL, NULL, NULL, &sys), JAM_OK);
  jam_destroy(sys);
  sys = NULL;
  more = fopen(path, "ab");
  fputs("0.1 0.1 0.1\n", more);
  fclose(more);
  assert_int_equal(jam_read(path, NULL, NULL, NULL, &sys), JAM_E_FORMAT);
  assert_null(sys);
}

/* What a shell does with >>: earlier and later lines stay, also where a link leads there. */
CASE(open_files_are_appended_to) {
  OWNED jam_system *sys = some_packing(3, 5, 1.0, 1.0);
  const char *path = in_scratch("log.txt"), *plain = in_scratch("alone.dat");
  char names[3][256], *text, *packing;
  const int fd = open(path, O_WRONLY | O_CREAT | O_APPEND, 0600);
  size_t size, one;
  assert_int_equal(jam_write(sys, plain, JAM_FORMAT_PLAIN), JAM_OK);
  packing = get_bytes(plain, &one);
  sprintf(names[0], "/dev/fd/%d", fd);
  sprintf(names[1], "/proc/%ld/fd/%d", (long)getpid(), fd);
  strcpy(names[2], in_scratch("to-the-log"));
  assert_int_equal(symlink(names[0], names[2]), 0);
  assert_int_equal(write(fd, "before\n", 7), 7);
  for (int k = 0; k < 3; ++k) assert_int_equal(jam_write(sys, names[k], JAM_FORMAT_PLAIN), JAM_OK);
  assert_int_equal(write(fd, "after\n", 6), 6);
  text = get_bytes(path, &size);
  assert_int_equal(size, 7 + 3 * one + 6);
  assert_memory_equal(text, "before\n", 7);
  for (int k = 0; k < 3; ++k) assert_memory_equal(text + 7 + k * one, packing, one);
  assert_string_equal(text + 7 + 3 * one, "after\n");
  free(text), free(packing);
  close(fd);
  assert_int_equal(jam_write(sys, names[0], JAM_FORMAT_PLAIN), JAM_E_IO); /* closed */
}

/* A file appears whole or not at all. What a pipe has taken, no call takes back: it is told. */
CASE(stopped_writes_say_what_a_pipe_has_taken) {
  OWNED jam_system *sys = some_packing(3, 20000, 1.0, 1.0);
  char fifo[256], part[4096] = {0};
  strcpy(fifo, in_scratch("taken"));
  assert_int_equal(mkfifo(fifo, 0600), 0);
  int ends = open(fifo, O_RDWR | O_NONBLOCK);
  assert_int_equal(jam_set_progress(sys, stop_at_once, NULL), JAM_OK);
  while (write(ends, part, sizeof part) > 0) {
  }
  SAYS(jam_write(sys, fifo, JAM_FORMAT_XYZ), JAM_CANCELLED, "nothing was changed or written"); /* it was full */
  while (read(ends, part, sizeof part) > 0) {
  }
  SAYS(jam_write(sys, fifo, JAM_FORMAT_XYZ), JAM_CANCELLED, "has a part of the file");
  assert_null(strstr(jam_last_error(), "nothing was changed or written"));
  close(ends);
}

FIXTURE(make_scratch, remove_scratch)
