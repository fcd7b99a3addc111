// SPDX-License-Identifier: Apache-2.0
#include "examples/riscv/elf.hpp"

#include <cstring>
#include <elf.h>
#include <stdexcept>

#include <gtest/gtest.h>

namespace rv32::test {
namespace {

using Bytes = std::vector<unsigned char>;

/// A program of one segment: bytes 1 to 5 at 0x100, of which the first is executed.
Bytes program() {
    Elf32_Ehdr header{};
    std::memcpy(header.e_ident, ELFMAG, SELFMAG);
    header.e_ident[EI_CLASS] = ELFCLASS32;
    header.e_ident[EI_DATA] = ELFDATA2LSB;
    header.e_type = ET_EXEC;
    header.e_machine = EM_RISCV;
    header.e_entry = 0x100;
    header.e_phoff = sizeof header;
    header.e_phentsize = sizeof(Elf32_Phdr);
    header.e_phnum = 1;
    Elf32_Phdr segment{};
    segment.p_type = PT_LOAD;
    segment.p_offset = sizeof header + sizeof segment;
    segment.p_paddr = 0x100;
    segment.p_filesz = 5;
    segment.p_memsz = 9;
    Bytes file(segment.p_offset);
    std::memcpy(file.data(), &header, sizeof header);
    std::memcpy(file.data() + sizeof header, &segment, sizeof segment);
    file.insert(file.end(), {1, 2, 3, 4, 5});
    return file;
}

TEST(HostileElf, AProgramIsItsSegments) {
    const Program read = parse_elf(program(), "file");
    EXPECT_EQ(read.entry, 0x100U);
    ASSERT_EQ(read.segments.size(), 1U);
    EXPECT_EQ(read.segments[0].address, 0x100U);
    EXPECT_EQ(read.segments[0].bytes, Bytes({1, 2, 3, 4, 5}));
}

TEST(HostileElf, EveryCutIsAnError) {
    const Bytes whole = program();
    for (std::size_t size = 0; size < whole.size(); ++size) {
        const Bytes cut(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
        EXPECT_THROW(parse_elf(cut, "file"), std::runtime_error) << size;
    }
}

TEST(HostileElf, NoByteOfTheHeadersLeadsOutOfTheFile) {
    const Bytes whole = program();
    for (std::size_t at = 0; at < whole.size() - 5; ++at) {
        for (const unsigned char value : Bytes{0x00, 0x01, 0x7F, 0x80, 0xFF}) {
            Bytes changed = whole;
            changed[at] = value;
            try {
                for (const auto& segment : parse_elf(changed, "file").segments) {
                    EXPECT_LE(segment.bytes.size(), whole.size());
                }
            } catch (const std::runtime_error& mistake) {
                EXPECT_EQ(std::string(mistake.what()).find("file "), 0U);
            }
        }
    }
}

TEST(HostileElf, AFileThatIsNotThereIsAnError) {
    EXPECT_THROW(load_elf("/nowhere/firmware.elf"), std::runtime_error);
}

} // namespace
} // namespace rv32::test
