#include "network/curvature_test.hpp"

#include <cmath>

#include "linalg/symmetric_eigen.hpp"
#include "network/slides.hpp"
#include "network/tuning.hpp"

namespace jam::inside {
namespace {

using Flexes = std::vector<std::vector<double>>;

// Sum over contacts of a weight times the squared part of u_a - u_b across the normal, as a form in the coefficients of
// flexes.
Eigen::MatrixXd form_of(const RigidityMatrix &g, const std::vector<double> &weight, const Flexes &flexes) {
  const auto m = static_cast<Eigen::Index>(flexes.size());
  Eigen::MatrixXd q = Eigen::MatrixXd::Zero(m, m);
  std::vector<double> sum(g.unknowns());
  const auto form = [&](const std::vector<double> &u) {
    double value = 0.0;
    for (size_t k = 0; k < weight.size(); ++k) value += weight[k] * g.stretch(k, u.data()).across;
    return value;
  };
  for (Eigen::Index a = 0; a < m; ++a) q(a, a) = form(flexes[a]);
  for (Eigen::Index a = 0; a < m; ++a)
    for (Eigen::Index b = 0; b < a; ++b) {
      for (size_t k = 0; k < sum.size(); ++k) sum[k] = flexes[a][k] + flexes[b][k];
      q(a, b) = q(b, a) = 0.5 * (form(sum) - q(a, a) - q(b, b));
    }
  return q;
}

std::vector<double> combine(const Flexes &flexes, const Eigen::VectorXd &part) {
  std::vector<double> u(flexes[0].size(), 0.0);
  for (size_t a = 0; a < flexes.size(); ++a)
    for (size_t k = 0; k < u.size(); ++k) u[k] += part[static_cast<Eigen::Index>(a)] * flexes[a][k];
  return u;
}

// The flex that opens most among those along which no sphere at a round wall moves across it: all distances to walls
// stay, and pairs only open, so that no state of self-stress holds it. Empty where there is none.
std::vector<double> free_beside_walls(const RigidityMatrix &g, const Flexes &flexes) {
  std::vector<double> at_walls(g.contacts()), at_pairs(g.contacts());
  for (size_t k = 0; k < g.contacts(); ++k) (g.b[k] < 0 ? at_walls : at_pairs)[k] = 1.0;
  const SymmetricEigen bends = symmetric_eigen(form_of(g, at_walls, flexes));
  Flexes kept;
  for (Eigen::Index k = 0; k < bends.values.size() && bends.values[k] < RigidityTuning::still; ++k)
    kept.push_back(combine(flexes, bends.vectors.col(k)));
  if (kept.empty()) return {};
  const SymmetricEigen opens = symmetric_eigen(form_of(g, at_pairs, kept));
  const Eigen::Index last = opens.values.size() - 1;
  if (!(opens.values[last] > RigidityTuning::least_curvature)) return {};
  return combine(kept, opens.vectors.col(last));
}

// The force of each contact times the second derivative of its distance, and the mean of their sizes.
std::vector<double> curvatures(const RigidityMatrix &g, const std::vector<double> &force, double &scale) {
  std::vector<double> weight(force);
  scale = 0.0;
  for (size_t k = 0; k < force.size(); ++k) weight[k] *= g.bending[k], scale += std::fabs(weight[k]);
  scale /= static_cast<double>(force.size());
  return weight;
}

}  // namespace

bool opens_by_curvature(const RigidityMatrix &carrying, const std::vector<double> &force,
                        const std::vector<double> &motion) {
  double scale = 0.0, square = 0.0;
  const std::vector<double> weight = curvatures(carrying, force, scale);
  std::vector<double> flex(carrying.unknowns());
  for (size_t k = 0, d = static_cast<size_t>(carrying.dim); k < flex.size(); ++k) {
    flex[k] = motion[static_cast<size_t>(carrying.sphere[k / d]) * d + k % d];
    square += flex[k] * flex[k];
  }
  for (double &x : flex) x /= std::sqrt(square);
  return form_of(carrying, weight, {std::move(flex)})(0, 0) > RigidityTuning::least_curvature * scale;
}

void test_prestress_stability(const RigidityMatrix &carrying, const std::vector<double> &force, Flexes &flexes,
                              RigidityResult &out) {
  double scale = 0.0;
  const SymmetricEigen eigen = symmetric_eigen(form_of(carrying, curvatures(carrying, force, scale), flexes));
  const Eigen::Index last = eigen.values.size() - 1;
  const double most = eigen.values[last], limit = RigidityTuning::least_curvature * scale;
  std::vector<double> first = combine(flexes, eigen.vectors.col(last));
  if (most < -limit) {
    flexes[0] = std::move(first);
    out.rigid = out.force_residual < RigidityTuning::most_residual ? Verdict::yes : Verdict::undecided;
    out.curvature = -most / scale;
    return;
  }
  Slides slides = find_slides(carrying);
  if (!(most > limit) && slides.count > 0) {
    out.slides = slides.count;
    first = std::move(slides.motion);
  } else if (!(most > limit) || out.self_stresses > 1) {  // other states of self-stress might hold it
    std::vector<double> free = free_beside_walls(carrying, flexes);
    if (free.empty())
      out.rigid = Verdict::undecided;
    else
      first = std::move(free);
  }
  flexes[0] = std::move(first);
}

}  // namespace jam::inside
