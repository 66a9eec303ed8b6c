// Nested dissection of libjam beside METIS (where its header is found): fill, flops and time of the order, and the time
// of one factorisation where it is asked for, on contact and neighbour graphs of relaxed points in d = 2, 3, 4. JSON to
// stdout; the chart is made by ordering.py.
//   ordering [largest N = 16384] [smallest N = 256] [largest N that is factorised = 4096] [seeds = 3]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <string>
#include <vector>
#ifdef JAM_BENCH_METIS
#include <metis.h>
#endif
#include "core/rng.hpp"
#include "linalg/blas.hpp"
#include "linalg/block_cholesky.hpp"

using namespace jam::inside;

namespace {

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Points {
  int dim;
  int32_t n;
  std::vector<double> x;  // in the unit box
};

struct Pairs {
  std::vector<int32_t> i, j;
  std::vector<double> r;
};

Pairs pairs_within(const Points &p, double radius) {
  const int cells = std::max(1, std::min(64, static_cast<int>(1.0 / radius)));
  int count = 1, blocks = 1;
  for (int c = 0; c < p.dim; ++c) count *= cells, blocks *= 3;
  std::vector<std::vector<int32_t>> cell(count);
  const auto at = [&](const double *x, int shift) {
    int index = 0;
    for (int c = 0; c < p.dim; ++c, shift /= 3)
      index = index * cells + (std::min(cells - 1, static_cast<int>(x[c] * cells)) + shift % 3 + cells - 1) % cells;
    return index;
  };
  for (int32_t k = 0; k < p.n; ++k) cell[at(&p.x[k * p.dim], (blocks - 1) / 2)].push_back(k);
  Pairs out;
  std::vector<int> seen;
  for (int32_t k = 0; k < p.n; ++k) {
    seen.clear();
    for (int b = 0; b < blocks; ++b) seen.push_back(at(&p.x[k * p.dim], b));
    std::sort(seen.begin(), seen.end());
    seen.erase(std::unique(seen.begin(), seen.end()), seen.end());
    for (const int s : seen)
      for (const int32_t l : cell[s]) {
        if (l <= k) continue;
        double r2 = 0.0;
        for (int c = 0; c < p.dim; ++c) {
          double t = p.x[k * p.dim + c] - p.x[l * p.dim + c];
          t -= std::nearbyint(t);
          r2 += t * t;
        }
        if (r2 < radius * radius) out.i.push_back(k), out.j.push_back(l), out.r.push_back(std::sqrt(r2));
      }
  }
  return out;
}

// Random points pushed apart as soft spheres of a dense packing: the local order of one.
Points relaxed_points(int dim, int32_t n, int64_t seed) {
  static const double volume[] = {0, 0, 3.14159265 / 4, 3.14159265 / 6, 9.8696 / 32},
                      fraction[] = {0, 0, .84, .64, .46};
  Points p{dim, n, std::vector<double>(static_cast<size_t>(dim) * n)};
  Rng rng(seed, Stream::rsa_positions);
  for (double &v : p.x) v = rng.uniform();
  const double sigma = std::pow(fraction[dim] / volume[dim] / n, 1.0 / dim);
  std::vector<double> push(p.x.size());
  for (int sweep = 0; sweep < 40; ++sweep) {
    const Pairs near = pairs_within(p, 1.1 * sigma);
    std::fill(push.begin(), push.end(), 0.0);
    for (size_t k = 0; k < near.i.size(); ++k) {
      const double strength = 0.3 * (1.1 * sigma / (near.r[k] + 1e-15) - 1.0);
      for (int c = 0; c < dim; ++c) {
        double t = p.x[near.i[k] * dim + c] - p.x[near.j[k] * dim + c];
        t -= std::nearbyint(t);
        push[near.i[k] * dim + c] += strength * t, push[near.j[k] * dim + c] -= strength * t;
      }
    }
    for (size_t k = 0; k < p.x.size(); ++k) {
      p.x[k] += std::max(-0.2 * sigma, std::min(0.2 * sigma, push[k]));
      p.x[k] -= std::floor(p.x[k]);
    }
  }
  return p;
}

// The closest pairs, `degree` a particle.
Pairs closest_pairs(const Points &p, double degree) {
  double radius = 1.2 * std::pow(2.0 * degree / p.n, 1.0 / p.dim);
  Pairs all = pairs_within(p, radius);
  const size_t wanted = static_cast<size_t>(degree * p.n);
  while (all.i.size() < wanted) all = pairs_within(p, radius *= 1.1);
  std::vector<double> r = all.r;
  std::nth_element(r.begin(), r.begin() + wanted - 1, r.end());
  Pairs out;
  for (size_t k = 0; k < all.i.size(); ++k)
    if (all.r[k] <= r[wanted - 1]) out.i.push_back(all.i[k]), out.j.push_back(all.j[k]), out.r.push_back(all.r[k]);
  return out;
}

struct Cost {
  double fill = 0.0, flops = 0.0;  // entries of L, sum of their squares by column, one number a particle
};

// Column counts by the rows' subtrees (J. W. H. Liu, SIAM J. Matrix Anal. Appl. 11, 134 (1990)).
Cost cost_of(const Graph &g, const std::vector<int32_t> &order) {
  const int32_t n = g.size();
  std::vector<int32_t> place(n), parent(n, -1), mark(n, -1), count(n, 1);
  for (int32_t k = 0; k < n; ++k) place[order[k]] = k;
  for (int32_t k = 0; k < n; ++k) {
    mark[k] = k;
    for (int32_t e = g.start[order[k]]; e < g.start[order[k] + 1]; ++e)
      for (int32_t i = place[g.adjacency[e]]; i < k && mark[i] != k; i = parent[i]) {
        if (parent[i] < 0) parent[i] = k;
        ++count[i], mark[i] = k;
      }
  }
  Cost c;
  for (const int32_t v : count) c.fill += v, c.flops += static_cast<double>(v) * v;
  return c;
}

#ifdef JAM_BENCH_METIS
std::vector<int32_t> order_by_metis(const Graph &g) {
  idx_t n = g.size(), options[METIS_NOPTIONS];
  std::vector<idx_t> start(g.start.begin(), g.start.end()), adjacency(g.adjacency.begin(), g.adjacency.end());
  std::vector<int32_t> order(n), inverse(n);
  METIS_SetDefaultOptions(options);
  options[METIS_OPTION_SEED] = 1;
  METIS_NodeND(&n, start.data(), adjacency.data(), nullptr, options, order.data(), inverse.data());
  return order;
}
#endif

double factor_seconds(const Points &p, const Pairs &e) {
  const int b = p.dim * p.dim;
  std::vector<double> diag(static_cast<size_t>(b) * p.n, 0.0), off(b * e.i.size());
  for (int32_t i = 0; i < p.n; ++i)
    for (int c = 0; c < p.dim; ++c) diag[i * b + c * (p.dim + 1)] = 1e-2;
  for (size_t k = 0; k < e.i.size(); ++k)
    for (int c = 0; c < p.dim; ++c)
      diag[e.i[k] * b + c * (p.dim + 1)] += 1.0, diag[e.j[k] * b + c * (p.dim + 1)] += 1.0,
          off[k * b + c * (p.dim + 1)] = -1.0;
  BlockCholesky f;
  f.analyse(p.dim, p.n, e.i.data(), e.j.data(), e.i.size());
  std::vector<double> t;
  for (int run = 0; run < 3; ++run) {
    const double t0 = processor_seconds();
    f.factorise(diag.data(), off.data());
    t.push_back(processor_seconds() - t0);
  }
  std::sort(t.begin(), t.end());
  return t[1];
}

}  // namespace

int main(int argc, char **argv) {
  const auto number = [&](int k, int otherwise) { return argc > k ? std::atoi(argv[k]) : otherwise; };
  const int largest = number(1, 16384), smallest = number(2, 256), factored = number(3, 4096), seeds = number(4, 3);
  const BlasThreads one(1);
  bool first = true;
  std::printf("{\"benchmark\": \"ordering\", \"runs\": [");
  for (int dim = 2; dim <= 4; ++dim)
    for (const double degree : {1.0 * dim, 2.2 * dim})  // contacts of an isostatic packing; neighbours in its crunch
      for (int n = smallest; n <= largest; n *= 4)
        for (int seed = 1; seed <= seeds; ++seed) {
          const Points p = relaxed_points(dim, n, seed);
          const Pairs e = closest_pairs(p, degree);
          const Graph g = make_graph(n, e.i.data(), e.j.data(), e.i.size());
          double t0 = processor_seconds();
          const Cost own = cost_of(g, nested_dissection(g));
          t0 = processor_seconds();
          for (int run = 0; run < 3; ++run) nested_dissection(g);
          std::printf(
              "%s\n  {\"dim\": %d, \"degree\": %.1f, \"n\": %d, \"seed\": %d, \"own\": {\"fill\": %.5g, \"flops\": "
              "%.5g, "
              "\"seconds\": %.3g}",
              first ? "" : ",", dim, degree, n, seed, own.fill, own.flops, (processor_seconds() - t0) / 3);
          first = false;
#ifdef JAM_BENCH_METIS
          t0 = processor_seconds();
          const std::vector<int32_t> order = order_by_metis(g);
          const double seconds = processor_seconds() - t0;
          const Cost metis = cost_of(g, order);
          std::printf(
              ", \"metis\": {\"fill\": %.5g, \"flops\": %.5g, \"seconds\": %.3g}, \"fill_ratio\": %.3f, "
              "\"flops_ratio\": %.3f",
              metis.fill, metis.flops, seconds, own.fill / metis.fill, own.flops / metis.flops);
#endif
          if (n <= factored && seed == 1) std::printf(", \"factorise_s\": %.3g", factor_seconds(p, e));
          std::printf("}");
          std::fflush(stdout);
        }
  std::printf("\n]}\n");
  return 0;
}
