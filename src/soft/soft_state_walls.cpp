// Walls of a soft state: a sphere at a wall is a contact at distance r = sigma = radius. Beyond the wall r is negative,
// and the force continues to grow.
#include <algorithm>

#include "soft/soft_state.hpp"
#include "soft/tuning.hpp"

namespace jam::inside {

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
