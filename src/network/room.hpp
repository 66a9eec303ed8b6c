// The room of a flex. A flex of contacts that carry force opens them by the square of its length alone: it shows that
// spheres are not held only if it opens these contacts by more than they are open already before another pair closes.
#pragma once
#include "network/rigidity_test.hpp"

namespace jam::inside {

// Pairs that a flex of `carrying` contacts can close on its way, none of them one of `taken`. The way is the square
// root of what the carrying contacts are open by, or of a rounding. strain: of the cell, too; own_images: of a sphere
// with itself, which a fixed cell keeps apart.
ContactNetwork pairs_in_the_way(const Packing &p, const ContactNetwork &carrying, const ContactNetwork &taken,
                                bool strain, bool own_images);

// Whether the flex of a no has room, `taken` being the contacts of v that count as closed. If not, one that keeps these
// pairs as well is looked for, and takes its place.
bool find_flex_with_room(const Packing &p, const std::vector<char> &taken, Jamming kind, PackingVerdict &v);

// The part of the flex of v along which no pair that touches overlaps beyond rounding: 1, or less where positions are
// noisy and the flex closes contacts at the rate of that noise. 0 where it is shorter than the way that a flex needs.
double free_part(const Packing &p, const PackingVerdict &v);

}  // namespace jam::inside
