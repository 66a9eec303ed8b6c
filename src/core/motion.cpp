#include "core/motion.hpp"

#include <cmath>
#include <utility>

#include "core/container.hpp"
#include "core/math.hpp"

namespace jam::inside {

void take_strained_cell(Packing &p, std::vector<double> rows) {
  const double least = least_cell_entry * Cell::from_triangle(p.dim, rows.data()).side();
  for (double &x : rows)
    if (std::fabs(x) < least) x = 0.0;
  p.cell = Cell::from_triangle(p.dim, rows.data());
  if (p.container) enclose(p, {p.container.kind(), p.container.flat()});
}

void strain_at_fixed_volume(Packing &p, PairList &pairs, const std::vector<double> &strain, double kept) {
  const int d = p.dim;
  const uint32_t closed = p.container.closed();
  double volume = kept > 0.0 ? p.cell.volume() / kept : 1.0;
  for (int c = 0; c < d; ++c) volume *= 1.0 + strain[c * (d + 1)];
  const double back = math::pow(volume, -1.0 / (p.container ? p.container.open_axes() : d));
  const auto deform = [&](double *x) {  // upper-triangular: component a needs those from a on
    for (int a = 0; a < d; ++a) {
      if (closed >> a & 1) continue;
      double sum = x[a];
      for (int b = a; b < d; ++b) sum += strain[a * d + b] * x[b];
      x[a] = back * sum;
    }
  };
  for (size_t k = 0; k < p.position.size(); k += d) deform(&p.position[k]);
  for (size_t k = 0; k < pairs.offset.size(); k += d) deform(&pairs.offset[k]);
  std::vector<double> rows = p.cell.rows();
  for (int c = 0; c < d; ++c) deform(&rows[c * d]);
  take_strained_cell(p, std::move(rows));
}

void move_packing(Packing &p, PairList &pairs, const double *s, double length, double growth,
                  const std::vector<double> &strain) {
  if (!strain.empty()) strain_at_fixed_volume(p, pairs, strain);
  for (size_t k = 0; k < p.position.size(); ++k) p.position[k] += length * s[k];
  for (double &sigma : p.diameter) sigma *= growth;
  p.given = {};  // positions have all digits now
  wrap_positions(p, pairs);
}

}  // namespace jam::inside
