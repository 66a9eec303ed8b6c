// Decompressions of packings that are not shown to be jammed: valid in every scene, each farther than the one before,
// counted, repeatable.
#include <algorithm>
#include <cmath>
#include "crunch/phases.hpp"
#include "test.h"

#include "crunch_scenes.hpp"

using namespace jam::inside;

namespace {

struct Crunch {
  explicit Crunch(const Packing &p) : s(p, o, monitor, history, hooks) { monitor.begin(); }
  jam_crunch_options o = default_crunch_options();
  Monitor monitor;
  History history;
  CrunchHooks hooks;
  CrunchState s;
};

Packing mixture(int dim, double delta, int32_t container, int32_t walls) {
  jam_create_options o = default_create_options();
  o.n = 40, o.dim = dim, o.packing_fraction = 0.1, o.seed = 5;
  o.non_additivity = delta, o.container = container, o.walls = walls;
  std::vector<double> diameter(40, 1.0);
  for (int i = 0; i < 40; i += 2) diameter[i] = 1.4;
  return make_packing(o, nullptr, 0, diameter.data(), diameter.size());
}

// Pairs and walls stay open; every sphere moves, by no more than half of what opens beside a partner of its size.
void valid_in_scene(int dim, double delta, int32_t container, int32_t walls) {
  Packing p = mixture(dim, delta, container, walls);
  const double grows = 1.0 + std::min(closest_pair(p).gap, closest_contact(p).gap);
  for (double &diameter : p.diameter) diameter *= grows;  // one pair, or a wall, touches
  Crunch a(p), b(p);
  Packing before = p;
  double moved_before = 0.0;
  for (const double part : Tuning().decompression) {
    assert_true(recompress(a.s) && recompress(b.s));
    const Packing &q = a.s.out.packing;
    assert_true(closest_contact(q).gap > 0.0);
    double most = 0.0;
    for (size_t i = 0; i < q.n(); ++i) {
      assert_true(std::fabs(q.diameter[i] / (before.diameter[i] * (1.0 - part)) - 1.0) < 1e-15);
      double r[JAM_MAX_DIM], square = 0.0;
      for (int c = 0; c < dim; ++c) r[c] = q.position[i * dim + c] - before.position[i * dim + c];
      q.cell.nearest(r);
      for (int c = 0; c < dim; ++c) square += r[c] * r[c];
      assert_true(square > 0.0 && std::sqrt(square) < 0.5 * part * before.diameter[i]);
      most = std::max(most, std::sqrt(square));
    }
    assert_true(most > moved_before);
    moved_before = most;
    const std::vector<double> &x = b.s.out.packing.position;
    assert_memory_equal(q.position.data(), x.data(), x.size() * sizeof(double));
    before = q;
  }
  assert_int_equal(a.history.rows().size(), Tuning().decompression.size());  // displacements of the report see them
  assert_false(recompress(a.s));
  assert_memory_equal(a.s.out.packing.position.data(), before.position.data(), before.position.size() * sizeof(double));
}

CASE(every_scene) {
  for (const int dim : {2, 3, 4}) valid_in_scene(dim, 0.0, JAM_CONTAINER_BRICK, 0);
  for (const double delta : {-0.8, -0.2, 0.5}) valid_in_scene(3, delta, JAM_CONTAINER_BRICK, 0);
  valid_in_scene(3, 0.0, JAM_CONTAINER_BRICK, 4);
  for (const int32_t round : {JAM_CONTAINER_CYLINDER, JAM_CONTAINER_BALL}) valid_in_scene(3, 0.0, round, 0);
}

}  // namespace
