/* jam-pack export and page: files of the packing of a file as it is. */
#include <math.h>
#include <stdio.h>
#include "jam-pack.h"

/* The contact network that tables and pages show. */
typedef struct network {
  int known, stopped;
  int64_t contacts;
  char doubt[1024]; /* why it is empty, or not the only one, or no jammed one; empty where none of these */
} network;

/* Contacts by the gaps of the file, which needs no crunch: those that balance, or with --contact-gap all within it.
 * Spheres without forces are a fault where the network is asked for, not where a mesh would join touching ones. */
static void find_network(const options *o, jam_system *sys, network *found, int wanted) {
  jam_status status;
  size_t numbers = 0;
  cancel_on_signal(sys);
  jam_set_progress(sys, stop_late, (void *)o);
  status = isfinite(o->contact_gap) ? jam_contacts_by_distance(sys, o->contact_gap)
                                    : jam_contacts_from_geometry(sys, NULL, NULL);
  jam_set_progress(sys, NULL, NULL);
  cancel_on_signal(NULL);
  found->stopped = status == JAM_CANCELLED;
  found->known = status >= 0 && !found->stopped;
  if (found->known) jam_contacts(sys, NULL, 0, &numbers);
  found->contacts = (int64_t)(numbers / 2);
  if (status == JAM_OK || (!wanted && found->known && found->contacts == 0)) return;
  in_own_words(jam_last_error(), found->doubt, sizeof found->doubt);
  complain("%s%s", found->known ? "warning: " : "no contact network: ", jam_last_error());
}

static int put_path(const char *path, void *with) {
  if (!is_omitted(path)) put_item(with, path);
  return 0;
}

/* What the packing is, and which files were written. */
static int write_json(const options *o, const jam_system *sys, int code, const network *found) {
  const jam_info info = info_of(sys);
  text_list list = {NULL, 0};
  output out;
  if (open_output(&out, "-")) return -1;
  list.file = out.file;
  begin_json(out.file, o->input, code, messages());
  put_count(out.file, "n", info.n, 1);
  put_count(out.file, "dim", info.dim, 1);
  put_number(out.file, "packing_fraction", info.packing_fraction);
  fprintf(out.file, "  \"network\": %s,\n", found->contacts > 0 ? "true" : "false");
  put_count(out.file, "contacts", found->contacts, found->known);
  put_number(out.file, "contact_gap", info.contact_gap);
  fputs("  \"written\": [", out.file);
  each_output(o, put_path, &list);
  fputs("],\n", out.file);
  put_notes(out.file, jam_notes(sys), found->doubt);
  return end_json(&out);
}

static int print_path(const char *path, void *with) {
  (void)with;
  if (!is_omitted(path)) printf("  written   %s\n", path);
  return 0;
}

int export_file(const options *o) {
  const int tables = o->contacts || o->spectrum || o->gaps || o->structure;
  const int bridges = o->stl && isfinite(o->stl_bridge) && !isfinite(o->stl_bridge_gap);
  const int wanted = tables || o->vtk || o->page || bridges;
  network found = {0, 0, 0, ""};
  jam_system *sys = NULL;
  int code = read_as_it_is(o, &sys), cut_short = 0;
  if (!code && !sys) code = EXIT_FAILED;
  if (!code && check_formats(o, sys)) code = EXIT_USAGE;
  if (code) return leave(sys, code);
  if (wanted || (o->stl && !isfinite(o->stl_shrink))) find_network(o, sys, &found, wanted);
  if (!found.known)
    note_omitted(o->contacts), note_omitted(o->spectrum), note_omitted(o->gaps), note_omitted(o->structure);
  if (write_files(sys, o, found.known, &cut_short))
    code = failure_code();
  else
    code = found.stopped || cut_short ? EXIT_EARLY : tables && !found.known ? EXIT_FAILED : EXIT_DONE;
  if (o->json) {
    if (write_json(o, sys, code, &found) && !code) code = EXIT_OUTPUT;
  } else if (!o->quiet && !o->given.stdout_taken) {
    each_output(o, print_path, NULL);
    if (o->stl && !is_omitted(o->stl) && !wanted && found.known && found.contacts == 0)
      printf("  network   none: the mesh joins no spheres\n");
    if (*found.doubt) printf("  network   %lld contacts: %s\n", (long long)found.contacts, found.doubt);
  }
  return leave(sys, end_stdout(code));
}
