// The linear system of an interior-point step: its solutions against the unassembled operator.
#include <cmath>
#include <random>
#include "test.h"

#include "core/create.hpp"
#include "core/pairs.hpp"
#include "lp/newton_system.hpp"

using namespace jam;

namespace {

// Rows of a packing with weights over three decades, and images of one pair that share a block where the box is small.
void solves(int dim, int32_t n) {
  jam_create_options o = default_create_options();
  o.n = n, o.dim = dim, o.packing_fraction = dim == 2 ? 0.5 : dim == 3 ? 0.3 : 0.1;
  const Packing p = make_packing(o, nullptr, 0, nullptr, 0);
  const PairList pairs = find_pairs(p, 0.4 * p.diameter[0], 1.0);
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> one(-1.0, 1.0);
  std::vector<double> a(pairs.size() * dim), weight(pairs.size()), box(p.position.size(), 1e-3), rhs(p.position.size());
  for (double &v : a) v = one(random);
  for (size_t k = 0; k < pairs.size(); ++k)
    if (pairs.i[k] == pairs.j[k]) std::fill_n(&a[k * dim], dim, 0.0);
  for (double &v : weight) v = std::pow(10.0, 1.5 * one(random));
  for (double &v : rhs) v = one(random);
  const double h = 0.7;
  NewtonSystem system;
  system.set_graph(dim, n, pairs, 1);
  assert_true(system.factorise(a.data(), weight.data(), box.data()));
  std::vector<double> s(rhs.size()), row(pairs.size()), left(rhs.size());
  double g = 0.0;
  system.solve(rhs.data(), h, s.data(), &g, 4);
  system.rows_times(a.data(), s.data(), row.data());
  double last = 0.0, worst = 0.0, scale = std::fabs(h);
  for (size_t k = 0; k < row.size(); ++k) row[k] = weight[k] * (row[k] - g), last -= row[k];
  system.transpose_times(a.data(), row.data(), left.data());
  for (size_t k = 0; k < left.size(); ++k) {
    worst = std::max(worst, std::fabs(left[k] + box[k] * s[k] - rhs[k]));
    scale = std::max(scale, std::fabs(rhs[k]));
  }
  print_message("d %d: %.1e of %.1e\n", dim, std::max(worst, std::fabs(last - h)), scale);
  assert_true(worst < 1e-9 * scale && std::fabs(last - h) < 1e-9 * scale);
}

void residuals_vanish(void **) {
  for (const int dim : {2, 3, 5}) solves(dim, 200);
  solves(3, 4);
}

// Numbers that are not finite are refused.
void not_finite(void **) {
  Packing p;
  p.set_cube(2, 1.0), p.position = {0.2, 0.5, 0.4, 0.5}, p.diameter = {0.1, 0.1}, p.velocity.assign(4, 0.0);
  const PairList pairs = find_pairs(p, 0.2, 1.0);
  assert_int_equal(pairs.size(), 1);
  NewtonSystem system;
  system.set_graph(2, 2, pairs, 1);
  const std::vector<double> a = {1.0, 0.0}, weight = {std::nan("")}, box(4, 1.0);
  assert_false(system.factorise(a.data(), weight.data(), box.data()));
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(residuals_vanish), cmocka_unit_test(not_finite)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
