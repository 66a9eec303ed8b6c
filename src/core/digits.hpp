// How many digits the numbers have that a packing was given by. Numbers that came from a file may have been rounded:
// then they are multiples of one step. It must be searched for before positions are wrapped, shifted or rotated.
#pragma once
#include <vector>

#include "core/packing.hpp"

namespace jam::inside {

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
