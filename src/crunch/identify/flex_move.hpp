// Leaving a saddle: forces balance, but a flex opens contacts. The spheres move along it until pairs block.
#pragma once
#include "crunch/state.hpp"
#include "verdict/verdict.hpp"

namespace jam::inside {

enum class FlexMove { none, blocked, free };  // blocked: after a way so short that the closed pairs are tested again
FlexMove move_along_flex(CrunchState &s, const PackingVerdict &verdict);
// The same with the strain of a strict test. False without a flex, or where near pairs block it.
bool move_along_strained_flex(CrunchState &s, const PackingVerdict &strict);

}  // namespace jam::inside
