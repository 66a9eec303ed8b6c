// Modes from the whole spectrum: all of them, and the choice among them without translations.
#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "analysis/modes.hpp"

namespace jam::inside {

jam_status all_modes(const BlockMatrix &h, Monitor &monitor, Modes &out) {
  const int n = static_cast<int>(h.rows()), d = h.dim;
  std::vector<double> a = lapack_array(static_cast<size_t>(n) * n);
  auto put = [&](int32_t i, int32_t j, const double *block) {
    for (int r = 0; r < d; ++r)
      for (int c = 0; c < d; ++c) a[static_cast<size_t>(j * d + c) * n + (i * d + r)] = block[r * d + c];
  };
  for (int32_t i = 0; i < h.nodes; ++i) put(i, i, &h.diag[static_cast<size_t>(i) * d * d]);
  for (size_t e = 0; e < h.ei.size(); ++e)
    put(h.ej[e], h.ei[e], &h.off[e * d * d]);  // lower triangle; blocks are symmetric
  auto stop = [&](double fraction) {
    jam_progress p = progress_of(JAM_PHASE_ANALYSE);
    p.fraction = fraction;
    return monitor.report(p, fraction == 0.0);
  };
  if (!dense_eigen(n, a, out.lambda, true, stop)) return JAM_CANCELLED;
  out.vector = std::move(a);
  return JAM_OK;
}

void select_modes(const RigidityMatrix &g, const jam_modes_options &o, Modes &m) {
  const size_t n = g.unknowns();
  std::vector<size_t> keep;
  // Translations may be mixed with other zero modes: take them out of the vectors and drop what is left of least
  // length.
  const double tiny =  // in the unit of the stiffness, which after jam_relax is any
      m.lambda.empty() ? 0.0 : 1e-9 * std::max(std::fabs(m.lambda.front()), std::fabs(m.lambda.back()));
  Eigen::Map<Eigen::MatrixXd> v(m.vector.data(), static_cast<Eigen::Index>(n), static_cast<Eigen::Index>(n));
  std::vector<size_t> zero;
  for (size_t k = 0; k < n; ++k)
    if (std::fabs(m.lambda[k]) <= tiny) zero.push_back(k);
  Eigen::MatrixXd z(n, zero.size());
  Eigen::Index rank = 0;
  const Eigen::Index room = std::max<Eigen::Index>(0, static_cast<Eigen::Index>(zero.size()) - g.symmetries());
  for (Eigen::Index pass = 0; pass < static_cast<Eigen::Index>(zero.size()) && rank < room; ++pass) {
    Eigen::VectorXd x = v.col(static_cast<Eigen::Index>(zero[pass]));
    for (int twice = 0; twice < 2; ++twice) {
      g.remove_symmetries(x.data());
      if (rank > 0) x -= z.leftCols(rank) * (z.leftCols(rank).transpose() * x).eval();
    }
    if (x.norm() < ModesTuning::spent && pass + (room - rank) < static_cast<Eigen::Index>(zero.size())) continue;
    z.col(rank++) = x.normalized();
  }
  for (Eigen::Index k = 0; k < rank; ++k) v.col(static_cast<Eigen::Index>(zero[k])) = z.col(k);
  for (size_t k = 0, seen = 0; k < n; ++k)
    if (std::fabs(m.lambda[k]) > tiny || static_cast<Eigen::Index>(seen++) < rank) keep.push_back(k);
  const double target = o.frequency * o.frequency;
  const size_t want = std::min<size_t>(keep.size(), static_cast<size_t>(o.count));
  if (o.which == JAM_MODES_HIGHEST) keep.erase(keep.begin(), keep.end() - static_cast<std::ptrdiff_t>(want));
  if (o.which == JAM_MODES_NEAR) {
    std::stable_sort(keep.begin(), keep.end(), [&](size_t x, size_t y) {
      return std::fabs(m.lambda[x] - target) < std::fabs(m.lambda[y] - target);
    });
    keep.resize(want);
    std::sort(keep.begin(), keep.end());
  }
  keep.resize(want);
  Modes cut;
  for (size_t k : keep) {
    cut.lambda.push_back(m.lambda[k]);
    cut.vector.insert(cut.vector.end(), &m.vector[k * n], &m.vector[k * n] + n);
  }
  m = std::move(cut);
}

}  // namespace jam::inside
