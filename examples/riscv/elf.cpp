// SPDX-License-Identifier: Apache-2.0
#include "elf.hpp"

#include <elf.h>

#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace rv32 {
namespace {

using Bytes = std::vector<unsigned char>;

void require(bool holds, const std::string& name, const char* what) {
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

} // namespace

Program parse_elf(const Bytes& file, const std::string& name) {
    const auto header = header_at<Elf32_Ehdr>(file, 0, name);
    require(std::memcmp(header.e_ident, ELFMAG, SELFMAG) == 0, name, "is no ELF file.");
    require(header.e_ident[EI_CLASS] == ELFCLASS32 && header.e_ident[EI_DATA] == ELFDATA2LSB &&
                header.e_machine == EM_RISCV && header.e_type == ET_EXEC,
            name, "is no executable for 32-bit RISC-V.");
    require(header.e_phentsize == sizeof(Elf32_Phdr), name, "has segments of another size.");
    Program program;
    program.entry = header.e_entry;
    for (std::uint64_t i = 0; i < header.e_phnum; ++i) {
        const auto segment =
            header_at<Elf32_Phdr>(file, header.e_phoff + i * sizeof(Elf32_Phdr), name);
        if (segment.p_type != PT_LOAD || segment.p_filesz == 0) {
            continue;
        }
        require(lies_within(file, segment.p_offset, segment.p_filesz), name,
                "ends within a segment.");
        const auto first = file.begin() + segment.p_offset;
        program.segments.push_back({segment.p_paddr, Bytes(first, first + segment.p_filesz)});
    }
    require(!program.segments.empty(), name, "has nothing to load.");
    return program;
}

Program load_elf(const std::string& path) {
    std::ifstream in(path, std::ios::binary);
    require(in.is_open(), path, "cannot be read.");
    return parse_elf(Bytes(std::istreambuf_iterator<char>(in), {}), path);
}

} // namespace rv32
