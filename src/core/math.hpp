// Elementary functions that give the same bits on every machine: sums, products, quotients and roots of doubles in a
// fixed order, and integers. C libraries differ in the last bit, and one library takes other code on another processor.
// Every result of libjam that needs one of these functions calls it here; what C rounds exactly (sqrt, floor, ldexp,
// fabs, ...) stays with the C library. Errors are below one unit in the last place (below two of acos and asin). Ends
// of the range, infinities and NaN are those of C; errno and the flags of floating point mean nothing.
#pragma once

namespace jam::inside::math {

constexpr double pi = 3.14159265358979323846;
double log(double x);
double log1p(double x);
double exp(double x);
double expm1(double x);
double pow(double x, double y);
double sin(double x);
double cos(double x);
double cos_of_turns(double turns);  // cos(2 pi turns), for |turns| < 2^30
double acos(double x);
double asin(double x);
// Share of the standard normal distribution below x, and its inverse, the error function in other words (Wichura, Appl.
// Stat. 37, 477 (1988)). Relative errors are below 1e-15; above a share of 1/2 the share's own rounding counts.
double normal_share(double x);
double normal_quantile(double share);

}  // namespace jam::inside::math
