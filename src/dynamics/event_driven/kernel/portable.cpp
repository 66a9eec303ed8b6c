// The loops for every processor of the target; on x86-64 that is SSE2, on arm64 NEON.
#define JAM_SIMD_NAMESPACE portable
#define JAM_SIMD_TARGET
#include "dynamics/event_driven/kernel/loops.hpp"
