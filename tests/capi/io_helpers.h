/* Shared by tests/capi/io_*.c: a scratch folder, files with given content, errors with text. */
#ifndef JAM_TEST_IO_HELPERS_H
#define JAM_TEST_IO_HELPERS_H
#ifndef _XOPEN_SOURCE
#define _XOPEN_SOURCE 700
#endif
#include <dirent.h>
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>
#include "systems.h"

static char scratch[64];

#if defined(_WIN32)
#define REMOVE_FOLDER "rmdir /s /q %s"
static inline int make_scratch(void **state) {
  (void)state;
  snprintf(scratch, sizeof scratch, "jam-io-%d", (int)getpid());
  return mkdir(scratch);
}
#else
#define REMOVE_FOLDER "rm -rf '%s'"
static inline int make_scratch(void **state) {
  (void)state;
  strcpy(scratch, "/tmp/jam-io-XXXXXX");
  return mkdtemp(scratch) ? 0 : -1;
}
#endif

static inline int remove_scratch(void **state) {
  char command[96];
  (void)state;
  snprintf(command, sizeof command, REMOVE_FOLDER, scratch);
  return system(command);
}

static inline int count_files(void) {
  int count = 0;
  struct dirent *entry;
  DIR *folder = opendir(scratch);
  while ((entry = readdir(folder)) != NULL) count += entry->d_name[0] != '.';
  closedir(folder);
  return count;
}

static inline const char *in_scratch(const char *name) {
  static char path[4][256];
  static int turn = 0;
  turn = (turn + 1) % 4;
  snprintf(path[turn], sizeof path[turn], "%s/%s", scratch, name);
  return path[turn];
}

static inline void put_bytes(const char *path, const char *bytes, size_t size) {
  FILE *f = fopen(path, "wb");
  assert_non_null(f);
  assert_int_equal(fwrite(bytes, 1, size, f), size);
  assert_int_equal(fclose(f), 0);
}

static inline char *get_bytes(const char *path, size_t *size) {
  FILE *f = fopen(path, "rb");
  char *bytes;
  long end;
  assert_non_null(f);
  fseek(f, 0, SEEK_END);
  end = ftell(f);
  rewind(f);
  bytes = (char *)malloc((size_t)end + 1);
  *size = fread(bytes, 1, (size_t)end, f);
  bytes[*size] = '\0';
  fclose(f);
  return bytes;
}

static inline void assert_bytes(const char *path, const char *bytes, size_t size) {
  size_t now;
  char *text = get_bytes(path, &now);
  assert_int_equal(now, size);
  assert_memory_equal(text, bytes, size);
  free(text);
}

/* Reads a file with these bytes; layout, o: what the caller says of it, or NULL. */
static inline jam_status read_bytes(const char *bytes, size_t size, const char *layout, const jam_create_options *o,
                                    jam_system **sys) {
  const char *path = in_scratch("in.any");
  put_bytes(path, bytes, size);
  return layout ? jam_read_as(path, layout, o, NULL, NULL, sys) : jam_read(path, o, NULL, NULL, sys);
}

static inline jam_system *read_as(const char *text, const char *layout, const jam_create_options *o) {
  jam_system *sys = NULL;
  if (read_bytes(text, strlen(text), layout, o, &sys) != JAM_OK)
    fail_msg("%s; layout '%s', input:\n%s", jam_last_error(), layout ? layout : "", text);
  return sys;
}
static inline jam_system *read_text(const char *text) { return read_as(text, NULL, NULL); }

/* Reading `text` must give `status`, with `part` in the message, and no handle. */
static inline void expect_refused_as(const char *text, const char *layout, const jam_create_options *o,
                                     jam_status status, const char *part) {
  jam_system *sys = NULL;
  const jam_status got = read_bytes(text, strlen(text), layout, o, &sys);
  if (got != status || !strstr(jam_last_error(), part))
    fail_msg("status %d, expected %d; text '%s', expected '%s' in it; input:\n%s", got, status, jam_last_error(), part,
             text);
  assert_null(sys);
}
static inline void expect_refused(const char *text, jam_status status, const char *part) {
  expect_refused_as(text, NULL, NULL, status, part);
}

/* The system has these numbers; it is freed. */
static inline void expect(jam_system *sys, int32_t dim, int64_t n, const double *x, const double *diameters) {
  const jam_info info = info_of(sys);
  assert_int_equal(info.dim, dim);
  assert_int_equal(info.n, n);
  assert_memory_equal(view_of(sys, JAM_VIEW_POSITIONS), x, (size_t)(n * dim) * sizeof *x);
  assert_memory_equal(view_of(sys, JAM_VIEW_DIAMETERS), diameters, (size_t)n * sizeof *diameters);
  jam_destroy(sys);
}

/* The system, whose notes have this part. */
static inline jam_system *noted(jam_system *sys, const char *part) {
  if (!strstr(jam_notes(sys), part)) fail_msg("'%s' does not contain '%s'", jam_notes(sys), part);
  return sys;
}

/* n spheres at random, diameters 50:50 with the given ratio. */
static inline jam_system *some_packing(int32_t dim, int64_t n, double ratio, double box) {
  double *diameters = (double *)malloc((size_t)n * sizeof *diameters);
  int64_t i;
  for (i = 0; i < n; ++i) diameters[i] = i % 2 ? ratio : 1.0;
  DEFAULTS(create, o);
  o.dim = dim;
  o.n = n;
  o.box = box;
  o.seed = 7;
  o.packing_fraction = 0.02; /* d = 8 saturates below 0.1 */
  jam_system *sys = created_from(&o, NULL, 0, diameters, (size_t)n);
  free(diameters);
  return sys;
}

static inline void assert_same_bits(const jam_system *a, const jam_system *b) {
  const jam_info ia = info_of(a), ib = info_of(b);
  assert_int_equal(ia.dim, ib.dim);
  assert_int_equal(ia.n, ib.n);
  assert_memory_equal(&ia.box, &ib.box, sizeof ia.box);
  same_view(a, b, JAM_VIEW_POSITIONS);
  same_view(a, b, JAM_VIEW_DIAMETERS);
}
#endif
