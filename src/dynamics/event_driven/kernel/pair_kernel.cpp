#include "dynamics/event_driven/kernel/pair_kernel.hpp"

#include "core/with_dimension.hpp"

namespace jam {

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

bool has_instruction_set(InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx2) return __builtin_cpu_supports("avx2");
  if (set == InstructionSet::avx512)
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512dq");
#endif
  return set == InstructionSet::best || set == InstructionSet::portable;
}

template <int D>
PairKernel<D> pair_kernel(InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::best)
    set = has_instruction_set(InstructionSet::avx512) ? InstructionSet::avx512
          : has_instruction_set(InstructionSet::avx2) ? InstructionSet::avx2
                                                      : InstructionSet::portable;
  if (set == InstructionSet::avx2) return avx2::pair_kernel<D>();
  if (set == InstructionSet::avx512) return avx512::pair_kernel<D>();
#endif
  return portable::pair_kernel<D>();
}

#define JAM_INSTANCE(D) template PairKernel<D> pair_kernel<D>(InstructionSet);
JAM_EACH_DIMENSION(JAM_INSTANCE)

}  // namespace jam
