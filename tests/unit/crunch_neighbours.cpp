// The pairs that the barrier path lists: longer reaches for uncovered spheres, and paths of mixtures that need them.
#include "test.h"

#include "crunch/phases.hpp"
#include "unit/crunch_scenes.hpp"

using namespace jam::inside;

namespace {

// A small sphere lies in the hole between 2^d large ones, none within reach. All of them are listed, or off the middle
// those that cover it in every direction. The large spheres are covered and get no other pairs.
CASE(holes_are_covered) {
  for (int dim = 2; dim <= 4; ++dim)
    for (const double off : {0.0, 0.05}) {
      Packing p;
      p.set_cube(dim, 4.0);
      int large = 1;
      for (int c = 0; c < dim; ++c) large *= 4;
      for (int k = 0, rest = 0; k < large; ++k) {
        rest = k;
        for (int c = 0; c < dim; ++c, rest /= 4) p.position.push_back(rest % 4);
      }
      p.diameter.assign(large, 0.97);
      for (int c = 0; c < dim; ++c) p.position.push_back(1.5 + off);
      p.diameter.push_back(0.05);
      p.velocity.assign(p.position.size(), 0.0);
      const PairList near = find_pairs(p, 0.1, 1.0), caged = select_neighbours(p, 0.1);
      size_t corners = 0;
      for (size_t k = 0; k < caged.size(); ++k) corners += caged.j[k] == large;
      const size_t all = 1u << dim;
      assert_true(off == 0.0 ? corners == all : corners > all / 2 && corners <= all);
      size_t had = 0;
      for (size_t k = 0; k < near.size(); ++k) had += near.j[k] == large;
      assert_int_equal(had, 0);
      assert_int_equal(caged.size() - near.size(), corners);
    }
}

// Spheres with nothing around them keep an empty list. A reach of zero grows too; one beyond the farthest stays.
CASE(nothing_within_reach) {
  Packing p;
  p.set_cube(3, 40.0), p.position = {1.0, 1.0, 1.0, 20.0, 20.0, 20.0}, p.diameter = {1.0, 1.0},
                       p.velocity.assign(6, 0.0);
  for (const double reach : {0.0, 0.1, 3.0}) assert_int_equal(select_neighbours(p, reach).size(), 0);
  p.position = {1.0, 1.0, 1.0, 3.0, 1.0, 1.0};  // a gap of 1: within the farthest reach, but not surrounded
  for (const double reach : {0.0, 0.1, 3.0}) assert_int_equal(select_neighbours(p, reach).size(), 1);
}

// Disks of sizes 1 : 10 and spheres of 1 : 4. With the plain reach the path ends at a gap of 2e-4 after 600
// factorisations: rows change as small spheres cross their holes.
CASE(mixtures_arrive) {
  for (const int dim : {2, 3})
    for (int seed = 1; seed <= 4; ++seed) {
      Packing p = near_jamming(start(128, dim, dim == 2 ? 0.25 : 0.19, seed, dim == 2 ? 10.0 : 4.0));
      NewtonSystem system;
      Monitor monitor;
      monitor.begin();
      const BarrierPathResult end = follow_barrier_path(p, BarrierPathControl(), system, monitor);
      assert_true(end.reached && end.gap <= Tuning().path_end(p) && closest_pair(p).gap > 0.0);
    }
}

}  // namespace
