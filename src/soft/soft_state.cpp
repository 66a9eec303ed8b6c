#include "soft/soft_state.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/call_scope.hpp"
#include "core/pair_rule.hpp"
#include "linalg/dot.hpp"
#include "network/rattlers.hpp"
#include "soft/tuning.hpp"

namespace jam::inside {

SoftState::SoftState(const Packing &p, const PairEnergy &energy, int32_t precision)
    : base_(p),
      energy_(energy),
      precision_(precision),
      diameter_mean_(jam::inside::diameter_mean(p)),
      skin_(SkinTuning::shortest * diameter_mean_),
      displacement_(p.position.size(), 0.0) {
  rebase();
}

void SoftState::rebase() {
  std::vector<double> e;
  if (strains() > 0) e = fold_strain();
  for (size_t i = 0; i < base_.n(); ++i) wrap_sphere(i * static_cast<size_t>(base_.dim), strains() > 0 ? &e : nullptr);
  diameter_mean_ = jam::inside::diameter_mean(base_);
  try {
    pairs_ = find_pairs(base_, skin_, 1.0);
  } catch (const Cancelled &) {  // back to where the last list was made: it does not hold here
    base_.position = listed_base_, displacement_ = listed_displacement_;
    base_.cell = listed_cell_, at_ = listed_at_;
    throw;
  }
  listed_base_ = base_.position, listed_displacement_ = displacement_;
  listed_cell_ = base_.cell, listed_at_ = at_;
  uses_ = 0;
  take_references();
}

// As Cell::wrap, by whole cell vectors, so that nothing of the low parts is lost.
void SoftState::wrap_sphere(size_t at, const std::vector<double> *strain) {
  const Cell &cell = base_.cell;
  std::array<DoubleDouble, JAM_MAX_DIM> x;
  for (int c = 0; c < base_.dim; ++c) x[c] = two_sum(base_.position[at + c], displacement_[at + c]);
  if (strain) strain_sphere(*strain, &base_.position[at], x.data());
  for (int c = base_.dim - 1; c >= 0; --c) {
    if (!cell.repeats(c)) continue;
    const double edge = cell.edge(c), inside = wrap(x[c].high, edge);
    if (inside == x[c].high) continue;
    const double m = std::nearbyint((x[c].high - inside) / edge);
    for (int k = 0; k <= c; ++k) x[k] = x[k] - two_product(m, cell.row(c)[k]);
    if (!(x[c].high >= 0.0 && x[c].high < edge)) x[c] = wrap(x[c].high, edge);
  }
  for (int c = 0; c < base_.dim; ++c) {
    base_.position[at + c] = x[c].high;
    displacement_[at + c] = precision_ == JAM_SOFT_DOUBLE ? 0.0 : x[c].low;
  }
}

void SoftState::take_references() {
  const int d = base_.dim;
  const size_t m = pairs_.size();
  vector_.resize(m * d), reference_.resize(m), sigma_.resize(m), inverse_.resize(m);
  walls_ = false;
  for (size_t k = 0; k < m; ++k) {
    const int32_t i = pairs_.i[k], j = pairs_.j[k];
    if (pairs_.wall(k)) {
      walls_ = true;
      const DoubleDouble radius = contact_distance<DoubleDouble>(base_, i, j);
      const double *x = &base_.position[static_cast<size_t>(i) * d];
      sigma_[k] = static_cast<double>(radius);
      inverse_[k] = 1.0 / sigma_[k];
      reference_[k] = static_cast<double>(radius - base_.container[wall_partner(j)].distance<DoubleDouble>(x));
      continue;
    }
    const double *a = &base_.position[static_cast<size_t>(i) * d], *b = &base_.position[static_cast<size_t>(j) * d];
    const DoubleDouble sigma = contact_distance<DoubleDouble>(base_, i, j);
    DoubleDouble q = sigma * sigma;
    for (int c = 0; c < d; ++c) {
      const DoubleDouble r = two_sum(a[c], -b[c]) + DoubleDouble(pairs_.offset[k * d + c]);
      vector_[k * d + c] = static_cast<double>(r);
      q = q - r * r;
    }
    sigma_[k] = static_cast<double>(sigma);
    inverse_[k] = 1.0 / sigma_[k];
    reference_[k] = static_cast<double>(q);
  }
}

bool SoftState::moved() {
  ++uses_;
  const double most = largest_squared(displacement_, n(), base_.dim);
  double rest = skin_;  // a strain shortens vectors by its norm times their length at most
  if (strains() > 0) rest = std::max(0.0, rest - norm(strain().e) * (skin_ + contact_distance_max(base_)));
  if (!(4.0 * most >= rest * rest)) return false;
  if (uses_ < SkinTuning::few_evaluations)
    skin_ = std::min(SkinTuning::grow * skin_, SkinTuning::longest * diameter_mean_);
  if (uses_ > SkinTuning::many_evaluations)
    skin_ = std::max(SkinTuning::shrink * skin_, SkinTuning::shortest * diameter_mean_);
  rebase();
  return true;
}

void SoftState::scale_diameters(double factor) {
  for (double &s : base_.diameter) s *= factor;
  rebase();
}

Packing SoftState::packing() const {
  Packing p = base_;
  if (strains() > 0) deform_base(p);
  for (size_t k = 0; k < p.position.size(); ++k) p.position[k] += displacement_[k];
  wrap_positions(p);
  return p;
}

// One pair at the present displacements: its overlap (sigma + r), positive where spheres overlap, and r_ij.
template <int D>
inline double overlap_square(int dim, const double *r0, double reference, const double *ui, const double *uj,
                             const double *strain, double *r) {
  double change = 0.0;
  for (int c = 0; c < (D ? D : dim); ++c) {
    double du = ui[c] - uj[c];
    for (int b = c; strain && b < (D ? D : dim); ++b) du += strain[c * (D ? D : dim) + b] * r0[b];
    r[c] = r0[c] + du;
    change += du * (r0[c] + r[c]);
  }
  return reference - change;
}

// The same from coordinates rounded to doubles, for comparison alone.
template <int D>
inline double overlap_square_plain(int dim, const double *xi, const double *xj, const double *offset, double sigma,
                                   const double *ui, const double *uj, const double *r0, const double *strain,
                                   double *r) {
  double r2 = 0.0;
  for (int c = 0; c < (D ? D : dim); ++c) {
    r[c] = ((xi[c] + ui[c]) - (xj[c] + uj[c])) + offset[c];
    for (int b = c; strain && b < (D ? D : dim); ++b) r[c] += strain[c * (D ? D : dim) + b] * r0[b];
    r2 += r[c] * r[c];
  }
  const double length = std::sqrt(r2);
  return (sigma - length) * (sigma + length);
}

double SoftState::part_coincident(size_t k, double *r) const {
  const int d = base_.dim;
  double largest = 0.0;
  for (int c = 0; c < d; ++c) largest = std::max(largest, std::fabs(r[c]));
  for (int c = 0; c < d && largest > 0.0; ++c) r[c] = std::ldexp(r[c], -std::ilogb(largest));
  if (largest == 0.0) {
    const uint64_t pair = static_cast<uint64_t>(pairs_.i[k]) << 32 | static_cast<uint64_t>(pairs_.j[k]);
    Rng rng(base_.seed, Stream::coincident, mix64(pair));
    for (int c = 0; c < d; ++c) r[c] = rng.uniform() - 0.5;
  }
  double r2 = 0.0;
  for (int c = 0; c < d; ++c) r2 += r[c] * r[c];
  const double length = CoincidentTuning::distance * sigma_[k];
  for (int c = 0; c < d; ++c) r[c] *= length / std::sqrt(r2);
  return length * length;
}

template <int D>
SoftSums SoftState::evaluate_in(std::vector<double> &force, const CellStrain *strain) const {
  const int d = D ? D : base_.dim;
  SoftSums sums;
  std::fill(force.begin(), force.end(), 0.0);
  const bool plain = precision_ == JAM_SOFT_DOUBLE;
  const double *e = strain ? strain->e.data() : nullptr;
  std::vector<double> stress(strain ? static_cast<size_t>(d) * d : 0, 0.0);  // sum of f n r0
  double r[JAM_MAX_DIM];
  for (size_t k = 0; k < reference_.size(); ++k) {
    if (walls_ && pairs_.wall(k)) {
      add_wall(k, sums, force);
      continue;
    }
    const size_t i = static_cast<size_t>(pairs_.i[k]) * d, j = static_cast<size_t>(pairs_.j[k]) * d;
    const double sigma = sigma_[k];
    const double q =
        plain ? overlap_square_plain<D>(d, &base_.position[i], &base_.position[j], &pairs_.offset[k * d], sigma,
                                        &displacement_[i], &displacement_[j], &vector_[k * d], e, r)
              : overlap_square<D>(d, &vector_[k * d], reference_[k], &displacement_[i], &displacement_[j], e, r);
    if (!(q > 0.0)) continue;
    double r2 = 0.0;
    for (int c = 0; c < d; ++c) r2 += r[c] * r[c];
    if (!(r2 > CoincidentTuning::tiny)) r2 = part_coincident(k, r), ++sums.coincident;
    const double length = std::sqrt(r2), sum = sigma + length, both = 1.0 / (length * sum);
    const double delta = q * length * both, f = energy_.force(delta, inverse_[k]);
    sums.energy += energy_.value_from_force(delta, f);
    sums.virial += f * length;
    sums.force += f;
    sums.overlap += delta;
    ++sums.contacts;
    const double push = f * sum * both;
    for (int c = 0; c < d; ++c) {
      const double x = push * r[c];
      force[i + c] += x;
      force[j + c] -= x;
      for (int b = c; e && b < d; ++b) stress[c * d + b] += x * vector_[k * d + b];
    }
  }
  if (strain) add_cell(sums, *strain, stress, force);
  return sums;
}

SoftSums SoftState::evaluate(std::vector<double> &force) const {
  force.resize(displacement_.size());
  CellStrain at;
  if (strains() > 0) at = strain();
  const CellStrain *s = strains() > 0 ? &at : nullptr;
  return base_.dim == 2   ? evaluate_in<2>(force, s)
         : base_.dim == 3 ? evaluate_in<3>(force, s)
                          : evaluate_in<0>(force, s);
}

SoftContacts SoftState::contacts() const {
  const int d = base_.dim;
  SoftContacts out;
  CellStrain at;
  if (strains() > 0) at = strain();
  const double *e = strains() > 0 ? at.e.data() : nullptr;
  double r[JAM_MAX_DIM];
  for (size_t k = 0; k < reference_.size(); ++k) {
    if (pairs_.wall(k)) {
      add_wall_contact(k, out);
      continue;
    }
    const size_t i = static_cast<size_t>(pairs_.i[k]) * d, j = static_cast<size_t>(pairs_.j[k]) * d;
    const double q =
        precision_ == JAM_SOFT_DOUBLE
            ? overlap_square_plain<0>(d, &base_.position[i], &base_.position[j], &pairs_.offset[k * d], sigma_[k],
                                      &displacement_[i], &displacement_[j], &vector_[k * d], e, r)
            : overlap_square<0>(d, &vector_[k * d], reference_[k], &displacement_[i], &displacement_[j], e, r);
    if (!(q > 0.0)) continue;
    double r2 = 0.0;
    for (int c = 0; c < d; ++c) r2 += r[c] * r[c];
    if (!(r2 > CoincidentTuning::tiny)) r2 = part_coincident(k, r);
    const double length = std::sqrt(r2), delta = q / (sigma_[k] + length);
    out.pair.push_back(k);
    out.overlap.push_back(delta);
    out.force.push_back(energy_.force(delta, inverse_[k]));
    out.distance.push_back(length);
    out.transverse.push_back(out.force.back() / length);
    for (int c = 0; c < d; ++c) out.normal.push_back(r[c] / length);
  }
  return out;
}

std::vector<char> stable_contacts(const SoftState &state, const SoftContacts &contacts) {
  PairList list;
  std::vector<char> on;
  for (const size_t k : contacts.pair) {
    list.i.push_back(state.pairs().i[k]), list.j.push_back(state.pairs().j[k]);
    // An image of the same sphere holds nothing, except for the cell.
    on.push_back(state.strains() > 0 || list.i.back() != list.j.back());
  }
  drop_loose(state.dim(), state.n(), state.base().container, list.i, list.j, on);
  return on;
}

}  // namespace jam::inside
