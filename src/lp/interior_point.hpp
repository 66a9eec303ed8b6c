// Primal-dual interior point for the packing LP: Mehrotra's predictor-corrector (SIAM J. Optim. 2, 575 (1992)) with
// Gondzio's multiple centrality correctors (Comput. Optim. Appl. 6, 137 (1996)), since here a triangular solve costs
// a few percent of a factorisation.
#pragma once
#include "lp/mixed_factor.hpp"
#include "lp/packing_lp.hpp"

namespace jam::inside {

// Which rows of a packing LP are worth a place in the normal equations: the working set. A row far from tight has a
// multiplier near zero and only costs fill. It is screened until the iterate comes near it, and every step is cut
// before it crosses one. In an LP screened rows leave the matrix, on the path they keep their diagonal blocks.

// Slack of the last of the rows that may carry force, when sorted. Infinite when there are fewer.
double carrying_slack(const std::vector<double> &c, int dim, int32_t n);

// The split of the rows of an LP: `lp` is an LP of its own on the pairs that it owns.
struct WorkingSet {
  PackingLp lp;
  PairList pairs;                       // without offsets: the rows of `lp` say all
  std::vector<size_t> index, screened;  // rows of the whole LP, both ascending
  double threshold = 0.0;               // slack above which a row started as screened
  // All up to far_slack times carrying_slack or a share of the step bound.
  void choose(const PackingLp &whole);
  // Rows k with take[k] join the working set.
  void join(const PackingLp &whole, const std::vector<char> &take);

 private:
  void gather(const PackingLp &whole, const std::vector<char> &taken);
};

struct IpmControl {
  double tolerance = 1e-15;     // on the sum of complementarity products, which is the duality gap in units of Gamma
  double early_fraction = 0.0;  // > 0: enough when that sum is below this fraction of the gain g (an early LP)
  int correctors = InteriorPointTuning::max_correctors;
  int threads = 1;
  // Of the diagonal that holds translations, over the mean weight. 0: spheres that their contacts hold softly, by weak
  // forces, move freely; translations keep to the bounds.
  double ridge = translation_ground;
  // One a row, of an LP with the same carrying rows: a warm start (0: not known). NULL: cold.
  const std::vector<double> *multipliers = nullptr;
};

class InteriorPoint {
 public:
  // Without `single` all factors are doubles.
  explicit InteriorPoint(NewtonSystem &system, const SinglePrecision &single = {})
      : system_(system), factor_(system, single) {}
  // Gives system the graph of the rows that it needs. The answer carries `solved` when the tolerances were met or when
  // rounding ended it with a gap near the tolerance. monitor may be NULL.
  LpSolution solve(const PackingLp &lp, const IpmControl &control, Monitor *monitor = nullptr);

 private:
  struct Direction {
    std::vector<double> s, y, w, zu, zv;
    double g = 0.0;
    void resize(size_t rows, size_t unknowns);
    void add(const Direction &other);
  };
  struct Steps {
    double primal, dual;
  };
  void start();
  double first_point();
  void residuals();
  double complementarity() const;
  bool converged() const;
  LpSolution answer() const;
  void weights();
  // Solves for targets rc (rows) and rcu, rcv (bounds); `full`: with the primal and dual residuals; only the
  // direction that is followed in the end is worth a step of refinement. False when no factor came out.
  bool direction(const std::vector<double> &rc, const std::vector<double> &rcu, const std::vector<double> &rcv,
                 bool full, int refine, Direction &out);
  Steps longest(const Direction &d) const;
  double mu_after(const Direction &d, const Steps &a) const;
  bool predictor_corrector(Direction &d);
  void centrality_correctors(Direction &d, double mu_target);
  void move(const Direction &d, const Steps &a);
  // Screened rows are outside the normal equations: the step leaves part of their slack, and one that comes near
  // joins.
  double screened_row(size_t k, const std::vector<double> &s) const;
  void update_screened();
  double longest_screened(const Direction &d, double wanted);
  bool admit_screened();

  NewtonSystem &system_;
  MixedFactor factor_;
  const PackingLp *lp_ = nullptr;  // the working set of *whole_
  const PackingLp *whole_ = nullptr;
  WorkingSet split_;
  IpmControl control_;
  bool box_ = false;
  size_t rows_ = 0, unknowns_ = 0;
  double g_ = 0.0, rg_ = 0.0, dual_norm_ = 0.0, gap_scale_ = 1.0;
  std::vector<double> s_, y_, w_, u_, v_, zu_, zv_;
  std::vector<double> rd_, rp_, weight_, diagonal_, rhs_, row_, targets_, targets_u_, targets_v_;
  std::vector<double> screened_w_;
  std::vector<size_t> crossed_;  // screened rows that cut more than half of the last step
  Direction main_, extra_, trial_;
};

}  // namespace jam::inside
