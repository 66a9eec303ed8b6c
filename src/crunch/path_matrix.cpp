#include "crunch/path_matrix.hpp"

#include <algorithm>
#include <cmath>

#include "lp/working_set.hpp"

namespace jam {
namespace {

// After a step cut short to this part few weights are others. The factor at hand then serves as preconditioner of
// conjugate gradients, if a factorisation is worth at least so many triangular solves, and finds the direction to this
// part of its length in the norm of the matrix, so its decrement to the square of that. What is left of it puts forces
// out of balance, most when mu has just jumped; a step with a factor of its own takes that up.
constexpr double short_part = 0.3, accuracy = 0.1, balanced = 0.3;
constexpr int least_worth = 20;

}  // namespace

void PathMatrix::forget(size_t rows, size_t unknowns) {
  near_.clear();
  weight_.resize(rows);
  diagonal_.resize(unknowns);
}

// Chosen anew for a new list, when a far row came near, and when a fifth could go.
void PathMatrix::choose_near(const Packing &p, const Barrier &b) {
  const std::vector<double> &c = b.lp.c;
  const double slack = far_slack * carrying_slack(c, p.dim, static_cast<int32_t>(p.n()));
  std::vector<char> coupled(c.size(), 0);
  for (const size_t k : near_) coupled[k] = 1;
  size_t wanted = 0, missing = 0;
  for (size_t k = 0; k < c.size(); ++k) wanted += c[k] <= slack, missing += !coupled[k] && c[k] <= 0.5 * slack;
  if (!near_.empty() && missing == 0 && static_cast<double>(wanted) > 0.8 * static_cast<double>(near_.size())) return;
  near_.clear();
  near_pairs_ = PairList();
  for (size_t k = 0; k < c.size(); ++k) {
    if (!(c[k] <= slack)) continue;
    near_.push_back(k);
    near_pairs_.i.push_back(b.pairs.i[k]), near_pairs_.j.push_back(b.pairs.j[k]);
  }
  near_a_.resize(near_.size() * p.dim), near_weight_.resize(near_.size());
  system_.set_graph(p.dim, static_cast<int32_t>(p.n()), near_pairs_, threads_);
}

void PathMatrix::weigh(const Packing &p, const Barrier &b, double proximal) {
  choose_near(p, b);
  const int d = p.dim;
  std::fill(diagonal_.begin(), diagonal_.end(), proximal);
  size_t q = 0;
  for (size_t k = 0; k < b.y.size(); ++k) {
    const double *a = &b.lp.a[k * d];
    weight_[k] = b.y[k] / b.lp.c[k];
    if (q < near_.size() && near_[q] == k) {
      near_weight_[q] = weight_[k];
      std::copy(a, a + d, &near_a_[q++ * d]);
      continue;
    }
    double a1 = 0.0;
    for (int c = 0; c < d; ++c) a1 += std::fabs(a[c]);
    for (int c = 0; c < d; ++c)  // at least a a^T by Gershgorin's circles
      for (const int32_t v : {b.pairs.i[k], b.pairs.j[k]})
        diagonal_[static_cast<size_t>(v) * d + c] += weight_[k] * std::fabs(a[c]) * a1;
  }
}

bool PathMatrix::factorise() {
  following_ = false;
  price_ = 0;
  return system_.factorise(near_a_.data(), near_weight_.data(), diagonal_.data());
}

bool PathMatrix::follow(double part, double balance) {
  const int worth = worth_ > 0 ? worth_ : system_.solves_worth();
  following_ =
      part < short_part && balance < balanced && worth >= least_worth && system_.has_factor() && price_ <= worth / 6;
  if (!following_) return false;
  system_.follow(near_a_.data(), near_weight_.data(), diagonal_.data());
  most_ = worth / 4;
  return true;
}

bool PathMatrix::solve(const double *rhs, double h, double *ds, double *dg) {
  if (following_) return system_.solve_pcg(rhs, h, ds, dg, accuracy, most_);
  system_.solve(rhs, h, ds, dg, 1);
  return true;
}

void PathMatrix::found() {
  if (!following_) return;
  price_ = system_.pcg_solves;
  most_ *= 2;
}

}  // namespace jam
