#include "core/bytes.hpp"

#include <cmath>
#include <cstdio>

namespace jam::inside {

std::string bytes_text(double bytes) {
  static constexpr const char *units[] = {"bytes", "kB", "MB", "GB", "TB"};
  int unit = 0;
  for (; std::round(bytes) > 999 && unit < 4; ++unit) bytes /= 1000;  // three digits make 1000 of 999.5
  char text[40];
  std::snprintf(text, sizeof text, "%.3g %s", bytes, units[unit]);
  return text;
}

}  // namespace jam::inside
