// The cell of a soft state: its strains, their forces, and how the cell takes them in without loss of digits.
#include <algorithm>
#include <cmath>

#include "core/cell_change.hpp"
#include "core/math.hpp"
#include "soft/soft_state.hpp"
#include "soft/tuning.hpp"

namespace jam::inside {

void SoftState::free_cell(const FreeCell &cell) {
  const size_t d = static_cast<size_t>(base_.dim);
  at_.free = cell;
  at_.low.assign(d * d, 0.0);
  at_.unit = 1.0 / (diameter_mean_ * std::sqrt(static_cast<double>(n())));
  displacement_.resize(spheres() + (strains() + d - 1) / d * d, 0.0);
  rebase();
}

CellStrain SoftState::strain() const {
  std::vector<double> amplitude(displacement_.begin() + spheres(), displacement_.begin() + spheres() + strains());
  for (double &a : amplitude) a *= at_.unit;
  CellStrain s = strain_of(at_.free, amplitude.data());
  for (size_t c = 0; c < s.e.size(); ++c) s.e[c] += at_.low[c];
  for (double &x : s.slope) x *= at_.unit;
  return s;
}

// Of pressure and loads since the list was made.
double SoftState::load_work(const CellStrain &strain) const {
  double sum = at_.free.volume ? at_.free.pressure * math::expm1(strain.log_volume) : 0.0;
  for (size_t c = 0; c < at_.free.beyond.size(); ++c) sum += at_.free.beyond[c] * (strain.e[c] - at_.low[c]);
  return sum * scene_volume(base_);
}

// Forces on strains from the sum of f n r0, and the part of the pressure.
void SoftState::add_cell(SoftSums &sums, const CellStrain &strain, const std::vector<double> &stress,
                         std::vector<double> &force) const {
  const int d = base_.dim;
  const size_t block = stress.size();
  const double volume = scene_volume(base_), p_v = at_.free.volume ? at_.free.pressure * volume : 0.0;
  sums.work = at_.work + load_work(strain);
  for (size_t k = 0; k < strains(); ++k) {
    const double *slope = &strain.slope[k * block];
    double f = 0.0;
    for (size_t c = 0; c < block; ++c) f += slope[c] * stress[c];
    for (size_t c = 0; c < at_.free.beyond.size(); ++c) f -= volume * at_.free.beyond[c] * slope[c];
    for (int c = 0; at_.free.volume && c < d; ++c)
      f -= p_v * math::exp(strain.log_volume) * slope[c * (d + 1)] / (1.0 + strain.e[c * (d + 1)]);
    force[spheres() + k] = f;
    const double most = at_.free.volume ? std::max(p_v, sums.virial / d) : sums.virial / d;
    sums.stress = std::max(sums.stress, most > 0.0 ? std::fabs(f) / (at_.unit * most) : 0.0);
  }
}

// New vectors (1 + E) a are rounded, with three bits to spare, so that their sums in the offsets of pairs are exact.
// What rounding takes off, as a strain of the rounded vectors, stays in at_.low.
std::vector<double> SoftState::fold_strain() {
  const int d = base_.dim;
  const CellStrain s = strain();
  at_.work += load_work(s);
  std::vector<double> rows = base_.cell.rows(), rest(rows.size(), 0.0);
  double widest = 0.0;
  for (const double x : rows) widest = std::max(widest, std::fabs(x));
  const double quantum = std::ldexp(1.0, std::ilogb(widest) - 49);
  for (int c = 0; c < d; ++c) {
    DoubleDouble x[JAM_MAX_DIM];
    for (int a = 0; a <= c; ++a) x[a] = rows[c * d + a];
    for (int a = 0; a <= c; ++a)
      for (int b = a; b <= c; ++b) x[a] = x[a] + two_product(s.e[a * d + b], rows[c * d + b]);
    for (int a = 0; a <= c; ++a) {
      rows[c * d + a] = std::nearbyint(x[a].high / quantum) * quantum;
      rest[c * d + a] = static_cast<double>(x[a] - rows[c * d + a]);
    }
  }
  std::fill(at_.low.begin(), at_.low.end(), 0.0);
  for (int c = 0; c < d && precision_ != JAM_SOFT_DOUBLE; ++c)
    for (int a = 0; a <= c; ++a) {
      double sum = rest[c * d + a];
      for (int b = a; b < c; ++b) sum -= at_.low[a * d + b] * rows[c * d + b];
      at_.low[a * d + c] = sum / rows[c * d + c];
    }
  take_strained_cell(base_, rows);
  std::fill(displacement_.begin() + spheres(), displacement_.end(), 0.0);
  return s.e;
}

// x = base + displacement becomes what at_.low leaves of (1 + E) base + displacement.
void SoftState::strain_sphere(const std::vector<double> &strain, const double *base, DoubleDouble *x) const {
  const int d = base_.dim;
  for (int a = 0; a < d; ++a)
    for (int b = a; b < d; ++b) x[a] = x[a] + two_product(strain[a * d + b], base[b]);
  for (int a = 0; a < d; ++a)  // ascending: x_b with b >= a are those before, to the digits that at_.low has
    for (int b = a; b < d; ++b) x[a] = x[a] - two_product(at_.low[a * d + b], x[b].high);
}

void SoftState::deform_base(Packing &p) const {
  const int d = p.dim;
  const std::vector<double> e = strain().e;
  const auto deform = [&](double *x) {
    for (int a = 0; a < d; ++a) {
      double sum = x[a];
      for (int b = a; b < d; ++b) sum += e[a * d + b] * x[b];
      x[a] = sum;
    }
  };
  std::vector<double> rows = p.cell.rows();
  for (int c = 0; c < d; ++c) deform(&rows[c * d]);
  for (size_t k = 0; k < p.position.size(); k += d) deform(&p.position[k]);
  take_strained_cell(p, std::move(rows));
}

// Walls of a soft state: a sphere at a wall is a contact at distance r = sigma = radius. Beyond the wall r is negative,
// and the force continues to grow.
double SoftState::wall_overlap(size_t k, double *normal) const {
  const size_t at = static_cast<size_t>(pairs_.i[k]) * static_cast<size_t>(base_.dim);
  const int w = wall_partner(pairs_.j[k]);
  const double change = base_.container[w].displaced(&base_.position[at], &displacement_[at], normal);
  if (precision_ != JAM_SOFT_DOUBLE) return reference_[k] - change;
  double x[JAM_MAX_DIM];
  for (int c = 0; c < base_.dim; ++c) x[c] = base_.position[at + c] + displacement_[at + c];
  return sigma_[k] - base_.container[w].distance(x);
}

void SoftState::add_wall(size_t k, SoftSums &sums, std::vector<double> &force) const {
  double n[JAM_MAX_DIM];
  const double delta = wall_overlap(k, n);
  if (!(delta > 0.0)) return;
  const double f = energy_.force(delta, inverse_[k]);
  sums.energy += energy_.value_from_force(delta, f);
  sums.virial += f * (sigma_[k] - delta);
  sums.force += f;
  sums.overlap += delta;
  ++sums.contacts;
  const size_t at = static_cast<size_t>(pairs_.i[k]) * static_cast<size_t>(base_.dim);
  for (int c = 0; c < base_.dim; ++c) force[at + c] += f * n[c];
}

void SoftState::add_wall_contact(size_t k, SoftContacts &out) const {
  double n[JAM_MAX_DIM], x[JAM_MAX_DIM];
  const double delta = wall_overlap(k, n);
  if (!(delta > 0.0)) return;
  const size_t at = static_cast<size_t>(pairs_.i[k]) * static_cast<size_t>(base_.dim);
  for (int c = 0; c < base_.dim; ++c) x[c] = base_.position[at + c] + displacement_[at + c];
  out.pair.push_back(k);
  out.overlap.push_back(delta);
  out.force.push_back(energy_.force(delta, inverse_[k]));
  out.distance.push_back(sigma_[k] - delta);
  const double bend = base_.container[wall_partner(pairs_.j[k])].curvature(x);
  out.transverse.push_back(-out.force.back() * std::min(bend, 1.0 / (CoincidentTuning::distance * sigma_[k])));
  out.normal.insert(out.normal.end(), n, n + base_.dim);
}

}  // namespace jam::inside
