#include "core/instruction_set.hpp"

namespace jam::inside {

bool has_instruction_set(InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx2) return __builtin_cpu_supports("avx2");
  if (set == InstructionSet::avx512)
    return __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512dq");
#endif
  return set == InstructionSet::best || set == InstructionSet::portable;
}

InstructionSet resolved(InstructionSet set) {
  if (set != InstructionSet::best) return set;
  return has_instruction_set(InstructionSet::avx512) ? InstructionSet::avx512
         : has_instruction_set(InstructionSet::avx2) ? InstructionSet::avx2
                                                     : InstructionSet::portable;
}

}  // namespace jam::inside
