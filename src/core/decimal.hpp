// Numbers as decimal text, in every locale: read to the nearest double, written with 17 digits.
#pragma once
#include <charconv>
#include <string_view>

#include "core/packing.hpp"

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

// How many digits the numbers have that a packing was given by. Numbers that came from a file may have been rounded:
// then they are multiples of one step. It must be searched for before positions are wrapped, shifted or rotated.

// From coordinates: most of them are multiples of one step, or some of four significant digits and more. From diameters
// and cell vectors: most of these numbers have four digits or more and end there; fewer digits may have been chosen.
GivenDigits digits_of(int dim, const std::vector<double> &position, const std::vector<double> &diameter,
                      const std::vector<double> &rows);
// From coordinates alone.
GivenDigits coordinate_digits(int dim, const std::vector<double> &position, double smallest_diameter);
// The same from the positions along the cell vectors: nearly all are multiples of one step. Of multiples of a length a
// part, up to half of them, are multiples along a vector too, so `some` may count only where there is no such length.
GivenDigits fraction_digits(const Packing &p, bool some);

}  // namespace jam::inside
