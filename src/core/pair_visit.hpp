// Pairs of spheres for what needs no list of them.
#pragma once
#include <functional>
#include "core/pairs.hpp"

namespace jam::inside {

// Takes the pairs of spheres that find_pairs lists, without walls, in parts and in no order.
using TakePairs = std::function<void(const PairList &part)>;
void visit_pairs(const Packing &p, double reach, double slope, const TakePairs &take);

}  // namespace jam::inside
