// The instruction sets of core/instruction_set.hpp that a processor of fewer would have: JAM_BITS_SET names the best
// one. A program that links this file before libjam's archive takes it in place of libjam's own.
#include "core/instruction_set.hpp"

#include <cstdlib>
#include <cstring>

namespace jam::inside {
namespace {

int best_allowed() {
  const char *const names[] = {"portable", "avx2", "avx512"};
  const char *const wanted = std::getenv("JAM_BITS_SET");
  for (int k = 0; wanted && k < 3; ++k)
    if (std::strcmp(wanted, names[k]) == 0) return k;
  return 0;
}

}  // namespace

bool has_instruction_set(InstructionSet set) {
  const int most = best_allowed();
#if defined(__x86_64__)
  if (set == InstructionSet::avx2) return most >= 1 && __builtin_cpu_supports("avx2");
  if (set == InstructionSet::avx512)
    return most >= 2 && __builtin_cpu_supports("avx512f") && __builtin_cpu_supports("avx512vl") &&
           __builtin_cpu_supports("avx512dq");
#endif
  static_cast<void>(most);  // other processors have one set
  return set == InstructionSet::best || set == InstructionSet::portable;
}

}  // namespace jam::inside
