/* How texts of jam-pack become files: as those of the library do, under another name and renamed, or in place. */
#define _XOPEN_SOURCE 700
#include <errno.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>
#include "jam-pack.h"
#include "system.h"

static int cannot(const char *path) {
  complain("cannot write %s: %s", path, strerror(errno));
  note_failure(EXIT_OUTPUT);
  return -1;
}

/* The number of an open descriptor that a name stands for, else -1. A rename would miss what the shell has opened: a
 * pipe, or a file that it appends to. */
static int descriptor_of(const char *path) {
  static const char *const folders[] = {"/dev/fd/", "/proc/self/fd/"};
  size_t k;
  if (!strcmp(path, "-") || !strcmp(path, "/dev/stdout")) return STDOUT_FILENO;
  if (!strcmp(path, "/dev/stderr")) return STDERR_FILENO;
  for (k = 0; k < sizeof folders / sizeof *folders; ++k) {
    const size_t length = strlen(folders[k]), digits = strlen(path) > length ? strlen(path + length) : 0;
    if (!strncmp(path, folders[k], length) && digits > 0 && digits < 9 && strspn(path + length, "0123456789") == digits)
      return atoi(path + length);
  }
  return -1;
}

int is_stdout(const char *path) { return descriptor_of(path) == STDOUT_FILENO; }

int appears_whole(const char *path) {
  return descriptor_of(path) < 0 && (kind_of(path) == KIND_NONE || kind_of(path) == KIND_FILE);
}

int check_writable(const char *path, void *unused) {
  file_kind kind;
  (void)unused;
  if (!path || descriptor_of(path) >= 0) return 0; /* open already: its folder, as /dev, takes no file of most users */
  kind = kind_of(path);
  if (kind == KIND_FOLDER) errno = EISDIR;
  if (kind == KIND_FOLDER || (kind != KIND_NONE && may_write(path))) return cannot(path);
  if (kind == KIND_OTHER) return 0;
  return may_create(path) ? cannot(path) : 0;
}

int end_stdout(int code) {
  const int now = fflush(stdout);
  if (!now && !ferror(stdout)) return code;
  complain("cannot write standard output%s%s", now ? ": " : "", now ? strerror(errno) : "");
  clearerr(stdout);
  return EXIT_OUTPUT;
}

int open_output(output *out, const char *path) {
  out->path = path;
  out->file = open_text(&out->text, &out->size);
  return out->file ? 0 : cannot(path);
}

int put_bytes(int fd, const char *text, size_t size) {
  int error = 0;
  ignore_signals_of_writes(1);
  while (size > 0 && !error) {
    const size_t most = size < 1 << 30 ? size : 1 << 30; /* Windows counts in ints */
    const ssize_t done = write(fd, text, most);
    if (done >= 0)
      text += done, size -= (size_t)done;
    else if (errno != EINTR)
      error = errno;
  }
  ignore_signals_of_writes(0);
  errno = error ? error : errno;
  return error ? -1 : 0;
}

int close_output(output *out) {
  const int descriptor = descriptor_of(out->path);
  int failed = close_text(out->file, &out->text, &out->size);
  if (!failed && descriptor >= 0) {
    failed = fflush(stdout) || put_bytes(descriptor, out->text, out->size);
  } else if (!failed && kind_of(out->path) == KIND_OTHER) {
    const int fd = open_in_place(out->path);
    failed = fd < 0 || put_bytes(fd, out->text, out->size);
    if (fd >= 0) failed |= close(fd);
  } else if (!failed) {
    failed = replace_file(out->path, out->text, out->size);
  }
  if (failed) cannot(out->path);
  free(out->text);
  return failed ? -1 : 0;
}
