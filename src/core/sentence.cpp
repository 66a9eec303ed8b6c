#include "core/error.hpp"

#include <cmath>
#include <cstdarg>
#include <cstdio>

namespace jam::inside {

std::string sentence(const char *format, ...) {
  va_list args, again;
  va_start(args, format);
  va_copy(again, args);
  std::string text(static_cast<size_t>(std::vsnprintf(nullptr, 0, format, args)), '\0');
  va_end(args);
  std::vsnprintf(&text[0], text.size() + 1, format, again);
  va_end(again);
  return text;
}

std::string bytes_text(double bytes) {
  static constexpr const char *units[] = {"bytes", "kB", "MB", "GB", "TB"};
  int unit = 0;
  for (; std::round(bytes) > 999 && unit < 4; ++unit) bytes /= 1000;  // three digits make 1000 of 999.5
  char text[40];
  std::snprintf(text, sizeof text, "%.3g %s", bytes, units[unit]);
  return text;
}

}  // namespace jam::inside
