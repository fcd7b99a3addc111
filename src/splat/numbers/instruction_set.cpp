// SPDX-License-Identifier: Apache-2.0
#include "splat/numbers/instruction_set.hpp"

#ifdef DEGS_HAS_WIDE_LANES
#include <cpuid.h>
#endif

namespace degs {
namespace {

#ifdef DEGS_HAS_WIDE_LANES
bool has_f16c() { // a name that not all compilers know
    constexpr unsigned kF16c = 1U << 29;
    unsigned eax = 0;
    unsigned ebx = 0;
    unsigned ecx = 0;
    unsigned edx = 0;
    return __get_cpuid(1, &eax, &ebx, &ecx, &edx) != 0 && (ecx & kF16c) != 0;
}

InstructionSet widest() {
    if (__builtin_cpu_supports("avx2") == 0 || !has_f16c()) {
        return InstructionSet::Narrow;
    }
    const bool avx512 =
        __builtin_cpu_supports("avx512f") != 0 && __builtin_cpu_supports("avx512bw") != 0 &&
        __builtin_cpu_supports("avx512dq") != 0 && __builtin_cpu_supports("avx512vl") != 0;
    return avx512 ? InstructionSet::Widest : InstructionSet::Wide;
}
#else
InstructionSet widest() {
    return InstructionSet::Narrow;
}
#endif

} // namespace

InstructionSet instruction_set() {
    static const InstructionSet set = widest();
    return set;
}

} // namespace degs
