#include "core/limits.hpp"

#include <algorithm>

#include "core/error.hpp"

namespace jam {

void check_range(const char *name, double value, double low, double high) {
  if (!(value >= low && value <= high)) fail(JAM_E_ARGUMENT, "%s is %g, supported are %g..%g", name, value, low, high);
}

void check_dim(int64_t dim) {
  if (dim < 2 || dim > JAM_MAX_DIM)
    fail(JAM_E_DIMENSION, "dim is %lld, supported are 2..%d", static_cast<long long>(dim), JAM_MAX_DIM);
}

void check_n(int64_t n) {
  if (n < 1 || n > limits::n_max) fail(JAM_E_ARGUMENT, "n is %lld, it must be in 1..2^31-1", static_cast<long long>(n));
}

void check_box(double box) { check_range("box", box, limits::box_min, limits::box_max); }

void check_non_additivity(double delta) {
  if (!(delta > -1.0 && delta <= limits::non_additivity_max))
    fail(JAM_E_ARGUMENT, "non_additivity is %g, it must be above -1 and at most %g", delta, limits::non_additivity_max);
}

void check_diameters(const std::vector<double> &diameter, double box) {
  const auto [least, most] = std::minmax_element(diameter.begin(), diameter.end());
  if (!(*least >= limits::diameter_min * box))
    fail(JAM_E_ARGUMENT, "diameters[%td] is %g, at least %g of the box (%g) is supported", least - diameter.begin(),
         *least, limits::diameter_min, box);
  if (!(*most <= limits::size_ratio_max * *least))
    fail(JAM_E_ARGUMENT, "diameters[%td] is %g and diameters[%td] is %g: ratios up to %g are supported",
         most - diameter.begin(), *most, least - diameter.begin(), *least, limits::size_ratio_max);
}

}  // namespace jam
