// Directions of the barrier path from factors in single and in double precision: processor time of one factorisation
// and one solve against the error of the direction in the norm of the matrix, for weights over so many decades. The
// reference is a factor in doubles with refinement. JSON to stdout.
//   single_precision [N = 4096] [runs = 3]
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <functional>

#include "linalg/newton_system.hpp"
#include "neighbour_graphs.hpp"

using namespace jam::inside;

namespace {

double processor_seconds() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

struct Direction {
  std::vector<double> s;
  double g = 0.0;
};

class Case {
 public:
  Case(const Points &p, const Pairs &e, double decades) : a_(3 * e.i.size()), weight_(e.i.size()) {
    pairs_.i = e.i, pairs_.j = e.j;
    Rng rng(7, Stream::velocities);
    for (size_t k = 0; k < weight_.size(); ++k) {
      double r2 = 0.0;
      for (size_t c = 0; c < 3; ++c) {
        double &t = a_[3 * k + c];
        t = p.x[3 * e.i[k] + c] - p.x[3 * e.j[k] + c];
        t -= p.box * std::nearbyint(t / p.box);
        r2 += t * t;
      }
      for (size_t c = 0; c < 3; ++c) a_[3 * k + c] /= std::sqrt(r2);
      weight_[k] = std::pow(10.0, decades * (rng.uniform() - 1.0));  // the largest are those of closed gaps
    }
    // As small as the least weight: rattlers and soft regions hang on it.
    box_.assign(p.x.size(), std::pow(10.0, -decades)), rhs_.resize(p.x.size());
    for (double &v : rhs_) v = rng.uniform() - 0.5;
    system_.set_graph(3, static_cast<int32_t>(p.size()), pairs_, 1);
    factorise(Precision::full);
    system_.solve(rhs_.data(), 1.0, start(exact_), &exact_.g, 10);
  }

  bool factorise(Precision precision) { return system_.factorise(a_.data(), weight_.data(), box_.data(), precision); }
  void solve(Direction &x, int refine) { system_.solve(rhs_.data(), 1.0, start(x), &x.g, refine); }
  bool solve_near(Direction &x, double accuracy) {
    return system_.solve_near(rhs_.data(), 1.0, start(x), &x.g, accuracy, 60);
  }

  double error(const Direction &x) const {
    Direction off = exact_;
    for (size_t k = 0; k < off.s.size(); ++k) off.s[k] -= x.s[k];
    off.g -= x.g;
    return std::sqrt(norm2(off) / norm2(exact_));
  }

 private:
  double *start(Direction &x) const {
    x.s.resize(box_.size());
    return x.s.data();
  }
  double norm2(const Direction &x) const {
    std::vector<double> rows(weight_.size());
    system_.rows_times(a_.data(), x.s.data(), rows.data());
    double sum = 0.0;
    for (size_t k = 0; k < rows.size(); ++k) sum += weight_[k] * (rows[k] - x.g) * (rows[k] - x.g);
    for (size_t k = 0; k < box_.size(); ++k) sum += box_[k] * x.s[k] * x.s[k];
    return sum;
  }

  PairList pairs_;
  std::vector<double> a_, weight_, box_, rhs_;
  NewtonSystem system_;
  Direction exact_;
};

struct Point {
  bool found = false;
  double seconds = 0.0, error = 0.0;
};

Point measured(const Case &c, int runs, const std::function<bool(Direction &)> &work) {
  std::vector<double> seconds;
  Point out;
  Direction x;
  for (int run = 0; run < runs; ++run) {
    const double begin = processor_seconds();
    out.found = work(x);
    seconds.push_back(processor_seconds() - begin);
  }
  std::sort(seconds.begin(), seconds.end());
  out.seconds = seconds[seconds.size() / 2];
  out.error = out.found ? c.error(x) : 0.0;
  return out;
}

void print(const char *precision, double asked, const Point &p, bool last) {
  std::printf("    {\"precision\": \"%s\", \"asked\": %g, \"found\": %s, \"seconds\": %.4g, \"error\": %.3g}%s\n",
              precision, asked, p.found ? "true" : "false", p.seconds, p.error, last ? "" : ",");
  std::fflush(stdout);
}

}  // namespace

int main(int argc, char **argv) {
  const size_t n = argc > 1 ? static_cast<size_t>(std::atoll(argv[1])) : 4096;
  const int runs = argc > 2 ? std::atoi(argv[2]) : 3;
  const Points p = relaxed_points(n);
  const Pairs e = pairs_of_degree(p, 6.5);
  std::printf("{\"benchmark\": \"single_precision\", \"n\": %zu, \"cases\": [\n", n);
  const std::vector<double> decades = {3, 6, 9, 12, 15};
  for (const double spread : decades) {
    Case c(p, e, spread);
    std::printf("  {\"decades\": %g, \"points\": [\n", spread);
    for (int refine = 0; refine <= 1; ++refine)
      print("double", 0.0,
            measured(c, runs, [&](Direction &x) { return c.factorise(Precision::full) && (c.solve(x, refine), true); }),
            false);
    for (int digits = 1; digits <= 12; ++digits) {
      const double asked = std::pow(10.0, -digits);
      print("single", asked,
            measured(c, runs, [&](Direction &x) { return c.factorise(Precision::single) && c.solve_near(x, asked); }),
            digits == 12);
    }
    std::printf("  ]}%s\n", spread == decades.back() ? "" : ",");
  }
  std::printf("]}\n");
  return 0;
}
