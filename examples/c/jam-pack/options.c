/* The command line of jam-pack. */
#include <errno.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "jam-pack.h"

static const char help[] =
    "Usage: jam-pack [options]\n"
    "Makes a jammed packing of hard spheres: random start, event-driven molecular\n"
    "dynamics with growth, then iterated linear programming down to the jamming point.\n"
    "\n"
    "Example: jam-pack --n 1024 --seed 1 --output packing.xyz --contacts forces.csv --report -\n"
    "\n"
    "Start\n"
    "  --n N                  spheres (1024)\n"
    "  --dim D                dimension, 2..8 (3)\n"
    "  --phi0 F               packing fraction of the random start (0.2; halved for each\n"
    "                         dimension above 3)\n"
    "  --diameters-ratio R    half of the spheres are R times as large (1)\n"
    "  --diameters WHAT       bidisperse:R as above; lognormal:S with S the standard deviation\n"
    "                         over the mean; or a file of diameters, of which the ratios count\n"
    "  --non-additivity D     spheres of unequal diameters touch at (1 + D) times their mean\n"
    "                         diameter, -1 < D <= 1 (0)\n"
    "  --model euclid|mk      distance: Euclidean (default) or Mari-Kurchan\n"
    "  --zeta Z               strength of the Mari-Kurchan shifts (infinite)\n"
    "  --plant F              Mari-Kurchan start, planted in equilibrium at packing fraction F\n"
    "  --seed S               of all random numbers (1)\n"
    "  --input FILE           start from a file, plain or extended XYZ; molecular dynamics is\n"
    "                         then off unless --growth or --nve is given\n"
    "  --box L                side of the box for a plain file that names none (1)\n"
    "  --shrink               shrink overlapping spheres of the file to contact\n"
    "Molecular dynamics\n"
    "  --nve C                first C collisions per particle without growth (0)\n"
    "  --growth RATE[:P]      one stage: growth rate G = (d sigma/dt)/sqrt(kT/m) up to reduced\n"
    "                         pressure P. Give it again for more stages.\n"
    "                         Default: 1e-2:500, then 3e-3 up to --pressure\n"
    "  --pressure P           target of stages without :P (1e7)\n"
    "  --no-md                none\n"
    "  --checkpoint FILE      state of the dynamics, every minute and where they stop\n"
    "  --resume FILE          go on from a checkpoint, to the same bits: the stage that was cut\n"
    "                         off, then those stages whose pressure lies beyond\n"
    "Crunch\n"
    "  --lp ipm|clp           linear programs by interior point (default) or Clp's simplex\n"
    "  --threads T            1 or 2 (1; the same bits each time on 1)\n"
    "  --no-crunch            stop after molecular dynamics\n"
    "Output\n"
    "  --output FILE          the packing: .xyz or .extxyz for extended XYZ; .data or .lmp for\n"
    "                         LAMMPS; .vtp for ParaView; .dat, .txt or no ending for plain text;\n"
    "                         with .gz behind it compressed\n"
    "  --page FILE.html       the packing to look at in a browser, with forces, certificate and\n"
    "                         distributions; needs no network\n"
    "  --contacts FILE        the contact network: i, j, unit vector, gap, force (mean 1), as\n"
    "                         .csv, .dump (LAMMPS dump local) or .vtp (ParaView)\n"
    "  --spectrum FILE.csv    lowest modes of the harmonic Hessian: omega^2, omega, participation\n"
    "  --modes K              how many --spectrum writes (100); 0: all, which needs\n"
    "                         24 (d N)^2 bytes, at most 2e9\n"
    "  --gaps FILE.csv        gaps h < 1 of pairs that are no contacts, sorted\n"
    "  --structure FILE.csv   a line a sphere: coordination, class, sums of contact vectors and\n"
    "                         forces, Q6, local packing fraction\n"
    "  --report FILE|-        figures and certificate as JSON; - is standard output\n"
    "  --quiet                no progress line, no summary\n"
    "Other\n"
    "  --wall-time SECONDS    limit for the whole run\n"
    "  --help, --version\n"
    "\n"
    "Ctrl-C stops the computation, and what was asked for is still written.\n"
    "Exit status: 0 done (jammed, unless --no-crunch); 1 stopped early or not jammed, the valid\n"
    "state reached is written; 2 wrong command line; 3 request or input refused, or the\n"
    "computation failed; 4 an output cannot be written.\n";

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
  stage *s = &o->stages[o->stage_count];
  if (o->stage_count == MAX_STAGES) {
    complain("--growth is given more than %d times", MAX_STAGES);
    return -1;
  }
  snprintf(rate, sizeof rate, "%.*s", colon ? (int)(colon - value) : 63, value);
  if (take_number("--growth", rate, &s->growth, 0)) return -1;
  s->pressure = 0;
  if (colon && take_number("the pressure of --growth", colon + 1, &s->pressure, 0)) return -1;
  if (colon && !(s->pressure > 1))
    return bad_value("the pressure of --growth", colon + 1, "larger than 1, an ideal gas");
  o->stage_count++;
  return 0;
}

static int take_value(const char *name, const char *value, options *o) {
  int64_t k = 0;
  int status = 0;
  if (!strcmp(name, "--n")) {
    status = take_integer(name, value, 1, INT32_MAX, &o->n);
    o->n_given = 1;
  } else if (!strcmp(name, "--seed"))
    status = take_integer(name, value, INT64_MIN, INT64_MAX, &o->seed);
  else if (!strcmp(name, "--dim")) {
    status = take_integer(name, value, 2, JAM_MAX_DIM, &k);
    o->dim = (int32_t)k;
  } else if (!strcmp(name, "--threads")) {
    status = take_integer(name, value, 1, 2, &k);
    o->threads = (int32_t)k;
  } else if (!strcmp(name, "--phi0"))
    status = take_number(name, value, &o->phi0, 0);
  else if (!strcmp(name, "--diameters-ratio"))
    status = take_number(name, value, &o->ratio, 0);
  else if (!strcmp(name, "--non-additivity"))
    status = take_delta(name, value, &o->non_additivity);
  else if (!strcmp(name, "--diameters")) {
    if (take_diameters(value, o))
      status = bad_value(name, value, "lognormal:S or bidisperse:R with a finite number > 0, or a file");
  } else if (!strcmp(name, "--model")) {
    if (!strcmp(value, "mk"))
      o->model = JAM_MODEL_MK;
    else if (strcmp(value, "euclid"))
      status = bad_value(name, value, "euclid or mk");
  } else if (!strcmp(name, "--zeta")) {
    status = take_number(name, value, &o->zeta, 1);
    o->model = JAM_MODEL_MK;
  } else if (!strcmp(name, "--plant")) {
    status = take_number(name, value, &o->phi0, 0);
    o->model = JAM_MODEL_MK;
  } else if (!strcmp(name, "--checkpoint"))
    o->checkpoint = value;
  else if (!strcmp(name, "--resume"))
    o->resume = value;
  else if (!strcmp(name, "--nve"))
    status = take_number(name, value, &o->nve, 1);
  else if (!strcmp(name, "--box"))
    status = take_number(name, value, &o->box, 0);
  else if (!strcmp(name, "--wall-time"))
    status = take_number(name, value, &o->wall_time, 0);
  else if (!strcmp(name, "--growth"))
    status = take_stage(value, o);
  else if (!strcmp(name, "--pressure")) {
    status = take_number(name, value, &o->pressure, 0);
    if (!status && !(o->pressure > 1)) status = bad_value(name, value, "larger than 1, an ideal gas");
  } else if (!strcmp(name, "--lp")) {
    if (!strcmp(value, "ipm"))
      o->lp_solver = JAM_LP_IPM;
    else if (!strcmp(value, "clp"))
      o->lp_solver = JAM_LP_CLP;
    else
      status = bad_value(name, value, "ipm or clp");
  } else if (!strcmp(name, "--input"))
    o->input = value;
  else if (!strcmp(name, "--output"))
    o->output = value;
  else if (!strcmp(name, "--contacts"))
    o->contacts = value;
  else if (!strcmp(name, "--report"))
    o->report = value;
  else if (!strcmp(name, "--page"))
    o->page = value;
  else if (!strcmp(name, "--modes"))
    status = take_integer(name, value, 0, INT32_MAX, &o->modes);
  else if (!strcmp(name, "--spectrum"))
    o->spectrum = value;
  else if (!strcmp(name, "--gaps"))
    o->gaps = value;
  else if (!strcmp(name, "--structure"))
    o->structure = value;
  else {
    complain("unknown option '%s'", name);
    status = -1;
  }
  return status;
}

/* Returns 1 when arg is a switch, which is then set. */
static int take_switch(const char *arg, options *o) {
  if (!strcmp(arg, "--no-md"))
    o->no_md = 1;
  else if (!strcmp(arg, "--no-crunch"))
    o->no_crunch = 1;
  else if (!strcmp(arg, "--quiet"))
    o->quiet = 1;
  else if (!strcmp(arg, "--shrink"))
    o->shrink = 1;
  else
    return 0;
  return 1;
}

static int same(const char *a, const char *b) { return a && b && strcmp(a, "-") && !strcmp(a, b); }

/* Every output to its own file, and none over the input. */
static int settle_files(const options *o) {
  const char *const name[] = {"--output", "--contacts", "--report", "--spectrum", "--gaps", "--structure", "--page"};
  const char *const file[] = {o->output, o->contacts, o->report, o->spectrum, o->gaps, o->structure, o->page};
  const int count = (int)(sizeof file / sizeof *file);
  int j, k;
  for (k = 0; k < count; ++k) {
    for (j = 0; j < k; ++j)
      if (same(file[j], file[k])) {
        complain("%s and %s must be different files", name[j], name[k]);
        return -1;
      }
    if (k > 0 && same(o->input, file[k])) {
      complain("%s would overwrite the input", name[k]);
      return -1;
    }
    if (o->no_crunch && file[k] && k != 0 && k != 2 && k != 6) {
      complain("%s needs the crunch that --no-crunch leaves out", name[k]);
      return -1;
    }
  }
  if (o->modes >= 0 && !o->spectrum) {
    complain("--modes says how many modes --spectrum writes, which is missing");
    return -1;
  }
  return 0;
}

/* What stands behind the last dot of a name, without .gz. */
static void ending_of(const char *path, char ending[8]) {
  const char *slash = strrchr(path, '/'), *name = slash ? slash + 1 : path, *dot;
  char bare[256];
  size_t length = strlen(name);
  if (length > 3 && !strcmp(name + length - 3, ".gz")) length -= 3;
  snprintf(bare, sizeof bare, "%.*s", (int)length, name);
  dot = strrchr(bare, '.');
  snprintf(ending, 8, "%.7s", dot && dot != bare ? dot + 1 : "");
}

static int is_one_of(const char *word, const char *const *list) {
  while (*list && strcmp(word, *list)) ++list;
  return *list != NULL;
}

/* Whether the library knows the formats of these names: said before the work, not after it. */
static int settle_formats(const options *o) {
  static const char *const packings[] = {"xyz", "extxyz", "data", "lmp", "vtp", "dat", "txt", "", NULL};
  static const char *const networks[] = {"csv", "dump", "vtp", NULL};
  char ending[8];
  if (o->output) {
    ending_of(o->output, ending);
    if (!is_one_of(ending, packings) && strspn(ending, "0123456789") != strlen(ending)) {
      complain(
          "--output %s: no format is known by this ending; use .xyz, .extxyz, .data, .lmp, .vtp, .dat, .txt or none,"
          " with .gz behind it or without",
          o->output);
      return -1;
    }
    if (o->non_additivity != 0 && strcmp(ending, "xyz") && strcmp(ending, "extxyz")) {
      complain("--non-additivity needs an --output that ends in .xyz or .extxyz: no other format can hold it");
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

/* What contradicts itself, and what follows from the rest. */
static int settle(options *o) {
  int k;
  if (settle_files(o)) return -1;
  if (settle_formats(o)) return -1;
  if (o->no_md && (o->stage_count || o->nve > 0)) {
    complain("--no-md contradicts %s", o->stage_count ? "--growth" : "--nve");
    return -1;
  }
  if (o->resume && o->input) {
    complain("--resume and --input are two starts");
    return -1;
  }
  if (o->checkpoint &&
      (same(o->checkpoint, o->output) || same(o->checkpoint, o->contacts) || same(o->checkpoint, o->report))) {
    complain("--checkpoint would be overwritten by another output");
    return -1;
  }
  if (!o->phi0) o->phi0 = 0.2 * pow(0.5, o->dim > 3 ? o->dim - 3 : 0);
  if (o->no_md || (o->input && !o->stage_count)) return 0;
  if (!o->stage_count) { /* the two stages that avoid crystals in d = 3 */
    o->stages[o->stage_count++] = (stage){1e-2, o->pressure < 500 ? o->pressure : 500};
    if (o->pressure > 500) o->stages[o->stage_count++] = (stage){3e-3, o->pressure};
  }
  for (k = 0; k < o->stage_count; ++k)
    if (!o->stages[k].pressure) o->stages[k].pressure = o->pressure;
  return 0;
}

int parse_options(int argc, char **argv, options *o) {
  int k;
  memset(o, 0, sizeof *o);
  o->n = 1024;
  o->dim = 3;
  o->seed = o->threads = 1;
  o->ratio = o->box = 1;
  o->modes = -1;
  o->zeta = INFINITY;
  o->pressure = 1e7;
  o->wall_time = INFINITY;
  for (k = 1; k < argc; ++k) {
    char name[32];
    const char *value = strchr(argv[k], '=');
    if (!strcmp(argv[k], "--help") || !strcmp(argv[k], "-h")) {
      fputs(help, stdout);
      return 1 + (fflush(stdout) ? EXIT_OUTPUT : EXIT_DONE);
    }
    if (!strcmp(argv[k], "--version")) {
      printf("jam-pack %s\n", jam_version());
      return 1 + (fflush(stdout) ? EXIT_OUTPUT : EXIT_DONE);
    }
    if (take_switch(argv[k], o)) continue;
    snprintf(name, sizeof name, "%.*s", value ? (int)(value - argv[k]) : 31, argv[k]);
    if (strncmp(argv[k], "--", 2))
      complain("unexpected argument '%s'", argv[k]);
    else if (!value && k + 1 == argc)
      complain("option '%s' is unknown or lacks its value", argv[k]);
    else if (!take_value(name, value ? value + 1 : argv[++k], o))
      continue;
    fputs("Try 'jam-pack --help'.\n", stderr);
    return 1 + EXIT_USAGE;
  }
  if (settle(o)) return 1 + EXIT_USAGE;
  return 0;
}
