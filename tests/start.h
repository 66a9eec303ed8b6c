/* Systems from arrays, as tests and benchmarks start them. */
#ifndef JAM_TESTS_START_H
#define JAM_TESTS_START_H

#include <jam/jam.h>

static inline jam_start start_at(const double *x, size_t x_len, const double *diameter, size_t diameter_len) {
  const jam_start start = {sizeof(jam_start), 0, x, x_len, diameter, diameter_len, NULL, 0, NULL, NULL};
  return start;
}

static inline jam_status create_from(const jam_create_options *o, const double *x, size_t x_len, const double *diameter,
                                     size_t diameter_len, jam_system **out) {
  const jam_start start = start_at(x, x_len, diameter, diameter_len);
  return jam_create(o, &start, out);
}

static inline jam_status create_in_cell(const jam_create_options *o, const double *cell, size_t cell_len,
                                        const double *x, size_t x_len, const double *diameter, size_t diameter_len,
                                        jam_system **out) {
  jam_start start = start_at(x, x_len, diameter, diameter_len);
  start.cell = cell, start.cell_len = cell_len;
  return jam_create(o, &start, out);
}

#endif /* JAM_TESTS_START_H */
