#include "network/force_balance.hpp"
#include "core/double_double.hpp"
#include "core/pair_rule.hpp"

#include <algorithm>
#include <cmath>

namespace jam::inside {

std::vector<double> relative_rows(const Packing &p, const ContactNetwork &net) {
  const double unit = diameter_mean(p);
  std::vector<double> a(net.vector);
  for (size_t k = 0; k < net.size(); ++k) {
    const double scale = unit / contact_distance(p, net.pairs.i[k], net.pairs.j[k]);
    for (int c = 0; c < p.dim; ++c) a[k * p.dim + c] *= scale;
  }
  return a;
}

void scale_to_mean(ContactNetwork &net) {
  double mean = 0.0;
  for (const double f : net.force) mean += std::fabs(f) / static_cast<double>(net.size());
  for (double &f : net.force) f /= mean;
  net.force_scale *= mean;
}

bool pushes_only(const ContactNetwork &net) {
  return std::all_of(net.force.begin(), net.force.end(), [](double f) { return f > 0.0; });
}

GapRows::GapRows(const ContactNetwork &net, int dim, const std::vector<double> &a, double ground, NewtonSystem &system)
    : system_(system), pairs_(net.pairs), d_(dim), a_(a), weight_(net.size(), 1.0), row_(net.size()) {
  for (const int32_t z : net.coordination) diagonal_.insert(diagonal_.end(), dim, z > 0 ? ground : 1.0);
  rhs_.resize(diagonal_.size());
}

Motion GapRows::towards(const std::vector<double> &wanted, std::vector<double> &rows) {
  Motion sum, step;
  sum.s.assign(rhs_.size(), 0.0), step.s.resize(rhs_.size());
  rows.assign(wanted.size(), 0.0);
  for (int round = 0; round < 2; ++round) {
    double h = 0.0;
    for (size_t k = 0; k < row_.size(); ++k) row_[k] = wanted[k] - rows[k], h -= row_[k];
    system_.transpose_times(a_.data(), row_.data(), rhs_.data());
    system_.solve(rhs_.data(), h, step.s.data(), &step.g, 0);
    for (size_t k = 0; k < sum.s.size(); ++k) sum.s[k] += step.s[k];
    sum.g += step.g;
    system_.rows_times(a_.data(), sum.s.data(), rows.data());
    for (double &v : rows) v -= sum.g;
  }
  return sum;
}

void GapRows::balance(std::vector<double> &y) {
  // In double the residuals of a converged packing are rounding of these sums alone.
  std::vector<DoubleDouble> z(y.begin(), y.end()), unbalanced(rhs_.size());
  for (int round = 0; round < 4; ++round) {
    std::fill(unbalanced.begin(), unbalanced.end(), 0.0);
    for (size_t k = 0; k < z.size(); ++k)
      for (int c = 0; c < d_; ++c) {
        const DoubleDouble v = z[k] * a_[k * d_ + c];
        DoubleDouble &on_i = unbalanced[static_cast<size_t>(pairs_.i[k]) * d_ + c];
        on_i = on_i + v;
        if (pairs_.wall(k)) continue;
        DoubleDouble &on_j = unbalanced[static_cast<size_t>(pairs_.j[k]) * d_ + c];
        on_j = on_j - v;
      }
    for (size_t k = 0; k < rhs_.size(); ++k) rhs_[k] = static_cast<double>(unbalanced[k]);
    system_.cholesky().solve(rhs_.data());
    system_.rows_times(a_.data(), rhs_.data(), row_.data());
    for (size_t k = 0; k < z.size(); ++k) z[k] = z[k] - two_product(weight_[k], row_[k]);
  }
  for (size_t k = 0; k < y.size(); ++k) y[k] = static_cast<double>(z[k]);
}

}  // namespace jam::inside
