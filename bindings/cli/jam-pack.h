/* jam-pack: the parts of the program. Everything it does goes through the public header. */
#ifndef JAM_PACK_H
#define JAM_PACK_H
#include <stdint.h>
#include <stdio.h>
#include "jam/jam.h"
#include "pack.h"

/* Exit codes, documented in --help; check.c has its own. */
enum { EXIT_DONE = 0, EXIT_EARLY = 1, EXIT_USAGE = 2, EXIT_FAILED = 3, EXIT_OUTPUT = 4 };

#define MAX_STAGES 32
enum { NOT_GIVEN = -1 };

typedef struct stage {
  double growth;   /* G */
  double pressure; /* target; 0: that of --pressure */
} stage;

typedef struct given {
  stage stages[MAX_STAGES];
  int stage_count;
  const char *sizes, *diameters_file;     /* of --sizes: the text of a law, or a file of diameters */
  double cell[JAM_MAX_DIM * JAM_MAX_DIM]; /* of --cell: sides or vectors */
  int cell_count;                         /* of its numbers */
  const char *cell_text;                  /* of --cell as it was given */
  int32_t copies[JAM_MAX_DIM];            /* of --tile, along each cell vector */
  int copies_count;                       /* of its numbers; 0: not given */
  double density;                         /* of --packing-fraction or --porosity, 0: not given */
  int n;                                  /* whether --n was given */
  int file_count;                         /* words without dashes */
  int verb;                               /* of the first word; VERB_PACK without one */
  char **words;                           /* the command line, for the report */
  int word_count;
  const jam_pack_host *host; /* NULL: jam-pack alone */
  double deadline;           /* of --wall-time, on the clock of seconds_now */
  int stdout_taken;          /* by an output or JSON: no summary is printed */
  jam_diameters_options law; /* of --sizes LAW with its curve, read once: a pipe gives it once */
  double *curve;             /* NULL: there is no law, or it could not be read */
  size_t curve_len;
} given;

#include "options_table.h"

/* What the program has done, for the report and the summary. */
typedef struct outcome {
  jam_info info;
  jam_crunch_report crunch;
  jam_proof_report strict; /* of the strict jam_prove, where --strict-proof goes with --prove */
  jam_radii_report radii;  /* with --radii, then crunch has the verdict on the maximum alone */
  int has_md, has_crunch, has_strict, has_radii;
  int32_t md_stop;
  int64_t collisions;
  double pressure;                /* that dynamics reached; the crunch ends at infinite pressure */
  int32_t stage_stop[MAX_STAGES]; /* jam_stop_reason of the stages that were begun, else NONE */
  int fell_short;                 /* dynamics stalled before their aim, and the job went on */
  int cut_short;                  /* a table was not computed in time */
  int code;                       /* the exit code */
  double seconds_md;
  double diameter_given; /* mean of --sizes or of the file; NAN: no sizes in a unit of the user */
  double walls[2 * JAM_MAX_DIM + 1][JAM_WALL_STRESS + 1]; /* jam_walls, at the end */
  size_t wall_numbers;                                    /* of `walls` */
  double stress[JAM_MAX_DIM * JAM_MAX_DIM];               /* jam_stress, at the end */
  size_t stress_numbers;                                  /* of `stress`; 0: not known */
  const char *notes;                                      /* jam_notes: what reading changed */
} outcome;

/* progress.c: lines on stderr, rewritten in place on a terminal, every ten seconds elsewhere; the log; checkpoints. */
typedef struct terminal {
  const char *stage;
  double begin, told, kept; /* seconds on the clock of seconds_now: of the job, the last line, the last checkpoint */
  int is_terminal, has_counted; /* counted: the number of spheres was printed */
  FILE *log;
  const options *o;
  const jam_system *sys;
} terminal;
double seconds_now(void);
double seconds_until(double deadline); /* on that clock; above 0, as calls refuse a wall_time of 0 */
int start_progress(terminal *t, const options *o, jam_system *sys);
void write_checkpoint(const jam_system *sys, const options *o);
int end_progress(terminal *t, const options *o);

/* options.c: returns 0 to go on, or 1 + the exit code when there is nothing left to do. */
int parse_options(int argc, char **argv, const jam_pack_host *host, options *o);
/* outputs.c: each int of settle_ is 0, or -1 after a message on stderr. */
/* Calls f for every file that will be written, until it returns something else than 0. */
int each_output(const options *o, int (*f)(const char *path, void *with), void *with);
/* Standard output takes one of the outputs that can go there; --json is one. */
int settle_stdout(options *o);
/* Every output has its own file, and none that of the input. A checkpoint may go where the run was resumed from. */
int settle_files(const options *o);
int settle_crunched(const options *o); /* no output without the crunch that it shows */

/* settle.c: 0, or -1 after a message on stderr. Refuses options that contradict each other, and completes the rest. */
int settle(options *o);
int settle_cell(const options *o); /* whether --cell has the numbers of d; 0 or -1 likewise */
/* The word of a choice that has this number. */
const char *word_of_choice(const char *option, int number, char word[32]);
int is_named(const options *o, const char *name); /* whether the command line has this option, without dashes */

/* formats.c: the ending of a file name, without .gz; at most 7 letters of it. */
void ending_of(const char *path, char ending[8]);
int is_host_format(const options *o, const char *path); /* whether the host reads and writes such a file */
/* Each returns 0, or -1 after a message on stderr. They test before the work whether the library has the formats of the
 * file names, and whether the formats can store this packing and a crunch can take it. */
int settle_formats(const options *o);
int check_formats(const options *o, const jam_system *sys);

/* start.c: start returns 0 or an exit code after a message on stderr. *mean: of the diameters that --sizes or the file
 * gives, NAN without either. */
int start(const options *o, jam_system **sys, double *mean);
/* The packing of --input as it is: spheres may overlap, as in every file with few digits. 0, and *sys NULL when it was
 * interrupted; else an exit code after a message on stderr. */
int read_as_it_is(const options *o, jam_system **sys);
void complain_notes(const jam_system *sys); /* those of jam_notes, on stderr */

/* resume.c: 0, or an exit code after a message where the options are not those of the job that left this checkpoint.
 * *mean: of the diameters of --sizes, where it is given. */
int check_resumed(const options *o, const jam_system *sys, double *mean);

/* sizes.c: each int is 0, or -1 after a message on stderr. */
int take_sizes(const char *value, options *o);
int take_cell(const char *value, options *o);
int take_copies(const char *value, options *o);
int take_numbers(const char *value, double *out, int most);

/* radii.c: --radii. */
int take_radii(const options *o, jam_radii_options *radii);
jam_status run_radii(jam_system *sys, const options *o, double wall_time, outcome *result);
void print_radii(const options *o, const jam_radii_report *r);

/* shear_path.c: 0, or -1 after a message on stderr. The path begins as zeros. */
enum { MOST_TURNS = 64 };
typedef struct shear_path {
  double turns[MOST_TURNS];
  int turn_count;
  double mode[2 * JAM_MAX_DIM * JAM_MAX_DIM]; /* then the stress, where some of it is held */
  size_t mode_count;
  char text[600]; /* all of it, without blanks */
} shear_path;
int take_path(const options *o, const jam_system *sys, jam_shear_options *options, shear_path *path);

/* With the shells of --least-distance. *out NULL: all equal; the caller frees it. */
int make_diameters(const options *o, double **out, int64_t *n);
double mean_of(const double *diameters, int64_t n);
void fill_cell(const options *o, double *cell); /* (d, d): the vectors of --cell, or of the cube of --box */
/* A small sphere in the middle of the cell of the options, between their walls: what the library makes of this cell. */
int make_scene(const options *o, jam_system **sys);

/* report.c: each returns 0, or -1 after a message on stderr. path "-" is standard output. */
int write_report(const options *o, const outcome *result, const char *path);
void print_summary(const options *o, const outcome *result);
void print_warnings(const char *notes); /* those of jam_notes, on stderr */
/* Why the work ended early, and the option that continues it, on stderr. After a limit of time the library's text names
 * arguments of its calls, which are no options. */
void print_stop(const jam_system *sys, const options *o, jam_status status, const outcome *result);

/* messages.c: lines on stderr, which are kept for the JSON of a job that fails. */
extern const char *program; /* its name, in help and messages */
void complain(const char *format, ...);
/* A text of the library with the words of a command line for its C functions. */
void in_own_words(const char *text, char *out, size_t size);
const char *messages(void); /* of this command line so far */
void forget_messages(void);
/* 1 after a message when a call failed or was stopped: then it has written nothing. Notes the exit code that fits. */
int has_failed(jam_status status);
int code_of(jam_status status);      /* the exit code of a call that failed */
void note_failure(int code);         /* the first one counts */
void note_omitted(const char *path); /* of an option: this file is not written; may be NULL */
int is_omitted(const char *path);
int missing(const char *path, int bad); /* returns bad, after a note_omitted where it is not 0 */
int failure_code(void);                 /* EXIT_OUTPUT where none was noted */

/* json.c: items of an object, each a line that ends with a comma. Numbers that are not finite, and counts that are not
 * known, are null. */
void put_number(FILE *f, const char *key, double x);
void put_count(FILE *f, const char *key, int64_t x, int known);
void put_verdict(FILE *f, const char *key, int32_t verdict);
void put_stress(FILE *f, const double *stress, size_t numbers); /* stress_tensor, row by row; 0 numbers: null */
/* What all objects begin with: the file or NULL, the exit code, and what was said. */
void begin_json(FILE *f, const char *file, int code, const char *text);
void put_text(FILE *f, const char *text);                     /* the value alone */
void put_notes(FILE *f, const char *notes, const char *more); /* the lines of jam_notes, and one more or "" */
/* Texts of a list, with commas between them. */
typedef struct text_list {
  FILE *file;
  int count;
} text_list;
void put_item(text_list *list, const char *text);
jam_info info_of(const jam_system *sys); /* zeros where there is no packing */
/* Ends the work on a packing, whose size a JSON of a later failure gives. Returns code. */
int leave(jam_system *sys, int code);
/* The JSON of a job that wrote none: exit code, messages, and the packing of `leave`. 0, or -1 after a message. */
int write_failure(const char *file, int code);
int has_written_json(void);
void forget_state(void);
/* The lines of jam_notes: calls f with each, without its end. */
void each_note(const char *notes, void (*f)(const char *line, int warns, void *with), void *with);

/* output.c: a text that is written at its end, as a file that appears whole or not at all. path "-" is standard output,
 * open descriptors (/dev/stdout, /dev/fd/N), pipes and devices are written in place. Each returns 0, or -1 after a
 * message on stderr. */
typedef struct output {
  const char *path;
  FILE *file; /* collects the text */
  char *text;
  size_t size;
} output;
int check_writable(const char *path, void *unused); /* before hours of work */
int is_stdout(const char *path);
int appears_whole(const char *path); /* a file, which is replaced as a whole */
int open_output(output *out, const char *path);
int close_output(output *out);
int end_stdout(int code);  /* what printf has collected; code, or after a message EXIT_OUTPUT */
int end_json(output *out); /* the version, and the end of the object */
/* All of them, also after signals. A lost reader and a limit on the size of files are errors, and no signal. */
int put_bytes(int descriptor, const char *text, size_t size);

/* verbs.c: Ctrl-C and SIGTERM cancel the calls on a system, also where they came before; NULL: on none. */
void cancel_on_signal(jam_system *sys);
void watch_signals(jam_system *sys); /* the same from now on */
/* Progress callbacks. The second one, with the options, stops at --wall-time too. */
int32_t stop_if_asked(const jam_progress *progress, void *user);
int32_t stop_late(const jam_progress *progress, void *options);

/* write.c: all that the options ask for, and the summary. Returns the exit code, which is result->code where all is
 * written. */
int write_all(jam_system *sys, const options *o, outcome *result);
/* The files of the packing and, where its network is known, of the network. */
int write_files(jam_system *sys, const options *o, int known, int *cut_short);

/* pack.c, shear.c, check.c, info.c, export.c: what the verbs do; each returns the exit code. */
int run_job(const options *o); /* pack, compress, crunch */
int shear_file(const options *o);
int check_file(const options *o);
int show_info(const options *o);
int export_file(const options *o); /* `page` too */

/* pore.c: mesh, image and tables of the pore space; as of write_network. */
int write_pore_space(jam_system *sys, const options *o);

/* network.c: what --spectrum, --gaps and --structure ask for. Returns 0, or after a message on
 * stderr -1, and 1 where a call was stopped before its numbers were there. */
int write_network(jam_system *sys, const options *o);

#endif
