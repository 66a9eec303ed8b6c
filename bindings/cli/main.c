/* The program jam-pack. */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include "pack.h"
#include "system.h"

/* The Python module has these verbs: `jam-pack ensemble ...` becomes what `python3 -m jam ensemble ...` runs. But
 * nothing is imported from the current folder, which may belong to anybody: that is "" in the path of -c. */
#define OWN_PATH "import sys; sys.path[:] = filter(None, sys.path); "
#define ERROR_ALONE "sys.excepthook = lambda kind, error, trace: print(error, file=sys.stderr); "
#define RUNS(module) OWN_PATH "from " module " import main; sys.exit(main(sys.argv[2:]))"
static struct {
  const char *verb;
  char runs[160];
} in_python[] = {{"ensemble", RUNS("jam.ensemble.cli")}, {"search", RUNS("jam._search")}};

static int run_in_python(int argc, char **argv, char *runs) {
  char **const words = calloc((size_t)argc + 3, sizeof *words), why[100];
  int k;
  if (words && !system("python3 -c \"" OWN_PATH ERROR_ALONE "import jam.ensemble\"")) {
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
    if (!strcmp(argv[1], in_python[k].verb)) return run_in_python(argc, argv, in_python[k].runs);
  return jam_pack(argc, argv, NULL);
}
