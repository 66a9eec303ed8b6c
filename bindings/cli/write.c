/* The files and the summary at the end of a job. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "jam-pack.h"

/* Of a crunch that ended before its contacts were known there is no network to write. */
static int knows_contacts(const options *o, const outcome *result) {
  if (!result->has_crunch) return 0;
  if (result->crunch.rattlers >= 0) return 1;
  if (o->contacts || o->proof || o->strict_proof || o->gaps || o->structure || o->spectrum)
    complain("the crunch stopped before its contacts were known: files of the contact network are not written");
  return 0;
}

/* By the ending of the name; a table where there is none. */
static int write_contacts(const jam_system *sys, const char *path) {
  char ending[8];
  ending_of(path, ending);
  if (!strcmp(path, "-")) path = "/dev/stdout";
  return has_failed(jam_write_contacts(sys, path, *ending ? JAM_CONTACTS_AUTO : JAM_CONTACTS_CSV));
}

/* A packing that is not jammed has nothing to prove. */
static int write_proof(jam_system *sys, const char *path, int32_t kind) {
  jam_rigidity_report tested = {.struct_size = sizeof tested};
  const jam_status status = jam_rigidity(sys, kind, &tested);
  if (status == JAM_OK) return has_failed(jam_write_proof(sys, path, kind, NULL, 0));
  if (has_failed(status)) return 1;
  complain("%s is not written: %s", path, jam_last_error());
  note_failure(EXIT_EARLY);
  return 1;
}

/* PREFIX.vtp, and PREFIX-forces.vtp where there is a network. */
static int write_vtk(const jam_system *sys, const char *prefix, int network) {
  char *const path = malloc(strlen(prefix) + sizeof "-forces.vtp");
  int bad;
  if (!path) {
    complain("cannot write %s.vtp: out of memory", prefix);
    return 1;
  }
  sprintf(path, "%s.vtp", prefix);
  bad = has_failed(jam_write(sys, path, JAM_FORMAT_VTP));
  sprintf(path, "%s-forces.vtp", prefix);
  if (network) bad |= has_failed(jam_write_contacts(sys, path, JAM_CONTACTS_VTP));
  free(path);
  return bad;
}

/* What the host writes and draws, from a copy. */
static int finish_by_host(const jam_system *sys, const options *o) {
  const jam_pack_host *const host = o->given.host;
  const char *const output = is_host_format(o, o->output) ? o->output : NULL;
  jam_system *copy = NULL;
  if (!host || !host->finish || (!output && !o->plot)) return 0;
  if (jam_copy(sys, &copy) != JAM_OK) return has_failed(JAM_E_MEMORY);
  if (!host->finish(copy, output, o->plot, host->user)) return 0;
  missing(output, 1), missing(o->plot, 1);
  return has_failed(JAM_E_IO);
}

int write_files(jam_system *sys, const options *o, int known, int *cut_short) {
  int bad = 0, network = 0;
  if (o->output && !is_host_format(o, o->output))
    bad |= missing(o->output, has_failed(jam_write_scaled(sys, o->output, JAM_FORMAT_AUTO, o->scale, o->density)));
  if (o->contacts && known) bad |= missing(o->contacts, write_contacts(sys, o->contacts));
  if (o->proof && known) bad |= missing(o->proof, write_proof(sys, o->proof, JAM_RIGIDITY_COLLECTIVE));
  if (o->strict_proof && known) bad |= missing(o->strict_proof, write_proof(sys, o->strict_proof, JAM_RIGIDITY_STRICT));
  if (o->page) bad |= missing(o->page, has_failed(jam_write_page(sys, o->page, "", 0, "", NULL, 0)));
  cancel_on_signal(sys); /* a large spectrum takes long */
  jam_set_progress(sys, stop_late, (void *)o);
  if (known) network = write_network(sys, o);
  if (network >= 0) network |= write_pore_space(sys, o);
  jam_set_progress(sys, NULL, NULL);
  cancel_on_signal(NULL);
  *cut_short = network > 0;
  if (o->vtk) bad |= missing(o->vtk, write_vtk(sys, o->vtk, known));
  return bad | (network < 0) | finish_by_host(sys, o);
}

int write_all(jam_system *sys, const options *o, outcome *result) {
  int bad;
  result->info = info_of(sys);
  result->notes = jam_notes(sys);
  jam_walls(sys, JAM_WALL_COLUMNS, &result->walls[0][0], sizeof result->walls / sizeof(double), &result->wall_numbers);
  if (!result->has_crunch || jam_stress(sys, result->stress, sizeof result->stress / sizeof *result->stress,
                                        &result->stress_numbers) != JAM_OK)
    result->stress_numbers = 0;
  bad = write_files(sys, o, knows_contacts(o, result), &result->cut_short);
  if (bad)
    result->code = failure_code();
  else if (result->cut_short && result->code == EXIT_DONE)
    result->code = EXIT_EARLY;
  if (o->report && write_report(o, result, o->report)) result->code = EXIT_OUTPUT;
  if (!o->quiet && !o->given.stdout_taken) print_summary(o, result);
  return end_stdout(result->code);
}
