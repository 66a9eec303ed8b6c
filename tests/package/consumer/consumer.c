/* A user's program, built against the installed tree only. */
#include <jam/jam.h>
#include <stdio.h>
#include <string.h>

int main(void) {
  const double positions[] = {0.25, 0.25, 0.25, 0.75, 0.75, 0.75}, diameter = 0.5;
  jam_create_options o;
  jam_start start = {.struct_size = sizeof(jam_start), .positions = positions, .positions_len = 6};
  jam_system *sys = NULL;
  jam_info info;
  start.diameters = &diameter;
  start.diameters_len = 1;
  if (jam_abi_version() != JAM_ABI) return 1;
  if (jam_create_options_init(&o, sizeof o) < 0) return 2;
  if (jam_create(&o, &start, &sys) < 0) {
    fprintf(stderr, "%s\n", jam_last_error());
    return 3;
  }
  info.struct_size = sizeof info;
  if (jam_get_info(sys, &info) < 0 || info.n != 2) return 4;
  jam_destroy(sys);
  printf("libjam %s: packing fraction %.4f\n", jam_version(), info.packing_fraction);
  return 0;
}
