// The loops in AVX2.
#if defined(__x86_64__)
#define JAM_SIMD_NAMESPACE avx2
#define JAM_SIMD_TARGET __attribute__((target("avx2")))
#define JAM_SIMD_256
#include "dynamics/event_driven/kernel/loops.hpp"
#endif
