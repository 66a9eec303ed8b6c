// Vectors of the loops.
#pragma once
#include "core/simd.hpp"

namespace jam::inside {
namespace JAM_SIMD_NAMESPACE {

template <class Real, int Bytes>
struct VectorOf {
  typedef Real type __attribute__((vector_size(Bytes)));
};
template <class Real, int Bytes = JAM_SIMD_BYTES>
using Vector = typename VectorOf<Real, Bytes>::type;

}  // namespace JAM_SIMD_NAMESPACE
}  // namespace jam::inside
