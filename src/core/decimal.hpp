// Numbers as decimal text, in every locale: read to the nearest double, written with 17 digits.
#pragma once
#include <charconv>
#include <string_view>

namespace jam::inside {

// std::from_chars: errc::invalid_argument without a number at the beginning, errc::result_out_of_range where a double
// overflows, or underflows to zero; else x.
std::from_chars_result from_decimal(std::string_view text, double &x);
// std::to_chars, general, 17 digits: what printf writes by %.17g. text has room for 32 characters; the result is the
// end.
char *to_decimal(char *text, double x);

// The same by C's functions: GCC has std's for doubles from version 11 on, libc++ has not all of them.
#if !defined(_WIN32)
std::from_chars_result from_decimal_by_c(std::string_view text, double &x);
char *to_decimal_by_c(char *text, double x);
#endif

}  // namespace jam::inside
