#include "soft/soft_cell.hpp"

#include <cmath>

#include "core/math.hpp"

namespace jam::inside {

FreeCell free_cell_of(int dim, int32_t strain, int64_t components, double pressure) {
  FreeCell cell;
  cell.dim = dim;
  cell.volume = (strain & JAM_STRAIN_VOLUME) != 0;
  cell.pressure = pressure;
  const size_t block = static_cast<size_t>(dim) * dim;
  const auto may = [&](int c, int k) { return (components >> (c * dim + k) & 1) != 0; };
  const auto matrix = [&]() {
    cell.matrices.resize(cell.matrices.size() + block, 0.0);
    return cell.matrices.data() + cell.matrices.size() - block;
  };
  if ((strain & JAM_STRAIN_EDGES) != 0) {
    int last = -1;  // at fixed volume each edge against the one before
    for (int c = 0; c < dim; ++c) {
      if (!may(c, c)) continue;
      if (cell.volume || last >= 0) {
        double *m = matrix();
        m[c * (dim + 1)] = 1.0;
        if (!cell.volume) m[last * (dim + 1)] = -1.0;
      }
      last = c;
    }
  } else if (cell.volume) {
    double *m = matrix();
    for (int c = 0; c < dim; ++c) m[c * (dim + 1)] = 1.0 / dim;
  }
  for (int c = 0; (strain & JAM_STRAIN_TILTS) != 0 && c < dim; ++c)
    for (int k = c + 1; k < dim; ++k)
      if (may(c, k)) matrix()[c * dim + k] = 1.0;
  return cell;
}

CellStrain strain_of(const FreeCell &cell, const double *amplitude) {
  const int d = cell.dim;
  const size_t block = static_cast<size_t>(d) * d, count = static_cast<size_t>(cell.count());
  CellStrain s;
  s.e.assign(block, 0.0);
  s.slope = cell.matrices;
  for (size_t k = 0; k < count; ++k)
    for (size_t c = 0; c < block; ++c) s.e[c] += amplitude[k] * cell.matrices[k * block + c];
  for (int c = 0; c < d; ++c) s.log_volume += math::log1p(s.e[c * (d + 1)]);
  if (cell.volume) return s;
  const double less = math::expm1(-s.log_volume / d), lambda = 1.0 + less;
  s.log_volume = 0.0;
  for (size_t k = 0; k < count; ++k) {
    double *slope = &s.slope[k * block], trace = 0.0;
    for (int c = 0; c < d; ++c) trace += slope[c * (d + 1)] / (1.0 + s.e[c * (d + 1)]);
    for (int a = 0; a < d; ++a)
      for (int b = a; b < d; ++b)
        slope[a * d + b] = lambda * (slope[a * d + b] - trace / d * ((a == b ? 1.0 : 0.0) + s.e[a * d + b]));
  }
  for (size_t c = 0; c < block; ++c) s.e[c] *= lambda;
  for (int c = 0; c < d; ++c) s.e[c * (d + 1)] += less;
  return s;
}

std::vector<double> volume_curvature(const FreeCell &cell) {
  const int d = cell.dim;
  const size_t block = static_cast<size_t>(d) * d, count = static_cast<size_t>(cell.count());
  std::vector<double> out(count * count);
  for (size_t k = 0; k < count; ++k)
    for (size_t l = 0; l < count; ++l) {
      double first = 0.0, second = 0.0, both = 0.0;
      for (int c = 0; c < d; ++c) {
        const double x = cell.matrices[k * block + c * (d + 1)], y = cell.matrices[l * block + c * (d + 1)];
        first += x, second += y, both += x * y;
      }
      out[k * count + l] = first * second - both;
    }
  return out;
}

}  // namespace jam::inside
