// Molecular dynamics of spheres of very different sizes, whose lists are made by levels of cells: against the naive
// engine, no overlaps in long growth, archives in the middle.
#include "core/pairs.hpp"
#include "dynamics/event_driven/engine.hpp"
#include "dynamics/event_driven/run.hpp"
#include "naive_dynamics.hpp"

using namespace jam::inside;
using namespace jamtest;

namespace {

struct Scene {
  const char *name;
  int dim, n, large;  // so many are `ratio` times as wide as the others; 0: diameters evenly spaced in their logarithm
  double ratio, fraction;
  std::vector<double> rows;  // of the cell; empty: a cube
};

// With one large sphere the contact distance exceeds half the box, so pairs have several images.
std::vector<Scene> scenes(int disks, int spheres) {
  return {{"disks", 2, disks, 4, 20.0, 0.3, {}},
          {"disks, one large", 2, disks, 1, 30.0, 0.45, {}},
          {"disks of all sizes", 2, disks, 0, 60.0, 0.3, {}},
          {"disks in a long cell", 2, disks, 3, 12.0, 0.3, {1.0, 0.0, 0.3, 2.5}},
          {"spheres", 3, spheres, 3, 8.0, 0.2, {}},
          {"spheres, one large", 3, spheres, 1, 12.0, 0.3, {}},
          {"spheres of all sizes", 3, spheres, 0, 20.0, 0.15, {}},
          {"spheres in a brick", 3, spheres, 0, 9.0, 0.2, {1.0, 0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 2.0}}};
}

Packing packing_of(const Scene &s, int64_t seed) {
  jam_create_options o = default_create_options();
  o.dim = s.dim;
  o.n = s.n;
  o.seed = seed;
  o.packing_fraction = s.fraction;
  std::vector<double> diameters(static_cast<size_t>(s.n), 1.0);
  for (int i = 0; i < s.n; ++i) {
    const double share = s.large > 0 ? (i < s.large ? 1.0 : 0.0) : static_cast<double>(i) / (s.n - 1);
    diameters[static_cast<size_t>(i)] = std::pow(s.ratio, share);
  }
  Packing p = make_packing(o, nullptr, 0, diameters.data(), diameters.size(), s.rows.empty() ? nullptr : s.rows.data());
  draw_velocities(p, seed);
  return p;
}

CASE(agrees_with_naive_engine) {
  for (const Scene &s : scenes(60, 50))
    for (const double rate : {0.0, 0.05}) {
      Packing p = packing_of(s, 3), q = p;
      EngineOptions o;
      o.growth = rate * diameter_mean(p) / p.cell.side();
      naive(q, 80, rate);
      agrees(p, q, o, 80, 1e-7);
    }
}

// A neighbour that a search missed would overlap: all pairs are searched by the pair list, which has cells of its own.
// An archive of the first block goes on with the same bits.
CASE(grows_without_overlap) {
  for (const Scene &s : scenes(500, 500)) {
    Packing p = packing_of(s, 5), q = p;
    EngineOptions o;
    o.growth = 0.02 * diameter_mean(p) / p.cell.side();
    const auto engine = make_engine(p, o);
    Archive out;
    for (int block = 0; block < 3; ++block) {
      assert_int_equal(engine->advance(6 * s.n, begun()), Halt::window);
      engine->write_state(p);
      const double gap = closest_pair(p).gap;
      if (!(gap > -1e-12)) print_error("%s: gap %g\n", s.name, gap);
      assert_true(gap > -1e-12);
      if (block > 0) continue;
      int64_t images = engine->with_images();
      out(images);
      engine->archive(out);
    }
    Archive in(out.bytes());
    const auto again = make_engine(q, in);
    in.end();
    for (int block = 1; block < 3; ++block) assert_int_equal(again->advance(6 * s.n, begun()), Halt::window);
    again->write_state(q);
    assert_memory_equal(p.position.data(), q.position.data(), p.position.size() * sizeof(double));
  }
}

}  // namespace
