/* Parts of a JSON object, a line each, which ends with a comma. */
#include <math.h>
#include <stdio.h>
#include <string.h>
#include "jam-pack.h"

/* JSON has no NaN and no infinity. */
void put_number(FILE *f, const char *key, double x) {
  if (isfinite(x))
    fprintf(f, "  \"%s\": %.17g,\n", key, x);
  else
    fprintf(f, "  \"%s\": null,\n", key);
}

void put_count(FILE *f, const char *key, int64_t x, int known) {
  if (known)
    fprintf(f, "  \"%s\": %lld,\n", key, (long long)x);
  else
    fprintf(f, "  \"%s\": null,\n", key);
}

/* A verdict that is open is null. */
void put_verdict(FILE *f, const char *key, int32_t verdict) {
  fprintf(f, "  \"%s\": %s,\n", key,
          verdict == JAM_VERDICT_YES  ? "true"
          : verdict == JAM_VERDICT_NO ? "false"
                                      : "null");
}

/* Bytes of the character of UTF-8 that begins here (RFC 3629), 0 where none does. */
static size_t character_length(const unsigned char *c) {
  const unsigned first = c[0], second = c[1];
  const size_t length = first < 0x80                    ? 1
                        : first >= 0xc2 && first < 0xe0 ? 2
                        : (first & 0xf0u) == 0xe0       ? 3
                        : first >= 0xf0 && first < 0xf5 ? 4
                                                        : 0;
  size_t k;
  for (k = 1; k < length; ++k)
    if ((c[k] & 0xc0u) != 0x80) return 0;
  return (first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f) || (first == 0xf0 && second < 0x90) ||
                 (first == 0xf4 && second > 0x8f)
             ? 0
             : length;
}

/* Names of files may hold bytes that are not UTF-8, and JSON must not: they show as \xff. */
void put_text(FILE *f, const char *text) {
  size_t length;
  fputc('"', f);
  for (; *text; text += length) {
    const unsigned char first = (unsigned char)*text;
    length = character_length((const unsigned char *)text);
    if (length == 0) {
      fprintf(f, "\\\\x%02x", first);
      length = 1;
    } else if (first == '"' || first == '\\') {
      fprintf(f, "\\%c", first);
    } else if (first < ' ') {
      fprintf(f, "\\u%04x", first);
    } else {
      fwrite(text, 1, length, f);
    }
  }
  fputc('"', f);
}

void put_stress(FILE *f, const double *stress, size_t numbers) {
  size_t k;
  fputs("  \"stress_tensor\": ", f);
  for (k = 0; k < numbers; ++k) fprintf(f, "%s%.17g", k ? ", " : "[", stress[k]);
  fputs(numbers ? "],\n" : "null,\n", f);
}

/* The lines of jam_notes: calls f with each, without its end. */
void each_note(const char *notes, void (*f)(const char *line, int warns, void *with), void *with) {
  while (*notes) {
    const size_t length = strcspn(notes, "\n");
    char line[640];
    snprintf(line, sizeof line, "%.*s", (int)length, notes);
    f(line, !strncmp(line, "warning: ", 9), with);
    notes += length + (notes[length] == '\n');
  }
}

void put_item(text_list *list, const char *text) {
  if (list->count++) fputs(", ", list->file);
  put_text(list->file, text);
}

static void put_note(const char *line, int warns, void *with) {
  (void)warns;
  put_item(with, line);
}

void put_notes(FILE *f, const char *notes, const char *more) {
  text_list list = {f, 0};
  fputs("  \"notes\": [", f);
  each_note(notes, put_note, &list);
  if (*more) put_note(more, 1, &list);
  fputs("],\n", f);
}

/* Of this command line: whether an object was begun, and the packing that its work ended with. */
static int begun;
static jam_info state;

void begin_json(FILE *f, const char *file, int code, const char *text) {
  begun = 1;
  fputs("{\n  \"file\": ", f);
  if (file)
    put_text(f, file);
  else
    fputs("null", f);
  fprintf(f, ",\n  \"status\": %d,\n  \"text\": ", code);
  put_text(f, text);
  fputs(",\n", f);
}

int has_written_json(void) { return begun; }

void forget_state(void) {
  begun = 0;
  memset(&state, 0, sizeof state);
}

jam_info info_of(const jam_system *sys) {
  jam_info info = {.struct_size = sizeof info};
  if (sys) jam_get_info(sys, &info);
  return info;
}

int leave(jam_system *sys, int code) {
  state = info_of(sys);
  jam_destroy(sys);
  return code;
}

int end_json(output *out) {
  fprintf(out->file, "  \"version\": \"%s\"\n}\n", jam_version());
  return close_output(out);
}

int write_failure(const char *file, int code) {
  output out;
  if (open_output(&out, "-")) return -1;
  begin_json(out.file, file, code, messages());
  put_count(out.file, "n", state.n, state.n > 0);
  put_count(out.file, "dim", state.dim, state.n > 0);
  put_number(out.file, "packing_fraction", state.n > 0 ? state.packing_fraction : NAN);
  return end_json(&out);
}
