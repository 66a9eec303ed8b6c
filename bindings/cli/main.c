/* The program jam-pack. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "pack.h"
#include "system.h"

/* The Python module has these verbs: `jam-pack ensemble ...` becomes `python3 -m jam ensemble ...`, also in the eyes of
 * the module. But nothing is imported from the current folder, which may belong to anybody: that is "" in the path of
 * -c. */
#define AS_M \
  "import sys; sys.path[:] = filter(None, sys.path); sys.orig_argv, sys.argv[0] = ['jam', *sys.argv[1:]], '-m'; "
#define ERROR_ALONE "sys.excepthook = lambda kind, error, trace: print(error, file=sys.stderr); "
static const char *const in_python[] = {"ensemble", "search"};

static int run_in_python(int argc, char **argv) {
  static char runs[] = AS_M "import runpy; runpy.run_module('jam', None, '__main__', True)";
  char **const words = calloc((size_t)argc + 3, sizeof *words), why[100];
  int k;
  if (words && !run_shell("python3 -c \"" AS_M ERROR_ALONE "import jam.ensemble\"")) {
    words[0] = "python3", words[1] = "-c", words[2] = runs;
    for (k = 1; k < argc; ++k) words[k + 2] = argv[k];
    become(words);
  }
  free(words);
  snprintf(why, sizeof why, "%s needs python3 with the module jam, which needs numpy and h5py", argv[1]);
  return jam_pack_refuse(argc, argv, 3, why);
}

int main(int argc, char **argv) {
  size_t k;
  take_words(&argc, &argv);
  for (k = 0; argc > 1 && k < sizeof in_python / sizeof *in_python; ++k)
    if (!strcmp(argv[1], in_python[k])) return run_in_python(argc, argv);
  return jam_pack(argc, argv, NULL);
}
