#include "core/decimal.hpp"

#include <locale.h>
#if defined(__APPLE__)
#include <xlocale.h>
#endif
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace jam::inside {

#if defined(__cpp_lib_to_chars)
std::from_chars_result from_decimal(std::string_view text, double &x) {
  return std::from_chars(text.data(), text.data() + text.size(), x);
}
char *to_decimal(char *text, double x) { return std::to_chars(text, text + 32, x, std::chars_format::general, 17).ptr; }
#else
std::from_chars_result from_decimal(std::string_view text, double &x) { return from_decimal_by_c(text, x); }
char *to_decimal(char *text, double x) { return to_decimal_by_c(text, x); }
#endif

#if !defined(_WIN32)
namespace {
// What strtod takes and from_chars does not: blanks, a plus sign, hexadecimal digits.
size_t length_of_decimal(std::string_view text) {
  const size_t first = !text.empty() && text[0] == '-' ? 1 : 0;
  const auto at = [&](size_t k) { return k < text.size() ? text[k] : '\0'; };
  const bool number =
      (at(first) >= '0' && at(first) <= '9') || at(first) == '.' || (at(first) | 32) == 'i' || (at(first) | 32) == 'n';
  if (!number) return 0;
  return at(first) == '0' && (at(first + 1) | 32) == 'x' ? first + 1 : text.size();
}
}  // namespace

std::from_chars_result from_decimal_by_c(std::string_view text, double &x) {
  static const locale_t c_locale = ::newlocale(LC_ALL_MASK, "C", nullptr);
  const std::string digits(text.substr(0, length_of_decimal(text)));  // ends with a zero
  char *end = nullptr;
  const int before = errno;
  errno = 0;
  const double value = ::strtod_l(digits.c_str(), &end, c_locale);
  const bool outside = errno == ERANGE && (value == 0.0 || std::isinf(value));
  errno = before;
  const char *const stop = text.data() + (end - digits.c_str());
  if (stop == text.data()) return {stop, std::errc::invalid_argument};
  if (outside) return {stop, std::errc::result_out_of_range};
  x = value;
  return {stop, std::errc()};
}

// The decimal point of the thread's locale may be several bytes long: all that belongs to no number.
char *to_decimal_by_c(char *text, double x) {
  char local[64];
  std::snprintf(local, sizeof local, "%.17g", x);
  bool in_point = false;
  for (const char *c = local; *c; ++c) {
    const bool point = !std::strchr("0123456789+-einfa", *c);
    if (!point || !in_point) *text++ = point ? '.' : *c;
    in_point = point;
  }
  return text;
}
#endif

}  // namespace jam::inside
