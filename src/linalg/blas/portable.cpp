// The loops for every processor of the target; on x86-64 that is SSE2, on arm64 NEON, with registers of 16 bytes.
#define JAM_SIMD_NAMESPACE portable
#define JAM_SIMD_TARGET
#define JAM_SIMD_BYTES 16
#if defined(__x86_64__)
#define JAM_SIMD_COLUMNS 4
#else
#define JAM_SIMD_COLUMNS 8
#endif
#include "linalg/blas/loops.hpp"
