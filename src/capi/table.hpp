// Arrays out. Tables: calls whose result has several columns fill one array of shape (rows, columns).
#pragma once
#include <algorithm>
#include <array>
#include <initializer_list>
#include <limits>
#include <vector>
#include "capi/guard.hpp"

namespace jam::inside {

// An array out of a call, as its caller gives it, and the elements that it needs.
struct Output {
  const void *out;
  size_t len, expected;
  const char *name;
};

// The one rule of calls that give arrays, of which each may be NULL: sets *count, `needed` or `rows` of the call, also
// where an array is too short, and says whether there is one to fill. Where the sizes are known before the work, a call
// asks first and works once. takes: the caller wants something else of the call.
inline bool outputs_wanted(size_t number, size_t *count, std::initializer_list<Output> outputs, bool takes = false) {
  bool any = false;
  for (const Output &o : outputs) {
    if (!o.out && o.len != 0) fail(JAM_E_NULL, "%s is NULL but its length is %zu", o.name, o.len);
    any = any || o.out;
  }
  if (!any && !count && !takes) fail(JAM_E_NULL, "there is no output array, and no place for the size: all are NULL");
  if (count) *count = number;
  for (const Output &o : outputs)
    if (o.out && o.len < o.expected)
      fail(JAM_E_BUFFER, "%s has %zu elements, %zu are needed", o.name, o.len, o.expected);
  return any;
}

template <class T>
bool array_wanted(size_t count, const T *out, size_t out_len, size_t *needed) {
  return outputs_wanted(count, needed, {{out, out_len, count, "output array"}});
}
template <class T>
jam_status give_array(const T *data, size_t count, T *out, size_t out_len, size_t *needed) {
  if (!array_wanted(count, out, out_len, needed)) return JAM_OK;
  if (count) std::memcpy(out, data, count * sizeof(T));
  return JAM_OK;
}

// A table of N columns as its caller wants it. An older program knows fewer columns and gets the first ones; one of a
// later version knows more, which are NaN.
template <size_t N>
class Table {
 public:
  Table(int32_t columns, double *out, size_t len) : columns_(static_cast<size_t>(columns)), out_(out), len_(len) {
    if (columns < 1 || columns > columns_max)
      fail(JAM_E_ARGUMENT, "columns is %d, it must be 1..%d: jam.h has the number of each table, here %zu", columns,
           columns_max, N);
    if (!out && len != 0) fail(JAM_E_NULL, "table is NULL but its length is %zu", len);
  }
  explicit operator bool() const { return out_ != nullptr; }

  Output output(size_t rows) const { return {out_, len_, rows * columns_, "table"}; }
  // Of a call that gives the table alone, whose size is known before the work: sets *needed and says whether there is
  // an array to fill.
  bool wanted(size_t rows, size_t *needed) const { return outputs_wanted(rows * columns_, needed, {output(rows)}); }
  // fill(k, row) writes the columns of row k, which are NaN before.
  template <class F>
  void give(size_t rows, F &&fill) const {
    if (!out_) return;
    const double nan = std::numeric_limits<double>::quiet_NaN();
    for (size_t k = 0; k < rows; ++k) {
      std::array<double, N> row;
      row.fill(nan);
      fill(k, row);
      double *const at = out_ + k * columns_;
      std::fill(std::copy_n(row.begin(), std::min(N, columns_), at), at + columns_, nan);
    }
  }

 private:
  static constexpr int32_t columns_max = 1000;  // more is no table of any version
  size_t columns_;
  double *out_;
  size_t len_;
};

// Rows of columns, as a history keeps them.
template <size_t N>
jam_status give_table(const std::vector<std::array<double, N>> &rows, int32_t columns, double *table, size_t table_len,
                      size_t *needed) {
  const Table<N> made(columns, table, table_len);
  if (made.wanted(rows.size(), needed)) made.give(rows.size(), [&](size_t k, auto &row) { row = rows[k]; });
  return JAM_OK;
}

// Fills an output of a call: what `data` lacks of `expected` elements becomes NaN.
template <class T>
void put_output(const std::vector<T> &data, T *out, size_t expected) {
  if (!out) return;
  const size_t have = data.size() < expected ? data.size() : expected;
  for (size_t k = 0; k < have; ++k) out[k] = data[k];
  for (size_t k = have; k < expected; ++k)
    out[k] = std::numeric_limits<T>::has_quiet_NaN ? std::numeric_limits<T>::quiet_NaN() : T(-1);
}

}  // namespace jam::inside
