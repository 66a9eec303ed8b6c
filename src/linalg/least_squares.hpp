// Small systems of more or fewer equations than unknowns.
#pragma once
#include <vector>

namespace jam::inside {

// The shortest u (d) of those with the least |A u - b|; A (rows, d).
std::vector<double> least_squares(int d, const std::vector<double> &a, const std::vector<double> &b);

}  // namespace jam::inside
