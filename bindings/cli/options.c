/* The command line of jam-pack, by the table of options_table.h. */
#include <errno.h>
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#define JAM_PACK_OPTIONS_TABLE
#include "jam-pack.h"

static int bad_value(const char *name, const char *value, const char *need) {
  complain("%s is '%s', it must be %s", name, value, need);
  return -1;
}

static int take_number(const char *name, const char *value, double *out, int zero_is_fine) {
  char *end;
  const double x = strtod(value, &end);
  const char *need = zero_is_fine ? "a finite number >= 0" : "a finite number > 0";
  if (end == value || *end || !isfinite(x) || x < 0 || (x == 0 && !zero_is_fine)) return bad_value(name, value, need);
  *out = x;
  return 0;
}

/* The same in the range of the row; 0, 0 is none. */
static int take_real(const option_row *row, const char *value, double *out, int zero_is_fine) {
  char need[80];
  if (take_number(row->name, value, out, zero_is_fine)) return -1;
  if (row->most == 0 || (*out >= row->least && *out <= row->most)) return 0;
  snprintf(need, sizeof need, "a number in %g..%g", row->least, row->most);
  return bad_value(row->name, value, need);
}

static int take_delta(const char *name, const char *value, double *out) {
  char *end;
  *out = strtod(value, &end);
  if (end == value || *end || !(*out > -1 && *out <= 1))
    return bad_value(name, value, "a number above -1 and at most 1");
  return 0;
}

static int take_integer(const char *name, const char *value, int64_t least, int64_t most, int64_t *out) {
  char *end, need[80];
  long long x;
  errno = 0;
  x = strtoll(value, &end, 10);
  if (end == value || *end || errno == ERANGE || x < least || x > most) {
    snprintf(need, sizeof need, "an integer in %lld..%lld", (long long)least, (long long)most);
    return bad_value(name, value, need);
  }
  *out = x;
  return 0;
}

static int take_stage(const char *value, options *o) {
  char rate[64];
  const char *colon = strchr(value, ':');
  stage *s = &o->given.stages[o->given.stage_count];
  if (o->given.stage_count == MAX_STAGES) {
    complain("--growth is given more than %d times", MAX_STAGES);
    return -1;
  }
  snprintf(rate, sizeof rate, "%.*s", colon ? (int)(colon - value) : 63, value);
  if (take_number("--growth", rate, &s->growth, 0)) return -1;
  s->pressure = 0;
  if (colon && take_number("the pressure of --growth", colon + 1, &s->pressure, 0)) return -1;
  if (colon && !(s->pressure > 1))
    return bad_value("the pressure of --growth", colon + 1, "larger than 1, an ideal gas");
  o->given.stage_count++;
  return 0;
}

/* value must be one of the words of the row, whose number counts. */
static int take_choice(const option_row *row, const char *value, int64_t *out) {
  const char *word = row->words;
  int64_t k;
  for (k = 0; *word; ++k) {
    const size_t length = strcspn(word, " ");
    if (strlen(value) == length && !strncmp(value, word, length)) {
      *out = k;
      return 0;
    }
    word += length + (word[length] == ' ');
  }
  complain("%s is '%s', it must be one of: %s", row->name, value, row->words);
  return -1;
}

static int take_value(const option_row *row, const char *value, options *o) {
  void *const place = (char *)o + row->place;
  switch (row->kind) {
    case TAKE_INTEGER:
      return take_integer(row->name, value, row->low, row->high, place);
    case TAKE_POSITIVE:
      return take_real(row, value, place, 0);
    case TAKE_NOT_NEGATIVE:
      return take_real(row, value, place, 1);
    case TAKE_PRESSURE:
      if (take_number(row->name, value, place, 0)) return -1;
      return *(double *)place > 1 ? 0 : bad_value(row->name, value, "larger than 1, an ideal gas");
    case TAKE_DELTA:
      return take_delta(row->name, value, place);
    case TAKE_CHOICE:
      return take_choice(row, value, place);
    case TAKE_STAGE:
      return take_stage(value, o);
    case TAKE_SIZES:
      return take_sizes(value, o);
    case TAKE_CELL:
      return take_cell(value, o);
    case TAKE_COPIES:
      return take_copies(value, o);
    case TAKE_FRACTION:
      if (take_number(row->name, value, place, 0)) return -1;
      return *(double *)place < 1 ? 0 : bad_value(row->name, value, "above 0 and below 1");
    default:
      *(const char **)place = value;
      if (*value) return 0;
      return bad_value(row->name, value, row->kind == TAKE_TEXT ? "a text that is not empty" : "the name of a file");
  }
}

static const option_row *find_option(const char *name, size_t length) {
  size_t k;
  for (k = 0; k < sizeof table / sizeof *table; ++k)
    if (strlen(table[k].name) == length && !strncmp(table[k].name, name, length)) return &table[k];
  return NULL;
}

/* Letters to change, add or leave out between two words. */
static int edits(const char *a, size_t length, const char *b) {
  int row[64];
  const size_t columns = strlen(b) < 63 ? strlen(b) : 63;
  for (size_t j = 0; j <= columns; ++j) row[j] = (int)j;
  for (size_t i = 0; i < length; ++i) {
    int before = row[0]++;
    for (size_t j = 0; j < columns; ++j) {
      const int above = row[j + 1], kept = before + (a[i] != b[j]), other = 1 + (above < row[j] ? above : row[j]);
      row[j + 1] = kept < other ? kept : other;
      before = above;
    }
  }
  return row[columns];
}

static void refuse_unknown(const char *name, size_t length) {
  const char *nearest = "";
  int least = length < 7 ? 1 + (int)(length - 1) / 3 : 3; /* above this two words have little in common */
  for (size_t k = 0; k < sizeof table / sizeof *table; ++k) {
    const int found = edits(name, length, table[k].name);
    if (found < least) nearest = table[k].name, least = found;
  }
  complain("unknown option '%.*s'%s%s%s", (int)length, name, *nearest ? "; did you mean " : "", nearest,
           *nearest ? "?" : "");
}

const char *word_of_choice(const char *option, int number, char word[32]) {
  const char *at = find_option(option, strlen(option))->words;
  while (number-- > 0) at = strchr(at, ' ') + 1;
  snprintf(word, 32, "%.*s", (int)strcspn(at, " "), at);
  return word;
}

/* What the verb takes, for those who gave it something else. */
static void refuse_option(const options *o, const char *word) {
  const unsigned bit = 1u << o->given.verb;
  char names[2048] = "";
  size_t k, length = 0;
  for (k = 0; k < sizeof table / sizeof *table; ++k)
    if (table[k].verbs & bit && strcmp(table[k].name, "--input") && length < sizeof names)
      length += (size_t)snprintf(names + length, sizeof names - length, "%s%s", length ? ", " : "", table[k].name);
  complain("%s takes no '%s'; it takes %s %s", verb_table[o->given.verb].name, word,
           verb_table[o->given.verb].first ? "a FILE," : "no FILE, but", names);
}

/* The value of an option, NULL of a switch. A second one would replace the first one in silence; stages are a list. */
static int take_once(const option_row *row, const char *value, options *o) {
  const int is_file = row->kind == TAKE_INPUT || row->kind == TAKE_OUTPUT || row->kind == TAKE_TEXT;
  if (o->named[row - table] && is_file) {
    complain("two files for %s, '%s' and '%s': leave one out", row->name, *(const char **)((char *)o + row->place),
             value);
    return -1;
  }
  if (o->named[row - table] && row->kind != TAKE_STAGE) {
    complain("%s is given twice: leave one out", row->name);
    return -1;
  }
  if (!value)
    *(int *)((char *)o + row->place) = 1;
  else if (take_value(row, value, o))
    return -1;
  o->named[row - table] = 1;
  return 0;
}

/* A word without dashes: a file, for the option that this place of the verb stands for. */
static int take_file(const char *word, options *o) {
  const verb_row *const verb = &verb_table[o->given.verb];
  const char *const places[] = {verb->first, verb->second};
  const char *const place = o->given.file_count < 2 ? places[o->given.file_count] : NULL;
  o->given.file_count++;
  if (*word == '-' && word[1])
    refuse_unknown(word, strlen(word));
  else if (place)
    return take_once(find_option(place, strlen(place)), word, o);
  else if (o->given.words[0] == word)
    complain("unexpected argument '%s': it is no verb, and a file is given by --input", word);
  else
    complain("unexpected argument '%s'", word);
  return -1;
}

/* One argument, with its value behind '=' or in the next one. Returns how many arguments were taken, 0 after a message.
 */
static int take_argument(char **argv, int left, options *o) {
  const char *value = strchr(argv[0], '=');
  const size_t length = value ? (size_t)(value - argv[0]) : strlen(argv[0]);
  const option_row *row = find_option(argv[0], length);
  if (row && row->flags & NEEDS_HOST && !o->given.host) {
    complain("option '%s' is one of python3 -m jam", row->name);
    return 0;
  }
  if (strncmp(argv[0], "--", 2)) {
    if (!take_file(argv[0], o)) return 1;
  } else if (!row)
    refuse_unknown(argv[0], length);
  else if (!(row->verbs >> o->given.verb & 1))
    refuse_option(o, row->name);
  else if (row->kind == TAKE_SWITCH) {
    if (!value) return !take_once(row, NULL, o);
    complain("option '%s' takes no value", row->name);
  } else if (!value && (left == 1 || find_option(argv[1], strlen(argv[1])))) /* --output=--json names such a file */

    complain("option '%s' lacks its value", argv[0]);
  else if (!take_once(row, value ? value + 1 : argv[1], o))
    return value ? 1 : 2;
  return 0;
}

/* Lines of options that need a host begin with a tab. Examples name the program. */
static void print_help(const jam_pack_host *host, int verb) {
  const help_line *line;
  for (line = help; line->text; ++line) {
    const char *const name = strstr(line->text, "jam-pack ");
    if (!(line->verbs >> verb & 1)) continue;
    if (name && (!strncmp(line->text, "Usage", 5) || !strncmp(line->text, "Example", 7) || name == line->text))
      printf("%.*s%s%s\n", (int)(name - line->text), line->text, program, name + strlen("jam-pack"));
    else if (*line->text != '\t')
      puts(line->text);
    else if (host)
      puts(line->text + 1);
  }
}

/* The verb that a command line begins with; VERB_NONE: none. */
static int find_verb(int argc, char **argv) {
  int k;
  for (k = 0; k < VERB_NONE; ++k)
    if (argc > 1 && !strcmp(argv[1], verb_table[k].name)) return k;
  return VERB_NONE;
}

int parse_options(int argc, char **argv, const jam_pack_host *host, options *o) {
  const int verb = find_verb(argc, argv);
  int k, taken;
  *o = defaults;
  o->given.host = host;
  o->given.words = argv + 1;
  o->given.word_count = argc - 1;
  o->given.verb = verb == VERB_NONE ? VERB_PACK : verb;
  for (k = 1; k < argc; ++k) {
    if (!strcmp(argv[k], "--help") || !strcmp(argv[k], "-h")) {
      print_help(host, verb);
      return 1 + end_stdout(EXIT_DONE);
    }
    if (!strcmp(argv[k], "--version")) {
      printf("%s %s, commit %s\n", program, jam_version(), jam_commit()[0] ? jam_commit() : "unknown");
      return 1 + end_stdout(EXIT_DONE);
    }
  }
  for (k = verb == VERB_NONE ? 1 : 2; k < argc; k += taken) {
    taken = take_argument(argv + k, argc - k, o);
    if (taken) continue;
    if (verb == VERB_NONE)
      fprintf(stderr, "Try '%s --help'.\n", program);
    else
      fprintf(stderr, "Try '%s %s --help'.\n", program, argv[1]);
    return 1 + EXIT_USAGE;
  }
  if (settle(o)) return 1 + EXIT_USAGE;
  return 0;
}
