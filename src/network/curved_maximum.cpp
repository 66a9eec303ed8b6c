#include <Eigen/Dense>
#include <cmath>

#include "core/call_scope.hpp"
#include "core/cell_change.hpp"
#include "linalg/symmetric_eigen.hpp"
#include "network/flex.hpp"
#include "network/rigidity_matrix.hpp"
#include "network/stress_cone.hpp"
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

// Unknowns: displacements of the stable spheres in mean diameters, growth of the diameters, and forces.
class Maximum {
 public:
  Maximum(const Packing &p, const ContactNetwork &net)
      : g_(make_rigidity_matrix(p, net)),
        net_(net),
        unit_(diameter_mean(p)),
        spheres_(static_cast<Eigen::Index>(g_.unknowns())),
        contacts_(static_cast<Eigen::Index>(net.size())) {}

  Eigen::Index size() const { return spheres_ + 1 + contacts_; }

  // Net forces, gaps, and the mean force less 1.
  Eigen::VectorXd residual() const {
    Eigen::VectorXd e(size());
    apply_equilibrium(g_, net_.force.data(), e.data());
    for (Eigen::Index k = 0; k < contacts_; ++k) e[spheres_ + k] = net_.gap[k];
    e[size() - 1] = -1.0;
    for (const double f : net_.force) e[size() - 1] += f / static_cast<double>(contacts_);
    return e;
  }

  // A unit vector turns by (1 - n n^T) ds times the second derivative of the distance.
  Eigen::VectorXd step(const Eigen::VectorXd &e) const {
    const int d = g_.dim;
    Eigen::MatrixXd m = Eigen::MatrixXd::Zero(size(), size());
    ContactWeights turn{std::vector<double>(net_.size(), 0.0), {}};
    for (size_t k = 0; k < net_.size(); ++k) turn.transverse.push_back(-net_.force[k] * g_.bending[k] * unit_);
    const BlockMatrix h = make_hessian(g_, turn);
    const auto put = [&](int32_t i, int32_t j, const double *block) {
      for (int r = 0; r < d; ++r)
        for (int c = 0; c < d; ++c) m(i * d + r, j * d + c) = block[r * d + c];
    };
    const size_t dd = static_cast<size_t>(d) * static_cast<size_t>(d);
    for (int32_t i = 0; i < g_.nodes; ++i) put(i, i, &h.diag[static_cast<size_t>(i) * dd]);
    for (size_t q = 0; q < h.ei.size(); ++q)
      put(h.ei[q], h.ej[q], &h.off[q * dd]), put(h.ej[q], h.ei[q], &h.off[q * dd]);
    for (Eigen::Index k = 0; k < contacts_; ++k) {
      for (int c = 0; c < d; ++c) {
        const double n = g_.normal[static_cast<size_t>(k) * d + c];
        for (const double sign : {1.0, -1.0}) {
          const int32_t node = sign > 0.0 ? g_.a[k] : g_.b[k];
          if (node < 0) continue;
          m(node * d + c, spheres_ + 1 + k) += sign * n;
          m(spheres_ + k, node * d + c) += sign * n * unit_ / g_.sigma[k];
        }
      }
      m(spheres_ + k, spheres_) = -(1.0 + net_.gap[k]);
      m(size() - 1, spheres_ + 1 + k) = 1.0 / static_cast<double>(contacts_);
    }
    Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> solver;  // the shortest step: symmetries are free
    solver.setThreshold(RoundingTuning::sure);
    solver.compute(m);
    return solver.solve(-e);
  }

  void take(const Eigen::VectorXd &x, Packing &p, ContactNetwork &net) const {
    std::vector<double> s(p.position.size(), 0.0);
    const size_t d = static_cast<size_t>(g_.dim);
    for (size_t i = 0; i < g_.sphere.size(); ++i)
      for (size_t c = 0; c < d; ++c) s[static_cast<size_t>(g_.sphere[i]) * d + c] = x[i * d + c];
    move_packing(p, net.pairs, s.data(), unit_, 1.0 + x[spheres_]);
    for (Eigen::Index k = 0; k < contacts_; ++k) net.force[k] += x[spheres_ + 1 + k];
    measure_contacts(p, net);
  }

 private:
  const RigidityMatrix g_;
  const ContactNetwork &net_;
  const double unit_;
  const Eigen::Index spheres_, contacts_;
};

}  // namespace

bool converge_at_curved_maximum(Packing &p, ContactNetwork &net) {
  Packing q = p;
  ContactNetwork now = net;
  double worst = HUGE_VAL;
  for (;;) {
    CallScope::look();
    const Maximum at(q, now);
    if (at.size() > most_unknowns_at_curved_maximum) return false;
    const Eigen::VectorXd e = at.residual();
    const double size = e.lpNorm<Eigen::Infinity>();
    if (!(size < worst)) break;
    worst = size;
    p = q, net = now;
    const Eigen::VectorXd x = at.step(e);
    if (!x.allFinite()) break;
    at.take(x, q, now);
  }
  return worst < RigidityTuning::most_residual;
}

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
