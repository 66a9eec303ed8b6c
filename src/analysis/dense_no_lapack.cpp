// A build without LAPACK (JAM_LAPACK): own loops compute full spectra.
#include "analysis/modes.hpp"

namespace jam::inside {

bool dense_eigen(int n, std::vector<double> &a, std::vector<double> &lambda, const std::function<bool(double)> &stop) {
  return dense_eigen_builtin(n, a, lambda, true, stop);
}

}  // namespace jam::inside
