/* The command line of jam-pack as a function, which the program and `python3 -m jam` call. */
#ifndef JAM_PACK_PACK_H
#define JAM_PACK_PACK_H
#include "jam/jam.h"

/* What a program around it adds. Members but name may be NULL. */
typedef struct jam_pack_host {
  const char *name; /* of the program, in help and messages */
  /* Reads a .gsd file with these options; 0, or -1 where jam_last_error says why. The caller destroys *sys. */
  int (*read)(const char *path, const jam_create_options *o, void *user, jam_system **sys);
  /* Before the work: whether `finish` can write and draw these, either of which may be NULL; 0, or -1 where
   * jam_last_error says why not. */
  int (*check)(const char *output, const char *plot, void *user);
  /* At the end: writes a .gsd file, unless output is NULL, and draws, unless plot is NULL; 0, or -1 where
   * jam_last_error says why. It destroys sys. */
  int (*finish)(jam_system *sys, const char *output, const char *plot, void *user);
  /* Sees each progress record where there is something to draw. */
  jam_progress_fn progress;
  void *user;
} jam_pack_host;

/* Runs a command line and returns the exit status. host NULL: that of jam-pack. One call at a time in a process: it
 * takes SIGINT and SIGTERM while it runs. */
int jam_pack(int argc, char **argv, const jam_pack_host *host);

/* What a command line without a job answers that cannot be done: a message, and JSON where it asks for that. Returns
 * code. */
int jam_pack_refuse(int argc, char **argv, int code, const char *why);

/* tables.c: tables of the jammed network as text, one header line, 17 digits. The caller frees *text, which stays NULL
 * where a call has failed or was stopped: its status is returned, jam_last_error says why. */
/* A line a mode that converged: number, lambda, omega, participation. mode: the table of jam_modes. */
jam_status jam_pack_modes(const double *mode, size_t mode_len, char **text);
/* A line a gap below h_max that is no contact: i, j, gap, and 1 when both spheres are stable. */
jam_status jam_pack_gaps(const jam_system *sys, double h_max, char **text);
/* A line a sphere: contacts, class, C_i, S_i, S_i with forces, Q6, packing fraction of its Voronoi cell (d = 3). */
jam_status jam_pack_structure(const jam_system *sys, char **text);
#endif
