/* The program jam-pack. */
#include "pack.h"

int main(int argc, char **argv) { return jam_pack(argc, argv, NULL); }
