// The routines of blas.hpp in the loops of one instruction set.
#pragma once
#include "core/instruction_set.hpp"
#include "linalg/blas.hpp"

namespace jam::inside {

template <class Real>
struct BlasRoutines {
  decltype(Blas<Real>::minus_product) *minus_product;
  decltype(Blas<Real>::minus_square) *minus_square;
  decltype(Blas<Real>::divide) *divide;
  decltype(Blas<Real>::solve) *solve, *solve_transposed;
  decltype(Blas<Real>::multiply) *multiply;
  decltype(Blas<Real>::subtract_transposed) *subtract_transposed;
};
template <class Real>
BlasRoutines<Real> blas_routines(InstructionSet set);

}  // namespace jam::inside
