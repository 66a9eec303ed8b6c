#include <windows.h>

#include <errno.h>
#include <fcntl.h>
#include <io.h>
#include <process.h>
#include <shellapi.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include "jam-pack.h"
#include "system.h"

/* Both return NULL where memory runs out; the caller frees the text. */
static wchar_t *wide(const char *text) {
  const int size = MultiByteToWideChar(CP_UTF8, 0, text, -1, NULL, 0);
  wchar_t *const out = malloc((size_t)size * sizeof *out);
  if (out) MultiByteToWideChar(CP_UTF8, 0, text, -1, out, size);
  return out;
}

static char *narrow(const wchar_t *text) {
  const int size = WideCharToMultiByte(CP_UTF8, 0, text, -1, NULL, 0, NULL, NULL);
  char *const out = malloc((size_t)size);
  if (out) WideCharToMultiByte(CP_UTF8, 0, text, -1, out, size, NULL, NULL);
  return out;
}

file_kind kind_of(const char *path) {
  struct _stat64 there;
  wchar_t *const name = wide(path);
  const int bad = !name || _wstat64(name, &there);
  free(name);
  if (bad) return KIND_NONE;
  return there.st_mode & _S_IFDIR ? KIND_FOLDER : there.st_mode & _S_IFREG ? KIND_FILE : KIND_OTHER;
}

int may_write(const char *path) {
  wchar_t *const name = wide(path);
  const int bad = name ? _waccess(name, 2) : -1;
  free(name);
  return bad;
}

/* Rights to create are known when a file is created; that the folder is there is known now. */
int may_create(const char *path) {
  char folder[4096];
  size_t end = strlen(path);
  while (end > 0 && !strchr("/\\:", path[end - 1])) --end;
  snprintf(folder, sizeof folder, "%.*s.", (int)end, path);
  if (kind_of(folder) == KIND_FOLDER) return 0;
  errno = ENOENT;
  return -1;
}

/* In small letters, since names that differ in the case of letters are one. */
char *resolve(const char *path) {
  wchar_t *const name = wide(path), whole[4096];
  const DWORD length = name ? GetFullPathNameW(name, 4096, whole, NULL) : 0;
  free(name);
  if (length == 0 || length >= 4096) return NULL;
  CharLowerW(whole);
  return narrow(whole);
}

FILE *open_stream(const char *path, const char *mode) {
  wchar_t *const name = wide(path), *const how = wide(mode);
  FILE *const file = name && how ? _wfopen(name, how) : NULL;
  free(name);
  free(how);
  return file;
}

void ignore_signals_of_writes(int yes) { (void)yes; } /* the system has no such signals */
void keep_standard_descriptors(void) {}

int open_in_place(const char *path) {
  wchar_t *const name = wide(path);
  const int fd = name ? _wopen(name, _O_WRONLY | _O_BINARY) : -1;
  free(name);
  return fd;
}

/* The system has no streams into memory: a file among the temporary ones, which goes when it is closed. */
FILE *open_text(char **text, size_t *size) {
  wchar_t folder[MAX_PATH + 1], name[MAX_PATH + 1];
  FILE *file;
  int fd;
  *text = NULL, *size = 0;
  if (!GetTempPathW(MAX_PATH + 1, folder) || !GetTempFileNameW(folder, L"jam", 0, name)) {
    errno = EACCES;
    return NULL;
  }
  fd = _wopen(name, _O_RDWR | _O_BINARY | _O_TEMPORARY | _O_NOINHERIT);
  if (fd < 0) return NULL;
  file = _fdopen(fd, "w+b");
  if (!file) _close(fd);
  return file;
}

int close_text(FILE *file, char **text, size_t *size) {
  const long long length = fflush(file) || ferror(file) ? -1 : _ftelli64(file);
  int bad = length < 0;
  if (!bad) {
    *size = (size_t)length;
    *text = malloc(*size + 1);
    rewind(file);
    bad = !*text || fread(*text, 1, *size, file) != *size;
  }
  bad |= fclose(file) != 0;
  if (bad) {
    free(*text);
    *text = NULL;
    errno = ENOMEM;
    return -1;
  }
  (*text)[*size] = '\0';
  return 0;
}

int replace_file(const char *path, const char *text, size_t size) {
  const size_t room = strlen(path) + 32;
  char *const name = malloc(room);
  wchar_t *const target = wide(path), *beside = NULL;
  int fd = -1, bad = -1, error = errno;
  if (name && target) {
    snprintf(name, room, "%s.jam-pack-%lu", path, (unsigned long)GetCurrentProcessId());
    beside = wide(name);
  }
  if (beside) {
    fd = _wopen(beside, _O_WRONLY | _O_CREAT | _O_EXCL | _O_BINARY | _O_NOINHERIT, _S_IREAD | _S_IWRITE);
    error = errno;
  }
  if (fd >= 0) {
    bad = put_bytes(fd, text, size) || _commit(fd);
    error = errno;
    if (_close(fd) && !bad) bad = -1, error = errno;
    if (!bad && !MoveFileExW(beside, target, MOVEFILE_REPLACE_EXISTING | MOVEFILE_WRITE_THROUGH))
      bad = -1, error = EACCES;
    if (bad) _wremove(beside);
  }
  free(name);
  free(target);
  free(beside);
  errno = error;
  return bad ? -1 : 0;
}

static void (*before_interrupt)(int number), (*before_terminate)(int number);

void take_signals(void (*handler)(int number)) {
  before_interrupt = signal(SIGINT, handler);
  before_terminate = signal(SIGTERM, handler);
}

void give_signals_back(void) {
  signal(SIGINT, before_interrupt);
  signal(SIGTERM, before_terminate);
}

/* Those of main are in the code page of the system, which may lack letters of a name. They are never freed. */
void take_words(int *argc, char ***argv) {
  int count, k;
  wchar_t **const given = CommandLineToArgvW(GetCommandLineW(), &count);
  char **const words = given ? calloc((size_t)count + 1, sizeof *words) : NULL;
  for (k = 0; words && k < count; ++k)
    if (!(words[k] = narrow(given[k]))) return;
  if (words) *argc = count, *argv = words;
}

int run_shell(const char *line) { return system(line); }

void become(char **words) {
  const intptr_t code = _spawnvp(_P_WAIT, words[0], (const char *const *)words);
  if (code != -1) exit((int)code);
}
