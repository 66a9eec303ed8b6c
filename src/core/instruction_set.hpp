// Instruction sets that loops in vectors are compiled for. The choice changes no bit.
#pragma once
#include <cstdint>

namespace jam::inside {

enum class InstructionSet : int64_t { best, portable, avx2, avx512 };
// Whether this processor, and this build, has it.
bool has_instruction_set(InstructionSet set);
// The set that `best` stands for here; any other stands for itself.
InstructionSet resolved(InstructionSet set);

}  // namespace jam::inside
