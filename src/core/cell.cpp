#include "core/cell.hpp"

#include <limits>

#include "core/math.hpp"
#include "core/packing.hpp"

namespace jam::inside {

Cell::Cell(int dim, double side) : dim_(dim), side_(side), volume_(math::pow(side, dim)) {
  for (int c = 0; c < dim; ++c) rows_[c][c] = side;
}

Cell Cell::from_triangle(int dim, const double *rows) {
  Cell cell(dim, rows[0]);
  cell.volume_ = 1.0;
  for (int c = 0; c < dim; ++c) {
    for (int k = 0; k <= c; ++k) {
      cell.rows_[c][k] = rows[c * dim + k];
      cell.cube_ = cell.cube_ && cell.rows_[c][k] == (k == c ? rows[0] : 0.0);
      cell.right_ = cell.right_ && (k == c || cell.rows_[c][k] == 0.0);
    }
    cell.volume_ *= cell.rows_[c][c];
  }
  if (cell.cube_) return Cell(dim, rows[0]);
  cell.side_ = math::pow(cell.volume_, 1.0 / dim);
  return cell;
}

// Column c of the inverse is normal to the faces that a_c joins; a_c has the product 1 with it.
double Cell::height(int c) const {
  if (cube_) return side_;
  Vector normal{};  // rows_[k] . normal = (k == c)
  double n2 = 0.0;
  for (int k = 0; k < dim_; ++k) {
    double rest = k == c ? 1.0 : 0.0;
    for (int q = 0; q < k; ++q) rest -= rows_[k][q] * normal[q];
    normal[k] = rest / rows_[k][k];
    n2 += normal[k] * normal[k];
  }
  return 1.0 / std::sqrt(n2);
}

double Cell::height_min() const {
  double least = height(0);
  for (int c = 1; c < dim_; ++c) least = std::min(least, height(c));
  return least;
}

double Cell::shortest() const {
  if (cube_) return side_;
  double least2 = std::numeric_limits<double>::infinity();
  for (int c = 0; c < dim_; ++c) {
    double r2 = 0.0;
    for (int k = 0; k <= c; ++k) r2 += rows_[c][k] * rows_[c][k];
    least2 = std::min(least2, r2);
  }
  const Vector origin{};
  images(origin.data(), std::sqrt(least2) * (1.0 + 1e-12), [&](const double *shift) {
    double r2 = 0.0;
    for (int k = 0; k < dim_; ++k) r2 += shift[k] * shift[k];
    if (r2 > 0.0) least2 = std::min(least2, r2);
  });
  return std::sqrt(least2);
}

double Cell::half_diagonal() const {
  if (cube_) return 0.5 * std::sqrt(static_cast<double>(dim_)) * side_;
  double r2 = 0.0;
  for (int c = 0; c < dim_; ++c) r2 += edge(c) * edge(c);
  return 0.5 * std::sqrt(r2);
}

void Cell::wrap(double *x, double *shift) const {
  if (shift) std::fill(shift, shift + dim_, 0.0);
  for (int c = dim_ - 1; c >= 0; --c) {
    if (!repeats(c)) continue;
    const double inside = jam::inside::wrap(x[c], edge(c));
    if (inside == x[c]) continue;
    const double m = std::nearbyint((x[c] - inside) / edge(c));
    for (int k = 0; !right_ && k < c; ++k) x[k] -= m * rows_[c][k];
    for (int k = right_ ? c : 0; shift && k <= c; ++k) shift[k] += m * rows_[c][k];
    x[c] = inside;
  }
}

double wrap(double x, double period) {
  if (x >= 0.0 && x < period) return x;
  const double near = x - period * std::floor(x / period);
  if (near >= 0.0 && near < period) return near;
  // Within rounding of a multiple of the period, or so many periods away that the product above is not exact.
  double rest = std::fmod(x, period);
  if (rest < 0.0) rest += period;
  return rest < period ? rest : 0.0;
}

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
