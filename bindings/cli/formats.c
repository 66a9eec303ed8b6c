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

static int is_one_of(const char *word, const char *const *list) {
  while (*list && strcmp(word, *list)) ++list;
  return *list != NULL;
}

static int is_packed(const char *path) {
  const size_t length = strlen(path);
  return length > 3 && !strcmp(path + length - 3, ".gz");
}

/* A name that promises what is not done. */
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

int settle_formats(const options *o) {
  static const char *const packings[] = {"xyz", "extxyz", "data", "lmp", "vtp", "dat", "txt", "", NULL};
  static const char *const images[] = {"npy", "mha", "vti", NULL};
  static const char *const networks[] = {"csv", "dump", "vtp", "", NULL};
  char ending[8];
  if (settle_gzip(o)) return -1;
  if (o->voxels) {
    ending_of(o->voxels, ending);
    if (!is_one_of(ending, images)) {
      complain("--voxels %s: no format is known by this ending; use .npy, .mha or .vti", o->voxels);
      return -1;
    }
  }
  if (o->output) {
    const int host = is_host_format(o, o->output);
    ending_of(o->output, ending);
    if (!host && !is_one_of(ending, packings) && strspn(ending, "0123456789") != strlen(ending)) {
      complain(
          "--output %s: no format is known by this ending; use .xyz, .extxyz, .data, .lmp, .vtp, .dat, .txt or none,"
          " with .gz behind it or without",
          o->output);
      return -1;
    }
    if (o->strain != JAM_STRAIN_NONE && !host &&
        (!is_one_of(ending, packings) || !strcmp(ending, "dat") || !strcmp(ending, "txt") || !*ending)) {
      complain("--strain needs an --output in another format: plain text has cubes alone");
      return -1;
    }
    if (o->non_additivity != 0 && strcmp(ending, "xyz") && strcmp(ending, "extxyz")) {
      complain("--non-additivity needs an --output that ends in .xyz or .extxyz: no other format has a place for it");
      return -1;
    }
  }
  if (o->contacts && strcmp(o->contacts, "-") && strncmp(o->contacts, "/dev/", 5)) {
    ending_of(o->contacts, ending);
    if (!is_one_of(ending, networks)) {
      complain("--contacts %s: no format is known by this ending; use .csv, .dump or .vtp", o->contacts);
      return -1;
    }
  }
  return 0;
}

/* The number of the format that the ending of a packing's file names; the checks of settle_formats came first. */
static int32_t format_of(const char *ending) {
  if (!strcmp(ending, "xyz") || !strcmp(ending, "extxyz")) return JAM_FORMAT_XYZ;
  if (!strcmp(ending, "data") || !strcmp(ending, "lmp")) return JAM_FORMAT_LAMMPS;
  return !strcmp(ending, "vtp") ? JAM_FORMAT_VTP : JAM_FORMAT_PLAIN;
}

int check_formats(const options *o, const jam_system *sys) {
  jam_info info;
  char ending[8];
  info.struct_size = sizeof info;
  jam_get_info(sys, &info);
  if (info.n == 1 && o->given.verb <= VERB_CRUNCH && !o->no_crunch && o->strain == JAM_STRAIN_NONE) {
    complain("a crunch of one sphere needs --strain: in a fixed cell nothing can move");
    return -1;
  }
  if ((info.walls || info.container) && (o->prove || o->proof || o->strict_proof || o->strain != JAM_STRAIN_NONE)) {
    complain("%s needs a packing without walls", o->strain != JAM_STRAIN_NONE ? "--strain"
                                                 : o->prove                   ? "--prove"
                                                 : o->proof                   ? "--proof"
                                                                              : "--strict-proof");
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
    if (info.walls || info.container) {
      complain("--output %s: such files have no place for walls", o->output);
      return -1;
    }
  } else if (o->output) {
    ending_of(o->output, ending);
    if (jam_write(sys, "/dev/null", format_of(ending)) < 0) {
      complain("--output %s: %s", o->output, jam_last_error());
      return -1;
    }
  }
  if (!o->contacts || info.dim <= 3) return 0;
  ending_of(o->contacts, ending);
  if (strcmp(ending, "dump") && strcmp(ending, "vtp")) return 0;
  complain("--contacts %s: such files have d = 2 or d = 3, this packing has d = %d", o->contacts, (int)info.dim);
  return -1;
}
