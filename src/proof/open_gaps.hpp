// All pairs that are no contacts stay apart, wherever the exact packing lies within its radius.
#pragma once
#include "proof/scene.hpp"

namespace jam::inside {

struct OpenGaps {
  bool open = false;
  bool of_rattler = false;  // the pair that is not open has a rattler
  double least = 0.0;       // least relative gap of a pair that is no contact, as far as proof_tuning::near
  bool all_seen = false;    // no pair was left out, and no sphere reaches its own image
  double overlap = 0.0;     // by how much growth has to fall, to first order, until none of these pairs overlaps; or 0
};
// Every image: |r|^2 - 2 |r|_1 radius m > gamma sigma^2, m the number of stable spheres of the pair, strict with the
// number of cell vectors between them; and no sphere reaches its own image. At a round wall
// |r|^2 + 2 |r|_1 radius m + (radius m)^2 < (W - g s)^2, and W > g s of all spheres. growth: at or above that of the
// exact packing.
OpenGaps open_gaps(const ProofScene &scene, double radius, double growth);

struct NearPair {
  int32_t i, j;                // spheres, i <= j; j < 0: a wall
  std::vector<int32_t> image;  // n of x_i - x_j + n A
  double opening;              // |r|^2 / sigma^2 - Gamma at the scene's exact numbers, rounded once
};
// All pairs that are no contacts with relative gaps up to proof_tuning::near, except for a sphere and its own images.
std::vector<NearPair> near_pairs(const ProofScene &scene);
Expansion apart(const ProofScene &scene, const NearPair &pair, size_t component);  // of x_i - x_j + n A
double opening_of(const ProofScene &scene, const NearPair &pair);

}  // namespace jam::inside
