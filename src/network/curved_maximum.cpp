#include "network/curved_maximum.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

#include "core/motion.hpp"
#include "network/hessian.hpp"
#include "network/rigidity_matrix.hpp"
#include "network/tuning.hpp"

namespace jam::inside {
namespace {

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
    solver.setThreshold(CurvedMaximumTuning::rank);
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
  for (int round = 0; round < CurvedMaximumTuning::most_rounds; ++round) {
    const Maximum at(q, now);
    if (at.size() > CurvedMaximumTuning::most_unknowns) return false;
    const Eigen::VectorXd e = at.residual();
    const double size = e.lpNorm<Eigen::Infinity>();
    if (!(size < worst)) break;
    worst = size;
    p = q, net = now;
    const Eigen::VectorXd x = at.step(e);
    if (!x.allFinite() || x.head(at.size()).lpNorm<Eigen::Infinity>() > CurvedMaximumTuning::longest) break;
    at.take(x, q, now);
  }
  return worst < RigidityTuning::most_residual;
}

}  // namespace jam::inside
