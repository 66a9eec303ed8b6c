#include "dynamics/pair_kernel.hpp"

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

template PairKernel<2> pair_kernel<2>(InstructionSet);
template PairKernel<3> pair_kernel<3>(InstructionSet);
template PairKernel<4> pair_kernel<4>(InstructionSet);
template PairKernel<5> pair_kernel<5>(InstructionSet);
template PairKernel<6> pair_kernel<6>(InstructionSet);
template PairKernel<7> pair_kernel<7>(InstructionSet);
template PairKernel<8> pair_kernel<8>(InstructionSet);

}  // namespace jam
