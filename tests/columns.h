/* Single columns of the tables that calls give. */
#ifndef JAM_TESTS_COLUMNS_H
#define JAM_TESTS_COLUMNS_H

#include <jam/jam.h>
#include <stdlib.h>

typedef jam_status (*fills_table)(const jam_system *sys, int32_t columns, double *table, size_t table_len,
                                  size_t *needed);

/* Column `which` of a table with that many columns; out may be NULL. *rows: its length. */
static inline jam_status column_of(fills_table fill, const jam_system *sys, int32_t columns, size_t which, double *out,
                                   size_t room, size_t *rows) {
  size_t needed = 0, k;
  double *table;
  jam_status status = fill(sys, columns, NULL, 0, &needed);
  *rows = needed / (size_t)columns;
  if (status < 0 || !out) return status;
  if (room < *rows) return JAM_E_BUFFER;
  table = (double *)malloc((needed + 1) * sizeof *table);
  if (!table) return JAM_E_MEMORY;
  status = fill(sys, columns, table, needed, &needed);
  for (k = 0; status >= 0 && k < *rows; ++k) out[k] = table[k * (size_t)columns + which];
  free(table);
  return status;
}

/* Eigenvalues and participation of the modes of the harmonic Hessian, at most `room`; participation may be NULL. */
static inline jam_status eigenvalues(jam_system *sys, const jam_modes_options *o, double *lambda, double *participation,
                                     size_t room, size_t *m) {
  double *const table = (double *)malloc((2 * room + 1) * sizeof *table);
  size_t k;
  jam_status status;
  if (!table) return JAM_E_MEMORY;
  status = jam_modes(sys, NULL, o, JAM_MODE_COLUMNS, table, 2 * room, NULL, 0, m);
  for (k = 0; status >= 0 && k < *m; ++k) {
    lambda[k] = table[2 * k + JAM_MODE_LAMBDA];
    if (participation) participation[k] = table[2 * k + JAM_MODE_PARTICIPATION];
  }
  free(table);
  return status;
}

#endif /* JAM_TESTS_COLUMNS_H */
