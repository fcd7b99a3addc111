// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rv32 {

/// A statically linked program: its bytes and where they lie.
struct Program {
    struct Segment {
        std::uint32_t address = 0; ///< physical
        std::vector<unsigned char> bytes;
    };
    std::vector<Segment> segments;
    std::uint32_t entry = 0;
};

/// Reads a 32-bit little-endian RISC-V executable in ELF (System V ABI, chapters 4 and 5). Throws
/// std::runtime_error, one sentence, if the file is none or passes its own end. Bytes that a
/// segment has in memory only are left out: start-up code clears them.
Program load_elf(const std::string& path);
Program parse_elf(const std::vector<unsigned char>& file, const std::string& name);

} // namespace rv32
