// Shells around spheres between walls: what part of them other centres can reach.
#pragma once
#include "core/packing.hpp"

namespace jam::inside {

// The pairs that g(r) compares with: of each sphere of `of`, and the spheres `with` spread evenly where the walls leave
// their centres room, between distances `edge`, in contact distances where `of_contact` says so. d = 2, 3.
// JAM_E_UNSUPPORTED where a sphere of `with` has no room.
std::vector<double> pairs_of_even_spread(const Packing &p, const std::vector<char> &of, const std::vector<char> &with,
                                         const std::vector<double> &edge, bool of_contact = false);

}  // namespace jam::inside
