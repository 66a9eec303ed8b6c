/* The program jam-pack. */
#include <stdlib.h>
#include <string.h>
#include "pack.h"
#include "system.h"

/* Ensembles are made by the Python module: `jam-pack ensemble ...` becomes what `python3 -m jam ensemble ...` runs. But
 * nothing is imported from the current folder, which may belong to anybody: that is "" in the path of -c. */
#define OWN_PATH "import sys; sys.path[:] = filter(None, sys.path); "
#define ERROR_ALONE "sys.excepthook = lambda kind, error, trace: print(error, file=sys.stderr); "
static char ensemble_main[] = OWN_PATH "from jam.ensemble.cli import main; sys.exit(main(sys.argv[2:]))";

static int run_ensemble(char **argv, int argc) {
  char **const words = calloc((size_t)argc + 3, sizeof *words);
  int k;
  if (words && !system("python3 -c \"" OWN_PATH ERROR_ALONE "import jam.ensemble\"")) {
    words[0] = "python3", words[1] = "-c", words[2] = ensemble_main;
    for (k = 1; k < argc; ++k) words[k + 2] = argv[k];
    become(words);
  }
  free(words);
  return jam_pack_refuse(argc, argv, 3, "ensemble needs python3 with the module jam, which needs numpy and h5py");
}

int main(int argc, char **argv) {
  take_words(&argc, &argv);
  return argc > 1 && !strcmp(argv[1], "ensemble") ? run_ensemble(argv, argc) : jam_pack(argc, argv, NULL);
}
