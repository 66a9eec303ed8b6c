// Comparison of two packings, sphere by sphere.
#pragma once
#include <string>
#include <vector>
#include "core/packing.hpp"
#include "network/contact_network.hpp"

namespace jam::inside {

struct Comparison {
  jam_comparison_report numbers{};
  std::vector<double> displacement;  // (n, d) from a to b without its mean over spheres stable in both
  std::string doubts;                // what differs and makes an answer one of several; empty when nothing does
};
// Networks may be NULL. JAM_E_ARGUMENT when n, dim, cell or model differ.
Comparison compare_packings(const Packing &a, const ContactNetwork *na, const Packing &b, const ContactNetwork *nb);

}  // namespace jam::inside
