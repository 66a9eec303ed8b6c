// The loops in AVX-512: vectors as long as in AVX2, which convert integers to doubles and choose lanes at once.
#if defined(__x86_64__)
#define JAM_SIMD_NAMESPACE avx512
#define JAM_SIMD_TARGET __attribute__((target("avx512f,avx512vl,avx512dq")))
#define JAM_SIMD_256
#define JAM_SIMD_CONVERTS
#include "dynamics/event_driven/kernel/loops.hpp"
#endif
