// Tables: calls whose result has several columns fill one array of shape (rows, columns).
#pragma once
#include <algorithm>
#include <array>
#include <vector>
#include "capi/guard.hpp"

namespace jam::inside {

// The size alone is known before the work: sets *needed and says whether there is an array to fill.
inline bool table_wanted(size_t rows, size_t columns, const double *table, size_t table_len, size_t *needed) {
  if (!table && table_len != 0) fail(JAM_E_NULL, "table is NULL but its length is %zu", table_len);
  if (!table && !needed) fail(JAM_E_NULL, "needed is NULL and there is no output array");
  const size_t count = rows * columns;
  if (needed) *needed = count;
  if (table && table_len < count)
    fail(JAM_E_BUFFER, "table has %zu elements, %zu are needed (%zu rows of %zu)", table_len, count, rows, columns);
  return table != nullptr;
}

template <class T>
void put_column(const std::vector<T> &values, size_t at, size_t columns, double *table) {
  for (size_t k = 0; k < values.size(); ++k) table[k * columns + at] = static_cast<double>(values[k]);
}

// Rows of columns, as a history keeps them.
template <class Row>
jam_status give_table(const std::vector<Row> &rows, double *table, size_t table_len, size_t *needed) {
  constexpr size_t columns = std::tuple_size<Row>::value;
  if (!table_wanted(rows.size(), columns, table, table_len, needed)) return JAM_OK;
  for (const Row &row : rows) table = std::copy(row.begin(), row.end(), table);
  return JAM_OK;
}

}  // namespace jam::inside
