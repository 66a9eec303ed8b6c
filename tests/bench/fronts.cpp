// The fronts of one factorisation with their times on one thread, for task_graph.py. JSON to stdout.
//   fronts [N = 4096]
#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "linalg/blas.hpp"
#include "linalg/block_cholesky.hpp"
#include "linalg/dense_front.hpp"
#include "linalg/tuning.hpp"
#include "neighbour_graphs.hpp"

using namespace jam::inside;

namespace {

constexpr int repeats = 3;  // the least of so many times

double processor_time() {  // other processes do not count
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

template <class F>
double seconds(F &&work) {
  const double t0 = processor_time();
  work();
  return processor_time() - t0;
}

struct Times {
  double panel = std::numeric_limits<double>::infinity(), square = panel;
};

// A front of these sizes with another matrix: dense products take no other time.
Times time_front(size_t rows, size_t columns) {
  const size_t below = rows - columns;
  const int ld = static_cast<int>(rows), width = static_cast<int>(columns);
  std::vector<double> panel(rows * columns), square(below * below);
  const std::vector<double> diagonal(columns, static_cast<double>(rows));
  Workers alone(1);
  Times out;
  for (int k = 0; k < repeats; ++k) {
    std::fill(panel.begin(), panel.end(), 0.5);
    for (size_t c = 0; c < columns; ++c) panel[c * rows + c] = static_cast<double>(rows);
    const auto factor = [&] {
      factor_panel(panel.data(), ld, ld, width, diagonal.data(), PivotRule{1e-16, 0.0}, alone);
    };
    out.panel = std::min(out.panel, seconds(factor));
    const auto multiply = [&] { minus_square(square.data(), ld - width, panel.data() + columns, ld, width, alone); };
    out.square = std::min(out.square, seconds(multiply));
  }
  return out;
}

}  // namespace

int main(int argc, char **argv) {
  const size_t n = argc > 1 ? static_cast<size_t>(std::atoll(argv[1])) : 4096;
  const Points p = relaxed_points(n);
  const Pairs e = pairs_of_degree(p, 6.5);
  std::vector<double> diag, off;
  make_values(p, e, diag, off);
  const BlasThreads one(1);
  BlockCholesky f;
  f.analyse(3, static_cast<int32_t>(n), e.i.data(), e.j.data(), e.i.size());
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < repeats; ++k) least = std::min(least, seconds([&] { f.factorise(diag.data(), off.data()); }));
  const std::vector<BlockCholesky::Front> fronts = f.fronts();
  std::map<std::pair<size_t, size_t>, Times> known;
  constexpr int narrow = SupernodeTuning::narrow;
  std::printf("{\"n\": %zu, \"seconds\": %.6g, \"narrow\": [%d, %.3g], \"product\": %g, \"additions\": %g", n, least,
              narrow, time_front(narrow, narrow).panel, ThreadTuning::product, ThreadTuning::additions);
  std::printf(", \"fronts\": [");
  for (size_t k = 0; k < fronts.size(); ++k) {
    const auto [at, anew] = known.try_emplace({fronts[k].rows, fronts[k].columns});
    if (anew) at->second = time_front(fronts[k].rows, fronts[k].columns);
    std::printf("%s\n[%d, %zu, %zu, %.3g, %.3g]", k ? "," : "", fronts[k].parent, fronts[k].rows, fronts[k].columns,
                at->second.panel, at->second.square);
  }
  std::printf("]}\n");
  return 0;
}
