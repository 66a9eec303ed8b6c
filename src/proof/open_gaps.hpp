// All pairs that are no contacts stay apart, wherever the exact packing lies within its radius.
#pragma once
#include "proof/scene.hpp"

namespace jam {

struct OpenGaps {
  bool open = false;
  bool of_rattler = false;  // the pair that is not open has a rattler
  double least = 0.0;       // least relative gap of a pair that is no contact, as far as proof_tuning::near
};
// Every image: |r|^2 - 2 |r|_1 radius m > gamma sigma^2, m the number of stable spheres of the pair, strict with the
// number of cell vectors between them; and no sphere reaches its own image.
OpenGaps open_gaps(const ProofScene &scene, double radius, double gamma);

}  // namespace jam
