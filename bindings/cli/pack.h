/* The command line of jam-pack as a function, which the program and `python3 -m jam` call. */
#ifndef JAM_PACK_PACK_H
#define JAM_PACK_PACK_H
#include "jam/jam.h"

/* What a program around it adds. Members but name may be NULL. */
typedef struct jam_pack_host {
  const char *name; /* of the program, in help and messages */
  /* Reads a .gsd file with these options; 0, or -1 after a message on stderr. The caller destroys *sys. */
  int (*read)(const char *path, const jam_create_options *o, void *user, jam_system **sys);
  /* At the end: writes a .gsd file, unless output is NULL, and draws, unless plot is NULL; 0, or -1 after a message. It
   * destroys sys. */
  int (*finish)(jam_system *sys, const char *output, const char *plot, void *user);
  /* Sees each progress record where there is something to draw. */
  jam_progress_fn progress;
  void *user;
} jam_pack_host;

/* Runs a command line and returns the exit status. host NULL: that of jam-pack. One call at a time in a process: it
 * takes SIGINT and SIGTERM while it runs. */
int jam_pack(int argc, char **argv, const jam_pack_host *host);
#endif
