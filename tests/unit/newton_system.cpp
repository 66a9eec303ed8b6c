// The linear system of an interior-point step: its solutions against the unassembled operator.
#include <cmath>
#include <numeric>
#include <random>
#include "test.h"

#include "core/create.hpp"
#include "core/pairs.hpp"
#include "linalg/newton_system.hpp"

using namespace jam::inside;

namespace {

// Rows of a packing with weights over three decades, and images of one pair that share a block where the box is small.
struct Scene {
  PairList pairs;
  std::vector<double> a, weight, box, rhs;
  const double h = 0.7;

  Scene(int dim, int32_t n, double diagonal) {
    jam_create_options o = default_create_options();
    o.n = n, o.dim = dim, o.packing_fraction = dim == 2 ? 0.5 : dim == 3 ? 0.3 : 0.1;
    const Packing p = make_packing(o, nullptr, 0, nullptr, 0);
    pairs = find_pairs(p, 0.4 * p.diameter[0], 1.0);
    std::mt19937_64 random(7);
    std::uniform_real_distribution<double> one(-1.0, 1.0);
    a.resize(pairs.size() * dim), weight.resize(pairs.size()), rhs.resize(p.position.size());
    box.assign(p.position.size(), diagonal);
    for (double &v : a) v = one(random);
    for (size_t k = 0; k < pairs.size(); ++k)
      if (pairs.i[k] == pairs.j[k]) std::fill_n(&a[k * dim], dim, 0.0);
    for (double &v : weight) v = std::pow(10.0, 1.5 * one(random));
    for (double &v : rhs) v = one(random);
  }

  // Left side at (s, g).
  std::vector<double> times(const NewtonSystem &system, const std::vector<double> &s, double g, double *last) const {
    std::vector<double> row(pairs.size()), left(rhs.size());
    system.rows_times(a.data(), s.data(), row.data());
    *last = 0.0;
    for (size_t k = 0; k < row.size(); ++k) row[k] = weight[k] * (row[k] - g), *last -= row[k];
    system.transpose_times(a.data(), row.data(), left.data());
    for (size_t k = 0; k < left.size(); ++k) left[k] += box[k] * s[k];
    return left;
  }
};

void solves(int dim, int32_t n) {
  const Scene scene(dim, n, 1e-3);
  NewtonSystem system;
  system.set_graph(dim, n, scene.pairs, 1);
  assert_true(system.factorise(scene.a.data(), scene.weight.data(), scene.box.data()));
  std::vector<double> s(scene.rhs.size());
  double g = 0.0, last = 0.0, worst = 0.0, scale = std::fabs(scene.h);
  system.solve(scene.rhs.data(), scene.h, s.data(), &g, 4);
  const std::vector<double> left = scene.times(system, s, g, &last);
  for (size_t k = 0; k < left.size(); ++k) {
    worst = std::max(worst, std::fabs(left[k] - scene.rhs[k]));
    scale = std::max(scale, std::fabs(scene.rhs[k]));
  }
  print_message("d %d: %.1e of %.1e\n", dim, std::max(worst, std::fabs(last - scene.h)), scale);
  assert_true(worst < 1e-9 * scale && std::fabs(last - scene.h) < 1e-9 * scale);
}

CASE(residuals_vanish) {
  for (const int dim : {2, 3, 5}) solves(dim, 200);
  solves(3, 4);
}

// With a factor of floats conjugate gradients come as near as asked, in the norm of the matrix; without a product they
// fail.
CASE(floats_come_near) {
  const int32_t n = 200;
  for (const int dim : {2, 3, 5}) {
    const Scene scene(dim, n, 1e-3);
    const double *a = scene.a.data(), *weight = scene.weight.data();
    NewtonSystem system;
    system.set_graph(dim, n, scene.pairs, 1);
    std::vector<double> exact(scene.rhs.size()), s(exact);
    double exact_g = 0.0, g = 0.0, last = 0.0, size = 0.0;
    const auto norm2 = [&](const std::vector<double> &x, double x_g) {
      const std::vector<double> y = scene.times(system, x, x_g, &last);
      return std::inner_product(x.begin(), x.end(), y.begin(), x_g * last);
    };
    assert_true(system.factorise(a, weight, scene.box.data()));
    system.solve(scene.rhs.data(), scene.h, exact.data(), &exact_g, 4);
    size = norm2(exact, exact_g);
    assert_true(system.factorise(a, weight, scene.box.data(), Precision::single));
    for (const double accuracy : {1e-2, 1e-6, 1e-9}) {
      assert_true(system.solve_near(scene.rhs.data(), scene.h, s.data(), &g, accuracy, 20));
      for (size_t k = 0; k < s.size(); ++k) s[k] -= exact[k];
      const double error = std::sqrt(norm2(s, g - exact_g) / size);
      print_message("d %d: %.1e where %.0e was asked\n", dim, error, accuracy);
      assert_true(error < 2.0 * accuracy);
    }
    assert_true(system.factorise(a, weight, scene.box.data(), Precision::single));
    assert_false(system.solve_near(scene.rhs.data(), scene.h, s.data(), &g, 1e-2, 0));
  }
}

// Two discs held apart by rows on both sides, and hardly to their places: floats lose the pivot of their common motion.
// The factor serves all the same. Numbers that are not finite are refused.
CASE(lost_pivots_and_refusals) {
  Packing p;
  p.set_cube(2, 1.0), p.position = {0.2, 0.5, 0.7, 0.5}, p.diameter = {0.1, 0.1}, p.velocity.assign(4, 0.0);
  const PairList pairs = find_pairs(p, 0.45, 1.0);
  assert_int_equal(pairs.size(), 2);
  NewtonSystem system;
  system.set_graph(2, 2, pairs, 1);
  const std::vector<double> a = {1.0, 0.0, -1.0, 0.0}, weight(2, std::nan("")), box(4, 1.0), one(2, 1.0), soft(4, 1e-9);
  const std::vector<double> together = {1.0, 0.0, 1.0, 0.0}, apart = {1.0, 0.0, -1.0, 0.0};
  std::vector<double> exact(4), s(4);
  double exact_g = 0.0, g = 0.0;
  for (const std::vector<double> &rhs : {together, apart}) {
    assert_true(system.factorise(a.data(), one.data(), soft.data()));
    system.solve(rhs.data(), 0.1, exact.data(), &exact_g, 4);
    assert_true(system.factorise(a.data(), one.data(), soft.data(), Precision::single));
    assert_true(system.solve_near(rhs.data(), 0.1, s.data(), &g, 1e-8, 8));
    // The pivot was raised from 2e-9 to 4e-6, so that the error is estimated up to 50 times too small.
    for (size_t k = 0; k < 4; ++k) assert_true(std::fabs(s[k] - exact[k]) < 1e-6 * std::fabs(exact[0]));
    assert_true(std::fabs(g - exact_g) < 1e-6 * std::fabs(exact[0]));
  }
  assert_false(system.factorise(a.data(), weight.data(), box.data()));
  assert_false(system.factorise(a.data(), weight.data(), box.data(), Precision::single));
}

}  // namespace
