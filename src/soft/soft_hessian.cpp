#include "soft/relaxation.hpp"
#include "soft/tuning.hpp"

#include <Eigen/Dense>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "network/rigidity_matrix.hpp"
#include "network/tuning.hpp"

namespace jam::inside {
namespace {

void add(const std::vector<double> &block, double *to) {
  for (size_t c = 0; c < block.size(); ++c) to[c] += block[c];
}

// Coordinates of stable spheres, one for each rigid motion of the scene, that move in any combination of these motions.
// As forces have no part along them, springs to these coordinates change no answer. Without walls: the first sphere.
std::vector<size_t> tied_coordinates(const SoftState &state, const std::vector<char> &stable) {
  const size_t d = static_cast<size_t>(state.dim());
  const Container &walls = state.base().container;
  std::vector<size_t> tied;
  if (!walls) {
    const auto first = static_cast<size_t>(std::find(stable.begin(), stable.end(), 1) - stable.begin());
    for (size_t c = 0; first < stable.size() && c < d; ++c) tied.push_back(first * d + c);
    return tied;
  }
  std::vector<std::vector<double>> motion;
  const auto add_motion = [&](const auto &velocity) {
    motion.emplace_back(stable.size() * d, 0.0);
    for (size_t i = 0; i < stable.size(); ++i)
      if (stable[i]) velocity(i, &motion.back()[i * d]);
  };
  for (size_t c = 0; c < d; ++c)
    if ((walls.closed() >> c & 1u) == 0) add_motion([&](size_t, double *v) { v[c] = state.diameter_mean(); });
  for (int q = 0; q < walls.rotations(); ++q)
    add_motion([&](size_t i, double *v) {
      double x[JAM_MAX_DIM];
      for (size_t c = 0; c < d; ++c) x[c] = state.base().position[i * d + c] + state.displacement()[i * d + c];
      walls.rotation(q, x, v);
    });
  // Gaussian elimination with the largest component of each motion as pivot.
  const auto larger = [](double x, double y) { return std::fabs(x) < std::fabs(y); };
  for (size_t m = 0; m < motion.size(); ++m) {
    const auto pivot = std::max_element(motion[m].begin(), motion[m].end(), larger);
    if (!(std::fabs(*pivot) > RoundingTuning::sure * state.diameter_mean())) continue;
    const auto at = static_cast<size_t>(pivot - motion[m].begin());
    tied.push_back(at);
    for (size_t l = m + 1; l < motion.size(); ++l) {
      const double part = motion[l][at] / *pivot;
      for (size_t k = 0; k < motion[l].size(); ++k) motion[l][k] -= part * motion[m][k];
    }
  }
  return tied;
}

}  // namespace

// The block of a contact: plus on the diagonal blocks of its spheres, minus off them.
void SoftHessian::assemble(const SoftState &state, const SoftContacts &contacts, const std::vector<char> &on) {
  const int d = state.dim(), dd = d * d;
  ei_.clear(), ej_.clear(), off_.clear();
  diag_.assign(state.n() * static_cast<size_t>(dd), 0.0);
  std::vector<char> stable(state.n(), 0);
  std::vector<double> block(static_cast<size_t>(dd));
  double sum = 0.0;
  int64_t count = 0;
  strains_ = state.strains();
  border_.assign(state.spheres() * strains_, 0.0), corner_.assign(strains_ * strains_, 0.0);
  CellStrain strain;
  if (strains_ > 0) strain = state.strain();
  double virial = 0.0;  // of the axes that may strain
  for (size_t q = 0; q < contacts.size(); ++q) {
    const int32_t i = state.pairs().i[contacts.pair[q]], j = state.pairs().j[contacts.pair[q]];
    if (strains_ > 0 && j >= 0) {  // walls keep their places in a strain
      add_border(state, contacts, strain, q);
      virial += contacts.force[q] * contacts.distance[q] * state.cell().open_part(&contacts.normal[q * d]);
    }
    if (i == j) continue;  // an image of itself moves with the sphere
    if (on[q]) for_spheres(i, j, [&](int32_t s) { stable[s] = 1; });
    const double k = state.energy().stiffness(contacts.overlap[q], contacts.force[q]);
    contact_block(d, k, contacts.transverse[q], &contacts.normal[q * d],
                  j < 0 ? state.base().container[wall_partner(j)].turning() : turning_of_pairs, block.data());
    for_spheres(i, j, [&](int32_t s) { add(block, &diag_[static_cast<size_t>(s) * dd]); });
    sum += k;
    ++count;
    if (j < 0) continue;
    if (ei_.empty() || ei_.back() != i || ej_.back() != j) {  // images of one pair stand one after the other
      ei_.push_back(i), ej_.push_back(j);
      off_.resize(off_.size() + dd, 0.0);
    }
    double *off = &off_[off_.size() - dd];
    for (int c = 0; c < dd; ++c) off[c] -= block[c];
  }
  unit_ = count > 0 ? sum / static_cast<double>(count) : strains_ > 0 && corner_[0] > 0.0 ? corner_[0] : 1.0;
  if (strains_ > 0) {
    const FreeCell &cell = state.cell();
    const double p_v = cell.volume ? cell.pressure * scene_volume(state.base()) : virial / cell.open_axes();
    const std::vector<double> curvature = volume_curvature(cell);
    for (size_t k = 0; k < corner_.size(); ++k)
      corner_[k] += p_v * curvature[k] * state.amplitude_unit() * state.amplitude_unit();
  }
  for (size_t i = 0; i < state.n(); ++i)
    for (int c = 0; c < d && !stable[i]; ++c) diag_[i * dd + c * d + c] += SoftHessianTuning::rattler_spring * unit_;
  for (const size_t k : tied_coordinates(state, stable)) diag_[k * d + k % d] += unit_;
}

// Forces on spheres and strains from strains: with v_k = slope_k r0, the columns H v_k and the numbers v_k . H v_l.
void SoftHessian::add_border(const SoftState &state, const SoftContacts &contacts, const CellStrain &strain,
                             size_t contact) {
  const size_t d = static_cast<size_t>(state.dim()), pair = contacts.pair[contact], spheres = state.spheres();
  const size_t i = static_cast<size_t>(state.pairs().i[pair]), j = static_cast<size_t>(state.pairs().j[pair]);
  const double *r0 = state.base_vector(pair), *n = &contacts.normal[contact * d];
  const double k = state.energy().stiffness(contacts.overlap[contact], contacts.force[contact]),
               t = contacts.force[contact] / contacts.distance[contact];
  std::vector<double> v(strains_ * d, 0.0), hv(d);
  for (size_t m = 0; m < strains_; ++m)
    for (size_t a = 0; a < d; ++a)
      for (size_t b = a; b < d; ++b) v[m * d + a] += strain.slope[(m * d + a) * d + b] * r0[b];
  for (size_t m = 0; m < strains_; ++m) {
    double along = 0.0;
    for (size_t c = 0; c < d; ++c) along += n[c] * v[m * d + c];
    for (size_t c = 0; c < d; ++c) hv[c] = (k + t) * along * n[c] - t * v[m * d + c];
    for (size_t c = 0; c < d && i != j; ++c)
      border_[m * spheres + i * d + c] += hv[c], border_[m * spheres + j * d + c] -= hv[c];
    for (size_t l = 0; l < strains_; ++l)
      for (size_t c = 0; c < d; ++c) corner_[m * strains_ + l] += hv[c] * v[l * d + c];
  }
}

bool SoftHessian::factorise_border(double shift) {
  if (strains_ == 0) return true;
  const auto q = static_cast<Eigen::Index>(strains_);
  const size_t spheres = border_.size() / strains_;
  border_solved_ = border_;
  Eigen::MatrixXd s = Eigen::Map<const Eigen::MatrixXd>(corner_.data(), q, q);
  for (size_t k = 0; k < strains_; ++k) {
    double *x = &border_solved_[k * spheres];
    cholesky_.solve(x);
    for (size_t l = 0; l < strains_; ++l)
      s(static_cast<Eigen::Index>(l), static_cast<Eigen::Index>(k)) -=
          std::inner_product(x, x + spheres, &border_[l * spheres], 0.0);
  }
  s.diagonal().array() += shift;
  const Eigen::LLT<Eigen::MatrixXd> factor(0.5 * (s + s.transpose()));
  if (factor.info() != Eigen::Success) return false;
  const Eigen::MatrixXd inverse = factor.solve(Eigen::MatrixXd::Identity(q, q));
  schur_.assign(inverse.data(), inverse.data() + inverse.size());
  return true;
}

void SoftHessian::solve(std::vector<double> &x) const {
  cholesky_.solve(x.data());
  if (strains_ == 0) return;
  const size_t spheres = border_.size() / strains_;
  std::vector<double> rest(strains_);
  for (size_t k = 0; k < strains_; ++k)
    rest[k] = x[spheres + k] - std::inner_product(x.begin(), x.begin() + spheres, &border_[k * spheres], 0.0);
  for (size_t k = 0; k < strains_; ++k) {
    double e = 0.0;
    for (size_t l = 0; l < strains_; ++l) e += schur_[k * strains_ + l] * rest[l];
    x[spheres + k] = e;
    for (size_t c = 0; c < spheres; ++c) x[c] -= e * border_solved_[k * spheres + c];
  }
}

bool SoftHessian::has_contacts(const SoftState &state, const SoftContacts &contacts) const {
  size_t at = 0;
  for (size_t q = 0; q < contacts.size(); ++q) {
    const int32_t i = state.pairs().i[contacts.pair[q]], j = state.pairs().j[contacts.pair[q]];
    if (i == j || j < 0) continue;
    if (at > 0 && ei_[at - 1] == i && ej_[at - 1] == j) continue;
    if (at == ei_.size() || ei_[at] != i || ej_[at] != j) return false;
    ++at;
  }
  return at == ei_.size();
}

size_t SoftHessian::factor_numbers(const SoftState &state, const SoftContacts &contacts, const std::vector<char> &on) {
  assemble(state, contacts, on);
  return BlockCholesky::measure(state.dim(), static_cast<int32_t>(state.n()), ei_.data(), ej_.data(), ei_.size(), 1)
      .factor;
}

bool SoftHessian::factorise(const SoftState &state, const SoftContacts &contacts, const std::vector<char> &on,
                            double shift, int64_t &factorisations) {
  assemble(state, contacts, on);
  if (cholesky_.supernodes() == 0 || ei_ != analysed_i_ || ej_ != analysed_j_) {  // one sphere: its lists are empty
    // A few contacts more or less leave the elimination order good.
    const bool first = analysed_i_.empty();
    analysed_i_.clear();  // until this ends: the memory of the call may not suffice
    if (first)
      cholesky_.analyse(state.dim(), static_cast<int32_t>(state.n()), ei_.data(), ej_.data(), ei_.size());
    else
      cholesky_.analyse_keep_order(state.dim(), static_cast<int32_t>(state.n()), ei_.data(), ej_.data(), ei_.size());
    analysed_i_ = ei_, analysed_j_ = ej_;
    cholesky_.set_pivot_rule(1e-14, 0.0);
  }
  const int d = state.dim();
  std::vector<double> shifted;
  for (double s = shift;
       s<SoftHessianTuning::last_try; s = s> 0.0 ? SoftHessianTuning::next_try * s : SoftHessianTuning::first_try) {
    shifted = diag_;
    for (size_t i = 0; i < state.n(); ++i)
      for (int c = 0; c < d; ++c) shifted[i * d * d + c * d + c] += s * unit_;
    ++factorisations;
    if (cholesky_.factorise(shifted.data(), off_.data()) == 0 && factorise_border(s * unit_)) {
      shift_ = s;
      return true;
    }
  }
  return false;
}

}  // namespace jam::inside
