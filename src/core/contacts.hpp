// The contact network that crunch leaves behind and analysis works on.
#pragma once
#include <cstdint>
#include <vector>
#include "core/pairs.hpp"

namespace jam {

struct ContactNetwork {
  PairList pairs;                     // contacts between stable spheres
  std::vector<double> vector;         // (contacts, dim) unit n_ij
  std::vector<double> gap;            // h of each contact
  std::vector<double> force;          // mean 1
  double force_scale = 0.0;           // mean of lambda |r| with sum lambda sigma^2 = 1
  std::vector<int32_t> coordination;  // n; 0 for rattlers
  size_t size() const { return pairs.size(); }
};

}  // namespace jam
