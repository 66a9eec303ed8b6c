// Equal disks order in part while they jam: weak forces, many contacts, flexes. Each verdict on 300 of them is looked
// at again from positions and forces alone, by means that share no code with the library:
//   - overlaps and contacts by all pairs;
//   - no small motion lets the diameters grow: weak duality bounds the gain of every motion from the contact forces;
//   - no motion opens contacts and closes none: a linear program over all closed pairs (Clp).
#include <coin/ClpSimplex.hpp>
#include <coin/CoinPackedMatrix.hpp>

#include <algorithm>
#include <cmath>
#include <memory>
#include <random>
#include <vector>

#include "jam/jam.h"
#include "test.h"

namespace {

constexpr int disks = 300, dim = 2;

struct Closed {
  int i, j;
  double n[dim], gap;  // unit vector from j to i
};

struct Free {
  void operator()(jam_system *s) const { jam_destroy(s); }
};
using System = std::unique_ptr<jam_system, Free>;

// Grown in two stages, as jam-pack does it.
System grown(int64_t seed) {
  DEFAULTS(create, o);
  o.n = disks, o.dim = dim, o.seed = seed;
  jam_system *sys = nullptr;
  assert_int_equal(jam_create(&o, nullptr, &sys), JAM_OK);
  const double rate[] = {1e-2, 3e-3}, pressure[] = {500.0, 1e7};
  for (int k = 0; k < 2; ++k) {
    DEFAULTS(compress, md);
    md.growth_rate = rate[k], md.pressure = pressure[k];
    assert_int_equal(jam_compress(sys, &md, nullptr), JAM_OK);
  }
  return System(sys);
}

// All pairs with a gap below h.
std::vector<Closed> pairs_below(const double *x, double sigma, double h) {
  std::vector<Closed> out;
  for (int i = 0; i < disks; ++i)
    for (int j = i + 1; j < disks; ++j) {
      Closed c{i, j, {}, 0.0};
      double r2 = 0.0;
      for (int a = 0; a < dim; ++a) {
        c.n[a] = x[i * dim + a] - x[j * dim + a];
        c.n[a] -= std::nearbyint(c.n[a]);
        r2 += c.n[a] * c.n[a];
      }
      const double r = std::sqrt(r2);
      for (double &n : c.n) n /= r;
      c.gap = r / sigma - 1.0;
      if (c.gap < h) out.push_back(c);
    }
  return out;
}

// Whether a motion with displacements up to 1 opens closed pairs of `held` disks and closes none. The first of them
// stays. Clp's tolerance lets pairs close by 1e-9, which a weak force turns into a motion up to some hundredths.
bool moves(const std::vector<Closed> &pairs, const std::vector<char> &held) {
  std::vector<int> row, column;
  std::vector<double> value;
  int rows = 0;
  for (const Closed &c : pairs) {
    if (!held[c.i] || !held[c.j]) continue;
    for (int a = 0; a < dim; ++a) {
      row.insert(row.end(), 2, rows), column.push_back(c.i * dim + a), column.push_back(c.j * dim + a);
      value.push_back(c.n[a]), value.push_back(-c.n[a]);
    }
    ++rows;
  }
  const int unknowns = disks * dim, first = static_cast<int>(std::find(held.begin(), held.end(), 1) - held.begin());
  CoinPackedMatrix matrix(true, row.data(), column.data(), value.data(), static_cast<CoinBigIndex>(value.size()));
  matrix.setDimensions(rows, unknowns);
  std::mt19937 random(1);
  std::normal_distribution<double> normal;
  for (int round = 0; round < 2; ++round) {
    std::vector<double> low(unknowns, 0.0), high(unknowns, 0.0), cost(unknowns, 0.0), zero(rows, 0.0),
        endless(rows, COIN_DBL_MAX);
    for (int k = 0; k < unknowns; ++k)
      if (held[k / dim] && k / dim != first) low[k] = -1.0, high[k] = 1.0, cost[k] = normal(random);
    ClpSimplex model;
    model.setLogLevel(0);
    model.loadProblem(matrix, low.data(), high.data(), cost.data(), zero.data(), endless.data());
    model.setPrimalTolerance(1e-9), model.setDualTolerance(1e-9);
    model.dual();
    assert_int_equal(model.status(), 0);
    const double *v = model.getColSolution();
    for (int k = 0; k < unknowns; ++k)
      if (std::fabs(v[k]) > 0.3) return true;
  }
  return false;
}

// Weak duality: with forces y >= 0, sum y = 1, every motion |s| <= bound gains at most sum y gap + bound |S^T y|.
void gains_nothing(jam_system *sys, const double *x, double sigma) {
  std::vector<double> force(4 * disks), balance(disks * dim, 0.0);
  std::vector<int32_t> pair(8 * disks);
  size_t m = 0, two = 0;
  assert_int_equal(jam_forces(sys, force.data(), force.size(), &m), JAM_OK);
  assert_int_equal(jam_contacts(sys, pair.data(), pair.size(), &two), JAM_OK);
  const std::vector<Closed> near = pairs_below(x, sigma, 1e-6);
  double total = 0.0, gain = 0.0, idle = 0.0;
  for (size_t k = 0; k < m; ++k) assert_true(force[k] > 0.0), total += force[k];
  for (size_t k = 0; k < m; ++k) {
    const auto it = std::find_if(near.begin(), near.end(), [&](const Closed &c) {
      return (c.i == pair[2 * k] && c.j == pair[2 * k + 1]) || (c.j == pair[2 * k] && c.i == pair[2 * k + 1]);
    });
    assert_true(it != near.end() && std::fabs(it->gap) < 1e-10);
    gain += force[k] / total * it->gap;
    for (int a = 0; a < dim; ++a) {
      balance[it->i * dim + a] += force[k] / total * it->n[a];
      balance[it->j * dim + a] -= force[k] / total * it->n[a];
    }
  }
  for (const double b : balance) idle += std::fabs(b);
  assert_true(gain + 0.01 * idle < 1e-12);
}

void verdict_holds(int64_t seed) {
  const System sys = grown(seed);
  jam_crunch_report r{};
  r.struct_size = sizeof r;
  const jam_status status = jam_crunch(sys.get(), nullptr, &r);
  const double *x = nullptr, *s = nullptr;
  size_t len = 0;
  assert_int_equal(jam_view(sys.get(), JAM_VIEW_POSITIONS, &x, &len), JAM_OK);
  assert_int_equal(jam_view(sys.get(), JAM_VIEW_DIAMETERS, &s, &len), JAM_OK);
  const std::vector<Closed> closed = pairs_below(x, s[0], 1e-10);
  for (const Closed &c : closed) assert_true(c.gap > -1e-13);
  print_message("seed %d: jammed %d, %s, residual %.1e, contacts %d\n", static_cast<int>(seed), r.jammed,
                jam_stop_string(r.stop_reason), r.force_residual, static_cast<int>(r.contacts));
  gains_nothing(sys.get(), x, s[0]);
  assert_int_equal(status, JAM_OK);
  assert_true(r.jammed);
  assert_true(r.force_residual < 1e-10 && r.flexes == 0);
  std::vector<int32_t> z(disks);
  assert_int_equal(jam_coordination(sys.get(), z.data(), z.size(), &len), JAM_OK);
  std::vector<char> held(disks);
  for (int k = 0; k < disks; ++k) held[k] = z[k] > 0;
  assert_false(moves(closed, held));
  // HiGHS on the pairs closed at this end, 776: 774 of them carry force. A disk between two contacts that are not quite
  // opposite has the other two.
  if (seed == 6) assert_true(std::fabs(r.packing_fraction - 0.877546382558) < 1e-11 && r.contacts == 774);
}

// Seeds 7, 75 and 123 come near saddles without a verdict; the crunch goes on to a packing that is held.
CASE(six_packings) {
  for (const int64_t seed : {1, 2, 6, 7, 75, 123}) verdict_holds(seed);
}

// The check itself: without one disk and those that touch it, the rim of the hole can move.
CASE(the_check_sees_motion) {
  const System sys = grown(2);
  assert_int_equal(jam_crunch(sys.get(), nullptr, nullptr), JAM_OK);
  const double *x = nullptr, *s = nullptr;
  size_t len = 0;
  jam_view(sys.get(), JAM_VIEW_POSITIONS, &x, &len), jam_view(sys.get(), JAM_VIEW_DIAMETERS, &s, &len);
  std::vector<Closed> closed = pairs_below(x, s[0], 1e-10);
  std::vector<int32_t> z(disks);
  jam_coordination(sys.get(), z.data(), z.size(), &len);
  std::vector<char> held(disks);
  for (int k = 0; k < disks; ++k) held[k] = z[k] > 0;
  assert_false(moves(closed, held));
  const int gone = static_cast<int>(std::max_element(z.begin(), z.end()) - z.begin());
  held[gone] = 0;
  for (const Closed &c : closed)
    if (c.i == gone || c.j == gone) held[c.i] = held[c.j] = 0;
  assert_true(moves(closed, held));
}

}  // namespace
