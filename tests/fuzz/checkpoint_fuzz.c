/* Fuzz target over jam_checkpoint_read: the input is a checkpoint without its magic and checksum, which are put right
 * here, so that every field is reached. The answer is an error with a text, or a valid system that runs on. */
#define _GNU_SOURCE
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <unistd.h>
#include "fuzz.h"

static uint64_t mix64(uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

static uint64_t checksum(const uint8_t *data, size_t size) {
  uint64_t sum = 0x6a616d;
  size_t k;
  for (k = 0; k < size; k += 8) {
    uint64_t word = 0;
    memcpy(&word, data + k, size - k < 8 ? size - k : 8);
    sum = mix64(sum ^ word);
  }
  return sum;
}

int LLVMFuzzerTestOneInput(const uint8_t *input, size_t size) {
  static const char magic[8] = {'j', 'a', 'm', 's', 't', 'a', 't', '3'};
  char path[64];
  jam_system *sys = NULL;
  jam_status status;
  jam_run_options run;
  jam_compress_options compress;
  uint64_t sum;
  uint8_t *data = malloc(size + 16);
  const int fd = memfd_create("input", 0);
  demand(data && fd >= 0, "memory");
  memcpy(data, magic, 8);
  if (size) memcpy(data + 8, input, size);
  sum = checksum(data, size + 8);
  memcpy(data + 8 + size, &sum, 8);
  demand(write(fd, data, size + 16) == (ssize_t)(size + 16), "write");
  free(data);
  snprintf(path, sizeof path, "/proc/self/fd/%d", fd);
  status = jam_checkpoint_read(path, &sys);
  close(fd);
  check_status(status);
  if (status != JAM_OK) {
    demand(!sys, "no handle with an error");
    return 0;
  }
  check_state(sys);
  jam_run_options_init(&run, sizeof run);
  jam_compress_options_init(&compress, sizeof compress);
  run.resume = compress.resume = 1;
  run.collisions_per_particle = compress.collisions_per_particle = 5.0;
  run.wall_time = compress.wall_time = 0.05;
  check_status(jam_run(sys, &run, NULL));
  check_state(sys);
  check_status(jam_compress(sys, &compress, NULL));
  check_state(sys);
  jam_destroy(sys);
  return 0;
}
