// The clearance of a flex. Contacts that carry force open by the square of its length alone. A flex proves "not jammed"
// only if, before another pair closes, it opens the force-bearing contacts by more than their present gaps.
#pragma once
#include "verdict/verdict.hpp"

namespace jam::inside {

// Pairs that a flex of `carrying` contacts can close before it is as long as it must be, none of them one of `taken`.
// That length is the square root of the widest gap of the carrying contacts, or of a rounding. strain: of the cell,
// too; own_images: of a sphere with itself, which a fixed cell keeps apart.
ContactNetwork blocking_pairs(const Packing &p, const ContactNetwork &carrying, const ContactNetwork &taken,
                              bool strain, bool own_images);

// Whether no pair blocks the flex of a no, `taken` being the contacts of v that count as closed. If one does, a flex
// that keeps these pairs as well is searched for, and replaces it.
bool find_unblocked_flex(const Packing &p, const std::vector<char> &taken, Jamming kind, PackingVerdict &v);

// A motion of some spheres and a strain (empty: none), the largest displacement 1.
struct StraightMotion {
  const std::vector<int32_t> &sphere;
  const std::vector<double> &flex, &strain;
};
// Whether it leads in a straight line over this length, in mean diameters, without an overlap beyond rounding. False
// between round walls and for no motion.
bool leads_free(const Packing &p, const StraightMotion &motion, double length);

// The fraction of the flex of v along which no pair that touches overlaps beyond rounding: 1, or less where positions
// are noisy and the flex closes contacts at the rate of that noise. 0 where it is shorter than the flex must be.
double unblocked_fraction(const Packing &p, const PackingVerdict &v);

}  // namespace jam::inside
