#include "core/motion.hpp"

#include <cmath>

#include "core/math.hpp"

namespace jam::inside {

Cell strained_cell(int dim, std::vector<double> rows) {
  const double least = least_cell_entry * Cell::from_triangle(dim, rows.data()).side();
  for (double &x : rows)
    if (std::fabs(x) < least) x = 0.0;
  return Cell::from_triangle(dim, rows.data());
}

void strain_at_fixed_volume(Packing &p, PairList &pairs, const std::vector<double> &strain) {
  const int d = p.dim;
  double volume = 1.0;
  for (int c = 0; c < d; ++c) volume *= 1.0 + strain[c * (d + 1)];
  const double back = math::pow(volume, -1.0 / d);
  const auto deform = [&](double *x) {  // upper-triangular: component a needs those from a on
    for (int a = 0; a < d; ++a) {
      double sum = x[a];
      for (int b = a; b < d; ++b) sum += strain[a * d + b] * x[b];
      x[a] = back * sum;
    }
  };
  for (size_t k = 0; k < p.position.size(); k += d) deform(&p.position[k]);
  for (size_t k = 0; k < pairs.offset.size(); k += d) deform(&pairs.offset[k]);
  std::vector<double> rows = p.cell.rows();
  for (int c = 0; c < d; ++c) deform(&rows[c * d]);
  p.cell = strained_cell(d, rows);
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
