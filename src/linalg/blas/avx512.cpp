// The loops in AVX-512: vectors as long as in AVX2, of which twice as many fit into the registers. Longer ones computed
// no faster where a product is rounded before it is added (measured on a Zen 4).
#if defined(__x86_64__)
#define JAM_SIMD_NAMESPACE avx512
#define JAM_SIMD_TARGET __attribute__((target("avx512f,avx512vl,avx512dq")))
#define JAM_SIMD_BYTES 32
#define JAM_SIMD_COLUMNS 8
#include "linalg/blas/loops.hpp"
#endif
