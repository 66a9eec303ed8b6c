// Instruction sets that loops in vectors are compiled for. The choice changes no bit.
#pragma once
#include <cstdint>

namespace jam::inside {

enum class InstructionSet : int64_t { best, portable, avx2, avx512 };
// Whether this processor, and this build, has it.
bool has_instruction_set(InstructionSet set);
// The set that `best` stands for here; any other stands for itself.
inline InstructionSet resolved(InstructionSet set) {
  if (set != InstructionSet::best) return set;
  return has_instruction_set(InstructionSet::avx512) ? InstructionSet::avx512
         : has_instruction_set(InstructionSet::avx2) ? InstructionSet::avx2
                                                     : InstructionSet::portable;
}

}  // namespace jam::inside
