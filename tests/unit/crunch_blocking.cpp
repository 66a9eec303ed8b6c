// Forces that push aside the rows which cut steps short: their sizes on rows whose answers are known, on one that no
// force moves, and on the path.
#include <cmath>
#include <cstdlib>
#include "test.h"

#include "crunch/barrier_path.hpp"
#include "crunch/blocking_constraints.hpp"
#include "unit/crunch_scenes.hpp"

using namespace jam;

namespace {

constexpr int most = 12;     // pushes that a step of the path may take
constexpr double aim = 0.8;  // the length up to which rows are to stay open

// Three rows that block, at c - close c after a whole step. A force alone moves each by `share` of what it would if the
// row were by itself, and pulls a little on the one before.
struct Scene {
  Barrier b;
  BarrierStep x;
  std::vector<double> weight, target;
  size_t block[3] = {1, 7, 20};
  double close[3] = {50.0, 300.0, 3.0}, share[3] = {1e-3, 1e-2, 0.5}, pull = 0.01;
  BlockingConstraints blocking;

  Scene() {
    const Packing p = start(40, 3, 0.3, 5);
    b.unit = diameter_mean(p), b.mu = 1e-3;
    b.pairs = find_pairs(p, 0.5 * b.unit, 1.0);
    assert_true(b.measure(p));
    const size_t rows = b.pairs.size();
    x.s.assign(p.position.size(), 0.0), x.w.resize(rows), x.y.assign(rows, 0.0), x.g = 0.0;
    weight.resize(rows), target.resize(rows), b.y.resize(rows);
    for (size_t k = 0; k < rows; ++k)
      b.y[k] = b.mu / b.lp.c[k], weight[k] = b.y[k] / b.lp.c[k], x.w[k] = 0.5 * b.lp.c[k];
    for (int q = 0; q < 3; ++q) x.w[block[q]] = -close[q] * b.lp.c[block[q]];
  }

  double base(size_t k) const { return b.lp.c[k] * weight[k] * first_[k]; }  // of a row that is not pushed
  bool pushed(size_t k) const { return k == block[0] || k == block[1] || k == block[2]; }

  // Pushes until none is needed or a step of the path may not push more; their number.
  int push() {
    first_ = x.w;
    blocking.begin(b, weight, x);
    BarrierStep next = x;
    b.search(x, 1.0);
    for (int pushes = 0; pushes < most; ++pushes) {
      if (!blocking.push(b, x, aim, target)) return pushes;
      double force[3];
      for (int q = 0; q < 3; ++q) force[q] = target[block[q]] / b.lp.c[block[q]] - weight[block[q]] * first_[block[q]];
      for (int q = 0; q < 3; ++q) {
        const size_t k = block[q], other = block[(q + 1) % 3];
        next.w[k] = first_[k] + share[q] * (force[q] / weight[k] -
                                            pull * force[(q + 1) % 3] / std::sqrt(weight[k] * weight[other]));
      }
      blocking.learn(x, next);
      std::swap(x, next);
      b.search(x, 1.0);
    }
    return most;
  }

 private:
  std::vector<double> first_;
};

// All are open at the end of the step, none is thrown open, and no other row feels a force.
void they_give_way(void **) {
  Scene w;
  assert_true(w.push() < most);
  for (size_t k = 0; k < w.weight.size(); ++k) {
    const double after = w.b.gap_after(w.x, k, aim) / w.b.lp.c[k];
    assert_true(w.pushed(k) ? after > 0.0999 && after < 0.5 : w.target[k] == w.base(k));
  }
}

// A row that no force moves stays in the way. The forces on it stay finite, the others open all the same, and the step
// ends before it, with positive gaps.
void one_stays(void **) {
  Scene w;
  w.share[1] = w.pull = 0.0;
  assert_int_equal(w.push(), most);
  for (double t : w.target) assert_true(std::isfinite(t));
  for (const size_t k : {w.block[0], w.block[2]}) assert_true(w.b.gap_after(w.x, k, aim) > 0.0999 * w.b.lp.c[k]);
  const Barrier::Best best = w.b.search(w.x, 1.0);
  assert_true(best.alpha > 0.0 && best.alpha < 1.0 / w.close[1]);
  for (size_t k = 0; k < w.weight.size(); ++k) assert_true(w.b.gap_after(w.x, k, best.alpha) > 0.0);
}

// The path takes them up: some steps take more solves than Gondzio's five correctors are. It arrives all the same.
void path_pushes(void **) {
  int pushed = 0;
  for (int seed = 1; seed <= 6; ++seed) {
    Packing p = near_jamming(start(200, 3, 0.3, seed));
    Monitor monitor;
    std::string log;
    listen(monitor, log, JAM_LOG_DEBUG);
    NewtonSystem system;
    const BarrierPathResult end = follow_barrier_path(p, BarrierPathControl(), system, monitor);
    assert_true(end.reached && closest_pair(p).gap > 0.0);
    const std::string word = "correctors ";
    for (size_t at = log.find(word); at != std::string::npos; at = log.find(word, at + 1))
      pushed += std::atoi(log.c_str() + at + word.size()) > 5;
  }
  assert_true(pushed > 0);
}

}  // namespace

int main() {
  const CMUnitTest tests[] = {cmocka_unit_test(they_give_way), cmocka_unit_test(one_stays),
                              cmocka_unit_test(path_pushes)};
  return cmocka_run_group_tests(tests, nullptr, nullptr);
}
