// Dynamics from lattices. Their spheres stand at the edges of the engine's cells and in rows along the axes, and may
// all have events at time zero. The engine must go on while there is an event, and miss no neighbour.
#include <algorithm>
#include <cmath>
#include <vector>

#include "core/rng.hpp"
#include "dynamics/event_driven/engine.hpp"
#include "dynamics/event_driven/run.hpp"
#include "naive_dynamics.hpp"

using namespace jam::inside;
using namespace jamtest;

namespace {

struct Crystal {
  const char *name;
  int dim;
  std::vector<std::vector<double>> basis;  // in edges of the cell
  std::vector<double> edges;               // of a brick; all 1: a cube
};

// All points of halves with an even number of them: D_n, which is fcc in d = 3.
std::vector<std::vector<double>> even_halves(int d) {
  std::vector<std::vector<double>> basis;
  for (int bits = 0; bits < 1 << d; ++bits) {
    if (__builtin_popcount(static_cast<unsigned>(bits)) % 2) continue;
    basis.emplace_back();
    for (int c = 0; c < d; ++c) basis.back().push_back(bits >> c & 1 ? 0.5 : 0.0);
  }
  return basis;
}

std::vector<Crystal> crystals() {
  std::vector<Crystal> all;
  const std::vector<double> cube(8, 1.0);
  for (int d = 2; d <= 6; ++d) {
    all.push_back({"simple cubic", d, {std::vector<double>(d, 0.0)}, cube});
    all.push_back({"body centred", d, {std::vector<double>(d, 0.0), std::vector<double>(d, 0.5)}, cube});
    if (d > 2 && d < 6) all.push_back({"face centred, D_d", d, even_halves(d), cube});
  }
  std::vector<std::vector<double>> diamond = even_halves(3);
  for (int k = 0; k < 4; ++k) {
    diamond.push_back(diamond[k]);
    for (double &x : diamond.back()) x += 0.25;
  }
  all.push_back({"diamond", 3, diamond, cube});
  const double s3 = std::sqrt(3.0);
  all.push_back({"triangular", 2, {{0, 0}, {0.5, 0.5}}, {1.0, s3}});
  all.push_back({"honeycomb", 2, {{0, 0}, {0.5, 0.5}, {0.0, 1.0 / 3.0}, {0.5, 5.0 / 6.0}}, {s3, 3.0}});
  all.push_back({"hcp",
                 3,
                 {{0, 0, 0}, {0.5, 0.5, 0}, {0.5, 5.0 / 6.0, 0.5}, {0, 1.0 / 3.0, 0.5}},
                 {1.0, s3, std::sqrt(8.0 / 3.0)}});
  return all;
}

// m cells along each axis; diameters are `part` of contact; noise in units of the box.
Packing crystal(const Crystal &l, int m, double part, double noise) {
  Packing p;
  const int d = l.dim;
  bool cube = true;
  double volume = 1.0;
  for (int c = 0; c < d; ++c) cube = cube && l.edges[c] == 1.0, volume *= l.edges[c];
  std::vector<double> rows(d * d, 0.0);
  for (int c = 0; c < d; ++c) rows[c * d + c] = l.edges[c] / std::pow(volume, 1.0 / d);
  p.set_cube(d, 1.0);
  if (!cube) p.cell = Cell::from_triangle(d, rows.data());
  p.seed = 3;
  int64_t cells = 1;
  for (int c = 0; c < d; ++c) cells *= m;
  Rng draw(11, Stream::velocities, 5000000);
  for (int64_t k = 0; k < cells; ++k)
    for (const std::vector<double> &at : l.basis) {
      int64_t rest = k;
      for (int c = 0; c < d; ++c, rest /= m) {
        const double s = (static_cast<double>(rest % m) + at[c]) / m;
        p.position.push_back(s * p.cell.edge(c) + noise * draw.normal());
      }
    }
  const size_t n = p.position.size() / d;
  p.diameter.assign(n, 1.0);
  wrap_positions(p);
  double contact = p.cell.shortest();
  for (size_t j = 1; j < n; ++j) {  // all spheres of a lattice have the same surroundings, but for the basis
    Cell::Vector r{};
    for (size_t i = 0; i < std::min(j, l.basis.size()); ++i) {
      for (int c = 0; c < d; ++c) r[c] = p.position[i * d + c] - p.position[j * d + c];
      p.cell.images(r.data(), contact, [&](const double *shift) {
        double r2 = 0.0;
        for (int c = 0; c < d; ++c) r2 += (r[c] + shift[c]) * (r[c] + shift[c]);
        contact = std::min(contact, std::sqrt(r2));
      });
    }
  }
  contact -= 20.0 * noise;
  p.diameter.assign(n, part * contact);
  for (size_t k = 0; k < n * d; ++k) p.velocity.push_back(draw.normal());
  for (int c = 0; c < d; ++c) {
    double mean = 0.0;
    for (size_t i = 0; i < n; ++i) mean += p.velocity[i * d + c] / static_cast<double>(n);
    for (size_t i = 0; i < n; ++i) p.velocity[i * d + c] -= mean;
  }
  p.has_velocity = true;
  return p;
}

// Cells a side for at most `most` spheres.
int side_for(const Crystal &l, double most) {
  return std::max(1, static_cast<int>(std::floor(std::pow(most / static_cast<double>(l.basis.size()), 1.0 / l.dim))));
}

// Every lattice, density, size, both kinds of lists, with growth and without, exact and with noise.
CASE(never_stalls_while_an_event_exists) {
  int stalled = 0, runs = 0;
  for (const Crystal &l : crystals())
    for (double most : {8.0, 150.0})
      for (double part : {0.05, 0.3, 0.6, 0.9, 0.999})
        for (double noise : {0.0, 1e-12, 1e-6})
          for (double growth : {0.0, 1e-2})
            for (int64_t cells : {-1, 0, 1}) {
              const Packing p = crystal(l, side_for(l, most), part, noise * part);
              if (p.n() < 2 || (most > 100.0 && noise > 0.0)) continue;
              EngineOptions o;
              o.growth = growth;
              o.cells = cells;
              const auto engine = make_engine(p, o);
              Halt halt = Halt::time;  // the calendar is sorted again after 8 N + 64 events, then more often
              for (double end = 0.02; (halt == Halt::time || halt == Halt::window) &&
                                      engine->sums.events < 30 * static_cast<int64_t>(p.n()) + 500;
                   end += 0.02) {
                engine->set_time_limit(end - engine->elapsed());
                halt = engine->advance(3000, begun());
              }
              Packing end = p;
              engine->write_state(end);
              const bool apart = closest_pair(end).gap > -1e-12;
              // Two spheres may grow until they touch their own images.
              const bool good = apart && (halt == Halt::time || halt == Halt::window || halt == Halt::needs_images ||
                                          (growth > 0.0 && halt == Halt::box_full));
              ++runs, stalled += !good;
              if (!good && stalled < 20)
                print_error("%s d=%d N=%zu part %g noise %g growth %g cells %d: apart %d, halt %d after %lld events\n",
                            l.name, l.dim, p.n(), part, noise, growth, static_cast<int>(cells), apart,
                            static_cast<int>(halt), static_cast<long long>(engine->sums.events));
            }
  print_message("%d runs, %d stopped before their collisions or overlap\n", runs, stalled);
  assert_int_equal(stalled, 0);
}

// Two small spheres meet once in 1e5 boxes, which are 1e6 events; two that move as one never meet.
CASE(a_rare_collision_is_waited_for) {
  Packing p = random_packing(3, 2, 0.001, 1.0, 4);
  p.diameter.assign(2, 2e-3);
  EngineOptions o;
  auto engine = make_engine(p, o);
  assert_int_equal(engine->advance(3, begun()), Halt::window);
  print_message("3 collisions in %lld events\n", static_cast<long long>(engine->sums.events));
  for (int c = 0; c < 3; ++c) p.velocity[3 + c] = p.velocity[c];
  engine = make_engine(p, o);
  assert_int_equal(engine->advance(3, begun()), Halt::stalled);
}

// A state of no motion has no event: that alone is stalled.
CASE(rest_is_stalled) {
  for (const Crystal &l : crystals()) {
    Packing p = crystal(l, 2, 0.5, 0.0);
    std::fill(p.velocity.begin(), p.velocity.end(), 0.0);
    EngineOptions o;
    const auto engine = make_engine(p, o);
    assert_int_equal(engine->advance(10, begun()), Halt::stalled);
  }
}

}  // namespace
