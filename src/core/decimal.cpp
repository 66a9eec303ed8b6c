#include "core/decimal.hpp"

#if defined(_LIBCPP_VERSION) && _LIBCPP_VERSION < 200000
#define JAM_FROM_CHARS 0
#include <locale.h>
#if defined(__APPLE__)
#include <xlocale.h>
#endif
#include <cerrno>
#include <cmath>
#include <cstdlib>
#include <string>
#else
#define JAM_FROM_CHARS 1
#endif

namespace jam {

#if JAM_FROM_CHARS
std::from_chars_result from_decimal(std::string_view text, double &x) {
  return std::from_chars(text.data(), text.data() + text.size(), x);
}
#else
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

std::from_chars_result from_decimal(std::string_view text, double &x) {
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
#endif

}  // namespace jam
