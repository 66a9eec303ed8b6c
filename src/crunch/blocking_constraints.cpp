#include "crunch/blocking_constraints.hpp"

#include <algorithm>

namespace jam {
namespace {

// A row is pushed where less than this part of its gap would be left, and let go where more than twice that is.
constexpr double left = 0.1;
// A force grows by at most so many times what it is, and a row gives way to it by a tenth of what it last did at least:
// the first answers of rows that push each other are far off.
constexpr double growth = 10.0, less = 0.1;

}  // namespace

void BlockingConstraints::begin(const Barrier &b, const std::vector<double> &weight, const BarrierStep &x) {
  const size_t rows = b.y.size();
  weight_ = weight;
  base_.resize(rows), compliance_.resize(rows);
  force_.assign(rows, 0.0), change_.assign(rows, 0.0);
  for (size_t k = 0; k < rows; ++k) {
    base_[k] = b.lp.c[k] * (x.y[k] + weight[k] * x.w[k]);
    compliance_[k] = 1.0 / weight[k];  // alone; with the rest of the packing around it a row gives way less
  }
}

bool BlockingConstraints::push(const Barrier &b, const BarrierStep &x, double aim, std::vector<double> &target) {
  bool any = false;
  for (size_t k = 0; k < force_.size(); ++k) {
    const double c = b.lp.c[k], after = b.gap_after(x, k, aim), before = force_[k];
    if (after < left * c) {
      force_[k] += std::min((left * c - after) / (aim * compliance_[k]), growth * (before + b.mu / c));
      any = true;
    } else if (before > 0.0 && after > 2.0 * left * c) {
      force_[k] = std::max(0.0, before + (2.0 * left * c - after) / (aim * compliance_[k]));
    }
    change_[k] = force_[k] - before;
    target[k] = base_[k] + force_[k] * c;
  }
  return any;
}

void BlockingConstraints::learn(const BarrierStep &before, const BarrierStep &after) {
  for (size_t k = 0; k < change_.size(); ++k) {
    if (change_[k] == 0.0) continue;
    const double got = (after.w[k] - before.w[k]) / change_[k];
    compliance_[k] = std::min(1.0 / weight_[k], std::max(got, less * compliance_[k]));
  }
}

}  // namespace jam
