#include "core/packing.hpp"

#include <algorithm>

#include "core/math.hpp"

namespace jam::inside {

double unit_sphere_volume(int dim) {
  double volume = 1.0;  // of one dimension, and of none; two more bring pi / 2 d
  for (int d = 2 + dim % 2; d <= dim; d += 2) volume *= 0.5 * 3.14159265358979323846 / d;
  return volume;
}

namespace {

// Kahan's sum: the plain one of 65536 equal terms is off by 1e-13.
template <class Term>
double sum_over(const std::vector<double> &x, const Term &term) {
  double sum = 0.0, lost = 0.0;
  for (const double v : x) {
    const double next = term(v) - lost, now = sum + next;
    lost = (now - sum) - next;
    sum = now;
  }
  return sum;
}

}  // namespace

double packing_fraction(const Packing &p) {
  const double of_cell =
      unit_sphere_volume(p.dim) * sum_over(p.diameter, [&](double s) { return math::pow(s / p.cell.side(), p.dim); });
  return p.container ? of_cell * (p.cell.volume() / p.container.volume()) : of_cell;
}

double diameter_mean(const Packing &p) {
  return sum_over(p.diameter, [](double s) { return s; }) / static_cast<double>(p.n());
}

double diameter_max(const Packing &p) { return *std::max_element(p.diameter.begin(), p.diameter.end()); }

std::vector<double> sphere_masses(const Packing &p) {
  std::vector<double> mass;
  if (p.masses != JAM_MASSES_VOLUME) return mass;
  double sum = 0.0;
  for (double s : p.diameter) mass.push_back(math::pow(s / p.cell.side(), p.dim)), sum += mass.back();
  for (double &m : mass) m *= static_cast<double>(p.n()) / sum;
  return mass;
}

void wrap_positions(Packing &p) {
  for (size_t i = 0; i < p.n(); ++i) p.cell.wrap(&p.position[i * static_cast<size_t>(p.dim)]);
}

}  // namespace jam::inside
