/* A call that fails: a status, and a text. */
#include <jam/jam.h>
#include <stdio.h>

int main(void) {
  jam_create_options o;
  jam_system *sys = NULL;
  if (jam_create_options_init(&o, sizeof o) < 0) return 1;
  o.n = 64;
  o.dim = 9;
  if (jam_create(&o, NULL, &sys) != JAM_E_DIMENSION || sys) return 2;
  puts(jam_last_error());
  return 0;
}
