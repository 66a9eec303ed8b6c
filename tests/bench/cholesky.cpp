// The block Cholesky on neighbour graphs of sphere packings, N = 256 .. 16384, beside sequential MUMPS (when found at
// configure time) and the dense matrix product of this machine; share_of_dgemm compares the least times. JSON to
// stdout.
//   cholesky [largest N = 16384] [seconds per measurement = 1] [all | default (one thread)] [smallest N = 256]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <vector>
#ifdef JAM_BENCH_MUMPS
#include <dmumps_c.h>
#endif
#include "linalg/blas.hpp"
#include "linalg/block_cholesky.hpp"
#include "neighbour_graphs.hpp"

using namespace jam::inside;

namespace {

double now() { return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count(); }

struct Times {
  double median, least;
};

Times summary(std::vector<double> v) {
  std::sort(v.begin(), v.end());
  return {v[v.size() / 2], v[0]};
}

template <class F>
Times timed(double budget, F &&work) {
  std::vector<double> t;
  const double begin = now();
  do {
    const double t0 = now();
    work();
    t.push_back(now() - t0);
  } while (now() - begin < budget ? t.size() < 25 : t.size() < 3 && now() - begin < 10.0 * budget);
  return summary(t);
}

bool read_shared(Points &p) {
  std::ifstream in(JAM_TEST_SHARED "/ls-n1024-d3.dat");
  double dim, n, sigma, v;
  if (!(in >> dim >> n >> sigma)) return false;
  while (p.x.size() < 3 * static_cast<size_t>(n) && in >> v) p.x.push_back(v - std::floor(v));
  return p.x.size() == 3 * static_cast<size_t>(n);
}

double relative_residual(const Points &p, const Pairs &e, const std::vector<double> &diag,
                         const std::vector<double> &off, const std::vector<double> &x, const std::vector<double> &b) {
  std::vector<double> r(b);
  double norm_a = 0.0, norm_x = 0.0, norm_r = 0.0;
  for (size_t i = 0; i < p.size(); ++i)
    for (int a = 0; a < 9; ++a)
      r[3 * i + a / 3] -= diag[9 * i + a] * x[3 * i + a % 3], norm_a = std::max(norm_a, std::fabs(diag[9 * i + a]));
  for (size_t k = 0; k < e.i.size(); ++k)
    for (int a = 0; a < 9; ++a) {
      r[3 * e.i[k] + a / 3] -= off[9 * k + a] * x[3 * e.j[k] + a % 3];
      r[3 * e.j[k] + a % 3] -= off[9 * k + a] * x[3 * e.i[k] + a / 3];
    }
  for (double v : r) norm_r = std::max(norm_r, std::fabs(v));
  for (double v : x) norm_x = std::max(norm_x, std::fabs(v));
  return norm_r / (norm_a * norm_x);
}

double dgemm_rate() {
  const int n = 1000;
  std::vector<double> a(n * n, 1.0), b(n * n, 1.0), c(n * n, 0.0);
  const BlasThreads one(1);
  return 2e-9 * n * n * n /
         timed(1.0, [&] {
           Blas<double>::minus_product(n, n, n, a.data(), n, b.data(), n, Result::written, c.data(), n);
         }).least;
}

#ifdef JAM_BENCH_MUMPS
struct MumpsTimes {
  double analyse = 0, flops = 0;
  Times factorise{}, solve{};
};

MumpsTimes time_mumps(const Points &p, const Pairs &e, const std::vector<double> &diag, const std::vector<double> &off,
                      double budget) {
  std::vector<int> row, column;
  std::vector<double> value;
  const auto add = [&](int r, int c, double v) { row.push_back(r + 1), column.push_back(c + 1), value.push_back(v); };
  for (int i = 0; i < static_cast<int>(p.size()); ++i)
    for (int a = 0; a < 9; ++a)
      if (a % 3 <= a / 3) add(3 * i + a / 3, 3 * i + a % 3, diag[9 * i + a]);
  for (size_t k = 0; k < e.i.size(); ++k)
    for (int a = 0; a < 9; ++a) add(3 * e.j[k] + a % 3, 3 * e.i[k] + a / 3, off[9 * k + a]);  // j > i: lower triangle
  const BlasThreads one(1);
  DMUMPS_STRUC_C m;
  std::memset(&m, 0, sizeof m);
  m.par = 1, m.sym = 1, m.comm_fortran = -987654, m.job = -1;
  dmumps_c(&m);
  m.icntl[0] = m.icntl[1] = m.icntl[2] = -1, m.icntl[3] = 0;
  // libjam's order of the particle graph, so that both eliminate alike; half as much memory again.
  const auto order = nested_dissection(make_graph(static_cast<int32_t>(p.size()), e.i.data(), e.j.data(), e.i.size()));
  std::vector<int> place(3 * order.size());
  for (size_t k = 0; k < place.size(); ++k) place[3 * order[k / 3] + k % 3] = static_cast<int>(k) + 1;
  m.icntl[6] = 1, m.perm_in = place.data(), m.icntl[13] = 50;
  m.n = static_cast<int>(3 * p.size()), m.nnz = static_cast<int64_t>(row.size());
  m.irn = row.data(), m.jcn = column.data(), m.a = value.data();
  const auto call = [&](int job) {
    m.job = job;
    dmumps_c(&m);
    if (m.infog[0] < 0) std::fprintf(stderr, "MUMPS job %d: infog %d %d\n", job, m.infog[0], m.infog[1]);
  };
  std::vector<double> b(3 * p.size(), 1.0);
  m.rhs = b.data(), m.nrhs = 1, m.lrhs = m.n;
  MumpsTimes t;
  const double t0 = now();
  call(1);
  t.analyse = now() - t0;
  t.factorise = timed(budget, [&] { call(2); });
  t.solve = timed(0.2 * budget, [&] { call(3); });
  t.flops = m.rinfog[2];
  call(-2);
  return t;
}
#endif

void report(const char *graph, const Points &p, double degree, double budget, bool all, double rate, bool first) {
  const Pairs e = pairs_of_degree(p, degree);
  std::vector<double> diag, off;
  make_values(p, e, diag, off);
  std::printf("%s\n  {\"graph\": \"%s\", \"n\": %zu, \"pairs_per_particle\": %.2f", first ? "" : ",", graph, p.size(),
              static_cast<double>(e.i.size()) / static_cast<double>(p.size()));
  for (int threads = 1; threads <= (all ? 2 : 1); ++threads) {
    BlockCholesky f;
    const auto analyse = [&] {
      f.analyse(3, static_cast<int32_t>(p.size()), e.i.data(), e.j.data(), e.i.size(), threads);
    };
    const double t_analyse = timed(0.3 * budget, analyse).median;
    int replaced = 0;
    const Times t = timed(budget, [&] { replaced = f.factorise(diag.data(), off.data()); });
    const double t_single = timed(budget, [&] { f.factorise(diag.data(), off.data(), Precision::single); }).median;
    f.factorise(diag.data(), off.data());
    std::vector<double> b(3 * p.size(), 1.0), x;
    const double t_solve = timed(0.2 * budget, [&] { x = b, f.solve(x.data()); }).median;
    std::printf(
        ",\n   \"jam_%d\": {\"analyse_s\": %.3g, \"factorise_s\": %.4g, \"factorise_least_s\": %.4g, "
        "\"factorise_single_s\": %.4g, \"solve_s\": "
        "%.3g, \"flops\": %.4g, \"gflops\": %.3g, "
        "\"share_of_dgemm\": %.3g, \"nonzeros\": %zu, \"bytes\": %zu, \"supernodes\": %zu, \"replaced\": %d, "
        "\"residual\": %.2g, \"solve_gb_per_s\": %.3g}",
        threads, t_analyse, t.median, t.least, t_single, t_solve, f.flops(), 1e-9 * f.flops() / t.median,
        1e-9 * f.flops() / t.least / rate, f.factor_nonzeros(), f.bytes(), f.supernodes(), replaced,
        relative_residual(p, e, diag, off, x, b), 16e-9 * static_cast<double>(f.factor_nonzeros()) / t_solve);
  }
#ifdef JAM_BENCH_MUMPS
  const MumpsTimes m = time_mumps(p, e, diag, off, budget);
  std::printf(
      ",\n   \"mumps\": {\"analyse_s\": %.3g, \"factorise_s\": %.4g, \"factorise_least_s\": %.4g, \"solve_s\": %.3g, "
      "\"flops\": %.4g}",
      m.analyse, m.factorise.median, m.factorise.least, m.solve.median, m.flops);
#endif
  std::printf("}");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char **argv) {
  const size_t largest = argc > 1 ? static_cast<size_t>(std::atoll(argv[1])) : 16384;
  const double budget = argc > 2 ? std::atof(argv[2]) : 1.0;
  const bool all = argc < 4 || std::strcmp(argv[3], "default") != 0;
  const double rate = dgemm_rate();
  std::printf("{\"benchmark\": \"cholesky\", \"dgemm_gflops\": %.4g, \"runs\": [", rate);
  bool first = true;
  const size_t smallest = argc > 4 ? static_cast<size_t>(std::atoll(argv[4])) : 256;
  for (size_t n = smallest; n <= largest; n *= n >= 4096 ? 4 : 2) {
    report("relaxed", relaxed_points(n), 6.5, budget, all, rate, first);
    first = false;
  }
  Points shared;
  if (read_shared(shared)) report("shared file", shared, 6.5, budget, all, rate, first);
  std::printf("\n]}\n");
  return 0;
}
