/* What --spectrum, --gaps and --structure write: tables of the jammed network, one header line, 17 digits. */
#include <stdio.h>
#include <stdlib.h>
#include "jam-pack.h"

/* Writes and frees the text that a call has made; 0, or after a message -1, and 1 where it was stopped. */
static int write_table(jam_status status, char *text, const char *path) {
  output out;
  int bad = -1;
  if (status < 0)
    complain("cannot write %s: %s", path, jam_last_error());
  else if (!text) {
    complain("%s is not written: Ctrl-C or --wall-time came before it was computed", path);
    note_omitted(path);
    bad = 1;
  } else if ((bad = open_output(&out, path)) == 0) {
    fputs(text, out.file);
    bad = close_output(&out);
  }
  free(text);
  return missing(path, bad);
}

static int write_spectrum(jam_system *sys, int64_t count, const char *path) {
  jam_modes_options o;
  size_t m = 0;
  double *mode = NULL;
  char *text = NULL;
  jam_status status;
  int bad;
  jam_modes_options_init(&o, sizeof o);
  if (count == 0) o.which = JAM_MODES_ALL;
  o.count = count < 0 ? 100 : count;
  status = jam_modes(sys, NULL, &o, JAM_MODE_COLUMNS, NULL, 0, NULL, 0, &m);
  if (status >= 0 && status != JAM_CANCELLED) {
    mode = malloc((2 * m + 1) * sizeof *mode);
    if (!mode) jam_set_error("out of memory");
    status = mode ? jam_modes(sys, NULL, &o, JAM_MODE_COLUMNS, mode, 2 * m, NULL, 0, NULL) : JAM_E_MEMORY;
  }
  if (status >= 0 && status != JAM_CANCELLED) status = jam_pack_modes(mode, 2 * m, &text);
  if (status >= 0 && text && count > 0 && (int64_t)m < count)
    complain("%s has %lld modes: there are no more", path, (long long)m);
  bad = write_table(status, text, path);
  free(mode);
  return bad;
}

static int write_gaps(const jam_system *sys, const char *path) {
  char *text = NULL;
  const jam_status status = jam_pack_gaps(sys, 1.0, &text);
  return write_table(status, text, path);
}

static int write_structure(const jam_system *sys, const char *path) {
  char *text = NULL;
  const jam_status status = jam_pack_structure(sys, &text);
  return write_table(status, text, path);
}

int write_network(jam_system *sys, const options *o) {
  const int bad[] = {o->gaps ? write_gaps(sys, o->gaps) : 0, o->structure ? write_structure(sys, o->structure) : 0,
                     o->spectrum ? write_spectrum(sys, o->modes, o->spectrum) : 0};
  int worst = 0, k;
  for (k = 0; k < 3; ++k)
    if (bad[k] && worst >= 0) worst = bad[k];
  return worst;
}
