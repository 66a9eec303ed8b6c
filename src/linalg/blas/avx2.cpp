// The loops in AVX2.
#if defined(__x86_64__)
#define JAM_SIMD_NAMESPACE avx2
#define JAM_SIMD_TARGET __attribute__((target("avx2")))
#define JAM_SIMD_BYTES 32
#define JAM_SIMD_COLUMNS 4
#include "linalg/blas/loops.hpp"
#endif
