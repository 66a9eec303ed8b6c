/* Calls of the fuzz target `calls` that look at a packing. Arrays are asked for by their size and then filled. */
#ifndef JAM_FUZZ_CALLS_ANALYSIS_H
#define JAM_FUZZ_CALLS_ANALYSIS_H
#include "input.h"

enum { many = 4096 };
static __thread double values[3][many];
static __thread int32_t integers[2][many];

static void call_network(input *in, jam_system *sys) {
  jam_geometry_options o;
  size_t needed;
  jam_geometry_options_init(&o, sizeof o);
  damage(in, &o, sizeof o);
  check_status(jam_contacts_from_geometry(sys, &o, NULL));
  check_status(jam_contact_candidates(sys, number(in), values[0], many, &needed));
  check_status(jam_contacts(sys, integers[0], many, &needed));
  check_status(jam_forces(sys, values[0], many, &needed));
  check_status(jam_stress_states(sys, values[0], many, values[1], many, values[2], &needed));
}

static void call_rigidity(input *in, jam_system *sys) {
  const int32_t kind = byte(in) % 3;
  size_t needed;
  check_status(jam_rigidity(sys, kind, NULL));
  check_status(jam_flex(sys, kind, values[0], many, values[1], 64, &needed));
  jam_check_report check = {.struct_size = sizeof check};
  jam_check_options o;
  jam_check_options_init(&o, sizeof o);
  damage(in, &o, sizeof o);
  o.wall_time = at_most(o.wall_time, 0.1);
  check_status(jam_check_packing(sys, &o, &check));
  jam_check_text(&check);
  check_status(jam_prove(sys, NULL, 0, NULL));
  check_status(jam_prove_strict(sys, NULL));
  check_status(jam_refined_positions(sys, NULL, 0, values[0], many, values[1], many, &needed));
}

static void call_modes(input *in, jam_system *sys) {
  jam_hessian_options h;
  jam_modes_options o;
  jam_moduli moduli;
  size_t rows;
  jam_hessian_options_init(&h, sizeof h);
  jam_modes_options_init(&o, sizeof o);
  h.stiffness = byte(in) % 4, o.which = byte(in) % 4;
  damage(in, &h, sizeof h);
  damage(in, &o, sizeof o);
  o.memory_limit = at_most(o.memory_limit, 1e8);
  check_status(jam_modes(sys, &h, &o, values[0], many, values[1], many, values[2], many, &rows));
  check_status(jam_hessian(sys, &h, NULL, 0, NULL, 0, NULL, 0, &rows));
  memset(&moduli, 0, sizeof moduli);
  moduli.struct_size = sizeof moduli;
  check_status(jam_moduli_get(sys, &h, &moduli));
}

static void call_spectrum(input *in, jam_system *sys) {
  jam_dos_options o;
  size_t needed;
  jam_dos_options_init(&o, sizeof o);
  o.moments = 16, o.vectors = 2, o.points = 10;
  damage(in, &o, sizeof o);
  check_status(jam_density_of_states(sys, NULL, &o, values[0], many, &needed));
}

static void call_floppy(input *in, jam_system *sys) {
  size_t needed;
  check_status(jam_floppy_mode(sys, byte(in) - 1, values[0], many, &needed));
  check_status(jam_floppy_modes(sys, values[0], many, &needed));
}

static void call_gaps(input *in, jam_system *sys) {
  size_t rows;
  check_status(jam_gaps(sys, number(in), byte(in) % 2, values[0], many, integers[0], many, &rows));
}

static void call_structure(input *in, jam_system *sys) {
  const int32_t bins = byte(in) % 8 ? byte(in) : 2000000000;
  double score;
  size_t needed;
  switch (byte(in) % 5) {
    case 0:
      check_status(jam_pair_correlation(sys, NULL, 0, -1, -1, number(in), bins, values[0], many, &needed));
      return;
    case 1:
      check_status(jam_structure_factor(sys, number(in), values[0], many, values[1], many, &needed));
      return;
    case 2:
      check_status(jam_bond_order(sys, byte(in), number(in), values[0], many, &needed));
      return;
    case 3:
      check_status(jam_crystal_score(sys, &score));
      return;
    default:
      check_status(jam_local_fraction(sys, values[0], many, &needed));
  }
}

static void call_classes(input *in, jam_system *sys) {
  const int32_t quantity = byte(in) % 9, which = byte(in) % 6;
  const int64_t bins = byte(in) % 8 ? byte(in) : (int64_t)1 << (byte(in) % 63);
  size_t rows;
  check_status(jam_contact_classes(sys, integers[0], many, &rows));
  check_status(jam_sphere_structure(sys, byte(in) % 2, values[0], many, values[1], many, &rows));
  check_status(jam_contact_dots(sys, byte(in) % 2, values[0], many, integers[0], many, &rows));
  check_status(jam_class_values(sys, quantity, which, values[0], many, &rows));
  check_status(jam_histogram(sys, quantity, which, number(in), number(in), bins, values[0], many, &rows));
}

/* A copy is as good as the packing, and the two compare. */
static void call_copy(input *in, jam_system *sys) {
  jam_system *copy = NULL;
  jam_comparison c;
  size_t needed;
  (void)in;
  check_status(jam_copy(sys, &copy));
  if (!copy) return;
  check_state(copy);
  memset(&c, 0, sizeof c);
  c.struct_size = sizeof c;
  check_status(jam_compare(sys, copy, &c, values[0], many, &needed));
  jam_destroy(copy);
}
#endif
