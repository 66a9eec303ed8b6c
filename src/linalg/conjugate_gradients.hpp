// Conjugate gradients on one matrix K for several right-hand sides, one after the other. The directions of the first
// ones are kept: later ones begin with the solution along them and stay conjugate to them, so that what the
// preconditioner misses is found once (Erhel and Guyomarc'h, SIAM J. Matrix Anal. Appl. 21, 1279 (2000)).
#pragma once
#include <cstddef>
#include <functional>
#include <vector>

namespace jam::inside {

class ConjugateGradients {
 public:
  // out := a symmetric positive definite matrix times in.
  using Product = std::function<void(const double *in, double *out)>;

  // From now on K is another matrix of so many unknowns.
  void forget(size_t unknowns);
  // x := K^-1 b, each as long as the unknowns, until the error is some `accuracy` of x in the norm of K. precondition:
  // M^-1, nearly K^-1. False when that takes more than `most` products with K, or nothing finite came out. As many
  // directions are kept at most.
  bool solve(const double *b, double accuracy, int most, const Product &precondition, const Product &times_k,
             double *x);

 private:
  struct Direction {
    std::vector<double> along, image;  // p, and K p
    double energy = 0.0;               // p . K p
  };

  std::vector<Direction> kept_;
  size_t count_ = 0;  // of kept_, those of this matrix
  Direction now_;
  std::vector<double> residual_, correction_;
};

}  // namespace jam::inside
