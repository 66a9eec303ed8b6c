#include "soft/soft_state.hpp"

#include <cmath>

#include "core/limits.hpp"
#include "core/math.hpp"

namespace jam::inside {

int FreeCell::open_axes() const {
  int count = 0;
  for (int c = 0; c < dim; ++c) count += open(c) ? 1 : 0;
  return count;
}

double FreeCell::open_part(const double *n) const {
  double sum = 0.0;
  for (int c = 0; c < dim; ++c) sum += open(c) ? n[c] * n[c] : 0.0;
  return open_axes() == dim ? 1.0 : sum;
}

FreeCell free_cell_of(int dim, int32_t strain, int64_t components, double pressure, uint32_t axes) {
  FreeCell cell;
  cell.dim = dim;
  cell.axes = axes;
  cell.volume = (strain & JAM_STRAIN_VOLUME) != 0;
  cell.pressure = pressure;
  const size_t block = static_cast<size_t>(dim) * dim;
  const auto may = [&](int c, int k) { return cell.open(c) && cell.open(k) && (components >> (c * dim + k) & 1) != 0; };
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
  } else if (cell.volume && cell.open_axes() > 0) {
    double *m = matrix();
    for (int c = 0; c < dim; ++c)
      if (cell.open(c)) m[c * (dim + 1)] = 1.0 / cell.open_axes();
  }
  for (int c = 0; (strain & JAM_STRAIN_TILTS) != 0 && c < dim; ++c)
    for (int k = c + 1; k < dim; ++k)
      if (may(c, k)) matrix()[c * dim + k] = 1.0;
  return cell;
}

void hold_stress(FreeCell &cell, int32_t strain, const double *stress) {
  const size_t d = static_cast<size_t>(cell.dim), block = d * d;
  std::vector<char> held(block, 0);
  for (size_t k = 0; k < cell.matrices.size(); ++k)
    if (cell.matrices[k] != 0.0) held[k % block] = 1;
  double sum = 0.0, count = 0.0;
  for (size_t a = 0; a < d; ++a) {
    for (size_t b = 0; b < d; ++b) {
      const double t = stress[a * d + b];
      if (!std::isfinite(t)) fail(JAM_E_NONFINITE, "stress[%zu] is %g", a * d + b, t);
      if (t != stress[b * d + a])
        fail(JAM_E_ARGUMENT, "stress[%zu] is %g and stress[%zu] is %g: a stress is symmetric", a * d + b, t, b * d + a,
             stress[b * d + a]);
    }
    if (!held[a * (d + 1)]) continue;
    sum += stress[a * (d + 1)], count += 1.0;
    if (!(stress[a * (d + 1)] > 0.0))
      fail(JAM_E_ARGUMENT, "stress[%zu] is %g, it must be above 0: spheres that repel hold no tension", a * (d + 1),
           stress[a * (d + 1)]);
    check_range("stress", stress[a * (d + 1)], limits::energy_min, limits::energy_max);
  }
  if (cell.volume) cell.pressure = sum / count;
  cell.beyond.assign(block, 0.0);
  for (size_t a = 0; a < d; ++a)
    for (size_t b = a; b < d; ++b) {
      if (!held[a * d + b]) continue;
      const double t = stress[a * d + b], normal = stress[a * (d + 1)] * stress[b * (d + 1)];
      if (a != b && held[a * (d + 1)] && held[b * (d + 1)] && t * t >= normal)
        fail(JAM_E_ARGUMENT, "stress[%zu] is %g, its magnitude must be below %g: spheres that repel hold no tension",
             a * d + b, t, std::sqrt(normal));
      cell.beyond[a * d + b] = a == b ? t - sum / count : t;
      if (a == b && (strain & JAM_STRAIN_EDGES) == 0 && t != stress[0])
        fail(JAM_E_ARGUMENT, "stress[%zu] is %g and stress[0] is %g: edges that change together hold one stress",
             a * (d + 1), t, stress[0]);
    }
}

std::vector<double> strain_between(const Cell &from, const Cell &to) {
  const size_t d = static_cast<size_t>(from.dim());
  std::vector<double> e(d * d, 0.0);
  for (size_t c = 0; c < d; ++c)
    for (size_t a = 0; a <= c; ++a) {
      double sum = to.row(c)[a] - from.row(c)[a];
      for (size_t b = a; b < c; ++b) sum -= e[a * d + b] * from.row(c)[b];
      e[a * d + c] = sum / from.row(c)[c];
    }
  return e;
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
  const int m = cell.open_axes();
  const double less = math::expm1(-s.log_volume / m), lambda = 1.0 + less;
  s.log_volume = 0.0;
  for (size_t k = 0; k < count; ++k) {
    double *slope = &s.slope[k * block], trace = 0.0;
    for (int c = 0; c < d; ++c) trace += slope[c * (d + 1)] / (1.0 + s.e[c * (d + 1)]);
    for (int a = 0; a < d; ++a)
      for (int b = a; b < d && cell.open(a); ++b)
        slope[a * d + b] = lambda * (slope[a * d + b] - trace / m * ((a == b ? 1.0 : 0.0) + s.e[a * d + b]));
  }
  for (size_t c = 0; c < block; ++c) s.e[c] *= lambda;
  for (int c = 0; c < d; ++c)
    if (cell.open(c)) s.e[c * (d + 1)] += less;
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
