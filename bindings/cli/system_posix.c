#define _XOPEN_SOURCE 700
#include <errno.h>
#include <fcntl.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>
#include "jam-pack.h"
#include "system.h"

file_kind kind_of(const char *path) {
  struct stat there;
  if (stat(path, &there)) return KIND_NONE;
  return S_ISDIR(there.st_mode) ? KIND_FOLDER : S_ISREG(there.st_mode) ? KIND_FILE : KIND_OTHER;
}

int may_write(const char *path) { return access(path, W_OK); }

int may_create(const char *path) {
  const char *const slash = strrchr(path, '/');
  char folder[4096];
  snprintf(folder, sizeof folder, "%.*s", slash ? (int)(slash - path + 1) : 1, slash ? path : ".");
  return access(folder, W_OK | X_OK);
}

/* A link whose file is not there yet leads to the place where it would be made. */
static char *resolve_links(const char *path, int links) {
  const char *const slash = strrchr(path, '/');
  const int head_length = slash ? (int)(slash - path) + 1 : 0;
  char *whole = realpath(path, NULL), *folder, *head, target[4096], next[8192];
  const ssize_t length = whole || links == 0 ? -1 : readlink(path, target, sizeof target - 1);
  if (whole) return whole;
  if (length > 0) {
    target[length] = '\0';
    if (snprintf(next, sizeof next, "%.*s%s", *target == '/' ? 0 : head_length, path, target) < (int)sizeof next)
      return resolve_links(next, links - 1);
  }
  head = slash ? strdup(path) : strdup(".");
  if (!head) return NULL;
  if (slash) head[slash == path ? 1 : slash - path] = '\0';
  folder = realpath(head, NULL);
  free(head);
  if (!folder) return NULL;
  whole = malloc(strlen(folder) + strlen(path) + 2);
  if (whole) sprintf(whole, "%s/%s", folder, slash ? slash + 1 : path);
  free(folder);
  return whole;
}

char *resolve(const char *path) { return resolve_links(path, 40); }

FILE *open_stream(const char *path, const char *mode) { return fopen(path, mode); }

int open_in_place(const char *path) { return open(path, O_WRONLY); }

void ignore_signals_of_writes(int yes) {
  static struct sigaction before_pipe, before_size;
  struct sigaction own;
  memset(&own, 0, sizeof own);
  own.sa_handler = SIG_IGN;
  sigaction(SIGPIPE, yes ? &own : &before_pipe, yes ? &before_pipe : NULL);
  sigaction(SIGXFSZ, yes ? &own : &before_size, yes ? &before_size : NULL);
}

void keep_standard_descriptors(void) {
  int fd;
  for (fd = STDIN_FILENO; fd <= STDERR_FILENO; ++fd)
    if (fcntl(fd, F_GETFD) < 0) (void)!open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

FILE *open_text(char **text, size_t *size) {
  *text = NULL;
  return open_memstream(text, size);
}

int close_text(FILE *file, char **text, size_t *size) {
  const int bad = ferror(file);
  (void)size;
  if (!fclose(file) && !bad) return 0;
  free(*text);
  *text = NULL;
  errno = ENOMEM;
  return -1;
}

/* Owner, where the system lets it, and permissions; never the bits that lend the rights of the owner. Rights of a group
 * that the file cannot be given are no rights of another group. */
static int keep_rights(int fd, const struct stat *there, mode_t mode) {
  if (there && there->st_uid != geteuid()) (void)!fchown(fd, there->st_uid, (gid_t)-1);
  if (there && fchown(fd, (uid_t)-1, there->st_gid)) mode = (mode & ~(mode_t)070) | (mode & 07) << 3;
  return fchmod(fd, mode);
}

int replace_file(const char *path, const char *text, size_t size) {
  struct stat there;
  char *const real = resolve(path); /* a link stays a link, also where it leads to no file yet */
  const char *const target = real ? real : path, *const slash = strrchr(target, '/');
  const size_t folder = slash ? (size_t)(slash - target) + 1 : 0;
  const mode_t mask = umask(0);
  const int is_there = stat(target, &there) == 0;
  const mode_t mode = is_there ? there.st_mode & 0777 : 0666 & ~mask;
  char *const beside = malloc(folder + 32);
  int bad = -1, fd = -1, error;
  umask(mask);
  if (beside) {
    snprintf(beside, folder + 32, "%.*s.jam-pack-XXXXXX", (int)folder, target);
    fd = mkstemp(beside);
  }
  if (fd >= 0) {
    bad = put_bytes(fd, text, size) || keep_rights(fd, is_there ? &there : NULL, mode) || fsync(fd);
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

static struct sigaction before_interrupt, before_terminate, before_size;

void take_signals(void (*handler)(int number)) {
  struct sigaction own;
  memset(&own, 0, sizeof own);
  own.sa_handler = handler;
  sigemptyset(&own.sa_mask);
  sigaction(SIGINT, &own, &before_interrupt);
  sigaction(SIGTERM, &own, &before_terminate);
  own.sa_handler = SIG_IGN;
  sigaction(SIGXFSZ, &own, &before_size);
}

void give_signals_back(void) {
  sigaction(SIGINT, &before_interrupt, NULL);
  sigaction(SIGTERM, &before_terminate, NULL);
  sigaction(SIGXFSZ, &before_size, NULL);
}

void take_words(int *argc, char ***argv) { (void)argc, (void)argv; }

int run_shell(const char *line) {
  const int status = system(line);
  if (WIFSIGNALED(status) ? WTERMSIG(status) == SIGINT : WEXITSTATUS(status) == 128 + SIGINT) raise(SIGINT);
  return status;
}

void become(char **words) { execvp(words[0], words); }
