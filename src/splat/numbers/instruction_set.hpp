// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

// The pragmas that compile a kernel for an instruction set are those of g++; with other compilers
// there are lanes for the instruction set of the build alone, which give the same bits.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define DEGS_HAS_WIDE_LANES 1
#endif

namespace degs {

/// The vectors that lanes of floats are computed with; each set has those before it.
enum class InstructionSet {
    Narrow, ///< 4 floats: SSE2 and its like, which every 64-bit machine has
    Wide,   ///< 8 floats: AVX2 and F16C
    Widest, ///< 16 floats: AVX-512 F, BW, DQ and VL
};

/// The widest set that this build has code for and this machine can run. Results do not depend on
/// it.
InstructionSet instruction_set();

/// The elements of `variants`, one per instruction set from Narrow on, that this machine can run;
/// the last one is the fastest.
template <class Variant>
std::vector<Variant> runnable(std::vector<Variant> variants) {
    const std::size_t most = static_cast<std::size_t>(instruction_set()) + 1;
    variants.erase(variants.begin() + std::min(variants.size(), most), variants.end());
    return variants;
}

} // namespace degs
