/* How texts of jam-pack become files: as those of the library do, under another name and renamed, or in place. */
#define _XOPEN_SOURCE 700
#include <errno.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include "jam-pack.h"

static int cannot(const char *path) {
  complain("cannot write %s: %s", path, strerror(errno));
  note_failure(EXIT_OUTPUT);
  return -1;
}

int check_writable(const char *path, void *unused) {
  struct stat there;
  char folder[4096];
  const char *slash;
  (void)unused;
  if (!path || !strcmp(path, "-")) return 0;
  if (stat(path, &there) == 0) {
    if (S_ISDIR(there.st_mode)) errno = EISDIR;
    if (S_ISDIR(there.st_mode) || access(path, W_OK)) return cannot(path);
    if (!S_ISREG(there.st_mode)) return 0;
  }
  slash = strrchr(path, '/');
  snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - path + 1) : 1, slash ? path : ".");
  return access(folder, W_OK | X_OK) ? cannot(path) : 0;
}

int open_output(output *out, const char *path) {
  out->path = path;
  out->text = NULL;
  out->file = open_memstream(&out->text, &out->size);
  return out->file ? 0 : cannot(path);
}

/* All of it, also after signals; 0 or -1. */
static int put(int fd, const char *text, size_t size) {
  while (size > 0) {
    const ssize_t done = write(fd, text, size);
    if (done < 0 && errno == EINTR) continue;
    if (done < 0) return -1;
    text += done, size -= (size_t)done;
  }
  return 0;
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

/* Into the folder of the target under a short name of its own, then renamed. A killed program leaves at most this file,
 * in the moment in which it is written. */
static int put_beside(const output *out) {
  struct stat there;
  char *const real = realpath(out->path, NULL); /* a link stays a link */
  const char *const target = real ? real : out->path, *const slash = strrchr(target, '/');
  const size_t folder = slash ? (size_t)(slash - target) + 1 : 0;
  const mode_t mask = umask(0);
  const mode_t mode = real && stat(real, &there) == 0 ? there.st_mode & 07777 : 0666 & ~mask;
  char *const beside = malloc(folder + 32);
  int bad = -1, fd = -1, error;
  umask(mask);
  if (beside) {
    snprintf(beside, folder + 32, "%.*s.jam-pack-XXXXXX", (int)folder, target);
    fd = mkstemp(beside);
  }
  if (fd >= 0) {
    bad = put(fd, out->text, out->size) || fchmod(fd, mode) || fsync(fd);
    error = errno;
    if (close(fd) && !bad) bad = -1, error = errno;
    if (!bad && rename(beside, target)) bad = -1, error = errno;
    if (bad) remove(beside);
    errno = error;
  }
  free(beside);
  free(real);
  return bad ? -1 : 0;
}

int close_output(output *out) {
  struct stat there;
  const int descriptor = descriptor_of(out->path), bad = ferror(out->file) | fclose(out->file);
  int failed = bad;
  if (bad) {
    errno = ENOMEM;
  } else if (descriptor >= 0) {
    failed = fflush(stdout) || put(descriptor, out->text, out->size);
  } else if (stat(out->path, &there) == 0 && !S_ISREG(there.st_mode)) {
    const int fd = open(out->path, O_WRONLY);
    failed = fd < 0 || put(fd, out->text, out->size);
    if (fd >= 0) failed |= close(fd);
  } else {
    failed = put_beside(out);
  }
  if (failed) cannot(out->path);
  free(out->text);
  return failed ? -1 : 0;
}
