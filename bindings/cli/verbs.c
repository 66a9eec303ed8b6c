/* The program as a function: reads the command line, takes the signals, and does what the verb says. */
#include <math.h>
#include <signal.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "jam-pack.h"
#include "system.h"

/* The handler can reach nothing else: the handle to cancel, and that it was asked to. */
static jam_system *volatile running = NULL;
static volatile sig_atomic_t interrupted = 0;

static void on_signal(int number) {
  interrupted = 1;
  if (running) jam_cancel(running);
  signal(number, SIG_DFL); /* a second Ctrl-C ends the program at once */
}

void cancel_on_signal(jam_system *sys) {
  running = sys;
  if (sys && interrupted) jam_cancel(sys);
}

void watch_signals(jam_system *sys) { running = sys; }

int32_t stop_if_asked(const jam_progress *progress, void *user) {
  (void)progress, (void)user;
  return interrupted;
}

int32_t stop_late(const jam_progress *progress, void *o) {
  return stop_if_asked(progress, NULL) || seconds_now() > ((const options *)o)->given.deadline;
}

/* What the verb of a command line does; the exit code. */
static int run_verb(options *o) {
  switch (o->given.verb) {
    case VERB_SHEAR:
      return shear_file(o);
    case VERB_CHECK:
      return check_file(o);
    case VERB_INFO:
      return show_info(o);
    case VERB_EXPORT:
    case VERB_PAGE:
      return export_file(o);
    default:
      return run_job(o);
  }
}

/* What the host shall write and draw, before the work. */
static int refused_by_host(const options *o) {
  const jam_pack_host *const host = o->given.host;
  const char *const output = is_host_format(o, o->output) ? o->output : NULL;
  if (!host || !host->check || (!output && !o->plot) || !host->check(output, o->plot, host->user)) return 0;
  complain("%s", jam_last_error());
  return 1;
}

/* Of a command line that is refused. */
static int asks_for_json(int argc, char **argv) {
  while (argc > 1 && strcmp(argv[argc - 1], "--json")) --argc;
  return argc > 1;
}

int jam_pack_refuse(int argc, char **argv, int code, const char *why) {
  forget_messages();
  forget_state();
  complain("%s", why);
  return asks_for_json(argc, argv) && write_failure(NULL, code) ? EXIT_OUTPUT : code;
}

static int run_words(int argc, char **argv, const jam_pack_host *host, options *o) {
  int code;
  program = host ? host->name : "jam-pack";
  keep_standard_descriptors();
  forget_messages();
  forget_state();
  code = parse_options(argc, argv, host, o) - 1;
  o->given.deadline = seconds_now() + o->wall_time;
  if (code >= 0) return code && asks_for_json(argc, argv) && write_failure(NULL, code) ? EXIT_OUTPUT : code;
  if (each_output(o, check_writable, NULL)) {
    code = EXIT_OUTPUT;
  } else if (refused_by_host(o)) {
    code = EXIT_USAGE;
  } else {
    interrupted = 0;
    take_signals(on_signal); /* they stop the work; afterwards those who had them get them back */
    code = run_verb(o);
    give_signals_back();
  }
  if (!code || has_written_json() || !(o->json || (o->report && !strcmp(o->report, "-")))) return code;
  return write_failure(o->input ? o->input : o->resume, code) ? EXIT_OUTPUT : code;
}

int jam_pack(int argc, char **argv, const jam_pack_host *host) {
  options o;
  const int code = run_words(argc, argv, host, &o);
  free(o.given.curve);
  return code;
}
