/* The formats of files, by the endings of their names. */
#define _XOPEN_SOURCE 700
#include <math.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>
#define JAM_PACK_OPTIONS_TABLE
#include "jam-pack.h"

void ending_of(const char *path, char ending[8]) {
  const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path, *dot;
  char bare[256];
  size_t length = strlen(name);
  if (length > 3 && !strcmp(name + length - 3, ".gz")) length -= 3;
  snprintf(bare, sizeof bare, "%.*s", (int)length, name);
  dot = strrchr(bare, '.');
  snprintf(ending, 8, "%.7s", dot && dot != bare ? dot + 1 : "");
}

int is_host_format(const options *o, const char *path) {
  char ending[8];
  if (!path || !o->given.host || !o->given.host->read) return 0;
  ending_of(path, ending);
  return !strcasecmp(ending, "gsd");
}

/* A row of jam_formats. */
typedef struct format {
  char content[16], word[16], name[48], endings[64], holds[64], use[16];
  int32_t number;
  int most_dim;
} format;

/* Reads the row at `*at` and moves on to the next; 0 at the end. */
static int next_format(const char **at, format *row) {
  const int fields = sscanf(*at, "%15[^\t]\t%d\t%15[^\t]\t%47[^\t]\t%63[^\t]\t%d\t%63[^\t]\t%15[^\n]", row->content,
                            &row->number, row->word, row->name, row->endings, &row->most_dim, row->holds, row->use);
  const char *const end = strchr(*at, '\n');
  *at = end ? end + 1 : *at + strlen(*at);
  return fields == 8;
}

/* Whether a list of words parted by blanks has this one. */
static int has_word(const char *list, const char *word) {
  const size_t length = strlen(word);
  for (; *list; list += strcspn(list, " "), list += *list == ' ')
    if (strcspn(list, " ") == length && !strncmp(list, word, length)) return 1;
  return 0;
}

/* The format by which a file of this name is written; 0 where no ending fits. One of digits alone (run.12) is none. */
static int find_format(const char *content, const char *path, format *row) {
  const char *at = jam_formats();
  char ending[8];
  ending_of(path, ending);
  if (strspn(ending, "0123456789") == strlen(ending)) strcpy(ending, "-");
  while (next_format(&at, row))
    if (!strcmp(row->content, content) && has_word(row->use, "write") && has_word(row->endings, ending)) return 1;
  return 0;
}

/* The endings of what is written and holds `what`: ".xyz, .extxyz, .data". */
static const char *endings_of(const char *content, const char *what) {
  static char all[512];
  const char *at = jam_formats();
  format row;
  char *word;
  *all = '\0';
  while (next_format(&at, &row)) {
    if (strcmp(row.content, content) || !has_word(row.use, "write") || !has_word(row.holds, what)) continue;
    for (word = strtok(row.endings, " "); word; word = strtok(NULL, " "))
      snprintf(all + strlen(all), sizeof all - strlen(all), "%s%s%s", *all ? ", " : "", *word == '-' ? "" : ".",
               *word == '-' ? "none" : word);
  }
  if ((word = strrchr(all, ',')) != NULL) { /* ".csv, .dump or .vtp" */
    char last[32];
    snprintf(last, sizeof last, "%s", word + 2);
    snprintf(word, sizeof all - (size_t)(word - all), " or %s", last);
  }
  return all;
}

/* 0 where the format of a file's name holds what the option needs, else -1 after a message. */
static int check_holds(const char *output, const char *option, const char *what) {
  format row;
  if (!find_format("packings", output, &row) || has_word(row.holds, what)) return 0;
  complain("%s needs an --output of another format: %s stores no %s; use %s", option, row.name,
           strcmp(what, "cells") ? what : "cells but cubes", endings_of("packings", what));
  return -1;
}

static int is_packed(const char *path) {
  const size_t length = strlen(path);
  return length > 3 && !strcmp(path + length - 3, ".gz");
}

/* A file name whose ending asks for what is not done. */
static int settle_gzip(const options *o) {
  size_t k;
  for (k = 0; k < sizeof table / sizeof *table; ++k) {
    const char *const path =
        table[k].kind == TAKE_OUTPUT ? *(const char *const *)((const char *)o + table[k].place) : NULL;
    if (!path || table[k].flags & TAKES_GZIP || !is_packed(path)) continue;
    complain("%s %s: this file is not compressed: leave .gz out", table[k].name, path);
    return -1;
  }
  return 0;
}

/* A file whose name has to say its format. */
static int check_ending(const char *option, const char *path, const char *content) {
  format row;
  if (find_format(content, path, &row)) return 0;
  complain("%s %s: no format is known by this ending; use %s", option, path, endings_of(content, "spheres"));
  return -1;
}

/* Standard output and devices get a table of contacts, as names without an ending do. */
static int names_table(const char *path) {
  char ending[8];
  ending_of(path, ending);
  return !*ending || !strcmp(path, "-") || !strncmp(path, "/dev/", 5);
}

int settle_formats(const options *o) {
  const char *const output = is_host_format(o, o->output) ? NULL : o->output;
  if (settle_gzip(o)) return -1;
  if (o->voxels && check_ending("--voxels", o->voxels, "images")) return -1;
  if (output && check_ending("--output", output, "packings")) return -1;
  if (o->contacts && !names_table(o->contacts) && check_ending("--contacts", o->contacts, "contacts")) return -1;
  if (output && o->strain != JAM_STRAIN_NONE && check_holds(output, "--strain", "cells")) return -1;
  if (output && (o->walls || o->container) && check_holds(output, o->container ? "--container" : "--walls", "walls"))
    return -1;
  if (o->output && !output && o->non_additivity != 0) {
    complain("--non-additivity needs an --output of another format: %s", endings_of("packings", "non_additivity"));
    return -1;
  }
  return output && o->non_additivity != 0 ? check_holds(output, "--non-additivity", "non_additivity") : 0;
}

int check_formats(const options *o, const jam_system *sys) {
  const jam_info info = info_of(sys);
  format row;
  if (info.n == 1 && o->given.verb <= VERB_CRUNCH && !o->no_crunch && !o->radii && o->strain == JAM_STRAIN_NONE) {
    if (info.walls || info.container)
      complain(
          "one sphere between walls needs no crunch: leave it out by --no-crunch; its largest diameter is the width");
    else
      complain("a crunch of one sphere needs --strain: in a fixed cell nothing can move");
    return -1;
  }
  if ((info.walls || info.container) && o->strict_proof) {
    complain("--strict-proof needs a packing without walls");
    return -1;
  }
  if (o->vtk && info.dim > 3) {
    complain("--vtk: such files have d = 2 or d = 3, this packing has d = %d", (int)info.dim);
    return -1;
  }
  if (is_host_format(o, o->output)) {
    if (info.dim > 3) {
      complain("--output %s: such files have d = 2 or d = 3, this packing has d = %d", o->output, (int)info.dim);
      return -1;
    }
    if (info.walls || info.container || info.non_additivity != 0) {
      complain("--output %s: such files have no place for %s", o->output,
               info.non_additivity != 0 ? "non_additivity" : "walls");
      return -1;
    }
  } else if (o->output && find_format("packings", o->output, &row) &&
             jam_write_scaled(sys, "/dev/null", row.number, o->scale, o->density) < 0) {
    complain("--output %s: %s", o->output, jam_last_error());
    return -1;
  }
  if (!o->contacts || names_table(o->contacts) || !find_format("contacts", o->contacts, &row)) return 0;
  if (info.dim <= row.most_dim) return 0;
  complain("--contacts %s: such files have d = 2 or d = 3, this packing has d = %d", o->contacts, (int)info.dim);
  return -1;
}
