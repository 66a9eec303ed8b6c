#include "network/flex.hpp"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/call_scope.hpp"
#include "core/rng.hpp"
#include "linalg/dot.hpp"
#include "linalg/symmetric_eigen.hpp"
#include "network/tuning.hpp"

namespace jam::inside {
namespace {

class BlockIteration {
 public:
  BlockIteration(const SoftRows &rows, double limit, size_t most)
      : rows_(rows), limit_(limit), most_(most), random_(5, Stream::analysis_start) {}

  SoftestModes run() {
    const size_t motions = rows_.columns > rows_.known ? rows_.columns - rows_.known : 0;
    size_t block = SoftestModesTuning::first_block;
    double last = std::numeric_limits<double>::infinity();
    for (;;) {
      const size_t found = out_.flexes.size();
      if (found >= motions) {
        out_.margin = 0.0;  // no eigenvalue is left that could be a margin
        return out_;
      }
      if (found >= most_) {
        out_.margin = 0.0, out_.complete = false;
        return out_;
      }
      CallScope::report_share();
      refill(std::min(block, motions - found));
      step();
      if (lock() > 0) {
        last = std::numeric_limits<double>::infinity();
        if (x_.empty()) block = std::min(2 * block, SoftestModesTuning::largest_block);
        continue;
      }
      // NaN ends it too
      if (!(value_[0] < limit_) && !(std::fabs(value_[0] - last) > SoftestModesTuning::settled * value_[0])) break;
      last = value_[0];
    }
    out_.margin = value_.empty() ? 0.0 : value_[0];
    return out_;
  }

 private:
  // Component of x orthogonal to symmetries, the flexes found and the first `count` vectors of the block, of unit
  // length. False when nothing is left.
  bool orthonormalise(std::vector<double> &x, size_t count) const {
    for (int twice = 0; twice < 2; ++twice) {
      const double before = std::sqrt(dot(x, x));
      rows_.remove(x.data());
      const auto take_out = [&](const std::vector<double> &q) {
        const double c = dot(q, x);
        for (size_t k = 0; k < x.size(); ++k) x[k] -= c * q[k];
      };
      for (const auto &q : out_.flexes) take_out(q);
      for (size_t b = 0; b < count; ++b) take_out(x_[b]);
      const double length = std::sqrt(dot(x, x));
      if (!(length > 1e-12 * before)) return false;
      for (double &v : x) v /= length;
    }
    return true;
  }
  void refill(size_t block) {
    if (x_.size() > block) x_.resize(block);
    while (x_.size() < block) {
      std::vector<double> fresh(rows_.columns);
      do
        for (double &v : fresh) v = random_.normal();
      while (!orthonormalise(fresh, x_.size()));
      x_.push_back(std::move(fresh));
    }
  }
  // One pass of inverse iteration, then the Ritz vectors of A^T A in the block, ascending.
  void step() {
    const size_t n = rows_.columns, b = x_.size();
    std::vector<double> all(n * b);
    for (size_t k = 0; k < b; ++k)
      std::copy(x_[k].begin(), x_[k].end(), all.begin() + static_cast<std::ptrdiff_t>(k * n));
    rows_.solve(all.data(), static_cast<int>(b));
    for (size_t k = 0; k < b; ++k) {
      std::copy_n(all.begin() + static_cast<std::ptrdiff_t>(k * n), n, x_[k].begin());
      while (!orthonormalise(x_[k], k))
        for (double &v : x_[k]) v = random_.normal();
    }
    Eigen::MatrixXd ax(rows_.rows, b);
    for (size_t k = 0; k < b; ++k) rows_.multiply(x_[k].data(), ax.col(static_cast<Eigen::Index>(k)).data());
    const SymmetricEigen ritz = symmetric_eigen(ax.transpose() * ax);
    std::vector<std::vector<double>> turned(b, std::vector<double>(n, 0.0));
    for (size_t k = 0; k < b; ++k)
      for (size_t q = 0; q < b; ++q) {
        const double c = ritz.vectors(static_cast<Eigen::Index>(q), static_cast<Eigen::Index>(k));
        for (size_t r = 0; r < n; ++r) turned[k][r] += c * x_[q][r];
      }
    x_ = std::move(turned);
    value_.clear();
    std::vector<double> y(rows_.rows);
    for (const auto &x : x_) {  // from A x itself: the Gram matrix loses the digits of small values
      rows_.multiply(x.data(), y.data());
      value_.push_back(dot(y, y));
    }
  }
  // Takes vectors below the limit out of the block once they have converged; they stay orthonormal.
  size_t lock() {
    size_t count = 0;
    std::vector<std::vector<double>> rest;
    std::vector<double> values;
    const auto converged = [&](size_t k) {
      return value_[k] < RoundingTuning::sure * limit_ ||
             (value_[k] < limit_ && k < before_.size() && value_[k] > SoftestModesTuning::converged * before_[k]);
    };
    const std::vector<double> now = value_;
    for (size_t k = 0; k < x_.size(); ++k)
      if (converged(k))
        out_.flexes.push_back(std::move(x_[k])), ++count;
      else
        rest.push_back(std::move(x_[k])), values.push_back(value_[k]);
    x_ = std::move(rest), value_ = std::move(values);
    before_ = count > 0 ? std::vector<double>() : now;
    return count;
  }

  const SoftRows &rows_;
  const double limit_;
  const size_t most_;
  Rng random_;
  SoftestModes out_;
  std::vector<std::vector<double>> x_;
  std::vector<double> value_, before_;
};

}  // namespace

SoftestModes softest_modes(const SoftRows &rows, double limit, size_t most_flexes) {
  return BlockIteration(rows, limit, most_flexes).run();
}

SoftestModes softest_modes(const ConstraintRows &rows, const NormalSolver &solver, double limit, size_t most_flexes) {
  const PartTranslations slides(rows.g);
  SoftestModes out =
      softest_modes({rows.rows(), rows.columns(), static_cast<size_t>(rows.g.symmetries() + slides.count()),
                     [&](const double *x, double *y) { rows.multiply(x, y); },
                     [&](double *x) { rows.g.remove_symmetries(x), slides.remove(x); },
                     [&](double *x, int count) { solver.solve(x, count); }},
                    limit, most_flexes);
  out.slides = slides;
  return out;
}

}  // namespace jam::inside
