// A number from decimal text, in every locale, rounded to the nearest.
#pragma once
#include <charconv>
#include <string_view>

namespace jam {

// std::from_chars, which libc++ before version 20 has for integers alone: errc::invalid_argument without a number at
// the beginning, errc::result_out_of_range where a double overflows, or underflows to zero; else x.
std::from_chars_result from_decimal(std::string_view text, double &x);

}  // namespace jam
