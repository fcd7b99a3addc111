// SPDX-License-Identifier: Apache-2.0
#include "elf.hpp"

#include <cstring>
#include <elf.h>
#include <functional>
#include <numeric>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/riscv/elf_file.hpp"

namespace rv32::test {
namespace {

using Bytes = std::vector<unsigned char>;

/// Bytes 1 to 5 at 0x100, of which the first is executed, and four zeros.
Bytes program() {
    return elf_file(0x100, {1, 2, 3, 4, 5}, 9);
}

Bytes changed_header(const std::function<void(Elf32_Ehdr&)>& change) {
    Bytes file = program();
    Elf32_Ehdr header;
    std::memcpy(&header, file.data(), sizeof header);
    change(header);
    std::memcpy(file.data(), &header, sizeof header);
    return file;
}

TEST(HostileElf, AProgramIsItsSegments) {
    const Program read = parse_elf(program(), "file");
    EXPECT_EQ(read.entry, 0x100U);
    ASSERT_EQ(read.segments.size(), 1U);
    EXPECT_EQ(read.segments[0].address, 0x100U);
    EXPECT_EQ(read.segments[0].bytes, Bytes({1, 2, 3, 4, 5}));
    EXPECT_EQ(read.segments[0].memory_bytes, 9U);
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

TEST(HostileElf, TheMemoryIsClearedUpToTheEndOfTheProgram) {
    Bytes expected(0x109);
    std::iota(expected.begin() + 0x100, expected.begin() + 0x105, 1);
    EXPECT_EQ(memory_image(parse_elf(program(), "file"), 0x109, "file"), expected);
}

/// What is said of a program for a core with `limit` bytes of memory.
std::string sentence_of(const Bytes& file, std::uint32_t limit = 0x20000) {
    try {
        memory_image(parse_elf(file, "file"), limit, "file");
    } catch (const std::runtime_error& mistake) {
        return mistake.what();
    }
    return "";
}

TEST(HostileElf, EveryMistakeHasASentence) {
    Bytes text(100, 'a');
    EXPECT_EQ(sentence_of(text), "file is no ELF file.");
    EXPECT_EQ(sentence_of(changed_header([](auto& h) { h.e_ident[EI_CLASS] = ELFCLASS64; })),
              "file is a program of 64 bits, and the core has 32: compile with -march=rv32im.");
    EXPECT_EQ(sentence_of(changed_header([](auto& h) { h.e_machine = EM_386; })),
              "file is no program for 32-bit RISC-V.");
    EXPECT_EQ(sentence_of(changed_header([](auto& h) { h.e_type = ET_REL; })),
              "file is not linked to an executable at fixed addresses.");
    EXPECT_EQ(sentence_of(changed_header([](auto& h) { h.e_phnum = 0; })),
              "file has nothing to load.");
    const std::string no_entry = "file has no entry: no code lies where it says that it starts.";
    for (const std::uint32_t entry : {0U, 0x102U, 0x104U, 0x108U, 0xFFFFFFFCU}) {
        EXPECT_EQ(sentence_of(changed_header([&](auto& h) { h.e_entry = entry; })), no_entry);
    }
    EXPECT_EQ(sentence_of(program(), 0x108),
              "file is too large: it takes memory up to address 265, and the core has 264 bytes of "
              "its own.");
}

} // namespace
} // namespace rv32::test
