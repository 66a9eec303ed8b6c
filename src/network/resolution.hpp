// How well the gaps of a packing are known. The one place that derives it: contacts from geometry, the test of jamming
// and the check of a packing ask here.
//
// Numbers that came from a file may have few digits. Rounding coordinates to multiples of a step moves each of two
// spheres by up to sqrt(d) step / 2, so the distance of a contact is wrong by up to sqrt(d) step. The same bound is
// used for rounded diameters (by step) and cell vectors (by sqrt(d) step / 2).
#pragma once
#include "core/packing.hpp"
#include "core/pairs.hpp"

namespace jam::inside {

// Relative gaps |h| of a contact, and of a pair that doubles cannot distinguish from one.
constexpr double contact_gap_limit = 1e-10, undecided_gap_limit = 1e-7, listed_gap_limit = 1e-5;

struct GapResolution {
  double step = 0.0;      // coordinates, diameters or cell are multiples of it; 0: all digits of a double
  int base = 0;           // 10 or 2: decimal digits, or bits as of single precision
  double rounding = 0.0;  // of gaps, relative to the smallest diameter, with all digits
  double error = 0.0;   // largest error of a distance from the digits or from overlaps, unit of box; 0: rounding alone
  double shrunk = 0.0;  // part of all diameters that was taken off, so that no pair overlaps
  // Relative to the smallest diameter.
  double relative(const Packing &p) const;
  // Pairs nearer to contact than this length may be contacts, where sigma is their contact distance. Both spheres are
  // wrong, pairs that touched are open by what was taken off, and as much again is left between yes and no.
  double reach(double sigma) const;
  // Too few digits to say which pairs touch.
  bool coarse(const Packing &p) const { return 8.0 * error > contact_gap_limit * diameter_mean(p); }
  // Whether a pair with this relative gap and contact distance may be a contact.
  bool may_touch(double gap, double sigma) const { return gap < undecided_gap_limit || gap * sigma < reach(sigma); }
  // All pairs in reach, and those with relative gaps below this one.
  PairList pairs_in_reach(const Packing &p, double gap) const;
  // Decimal digits of lengths as large as the box; 0: all of a double.
  int32_t digits(const Packing &p) const;
};

// From the coordinates, Cartesian or along the cell vectors: most of them are multiples of one step, or some of four
// digits and more. From diameters and cell: most of these numbers have four digits or more and end there; fewer digits
// may have been chosen. Where nearly all pairs that are near to contact touch to 1e-10, no digits are missing.
GapResolution gap_resolution(const Packing &p);
}  // namespace jam::inside
