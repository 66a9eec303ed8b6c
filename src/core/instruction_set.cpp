#include "core/instruction_set.hpp"

#if defined(__x86_64__)
#include <cpuid.h>
#endif

namespace jam::inside {

#if defined(__x86_64__)
namespace {

// Whether the processor has all of these features of leaf 7, and the system keeps these registers. Not by
// __builtin_cpu_supports: run times of some Clangs lack what it reads.
bool has_vectors(unsigned features, unsigned registers) {
  unsigned a, b, c, d;
  if (!__get_cpuid(1, &a, &b, &c, &d) || !(c & bit_OSXSAVE)) return false;
  unsigned kept, high;
  __asm__("xgetbv" : "=a"(kept), "=d"(high) : "c"(0));
  return (kept & registers) == registers && __get_cpuid_count(7, 0, &a, &b, &c, &d) && (b & features) == features;
}

constexpr unsigned ymm = 0x6, zmm = 0xe6;  // bits of XCR0, with those of the smaller registers

}  // namespace
#endif

bool has_instruction_set(InstructionSet set) {
#if defined(__x86_64__)
  if (set == InstructionSet::avx2) return has_vectors(bit_AVX2, ymm);
  if (set == InstructionSet::avx512) return has_vectors(bit_AVX512F | bit_AVX512VL | bit_AVX512DQ, zmm);
#endif
  return set == InstructionSet::best || set == InstructionSet::portable;
}

}  // namespace jam::inside
