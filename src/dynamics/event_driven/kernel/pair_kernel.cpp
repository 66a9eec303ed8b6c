#include "dynamics/event_driven/kernel/pair_kernel.hpp"

#include "core/with_dimension.hpp"

namespace jam::inside {

namespace portable {
template <int D>
PairKernel<D> pair_kernel();
}
namespace avx2 {
template <int D>
PairKernel<D> pair_kernel();
}
namespace avx512 {
template <int D>
PairKernel<D> pair_kernel();
}

template <int D>
PairKernel<D> pair_kernel([[maybe_unused]] InstructionSet set) {
#if defined(__x86_64__)
  set = resolved(set);
  if (set == InstructionSet::avx2) return avx2::pair_kernel<D>();
  if (set == InstructionSet::avx512) return avx512::pair_kernel<D>();
#endif
  return portable::pair_kernel<D>();
}

#define JAM_INSTANCE(D) template PairKernel<D> pair_kernel<D>(InstructionSet);
JAM_EACH_DIMENSION(JAM_INSTANCE)

}  // namespace jam::inside
