/* Fuzz target over sequences of calls on tiny systems of any dimension, size ratio, model and box. Option structs hold
 * bytes of the input behind a struct_size that is mostly right. Every call ends with a known status and a valid state.
 */
#include "fuzz.h"

typedef struct input {
  const uint8_t *data;
  size_t left;
} input;

static int byte(input *in) {
  if (!in->left) return 0;
  --in->left;
  return *in->data++;
}

/* Between 1e-9 and 1e9 by powers, or now and then a special value. */
static double number(input *in) {
  static const double special[] = {0.0, -1.0, NAN, INFINITY, -INFINITY, 1e300, 1e-300, 5e-324};
  const int kind = byte(in);
  if (kind > 247) return special[kind - 248];
  return (1.0 + byte(in) / 256.0) * pow(10.0, (kind % 19) - 9);
}

/* Damages one field of an option struct: four bytes somewhere behind struct_size, or the size itself. */
static void damage(input *in, void *options, size_t size) {
  const int how = byte(in);
  uint8_t *bytes = options;
  size_t at;
  if (how < 128) return;
  if (how > 250) {
    uint32_t wrong = (uint32_t)byte(in);
    memcpy(bytes, &wrong, sizeof wrong);
    return;
  }
  at = 4 + 4 * ((size_t)byte(in) % ((size - 4) / 4));
  for (size_t k = 0; k < 4; ++k) bytes[at + k] = (uint8_t)byte(in);
}

static jam_system *create(input *in) {
  jam_create_options o;
  jam_system *sys = NULL;
  double x[6 * 8], diameter[6];
  int k, given, n;
  jam_status status;
  jam_create_options_init(&o, sizeof o);
  o.dim = 2 + byte(in) % 7;
  n = 1 + byte(in) % 6;
  o.n = n;
  o.seed = byte(in);
  o.model = byte(in) % 4 == 0;
  o.overlap = JAM_OVERLAP_SHRINK;
  o.packing_fraction = 0.001 * (1 + byte(in) % 100);
  given = byte(in);
  if (given % 8 == 0) o.box = number(in);
  if (given % 16 == 1) o.mk_zeta = number(in);
  damage(in, &o, sizeof o);
  for (k = 0; k < n; ++k) diameter[k] = given % 4 == 2 ? number(in) : 0.1;
  for (k = 0; k < n * o.dim && k < 48; ++k) x[k] = given % 32 == 3 ? number(in) : byte(in) / 256.0;
  if (o.dim < 2 || o.dim > 8 || o.n < 1 || o.n > 6 || given % 3 == 0) {
    if (o.n > 50) o.n = 50;
    status = jam_create(&o, NULL, 0, NULL, 0, &sys);
  } else {
    status = jam_create(&o, x, (size_t)(o.n * o.dim), diameter, (size_t)o.n, &sys);
  }
  check_status(status);
  demand((status == JAM_OK) == (sys != NULL), "a handle exactly with success");
  return sys;
}

static void step(input *in, jam_system *sys) {
  size_t needed = 0;
  switch (byte(in) % 10) {
    case 0: {
      jam_run_options o;
      jam_run_options_init(&o, sizeof o);
      o.collisions_per_particle = 5.0, o.wall_time = 0.02;
      damage(in, &o, sizeof o);
      if (!(o.wall_time <= 0.02)) o.wall_time = 0.02;
      check_status(jam_run(sys, &o, NULL));
      return;
    }
    case 1: {
      jam_compress_options o;
      jam_compress_options_init(&o, sizeof o);
      o.wall_time = 0.02;
      damage(in, &o, sizeof o);
      if (!(o.wall_time <= 0.02)) o.wall_time = 0.02;
      check_status(jam_compress(sys, &o, NULL));
      return;
    }
    case 2: {
      jam_crunch_options o;
      jam_crunch_options_init(&o, sizeof o);
      o.wall_time = 0.05;
      damage(in, &o, sizeof o);
      if (!(o.wall_time <= 0.05)) o.wall_time = 0.05;
      check_status(jam_crunch(sys, &o, NULL));
      return;
    }
    case 3:
      check_status(jam_scale_diameters(sys, number(in)));
      return;
    case 4:
      check_status(jam_gaps(sys, number(in), byte(in) % 2, NULL, 0, NULL, 0, &needed));
      return;
    case 5:
      check_status(jam_local_fraction(sys, NULL, 0, &needed));
      return;
    case 6: {
      double x[48];
      const double *view;
      size_t len, k;
      jam_positions_view(sys, &view, &len);
      for (k = 0; k < len && k < 48; ++k) x[k] = byte(in) / 16.0;
      check_status(jam_set_positions(sys, x, len < 48 ? len : 48));
      return;
    }
    case 7: {
      jam_monte_carlo_options o;
      jam_monte_carlo_options_init(&o, sizeof o);
      o.sweeps = 5, o.wall_time = 0.02;
      damage(in, &o, sizeof o);
      if (!(o.wall_time <= 0.02)) o.wall_time = 0.02;
      check_status(jam_monte_carlo(sys, &o, NULL));
      return;
    }
    case 8: {
      double strain[64];
      int k;
      for (k = 0; k < 64; ++k) strain[k] = 0.01 * number(in);
      check_status(jam_strain(sys, strain, (size_t)(1 + byte(in) % 64)));
      return;
    }
    default: {
      jam_system *copy = NULL;
      check_status(jam_copy(sys, &copy));
      if (copy) check_state(copy);
      jam_destroy(copy);
      return;
    }
  }
}

int LLVMFuzzerTestOneInput(const uint8_t *data, size_t size) {
  input in = {data, size};
  int calls;
  jam_system *sys = create(&in);
  if (!sys) return 0;
  check_state(sys);
  jam_set_memory_limit(sys, 1e8); /* and with it the time of searches for pairs */
  for (calls = 0; calls < 6 && in.left > 0; ++calls) {
    step(&in, sys);
    check_state(sys);
  }
  jam_destroy(sys);
  return 0;
}
