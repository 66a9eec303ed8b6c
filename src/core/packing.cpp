#include "core/packing.hpp"

#include <algorithm>

namespace jam {

double unit_sphere_volume(int dim) {
  const double pi = 3.14159265358979323846;
  return std::pow(pi, 0.5 * dim) * std::pow(0.5, dim) / std::tgamma(1.0 + 0.5 * dim);
}

double packing_fraction(const Packing &p) {
  double sum = 0.0;
  for (double s : p.diameter) sum += std::pow(s / p.box, p.dim);
  return unit_sphere_volume(p.dim) * sum;
}

double diameter_mean(const Packing &p) {
  double sum = 0.0;
  for (double s : p.diameter) sum += s;
  return sum / static_cast<double>(p.n());
}

double diameter_max(const Packing &p) { return *std::max_element(p.diameter.begin(), p.diameter.end()); }

std::vector<double> sphere_masses(const Packing &p) {
  std::vector<double> mass;
  if (p.masses != JAM_MASSES_VOLUME) return mass;
  double sum = 0.0;
  for (double s : p.diameter) mass.push_back(std::pow(s / p.box, p.dim)), sum += mass.back();
  for (double &m : mass) m *= static_cast<double>(p.n()) / sum;
  return mass;
}

double wrap(double x, double box) {
  if (x >= 0.0 && x < box) return x;
  x -= box * std::floor(x / box);
  return x < box ? x : 0.0;
}

}  // namespace jam
