// Checks of options. Each throws JAM_E_ARGUMENT with the option's name and value.
#pragma once
#include <cmath>
#include <cstdint>

#include "core/error.hpp"
#include "core/limits.hpp"

namespace jam::inside {

// NaN is refused by all.
inline void check_positive(double value, const char *name) {
  if (!(value > 0.0)) fail(JAM_E_ARGUMENT, "%s is %g, it must be positive", name, value);
}
inline void check_positive_finite(double value, const char *name) {
  if (!(value > 0.0) || std::isinf(value))
    fail(JAM_E_ARGUMENT, "%s is %g, it must be positive and finite", name, value);
}
inline void check_not_negative(double value, const char *name) {
  if (!(value >= 0.0)) fail(JAM_E_ARGUMENT, "%s is %g, it must be >= 0", name, value);
}
inline void check_at_least(int64_t value, int64_t least, const char *name) {
  if (value < least)
    fail(JAM_E_ARGUMENT, "%s is %lld, it must be at least %lld", name, static_cast<long long>(value),
         static_cast<long long>(least));
}
inline void check_flag(int32_t value, const char *name) {
  if (value != 0 && value != 1) fail(JAM_E_ARGUMENT, "%s is %d, it must be 0 or 1", name, value);
}
inline void check_threads(int32_t threads) {
  if (threads < 1 || threads > limits::threads_max)
    fail(JAM_E_ARGUMENT, "threads is %d, it must be 1 .. %d", threads, limits::threads_max);
}
// Values of an enum follow each other from first to last; `type` is its name in jam.h.
inline void check_enum(int32_t value, int32_t first, int32_t last, const char *name, const char *type) {
  if (value < first || value > last) fail(JAM_E_ARGUMENT, "%s is %d, not a %s", name, value, type);
}

}  // namespace jam::inside
