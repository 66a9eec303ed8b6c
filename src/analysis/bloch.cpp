#include "analysis/modes.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Dense>

#include "core/call_scope.hpp"
#include "core/math.hpp"

namespace jam::inside {

WavePhase phase_of(const double *q, const std::array<int32_t, JAM_MAX_DIM> &s, int dim) {
  double turns = 0.0;
  for (int c = 0; c < dim; ++c) {
    const double t = q[c] * s[c];
    turns += t - std::nearbyint(t);
  }
  turns -= std::nearbyint(turns);
  const bool real = turns == 0.0 || std::fabs(turns) == 0.5;
  return {math::cos_of_turns(turns), real ? 0.0 : -math::cos_of_turns(turns - 0.25)};
}

bool is_real(const CellsBack &back, const double *q, int dim) {
  return std::all_of(back.begin(), back.end(), [&](const auto &s) { return phase_of(q, s, dim).sine == 0.0; });
}

namespace {

// The lower triangle of the symmetric matrix that stands for the Hermitian one, column after column.
class Hermitian {
 public:
  Hermitian(int n, bool real) : n_(n), size_(real ? n : 2 * n), a_(lapack_array(static_cast<size_t>(size_) * size_)) {}
  int size() const { return size_; }
  std::vector<double> &entries() { return a_; }
  // Adds block * phase to the block (i, j).
  void add(int32_t i, int32_t j, const double *block, double factor, WavePhase phase, int d) {
    for (int r = 0; r < d; ++r)
      for (int c = 0; c < d; ++c) {
        const double x = factor * block[r * d + c];
        put(i * d + r, j * d + c, x * phase.cosine);
        if (size_ == n_) continue;
        put(n_ + i * d + r, n_ + j * d + c, x * phase.cosine);
        put(n_ + i * d + r, j * d + c, x * phase.sine);
      }
  }

 private:
  void put(int row, int column, double x) {
    if (row >= column) a_[static_cast<size_t>(column) * size_ + row] += x;
  }
  int n_, size_;
  std::vector<double> a_;
};

// Of the vectors (x, y) of the symmetric matrix to frequencies that may be mixed, half as many x + i y that span the
// same. Those that are farthest from the span so far come first.
void take_complex(const double *vectors, int n, size_t first, size_t last, Eigen::MatrixXcd &out) {
  const auto count = static_cast<Eigen::Index>(last - first);
  Eigen::MatrixXcd left(n, count);
  for (Eigen::Index k = 0; k < count; ++k) {
    const double *v = &vectors[(first + static_cast<size_t>(k)) * 2 * static_cast<size_t>(n)];
    for (int r = 0; r < n; ++r) left(r, k) = {v[r], v[n + r]};
  }
  const auto at = static_cast<Eigen::Index>(first / 2);
  for (Eigen::Index k = 0; k < count / 2; ++k) {
    Eigen::Index farthest = 0;
    left.colwise().squaredNorm().maxCoeff(&farthest);
    Eigen::VectorXcd x = left.col(farthest).normalized();
    x -= out.middleCols(at, k) * (out.middleCols(at, k).adjoint() * x).eval();
    out.col(at + k) = x.normalized();
    left -= out.col(at + k) * (out.col(at + k).adjoint() * left).eval();
  }
}

// The solver keeps vectors (x, y) orthogonal to rounding, and those of near frequencies mix: x + i y of two of them
// need not be. Twice is enough (L. Giraud et al., Numer. Math. 101, 87 (2005)).
void make_orthogonal(const std::vector<double> &lambda, Eigen::MatrixXcd &v) {
  const double near = ModesTuning::leaning * std::max(std::fabs(lambda.front()), std::fabs(lambda.back()));
  for (Eigen::Index k = 1, first = 0; k < v.cols(); ++k) {
    CallScope::look();
    while (lambda[static_cast<size_t>(k)] - lambda[static_cast<size_t>(first)] > near) ++first;
    for (int pass = 0; pass < 2 && first < k; ++pass) {
      Eigen::VectorXcd x = v.col(k);
      x -= v.middleCols(first, k - first) * (v.middleCols(first, k - first).adjoint() * x).eval();
      v.col(k) = x.normalized();
    }
  }
}

void write_vectors(const Eigen::MatrixXcd &v, Modes &out) {
  out.vector.clear();
  for (Eigen::Index k = 0; k < v.cols(); ++k)
    for (Eigen::Index r = 0; r < v.rows(); ++r)
      out.vector.push_back(v(r, k).real()), out.vector.push_back(v(r, k).imag());
}

// Whether a contact between these cells changes its length at the wave vector, for a sphere and its own image.
bool stretches(const double *q, const std::array<int32_t, JAM_MAX_DIM> &s, int dim) {
  return phase_of(q, s, dim).cosine != 1.0;
}

}  // namespace

CellsBack cells_back(const Packing &p, const ContactNetwork &net) {
  CellsBack out(net.size());
  for (size_t k = 0; k < net.size(); ++k)
    if (!net.pairs.wall(k)) out[k] = lattice_steps(p.cell, &net.pairs.offset[k * static_cast<size_t>(p.dim)]);
  return out;
}

void refuse_own_images_at(const Packing &p, const ContactNetwork &net, const double *q) {
  ContactNetwork own = unlisted_own_images(p, net);
  const CellsBack back = cells_back(p, own);
  std::vector<char> on(own.size());
  for (size_t k = 0; k < on.size(); ++k) on[k] = stretches(q, back[k], p.dim);
  refuse_own_images(subset(own, on, p.dim), "modes at this wave vector");
}

void need_memory_for_bloch(const RigidityMatrix &g, const CellsBack &back, const double *q) {
  const auto n = static_cast<double>(g.unknowns());
  const double bytes = is_real(back, q, g.dim) ? ModesTuning::real_wave_bytes : 4.0 * ModesTuning::dense_bytes;
  CallScope::need_memory(bytes * n * n, "the modes at a wave vector");
}

Modes bloch_modes(const RigidityMatrix &g, const ContactWeights &w, const CellsBack &back, const double *q,
                  bool vectors) {
  const int d = g.dim, n = static_cast<int>(g.unknowns());
  Hermitian h(n, is_real(back, q, d));
  std::vector<double> block(static_cast<size_t>(d) * d);
  constexpr WavePhase one{1.0, 0.0};
  const bool bends =
      !w.transverse.empty();  // rows of rattlers that stay (add_rows) have no wall: they have springs alone
  for (size_t k = 0; k < g.contacts(); ++k) {
    contact_block(d, w.stiffness[k], bends ? w.transverse[k] : 0.0, &g.normal[k * d],
                  bends ? g.turning(k) : turning_of_pairs, block.data());
    h.add(g.a[k], g.a[k], block.data(), 1.0, one, d);
    if (g.b[k] < 0) continue;
    const WavePhase phase = phase_of(q, back[k], d);
    h.add(g.b[k], g.b[k], block.data(), 1.0, one, d);
    h.add(g.a[k], g.b[k], block.data(), -1.0, phase, d);
    h.add(g.b[k], g.a[k], block.data(), -1.0, {phase.cosine, -phase.sine}, d);
  }
  std::vector<double> lambda;
  {
    const auto look = [](double share) { return CallScope::report_share(0, share), false; };
    if (vectors)
      dense_eigen(h.size(), h.entries(), lambda, look);
    else  // of a verdict
      dense_eigen_builtin(h.size(), h.entries(), lambda, false, look);
  }
  Modes out;
  const bool twice = h.size() > n;
  for (int k = 0; k < n; ++k) out.lambda.push_back(twice ? 0.5 * (lambda[2 * k] + lambda[2 * k + 1]) : lambda[k]);
  if (!vectors) return out;
  Eigen::MatrixXcd v(n, n);
  if (twice) {
    const double near = ModesTuning::mixed * std::max(std::fabs(lambda.front()), std::fabs(lambda.back()));
    for (size_t first = 0, last; first < lambda.size(); first = last) {
      for (last = first + 2; last < lambda.size() && lambda[last] - lambda[last - 1] <= near;) last += 2;
      take_complex(h.entries().data(), n, first, last, v);
    }
    make_orthogonal(out.lambda, v);
  } else {
    v = Eigen::Map<const Eigen::MatrixXd>(h.entries().data(), n, n).cast<std::complex<double>>();
  }
  write_vectors(v, out);
  for (int k = 0; k < n; ++k)  // a complex vector of d components has 2 d real ones
    out.participation.push_back(inverse_participation(2 * d, g.nodes, &out.vector[2 * static_cast<size_t>(n) * k]));
  return out;
}

}  // namespace jam::inside
