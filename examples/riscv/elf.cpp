// SPDX-License-Identifier: Apache-2.0
#include "elf.hpp"

#include <elf.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>

namespace rv32 {
namespace {

using Bytes = std::vector<unsigned char>;

void require(bool holds, const std::string& name, const std::string& what) {
    if (!holds) {
        throw std::runtime_error(name + " " + what);
    }
}

bool lies_within(const Bytes& file, std::uint64_t offset, std::uint64_t size) {
    return offset <= file.size() && size <= file.size() - offset;
}

/// A structure of the file, on a little-endian host.
template <typename Header>
Header header_at(const Bytes& file, std::uint64_t offset, const std::string& name) {
    require(lies_within(file, offset, sizeof(Header)), name, "ends within a header.");
    Header header;
    std::memcpy(&header, file.data() + offset, sizeof header);
    return header;
}

Elf32_Ehdr checked_header(const Bytes& file, const std::string& name) {
    require(file.size() >= SELFMAG && std::memcmp(file.data(), ELFMAG, SELFMAG) == 0, name,
            "is no ELF file.");
    const auto header = header_at<Elf32_Ehdr>(file, 0, name);
    require(header.e_ident[EI_CLASS] != ELFCLASS64, name,
            "is a program of 64 bits, and the core has 32: compile with -march=rv32im.");
    require(header.e_ident[EI_CLASS] == ELFCLASS32 && header.e_ident[EI_DATA] == ELFDATA2LSB &&
                header.e_machine == EM_RISCV,
            name, "is no program for 32-bit RISC-V.");
    require(header.e_type == ET_EXEC, name, "is not linked to an executable at fixed addresses.");
    require(header.e_phentsize == sizeof(Elf32_Phdr), name, "has segments of another size.");
    return header;
}

bool starts_in(const Program::Segment& segment, std::uint32_t entry) {
    const std::uint32_t offset = entry - segment.address;
    return offset < segment.bytes.size() && segment.bytes.size() - offset >= 4;
}

} // namespace

Program parse_elf(const Bytes& file, const std::string& name) {
    const Elf32_Ehdr header = checked_header(file, name);
    Program program;
    program.entry = header.e_entry;
    for (std::uint64_t i = 0; i < header.e_phnum; ++i) {
        const auto segment =
            header_at<Elf32_Phdr>(file, header.e_phoff + i * sizeof(Elf32_Phdr), name);
        if (segment.p_type != PT_LOAD || segment.p_memsz == 0) {
            continue;
        }
        require(lies_within(file, segment.p_offset, segment.p_filesz), name,
                "ends within a segment.");
        require(segment.p_filesz <= segment.p_memsz, name, "has a segment larger than its memory.");
        const auto first = file.begin() + segment.p_offset;
        program.segments.push_back(
            {segment.p_paddr, Bytes(first, first + segment.p_filesz), segment.p_memsz});
    }
    require(!program.segments.empty(), name, "has nothing to load.");
    require(program.entry % 4 == 0 &&
                std::any_of(program.segments.begin(), program.segments.end(),
                            [&](const auto& each) { return starts_in(each, program.entry); }),
            name, "has no entry: no code lies where it says that it starts.");
    return program;
}

Bytes memory_image(const Program& program, std::uint32_t limit, const std::string& name) {
    Bytes memory;
    for (const Program::Segment& segment : program.segments) {
        const std::uint64_t end = std::uint64_t{segment.address} + segment.memory_bytes;
        require(end <= limit, name,
                "is too large: it takes memory up to address " + std::to_string(end) +
                    ", and the core has " + std::to_string(limit) + " bytes of its own.");
        memory.resize(std::max<std::size_t>(memory.size(), end));
        std::copy(segment.bytes.begin(), segment.bytes.end(), memory.begin() + segment.address);
    }
    return memory;
}

} // namespace rv32
