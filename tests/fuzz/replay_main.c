/* replay COUNT PATH...: runs a fuzz target over files and folders of files, without libFuzzer. Each file is also cut at
 * every one of its first COUNT bytes and has each of them changed. */
#include <dirent.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <sys/stat.h>

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size);

static long replay(const char *path, size_t changed) {
  static const uint8_t changes[] = {0, '\n', '9', '-', '=', 255};
  FILE *f = fopen(path, "rb");
  uint8_t *data = malloc(1 << 16);
  size_t size, k, c;
  long runs = 1;
  if (!f || !data) exit(2);
  size = fread(data, 1, 1 << 16, f);
  fclose(f);
  LLVMFuzzerTestOneInput(data, size);
  for (k = 0; k < size && k < changed; ++k) {
    const uint8_t kept = data[k];
    LLVMFuzzerTestOneInput(data, k);
    for (c = 0; c < sizeof changes; ++c) {
      data[k] = changes[c];
      LLVMFuzzerTestOneInput(data, size);
    }
    data[k] = kept;
    runs += 1 + (long)sizeof changes;
  }
  free(data);
  return runs;
}

int main(int argc, char **argv) {
  long files = 0, runs = 0;
  const size_t changed = argc > 1 ? (size_t)atol(argv[1]) : 0;
  int k;
  for (k = 2; k < argc; ++k) {
    struct dirent *entry;
    DIR *folder = opendir(argv[k]);
    char path[4096];
    if (!folder) {
      ++files;
      runs += replay(argv[k], changed);
      continue;
    }
    while ((entry = readdir(folder)) != NULL) {
      if (entry->d_name[0] == '.') continue;
      snprintf(path, sizeof path, "%s/%s", argv[k], entry->d_name);
      ++files;
      runs += replay(path, changed);
    }
    closedir(folder);
  }
  printf("%ld files, %ld inputs\n", files, runs);
  return files ? 0 : 1;
}
