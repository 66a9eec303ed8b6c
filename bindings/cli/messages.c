/* What the program says on standard error, kept for the JSON of a job that fails. */
#define _XOPEN_SOURCE 700
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "jam-pack.h"
#include "system.h"

const char *program = "jam-pack";

/* Of this command line: all messages, a line each, the exit code of the first failure, and files that were asked for
 * but are not written. */
static struct {
  char *text;
  size_t size;
  int code;
  const char *omitted[16];
  int omitted_count;
} said;

void forget_messages(void) {
  free(said.text);
  memset(&said, 0, sizeof said);
}

const char *messages(void) { return said.text ? said.text : ""; }

/* Texts of the library name its C functions. A command line has other words for what they do. */
static const struct {
  const char *text, *here;
} phrases[] = {
    {"jam_cancel or the callback", "Ctrl-C or --wall-time"},
    {"jam_cancel or a callback", "Ctrl-C or --wall-time"},
    {"set tolerance to choose", "contacts_from_geometry(tolerance=...) of Python's module jam chooses"},
    {"jam_contacts_by_distance", "--contact-gap"},
    {"jam_write_voxels", "--voxels"},
    {"JAM_MESH_SHRUNK", "--stl-shrink"},
    {"bridge_gap", "--stl-bridge-gap"},
    {"call jam_crunch or jam_contacts_from_geometry first", "the verb crunch makes one"},
    {"jam_read_checkpoint", "--resume"},
    {"jam_read", "--input"},
    {"jam_crunch", "the verb crunch"},
    {"wall_time", "--wall-time"},
    {"call again to continue", "continue from a checkpoint by --resume"},
};
enum { PHRASES = sizeof phrases / sizeof *phrases };

/* A function without a verb or option of its own is one of Python too. */
static size_t put_function(FILE *f, const char *text) {
  const size_t length = strspn(text, "abcdefghijklmnopqrstuvwxyz_");
  const int ends = text[length] == '\0' || strchr(" ,;:", text[length]);
  if (strncmp(text, "jam_", 4) || !ends) return 0;
  fprintf(f, "%.*s() of Python's module jam", (int)length - 4, text + 4);
  return length;
}

/* Replaces at beginnings of words alone, since names of files may hold anything. */
static void put_translated(FILE *f, const char *text) {
  const char *at = text;
  while (*at) {
    size_t taken = 0;
    int k;
    if (at == text || strchr(" (", at[-1])) {
      for (k = 0; k < PHRASES && !taken; ++k) {
        const size_t length = strlen(phrases[k].text);
        if (strncmp(at, phrases[k].text, length) || (at[length] && !strchr(" ,;:", at[length]))) continue;
        fputs(phrases[k].here, f);
        taken = length;
      }
      if (!taken) taken = put_function(f, at);
    }
    if (!taken) fputc(*at, f), taken = 1;
    at += taken;
  }
}

/* Without memory for a copy the line stands on standard error alone. */
static void keep_line(const char *line) {
  const size_t length = strlen(line);
  char *const longer = realloc(said.text, said.size + length + 2);
  if (!longer) return;
  if (said.size) longer[said.size++] = '\n';
  memcpy(longer + said.size, line, length + 1);
  said.text = longer, said.size += length;
}

void in_own_words(const char *text, char *out, size_t size) {
  char *own;
  size_t length;
  FILE *const f = open_text(&own, &length);
  if (f) put_translated(f, text);
  snprintf(out, size, "%s", f && !close_text(f, &own, &length) ? own : text);
  free(own);
}

void complain(const char *format, ...) {
  char text[4096], line[6144];
  va_list args;
  va_start(args, format);
  vsnprintf(text, sizeof text, format, args);
  va_end(args);
  in_own_words(text, line, sizeof line);
  fprintf(stderr, "%s: %s\n", program, line);
  keep_line(line);
}

void note_omitted(const char *path) {
  if (path && said.omitted_count < (int)(sizeof said.omitted / sizeof *said.omitted))
    said.omitted[said.omitted_count++] = path;
}

int missing(const char *path, int bad) {
  if (bad && !is_omitted(path)) note_omitted(path);
  return bad;
}

int is_omitted(const char *path) {
  int k;
  for (k = 0; k < said.omitted_count; ++k)
    if (said.omitted[k] == path) return 1;
  return 0;
}

void note_failure(int code) {
  if (!said.code) said.code = code;
}

int failure_code(void) { return said.code ? said.code : EXIT_OUTPUT; }

/* A value that the library refuses is a wrong command line. */
int code_of(jam_status status) {
  return status == JAM_CANCELLED    ? EXIT_EARLY
         : status == JAM_E_ARGUMENT ? EXIT_USAGE
         : status == JAM_E_IO       ? EXIT_OUTPUT
                                    : EXIT_FAILED;
}

int has_failed(jam_status status) {
  const int bad = status < 0 || status == JAM_CANCELLED;
  if (!bad) return 0;
  complain("%s", jam_last_error());
  note_failure(code_of(status));
  return 1;
}
