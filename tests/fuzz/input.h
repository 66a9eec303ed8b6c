/* How a fuzz target takes numbers and damaged option structs from its input. */
#ifndef JAM_FUZZ_INPUT_H
#define JAM_FUZZ_INPUT_H
#include "fuzz.h"

typedef struct input {
  const uint8_t *data;
  size_t left;
} input;

static inline int byte(input *in) {
  if (!in->left) return 0;
  --in->left;
  return *in->data++;
}

/* Between 1e-9 and 1e9 by powers, or now and then a special value. */
static inline double number(input *in) {
  static const double special[] = {0.0, -1.0, NAN, INFINITY, -INFINITY, 1e300, 1e-300, 5e-324};
  const int kind = byte(in);
  if (kind > 247) return special[kind - 248];
  return (1.0 + byte(in) / 256.0) * pow(10.0, (kind % 19) - 9);
}

/* Damages one field of an option struct: four bytes somewhere behind struct_size, or the size itself, which is trusted
 * not to exceed the struct. */
static inline void damage(input *in, void *options, size_t size) {
  const int how = byte(in);
  uint8_t *bytes = options;
  size_t at;
  if (how < 128) return;
  if (how > 250) {
    const uint32_t wrong = (uint32_t)((size_t)byte(in) % (size + 4)); /* beyond it no multiple of its alignment */
    memcpy(bytes, &wrong, sizeof wrong);
    return;
  }
  at = 4 + 4 * ((size_t)byte(in) % ((size - 4) / 4));
  for (size_t k = 0; k < 4; ++k) bytes[at + k] = (uint8_t)byte(in);
}

/* Limits of time stay as the target set them: an infinite one is no defect. */
static inline double at_most(double wanted, double most) { return wanted <= most ? wanted : most; }
#endif
