/* Checkpoints: each verb goes on from one to the bits of a handle that was never written; damaged ones are refused. */
#include "io_helpers.h"
#include "steps.h"

static jam_system *make(int32_t model, int64_t n) {
  DEFAULTS(create, o);
  o.n = n, o.model = model, o.packing_fraction = model == JAM_MODEL_MK ? 1.5 : 0.3;
  return created(&o);
}

static void move(jam_system *sys, int32_t model) {
  DEFAULTS(monte_carlo, mc);
  mc.sweeps = 20, mc.step = 0.1;
  run(sys, 100);
  if (model == JAM_MODEL_EUCLID) assert_int_equal(jam_monte_carlo(sys, &mc, NULL), JAM_OK);
}

CASE(resumes_to_the_same_bits) {
  for (int32_t model = JAM_MODEL_EUCLID; model <= JAM_MODEL_MK; ++model) {
    OWNED jam_system *a = make(model, 120), *b = NULL;
    move(a, model);
    b = from_checkpoint(a);
    same(a, b);
    move(a, model), move(b, model); /* random numbers go on, too */
    same(a, b);
    assert_int_equal(jam_compress(a, NULL, NULL), JAM_OK);
    assert_int_equal(jam_compress(b, NULL, NULL), JAM_OK);
    same(a, b);
  }
}

static char *bytes_of(const jam_system *sys, size_t *size) {
  assert_int_equal(jam_write_checkpoint(sys, in_scratch("state")), JAM_OK);
  return get_bytes(in_scratch("state"), size);
}

static jam_status read_state(const char *bytes, size_t size, jam_system **out) {
  put_bytes(in_scratch("state"), bytes, size);
  return jam_read_checkpoint(in_scratch("state"), NULL, NULL, out);
}

CASE(refuses_what_is_no_checkpoint) {
  jam_system *sys = make(JAM_MODEL_MK, 120), *out = NULL;
  size_t size;
  assert_int_equal(jam_write_checkpoint(sys, NULL), JAM_E_NULL);
  assert_int_equal(jam_read_checkpoint(NULL, NULL, NULL, &out), JAM_E_NULL);
  assert_int_equal(jam_read_checkpoint("no such file", NULL, NULL, &out), JAM_E_IO);
  assert_int_equal(jam_write_checkpoint(sys, "no such folder/x"), JAM_E_IO);
  char *data = bytes_of(sys, &size);
  for (size_t at = 0; at < size; at += size / 17) assert_int_equal(read_state(data, at, &out), JAM_E_FORMAT);
  for (size_t at = 0; at < size; at += size / 23) { /* a bit changed anywhere */
    data[at] ^= 4;
    assert_int_equal(read_state(data, size, &out), JAM_E_FORMAT);
    data[at] ^= 4;
  }
  data[7] = '0';
  SAYS(read_state(data, size, &out), JAM_E_FORMAT, "another version");
  assert_null(out);
  free(data);
  jam_destroy(sys);
}

static uint64_t mix64(uint64_t x) {
  x += 0x9e3779b97f4a7c15ull;
  x = (x ^ (x >> 30)) * 0xbf58476d1ce4e5b9ull;
  x = (x ^ (x >> 27)) * 0x94d049bb133111ebull;
  return x ^ (x >> 31);
}

static void seal(char *data, size_t size) {
  uint64_t sum = 0x6a616d, word;
  for (size_t k = 0; k < size - 8; k += 8) {
    word = 0;
    memcpy(&word, data + k, size - 8 - k < 8 ? size - 8 - k : 8);
    sum = mix64(sum ^ word);
  }
  memcpy(data + size - 8, &sum, 8);
}

/* A stage never has a growth rate that its call refuses: below 1e-15 no diameter would change, and the
 * stage would not end. */
CASE(growth_rates_of_stages_are_those_of_calls) {
  OWNED jam_system *sys = make(JAM_MODEL_EUCLID, 60);
  jam_system *out = NULL;
  size_t size, at = 0;
  DEFAULTS(compress, c);
  c.growth_rate = 0.0123, c.pressure = 1e6, c.collisions_per_particle = 20;
  assert_int_equal(jam_compress(sys, &c, NULL), JAM_LIMIT);
  char *data = bytes_of(sys, &size);
  while (memcmp(data + at, &c.growth_rate, 8) != 0) assert_true(++at + 8 < size);
  const double rates[] = {1e-15, 9e-16, 1e-300, 1001.0, -0.0123};
  for (size_t k = 0; k < sizeof rates / sizeof *rates; ++k) {
    memcpy(data + at, &rates[k], 8);
    seal(data, size);
    assert_int_equal(read_state(data, size, &out), k == 0 ? JAM_OK : JAM_E_FORMAT);
  }
  jam_destroy(out);
  free(data);
}

/* Any byte of a stage may be damaged and the checksum made right again: an error or a run, never a crash or an endless
 * loop. */
CASE(damaged_stages_are_refused) {
  for (int32_t model = JAM_MODEL_EUCLID; model <= JAM_MODEL_MK; ++model) {
    DEFAULTS(create, o);
    o.n = 60, o.model = model, o.packing_fraction = 0.3;
    jam_system *sys = created(&o), *out = NULL;
    size_t size;
    int refused = 0;
    DEFAULTS(compress, c);
    c.collisions_per_particle = 20;
    assert_int_equal(jam_compress(sys, &c, NULL), JAM_LIMIT);
    char *data = bytes_of(sys, &size);
    c.resume = 1, c.collisions_per_particle = 25, c.wall_time = 0.2;
    assert_true(size > 9000);
    for (size_t at = 60 * 7 * 8 + 100; at + 8 < size; at += 211) {
      const char was = data[at];
      data[at] ^= (char)(1u << at % 8);
      seal(data, size);
      if (read_state(data, size, &out) < 0) {
        ++refused;
      } else {
        jam_compress(out, &c, NULL);
        jam_destroy(out);
      }
      data[at] = was;
    }
    assert_true(refused > 5);
    free(data);
    jam_destroy(sys);
  }
}

FIXTURE(make_scratch, remove_scratch)
