// Jammed or not by Clp and dense algebra alone: an answer that shares no code with the library's test.
#pragma once
#include <Eigen/Dense>
#include <coin/ClpSimplex.hpp>
#include <coin/CoinPackedMatrix.hpp>
#include <random>
#include <set>
#include <vector>

#include "capi/system.hpp"
#include "network/rigidity_matrix.hpp"
#include "start.h"
#include "test.h"

namespace jamtest {

struct Sys {
  jam_system *sys = nullptr;
  ~Sys() { jam_destroy(sys); }
};

// Grown to a pressure, and crunched. Disks are of two sizes.
inline void make(Sys &s, int dim, int64_t n, int64_t seed) {
  DEFAULTS(create, o);
  o.dim = dim, o.n = n, o.seed = seed;
  std::vector<double> sigma(static_cast<size_t>(n), 1.0);
  for (size_t k = 0; k < sigma.size() / 2 && dim == 2; ++k) sigma[k] = 1.4;
  assert_int_equal(create_from(&o, nullptr, 0, sigma.data(), sigma.size(), &s.sys), JAM_OK);
  DEFAULTS(compress, c);
  c.growth_rate = 1e-2, c.pressure = 500.0;
  assert_int_equal(jam_compress(s.sys, &c, nullptr), JAM_OK);
  assert_int_equal(jam_crunch(s.sys, nullptr, nullptr), JAM_OK);
}

struct Oracle {
  std::vector<char> carrying;  // contacts with force in some non-negative state
  bool jammed = false;
  int flexes = 0;  // kernel on the carrying contacts, beyond translations, by a dense factorisation with pivots
};

// A row as pairs (column, value): displacement of the nodes, then with `strain` the upper triangle of a symmetric eps.
inline std::vector<std::vector<std::pair<int, double>>> oracle_rows(const jam::inside::RigidityMatrix &g, bool strain) {
  std::vector<std::vector<std::pair<int, double>>> rows(g.contacts());
  const int d = g.dim;
  for (size_t k = 0; k < g.contacts(); ++k) {
    const double *n = &g.normal[k * d];
    for (int c = 0; c < d && g.a[k] != g.b[k]; ++c) {
      rows[k].push_back({g.a[k] * d + c, n[c]});
      rows[k].push_back({g.b[k] * d + c, -n[c]});
    }
    int at = g.nodes * d;
    for (int r = 0; r < d && strain; ++r)
      for (int c = r; c < d; ++c) rows[k].push_back({at++, (r == c ? 1.0 : 2.0) * n[r] * n[c] * g.distance[k]});
  }
  return rows;
}

inline ClpSimplex oracle_model(const std::vector<int> &r, const std::vector<int> &c, const std::vector<double> &v,
                               const std::vector<double> &low, const std::vector<double> &high,
                               const std::vector<double> &cost, const std::vector<double> &row_low,
                               const std::vector<double> &row_high) {
  CoinPackedMatrix matrix(true, r.data(), c.data(), v.data(), static_cast<CoinBigIndex>(v.size()));
  matrix.setDimensions(static_cast<int>(row_low.size()), static_cast<int>(cost.size()));
  ClpSimplex model;
  model.setLogLevel(0);
  model.loadProblem(matrix, low.data(), high.data(), cost.data(), row_low.data(), row_high.data());
  model.setPrimalTolerance(1e-9);
  model.setDualTolerance(1e-9);
  model.dual();
  return model;
}

inline Oracle ask_oracle(const jam::inside::RigidityMatrix &g, bool strain, int tries = 4) {
  Oracle out;
  const int d = g.dim, m = static_cast<int>(g.contacts()), n = g.nodes * d, q = strain ? d * (d + 1) / 2 : 0;
  const auto rows = oracle_rows(g, strain);
  out.carrying.assign(m, 0);
  if (m == 0) return out;
  // Largest support: maximise sum e, 0 <= e <= 1, e + s = f, s >= 0, with f in balance; the strain's equations say that
  // E^T f is a multiple of the unit matrix (one column more, the multiple).
  std::vector<int> r, c;
  std::vector<double> v;
  for (int k = 0; k < m; ++k)
    for (const auto &[column, value] : rows[k])
      for (const int part : {k, m + k}) r.push_back(column), c.push_back(part), v.push_back(value);
  int columns = 2 * m;
  if (strain) {
    int at = n;
    for (int x = 0; x < d; ++x)
      for (int y = x; y < d; ++y, ++at)
        if (x == y) r.push_back(at), c.push_back(columns), v.push_back(-1.0);
    ++columns;
  }
  std::vector<double> low(columns, 0.0), high(columns, COIN_DBL_MAX), cost(columns, 0.0), zero(n + q, 0.0);
  for (int k = 0; k < m; ++k) high[k] = 1.0, cost[k] = g.a[k] == g.b[k] && !strain ? 0.0 : -1.0;
  const ClpSimplex support = oracle_model(r, c, v, low, high, cost, zero, zero);
  const double *e = support.getColSolution();
  std::set<int> nodes;
  for (int k = 0; k < m; ++k)
    if (cost[k] < 0.0 && e[k] > 0.5) out.carrying[k] = 1, nodes.insert(g.a[k]), nodes.insert(g.b[k]);
  if (nodes.empty()) return out;
  // Rank on the carrying contacts. The trace of eps stays out: it opens or closes all of them.
  std::vector<int> carried;
  for (int k = 0; k < m; ++k)
    if (out.carrying[k]) carried.push_back(k);
  std::vector<int> place(n + q, -1);
  int used = 0;
  for (const int i : nodes)
    for (int x = 0; x < d; ++x) place[i * d + x] = used++;
  for (int x = 0; x < q; ++x) place[n + x] = used++;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(static_cast<Eigen::Index>(carried.size()) + (strain ? 1 : 0), used);
  for (size_t k = 0; k < carried.size(); ++k)
    for (const auto &[column, value] : rows[carried[k]]) a(static_cast<Eigen::Index>(k), place[column]) += value;
  int at = n;
  for (int x = 0; x < d && strain; ++x)
    for (int y = x; y < d; ++y, ++at)
      if (x == y) a(a.rows() - 1, place[at]) = 1.0;
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(a);
  qr.setThreshold(1e-9);
  out.flexes = used - static_cast<int>(qr.rank()) - d;
  // A motion of the carrying spheres that opens contacts or keeps them, the first of them fixed: random directions.
  std::mt19937 random(7);
  std::normal_distribution<double> normal;
  out.jammed = true;
  r.clear(), c.clear(), v.clear();
  for (int k = 0; k < m; ++k)
    for (const auto &[column, value] : rows[k]) r.push_back(k), c.push_back(column), v.push_back(value);
  at = n;
  for (int x = 0; x < d && strain; ++x)
    for (int y = x; y < d; ++y, ++at)
      if (x == y) r.push_back(m), c.push_back(at), v.push_back(-1.0);
  const std::vector<double> open(m + (strain ? 1 : 0), 0.0), endless(open.size(), COIN_DBL_MAX);
  for (int k = 0; k < tries && out.jammed; ++k) {
    std::vector<double> bottom(n + q, -1.0), top(n + q, 1.0), gain(n + q, 0.0);
    for (int x = 0; x < d; ++x) bottom[*nodes.begin() * d + x] = top[*nodes.begin() * d + x] = 0.0;
    for (const int i : nodes)
      for (int x = 0; x < d; ++x) gain[i * d + x] = normal(random);
    for (int x = 0; x < q; ++x) gain[n + x] = normal(random);
    const ClpSimplex motion = oracle_model(r, c, v, bottom, top, gain, open, endless);
    if (-motion.objectiveValue() > 1e-5) out.jammed = false;
  }
  return out;
}

}  // namespace jamtest
