/* The program jam-pack. */
#include <stdlib.h>
#include <string.h>
#include "pack.h"
#include "system.h"

/* Ensembles are made by the Python module: `jam-pack ensemble ...` becomes `python3 -m jam ensemble ...`. */
static int run_ensemble(char **argv, int argc) {
  char **const words = calloc((size_t)argc + 3, sizeof *words);
  int k;
  if (words && !system("python3 -c \"import jam.ensemble\"")) {
    words[0] = "python3", words[1] = "-m", words[2] = "jam";
    for (k = 1; k < argc; ++k) words[k + 2] = argv[k];
    become(words);
  }
  free(words);
  return jam_pack_refuse(argc, argv, 3, "ensemble needs python3 with the module jam");
}

int main(int argc, char **argv) {
  take_words(&argc, &argv);
  return argc > 1 && !strcmp(argv[1], "ensemble") ? run_ensemble(argv, argc) : jam_pack(argc, argv, NULL);
}
