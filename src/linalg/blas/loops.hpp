// The routines of blas.hpp in vectors; a file for each instruction set includes them once. Each number of a result is
// computed by the same operations in the same order, whatever the vectors' length and the blocks' size: products are
// subtracted one after the other in the order of k, and sums of products have as many parts everywhere. Products are
// rounded before they are added, since not all processors can fuse the two.
// The file that includes this header defines, beside what core/simd.hpp requires,
//   JAM_SIMD_BYTES    the length of a register,
//   JAM_SIMD_COLUMNS  the columns of a tile, three registers high, that fit into the registers.
#pragma once
#include "linalg/blas/product_loops.hpp"
#include "linalg/blas/routines.hpp"
#include "linalg/blas/vector_loops.hpp"

namespace jam::inside {
namespace JAM_SIMD_NAMESPACE {

template <class Real>
BlasRoutines<Real> routines() {
  return {minus_product<Real>, minus_square<Real>,       divide<Real>, solve<Real>, solve_transposed<Real>,
          multiply<Real>,      subtract_transposed<Real>};
}
template BlasRoutines<double> routines<double>();
template BlasRoutines<float> routines<float>();

}  // namespace JAM_SIMD_NAMESPACE
}  // namespace jam::inside
