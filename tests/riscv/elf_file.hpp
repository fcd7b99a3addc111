// SPDX-License-Identifier: Apache-2.0
// Executables for the core, byte by byte.
#pragma once

#include <cstdint>
#include <cstring>
#include <vector>

#include <elf.h>

namespace rv32::test {

/// An executable of one segment: `content` lies at `address`, where it starts, and takes
/// `memory` bytes there.
inline std::vector<unsigned char>
elf_file(std::uint32_t address, const std::vector<unsigned char>& content, std::uint32_t memory) {
    Elf32_Ehdr header{};
    std::memcpy(header.e_ident, ELFMAG, SELFMAG);
    header.e_ident[EI_CLASS] = ELFCLASS32;
    header.e_ident[EI_DATA] = ELFDATA2LSB;
    header.e_type = ET_EXEC;
    header.e_machine = EM_RISCV;
    header.e_entry = address;
    header.e_phoff = sizeof header;
    header.e_phentsize = sizeof(Elf32_Phdr);
    header.e_phnum = 1;
    Elf32_Phdr segment{};
    segment.p_type = PT_LOAD;
    segment.p_offset = sizeof header + sizeof segment;
    segment.p_paddr = address;
    segment.p_filesz = static_cast<std::uint32_t>(content.size());
    segment.p_memsz = memory;
    std::vector<unsigned char> file(segment.p_offset);
    std::memcpy(file.data(), &header, sizeof header);
    std::memcpy(file.data() + sizeof header, &segment, sizeof segment);
    file.insert(file.end(), content.begin(), content.end());
    return file;
}

} // namespace rv32::test
