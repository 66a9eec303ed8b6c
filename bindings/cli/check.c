/* jam-pack check FILE: is the packing of the file jammed, as it is? One paragraph on standard output. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "jam-pack.h"

enum { CHECK_YES = 0, CHECK_NO = 1, CHECK_REFUSED = 2, CHECK_UNDECIDED = 3 };
enum { CHECK_HOST = 1000 }; /* beside the statuses: the host could not read the file */

static const char *const allowed[] = {"--box",       "--frame", "--non-additivity", "--prove", "--proof",
                                      "--wall-time", "--quiet", "--help",           "-h"};

static int is_allowed(const char *word) {
  const size_t length = strcspn(word, "=");
  size_t k;
  for (k = 0; k < sizeof allowed / sizeof *allowed; ++k)
    if (strlen(allowed[k]) == length && !strncmp(word, allowed[k], length)) return 1;
  return 0;
}

static int takes_next(const char *word) {
  return !strchr(word, '=') && strcmp(word, "--quiet") && strcmp(word, "--prove") && strcmp(word, "--help") &&
         strcmp(word, "-h");
}

/* The words of an ordinary command line with --input FILE, which options.c takes. The first word that is neither an
 * option nor its value is the FILE. NULL after a message. */
static char **as_input(int argc, char **argv) {
  char **words;
  int k, at = 2, file = 0;
  for (k = 2; k < argc; ++k) {
    if (argv[k][0] == '-' && argv[k][1]) {
      if (!is_allowed(argv[k])) {
        complain(
            "check takes a FILE and --box, --frame, --non-additivity, --prove, --proof, --wall-time or --quiet, not "
            "'%s'",
            argv[k]);
        return NULL;
      }
      k += takes_next(argv[k]);
    } else if (!file) {
      file = k;
    }
  }
  words = malloc(((size_t)argc + 2) * sizeof *words);
  if (!words) {
    complain("out of memory");
    return NULL;
  }
  words[0] = argv[0];
  words[1] = "--input";
  if (file) words[at++] = argv[file];
  for (k = 2; k <= argc; ++k)
    if (k != file) words[at++] = argv[k];
  return words;
}

/* Spheres may overlap: a file with few digits always has some that do, and the verdict says so. */
static jam_status read_as_it_is(const options *o, jam_system **sys) {
  jam_create_options create;
  const jam_status status = jam_create_options_init(&create, sizeof create);
  create.box = o->box;
  create.frame = o->frame;
  create.non_additivity = o->non_additivity;
  create.overlap = JAM_OVERLAP_ALLOW;
  if (status < 0 || !is_host_format(o, o->input))
    return status < 0 ? status : jam_read(o->input, &create, stop_if_asked, NULL, sys);
  return o->given.host->read(o->input, &create, o->given.host->user, sys) ? CHECK_HOST : JAM_OK;
}

/* The proof speaks of the contacts of the file's packing. */
static jam_status write_proof_file(jam_system *sys, const char *path) {
  const jam_status status = jam_contacts_from_geometry(sys, NULL, NULL);
  return status < 0 ? status : jam_write_proof(sys, path, NULL, 0);
}

static int judge(const options *o) {
  jam_check_options check;
  jam_check_report report = {0};
  jam_system *sys = NULL;
  jam_status status = read_as_it_is(o, &sys), written = JAM_OK;
  report.struct_size = sizeof report;
  if (status == CHECK_HOST) return CHECK_REFUSED; /* the host has said why */
  cancel_on_signal(sys);
  if (sys) print_warnings(jam_notes(sys));
  if (sys) status = jam_check_options_init(&check, sizeof check);
  if (sys && status >= 0) {
    check.wall_time = o->wall_time;
    check.prove = o->prove || o->proof;
    status = jam_check_packing(sys, &check, &report);
  }
  if (o->proof && status == JAM_OK) written = write_proof_file(sys, o->proof);
  cancel_on_signal(NULL);
  jam_destroy(sys);
  if (status == JAM_CANCELLED || (status >= 0 && !sys)) {
    complain("interrupted before the verdict");
    return CHECK_UNDECIDED;
  }
  if (status < 0) {
    complain("%s", jam_last_error());
    return CHECK_REFUSED;
  }
  if (!o->quiet) puts(jam_check_text(&report));
  if (written < 0) complain("%s", jam_last_error());
  if (o->proof && status != JAM_OK) complain("%s is not written: the packing is not jammed", o->proof);
  if (written < 0 || fflush(stdout)) return EXIT_OUTPUT;
  return status == JAM_OK ? CHECK_YES : status == JAM_NOT_JAMMED ? CHECK_NO : CHECK_UNDECIDED;
}

int check_file(int argc, char **argv, const jam_pack_host *host) {
  options o;
  int parsed;
  char **words = as_input(argc, argv);
  if (!words) return CHECK_REFUSED;
  parsed = parse_options(argc, words, host, &o);
  free(words);
  return parsed ? parsed - 1 : judge(&o);
}
