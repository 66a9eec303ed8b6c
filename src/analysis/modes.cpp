// Few modes by Lanczos (Spectra): the only file that includes it. Lowest modes by shift and invert on the sparse
// factor, highest on the matrix itself, modes near a frequency by an indefinite LDL^T.
#include "analysis/modes.hpp"

#include <Spectra/SymEigsSolver.h>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "core/call_scope.hpp"
#include "core/limits.hpp"
#include "core/rng.hpp"
#include "linalg/block_cholesky.hpp"
#include "linalg/dot.hpp"

namespace jam::inside {

jam_modes_options default_modes_options() {
  jam_modes_options o{};
  o.struct_size = sizeof o;
  o.which = JAM_MODES_LOWEST;
  o.count = 10;
  o.frequency = 0.0;
  o.tolerance = 1e-10;
  o.memory_limit = 2e9;
  return o;
}

void check_modes_options(const jam_modes_options &o, const RigidityMatrix &g) {
  check_enum(o.which, JAM_MODES_LOWEST, JAM_MODES_ALL, "which", "jam_modes_which");
  if (o.which != JAM_MODES_ALL && o.count < 1)
    fail(JAM_E_ARGUMENT, "count is %lld, it must be at least 1", static_cast<long long>(o.count));
  if (!(o.frequency >= 0.0 && std::isfinite(o.frequency)))
    fail(JAM_E_ARGUMENT, "frequency is %g, it must be finite and >= 0", o.frequency);
  if (!(o.tolerance > 0.0 && o.tolerance < 1.0))
    fail(JAM_E_ARGUMENT, "tolerance is %g, it must be in (0, 1)", o.tolerance);
  const double n = static_cast<double>(g.unknowns());
  const double krylov = 8.0 * n * (3.0 * static_cast<double>(o.count) + ModesTuning::krylov_vectors),
               dense = ModesTuning::dense_bytes * n * n;
  const double need = o.which == JAM_MODES_ALL ? dense : std::min(krylov, dense);
  if (!(need <= o.memory_limit))
    fail(JAM_E_MEMORY, "%s of %.0f unknowns needs about %s, memory_limit is %s",
         o.which == JAM_MODES_ALL ? "the full spectrum" : "this many modes", n, bytes_text(need).c_str(),
         bytes_text(o.memory_limit).c_str());
}

namespace {

// One Lanczos operator: x -> P A' P x with P taking out the translations and the modes already found.
class Operator {
 public:
  using Scalar = double;
  Operator(const RigidityMatrix &g, std::function<void(const double *, double *)> apply)
      : g_(g), apply_(std::move(apply)), work_(g.unknowns()) {}
  Eigen::Index rows() const { return static_cast<Eigen::Index>(g_.unknowns()); }
  Eigen::Index cols() const { return rows(); }
  void perform_op(const double *x, double *y) const {
    CallScope::report_share(++count_);
    std::copy(x, x + g_.unknowns(), work_.begin());
    project(work_.data());
    apply_(work_.data(), y);
    project(y);
  }
  void project(double *x) const {
    g_.remove_symmetries(x);
    if (found.empty()) return;
    const auto n = static_cast<Eigen::Index>(g_.unknowns());
    Eigen::Map<const Eigen::MatrixXd> f(found.data(), n, static_cast<Eigen::Index>(found.size()) / n);
    Eigen::Map<Eigen::VectorXd> v(x, n);
    const Eigen::VectorXd along = f.transpose() * v;
    v.noalias() -= f * along;
  }
  std::vector<double> found;  // vectors to project out, one after the other

 private:
  const RigidityMatrix &g_;
  std::function<void(const double *, double *)> apply_;
  mutable std::vector<double> work_;
  mutable int64_t count_ = 0;
};

struct Found {
  Eigen::VectorXd value;
  Eigen::MatrixXd vector;
};

Eigen::VectorXd random_vector(const Operator &op) {
  Eigen::VectorXd out(op.rows());
  Rng rng(1, Stream::analysis_start, static_cast<uint64_t>(op.found.size()));
  for (double &x : out) x = rng.normal();
  return out;
}

// Whether `op` inverts h - shift to within `error`, and no mode is nearer to the shift than that: rounding of its part
// would hide all others. By two steps of inverse iteration.
bool inverts(const Operator &op, const BlockMatrix &h, double shift, double error) {
  Eigen::VectorXd x = random_vector(op), y(op.rows()), left(op.rows());
  op.perform_op(x.data(), y.data());
  x = y.normalized();
  op.perform_op(x.data(), y.data());
  h.multiply(y.data(), left.data());
  left -= shift * y + x;
  op.project(left.data());
  return left.norm() < error * y.norm() && y.norm() * error < 1.0;
}

Found lanczos(Operator &op, int64_t count, Spectra::SortRule rule, double tolerance, int iterations) {
  const Eigen::Index n = op.rows(), nev = std::min<Eigen::Index>(count, n - 1);
  const Eigen::Index ncv = std::min<Eigen::Index>(n, std::max<Eigen::Index>(2 * nev, nev + 20));
  Spectra::SymEigsSolver<Operator> solver(op, nev, ncv);
  try {
    solver.init(random_vector(op).data());
    solver.compute(rule, iterations, tolerance, rule);
  } catch (const Cancelled &) {
    throw;
  } catch (const std::exception &e) {
    fail(JAM_E_SOLVER, "Lanczos: %s", e.what());
  }
  return {solver.eigenvalues(), solver.eigenvectors()};
}

void append(Operator &op, std::vector<double> &theta, const Found &f) {
  for (Eigen::Index k = 0; k < f.value.size(); ++k) {
    theta.push_back(f.value[k]);
    op.found.insert(op.found.end(), f.vector.col(k).data(), f.vector.col(k).data() + f.vector.rows());
  }
}

// A Krylov sequence finds one vector of a degenerate eigenspace, and more only by rounding. So the search is repeated
// with the found vectors projected out, until the best new one is worse than all that are kept.
void search(Operator &op, int64_t count, Spectra::SortRule rule, double tolerance, std::vector<double> &theta) {
  auto rank = [&](double t) { return rule == Spectra::SortRule::LargestMagn ? std::fabs(t) : t; };
  append(op, theta, lanczos(op, count, rule, tolerance, ModesTuning::restarts));
  const auto all = static_cast<int64_t>(op.rows());
  for (int round = 0; round < ModesTuning::probes && static_cast<int64_t>(theta.size()) + 4 < all && !theta.empty();
       ++round) {
    std::vector<double> sorted(theta);
    std::sort(sorted.begin(), sorted.end(), [&](double x, double y) { return rank(x) > rank(y); });
    const bool some = static_cast<int64_t>(sorted.size()) >= count;  // else any mode is wanted
    const double last = some ? rank(sorted[static_cast<size_t>(count) - 1]) : -std::numeric_limits<double>::infinity();
    const Found probe = lanczos(op, 2, rule, ModesTuning::probe_tolerance, ModesTuning::probe_restarts);
    if (probe.value.size() == 0 || rank(probe.value[0]) < last * (1.0 - 1e-7)) break;
    const Found more =
        lanczos(op, std::min<int64_t>(count, ModesTuning::at_once), rule, tolerance, ModesTuning::restarts);
    if (more.value.size() == 0 || rank(more.value[0]) <= last * (1.0 + 1e-12)) break;
    append(op, theta, more);
  }
}

// Makes the vectors orthonormal, those of least distance first, and keeps `count` that are modes: a residual of the
// root of the tolerance leaves an error of the tolerance in the Rayleigh quotient.
void harvest(const RigidityMatrix &g, const ContactWeights &w, const BlockMatrix &h, const Operator &op,
             const std::vector<double> &distance, size_t count, double tolerance, Modes &out) {
  const auto n = static_cast<Eigen::Index>(g.unknowns());
  std::vector<size_t> order(distance.size());
  std::iota(order.begin(), order.end(), size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](size_t x, size_t y) { return distance[x] < distance[y]; });
  Eigen::MatrixXd v(n, static_cast<Eigen::Index>(std::min(count, order.size())));
  Eigen::VectorXd left(n);
  std::vector<std::pair<double, Eigen::Index>> lambda;
  for (size_t at = 0; at < order.size() && lambda.size() < count; ++at) {
    const auto k = static_cast<Eigen::Index>(lambda.size());
    auto col = v.col(k);
    col = Eigen::Map<const Eigen::VectorXd>(&op.found[order[at] * g.unknowns()], n);
    for (int twice = 0; twice < 2; ++twice)
      if (k > 0) {
        const Eigen::VectorXd along = v.leftCols(k).transpose() * col;
        col -= v.leftCols(k) * along;
      }
    g.remove_symmetries(col.data());
    col.normalize();
    const double l = curvature(g, w, col.data());
    h.multiply(col.data(), left.data());
    if ((left - l * col).norm() <= std::sqrt(tolerance) * h.norm_bound()) lambda.push_back({l, k});
  }
  std::sort(lambda.begin(), lambda.end());
  for (const auto &[l, k] : lambda) {
    out.lambda.push_back(l);
    out.vector.insert(out.vector.end(), v.col(k).data(), v.col(k).data() + n);
  }
}

using Ldlt = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;

Operator inverse(const RigidityMatrix &g, const Ldlt &ldlt) {
  return {g, [&](const double *x, double *y) {
            const auto n = static_cast<Eigen::Index>(g.unknowns());
            Eigen::Map<Eigen::VectorXd>(y, n) = ldlt.solve(Eigen::Map<const Eigen::VectorXd>(x, n));
          }};
}

// The shift for modes near `target`, and the factor there: a step away where the target is a mode, or where a pivot
// that vanishes spoils the factor.
double factorise_near(const RigidityMatrix &g, const BlockMatrix &h, double target, Ldlt &ldlt) {
  const double numbers =
      static_cast<double>(BlockCholesky::measure(h.dim, h.nodes, h.ei.data(), h.ej.data(), h.ei.size(), 1).factor);
  CallScope::need_memory(ModesTuning::sparse_bytes * (numbers + 2.0 * static_cast<double>(csr_entries(h))),
                         "the numbers of a factorised matrix");
  const CsrMatrix csr = to_csr(h);
  const auto n = static_cast<Eigen::Index>(g.unknowns());
  const Eigen::SparseMatrix<double> a = Eigen::Map<const Eigen::SparseMatrix<double>>(
      n, n, static_cast<Eigen::Index>(csr.value.size()), csr.start.data(), csr.column.data(), csr.value.data());
  ldlt.analyzePattern(a);
  const Operator op = inverse(g, ldlt);
  const double step = ModesTuning::near_shift * h.norm_bound();
  for (double away = 0.0; away < ModesTuning::farthest_shift * step; away = std::max(step, 2.0 * away)) {
    CallScope::report_share();
    ldlt.setShift(-(target + away));
    ldlt.factorize(a);
    if (ldlt.info() == Eigen::Success && inverts(op, h, target + away, step)) return target + away;
  }
  fail(JAM_E_SOLVER, "frequency %g hits an eigenvalue; change it a little", std::sqrt(target));
}

jam_status few_modes(const RigidityMatrix &g, const ContactWeights &w, const BlockMatrix &h, const jam_modes_options &o,
                     Modes &out) {
  const size_t n = g.unknowns(), most = n - static_cast<size_t>(g.symmetries());
  auto run = [&](Operator op, Spectra::SortRule rule, const std::function<double(double)> &distance) {
    std::vector<double> theta;
    search(op, o.count, rule, o.tolerance, theta);
    std::transform(theta.begin(), theta.end(), theta.begin(), distance);
    harvest(g, w, h, op, theta, static_cast<size_t>(o.count), o.tolerance, out);
  };
  const auto minus = [](double t) { return -t; };
  if (o.which == JAM_MODES_LOWEST) {
    ShiftedFactor factor(h);
    factor.factorise_from(1e-9 * h.norm_bound());
    run({g,
         [&](const double *x, double *y) {
           std::copy(x, x + n, y);
           factor.solve(y);
         }},
        Spectra::SortRule::LargestAlge, minus);
  } else if (o.which == JAM_MODES_HIGHEST) {
    run({g, [&](const double *x, double *y) { h.multiply(x, y); }}, Spectra::SortRule::LargestAlge, minus);
  } else {
    Ldlt ldlt;
    const double target = o.frequency * o.frequency, away = factorise_near(g, h, target, ldlt) - target;
    run(inverse(g, ldlt), Spectra::SortRule::LargestMagn, [&](double t) { return std::fabs(away + 1.0 / t); });
  }
  return out.lambda.size() >= std::min(static_cast<size_t>(o.count), most) ? JAM_OK : JAM_NOT_CONVERGED;
}

}  // namespace

jam_status find_modes(const RigidityMatrix &g, const ContactWeights &w, const jam_modes_options &o, Monitor &monitor,
                      Modes &out) {
  check_modes_options(o, g);
  const BlockMatrix h = make_hessian(g, w);
  const size_t n = g.unknowns();
  jam_status status = JAM_OK;
  const double wanted = static_cast<double>(o.count);
  const bool dense = o.which == JAM_MODES_ALL || n <= ModesTuning::always_dense ||
                     (wanted >= ModesTuning::dense_share * static_cast<double>(n) &&
                      ModesTuning::dense_bytes * n * n <= o.memory_limit) ||
                     (o.which == JAM_MODES_NEAR && o.frequency == 0.0 && n <= ModesTuning::dense_for_lowest);
  if (dense) {
    status = all_modes(h, monitor, out);
    if (status == JAM_CANCELLED) out = Modes();
    if (status == JAM_OK && o.which != JAM_MODES_ALL) select_modes(g, o, out);
  } else {
    const CancellableScope scope(CallScope::memory_limit(), &monitor);
    try {
      status = few_modes(g, w, h, o, out);
    } catch (const Cancelled &) {
      out = Modes();
      status = JAM_CANCELLED;
    }
  }
  for (size_t k = 0; k < out.lambda.size(); ++k)
    out.participation.push_back(inverse_participation(g.dim, g.nodes, &out.vector[k * n]));
  return status;
}

double inverse_participation(int dim, int32_t nodes, const double *v) {
  double two = 0.0, four = 0.0;
  for (int32_t i = 0; i < nodes; ++i) {
    const double s = squared(v + static_cast<size_t>(i) * dim, dim);
    two += s;
    four += s * s;
  }
  return two > 0.0 ? four / (two * two) : 0.0;
}

}  // namespace jam::inside
