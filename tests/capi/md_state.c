/* Checkpoints, equations of state, the fit of the glass branch. */
#include <stdio.h>

#include "steps.h"

static const char *path = "md_state_checkpoint.bin";

static jam_system *make(int32_t model) {
  DEFAULTS(create, o);
  o.n = 120;
  o.model = model;
  o.packing_fraction = model == JAM_MODEL_MK ? 1.5 : 0.3;
  return created(&o);
}

CASE(resumes_to_the_same_bits) {
  int32_t model;
  for (model = JAM_MODEL_EUCLID; model <= JAM_MODEL_MK; ++model) {
    jam_system *a = make(model), *b = NULL;
    DEFAULTS(compress, c);
    assert_int_equal(jam_run(a, NULL, NULL), JAM_OK);
    assert_int_equal(jam_write_checkpoint(a, path), JAM_OK);
    assert_int_equal(jam_read_checkpoint(path, NULL, NULL, &b), JAM_OK);
    same(a, b);
    assert_int_equal(jam_run(a, NULL, NULL), JAM_OK);
    assert_int_equal(jam_run(b, NULL, NULL), JAM_OK);
    same(a, b);
    assert_int_equal(jam_compress(a, &c, NULL), JAM_OK);
    assert_int_equal(jam_compress(b, &c, NULL), JAM_OK);
    same(a, b);
    jam_destroy(a);
    jam_destroy(b);
  }
  remove(path);
}

CASE(refuses_what_is_no_checkpoint) {
  jam_system *sys = make(JAM_MODEL_MK), *out = NULL;
  unsigned char data[200000];
  size_t size, cut;
  FILE *f;
  assert_int_equal(jam_write_checkpoint(sys, NULL), JAM_E_NULL);
  assert_int_equal(jam_read_checkpoint(NULL, NULL, NULL, &out), JAM_E_NULL);
  assert_int_equal(jam_read_checkpoint("no such file", NULL, NULL, &out), JAM_E_IO);
  assert_int_equal(jam_write_checkpoint(sys, "no such folder/x"), JAM_E_IO);
  assert_int_equal(jam_write_checkpoint(sys, path), JAM_OK);
  f = fopen(path, "rb");
  size = fread(data, 1, sizeof data, f);
  fclose(f);
  for (cut = 0; cut < size; cut += size / 17) { /* truncated anywhere */
    f = fopen(path, "wb");
    fwrite(data, 1, cut, f);
    fclose(f);
    assert_int_equal(jam_read_checkpoint(path, NULL, NULL, &out), JAM_E_FORMAT);
  }
  for (cut = 0; cut < size; cut += size / 23) { /* a bit changed anywhere */
    f = fopen(path, "wb");
    data[cut] ^= 4;
    fwrite(data, 1, size, f);
    data[cut] ^= 4;
    fclose(f);
    assert_int_equal(jam_read_checkpoint(path, NULL, NULL, &out), JAM_E_FORMAT);
  }
  assert_null(out);
  remove(path);
  jam_destroy(sys);
}
