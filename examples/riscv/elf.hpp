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
        std::uint32_t memory_bytes = 0; ///< the rest of them is cleared
    };
    std::vector<Segment> segments;
    std::uint32_t entry = 0; ///< a multiple of 4, within the bytes of a segment
};

/// Reads a 32-bit little-endian RISC-V executable in ELF (System V ABI, chapters 4 and 5). Throws
/// std::runtime_error, a sentence that begins with `name`, if the file is none or passes its own
/// end.
Program parse_elf(const std::vector<unsigned char>& file, const std::string& name);

/// The memory from address 0 up to the end of the last segment. Throws std::runtime_error, a
/// sentence that begins with `name`, if that is more than `limit` bytes.
std::vector<unsigned char> memory_image(const Program& program, std::uint32_t limit,
                                        const std::string& name);

} // namespace rv32
