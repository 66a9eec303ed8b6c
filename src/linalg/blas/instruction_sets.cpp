// The loops of each instruction set.
#include "linalg/blas/routines.hpp"

namespace jam::inside {

namespace portable {
template <class Real>
BlasRoutines<Real> routines();
}
namespace avx2 {
template <class Real>
BlasRoutines<Real> routines();
}
namespace avx512 {
template <class Real>
BlasRoutines<Real> routines();
}

template <class Real>
BlasRoutines<Real> blas_routines([[maybe_unused]] InstructionSet set) {
#if defined(__x86_64__)
  set = resolved(set);
  if (set == InstructionSet::avx2) return avx2::routines<Real>();
  if (set == InstructionSet::avx512) return avx512::routines<Real>();
#endif
  return portable::routines<Real>();
}
template BlasRoutines<double> blas_routines(InstructionSet);
template BlasRoutines<float> blas_routines(InstructionSet);

}  // namespace jam::inside
