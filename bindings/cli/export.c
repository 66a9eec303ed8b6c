/* jam-pack export and page: files of the packing of a file as it is. */
#include <stdio.h>
#include "jam-pack.h"

/* The network that tables and pages show: contacts by the gaps of the file, which needs no crunch. Returns whether it
 * is there. */
static int find_network(jam_system *sys) {
  jam_status status;
  cancel_on_signal(sys);
  status = jam_contacts_from_geometry(sys, NULL, NULL);
  cancel_on_signal(NULL);
  if (status != JAM_OK) complain("%s%s", status > 0 ? "warning: " : "no contact network: ", jam_last_error());
  return status >= 0 && status != JAM_CANCELLED;
}

struct list {
  FILE *file;
  int first;
};
static int put_path(const char *path, void *with) {
  struct list *list = with;
  if (!list->first) fputs(", ", list->file);
  list->first = 0;
  put_text(list->file, path);
  return 0;
}

/* What the packing is, and which files were written. */
static int write_json(const options *o, const jam_system *sys, int known) {
  struct list list = {NULL, 1};
  jam_info info;
  output out;
  if (open_output(&out, "-")) return -1;
  list.file = out.file;
  info.struct_size = sizeof info;
  jam_get_info(sys, &info);
  begin_json(out.file, o->input);
  put_count(out.file, "n", info.n, 1);
  put_count(out.file, "dim", info.dim, 1);
  put_number(out.file, "packing_fraction", info.packing_fraction);
  fprintf(out.file, "  \"network\": %s,\n  \"written\": [", known ? "true" : "false");
  each_output(o, put_path, &list);
  fputs("],\n", out.file);
  put_notes(out.file, jam_notes(sys));
  fprintf(out.file, "  \"version\": \"%s\"\n}\n", jam_version());
  return close_output(&out);
}

static int print_path(const char *path, void *with) {
  (void)with;
  printf("  written   %s\n", path);
  return 0;
}

int export_file(const options *o) {
  const int tables = o->contacts || o->spectrum || o->gaps || o->structure;
  jam_system *sys = NULL;
  int code = read_as_it_is(o, &sys), known = 0, bad, cut_short = 0;
  if (!code && !sys) code = EXIT_FAILED;
  if (!code && check_formats(o, sys)) code = EXIT_USAGE;
  if (code) {
    jam_destroy(sys);
    return code;
  }
  if (tables || o->vtk || o->page || o->stl) known = find_network(sys);
  bad = write_files(sys, o, known, seconds_now() + o->wall_time, &cut_short);
  if (!bad && o->json)
    bad = write_json(o, sys, known);
  else if (!bad && !o->quiet)
    each_output(o, print_path, NULL);
  jam_destroy(sys);
  if (bad || fflush(stdout)) return EXIT_OUTPUT;
  if (tables && !known) return EXIT_FAILED;
  return cut_short ? EXIT_EARLY : EXIT_DONE;
}
