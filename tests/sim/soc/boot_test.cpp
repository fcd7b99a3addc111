// SPDX-License-Identifier: Apache-2.0
// degs soc --cpu riscv, as a user calls it.
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <elf.h>

#include "sim/soc/built_in_firmware.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

const std::string kBootScene = "synthetic:object,gaussians=2000";

std::vector<std::string> boot(const std::string& design, const std::vector<std::string>& more) {
    std::vector<std::string> words{"soc", config(design), "--cpu", "riscv"};
    words.insert(words.end(), more.begin(), more.end());
    return words;
}

void write_bytes(const std::string& path, const std::vector<unsigned char>& bytes) {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
}

/// An executable for the core that has these instructions at address 0.
std::vector<unsigned char> executable(const std::vector<std::uint32_t>& code) {
    Elf32_Ehdr header{};
    std::memcpy(header.e_ident, ELFMAG, SELFMAG);
    header.e_ident[EI_CLASS] = ELFCLASS32;
    header.e_ident[EI_DATA] = ELFDATA2LSB;
    header.e_type = ET_EXEC;
    header.e_machine = EM_RISCV;
    header.e_phoff = sizeof header;
    header.e_phentsize = sizeof(Elf32_Phdr);
    header.e_phnum = 1;
    Elf32_Phdr segment{};
    segment.p_type = PT_LOAD;
    segment.p_offset = sizeof header + sizeof segment;
    segment.p_filesz = segment.p_memsz = static_cast<std::uint32_t>(4 * code.size());
    std::vector<unsigned char> file(segment.p_offset + segment.p_filesz);
    std::memcpy(file.data(), &header, sizeof header);
    std::memcpy(file.data() + sizeof header, &segment, sizeof segment);
    std::memcpy(file.data() + segment.p_offset, code.data(), segment.p_filesz);
    return file;
}

class SmallRunBoot : public testing::TestWithParam<const char*> {};

/// The view is a window, whose registers the firmware sets, too.
TEST_P(SmallRunBoot, PrintsTheChecksumOfARun) {
    if (sim::built_in_firmware().empty()) {
        GTEST_SKIP() << "the build had no riscv64-unknown-elf-gcc";
    }
    const Folder folder; // of floats, as memory holds them; generated scenes have doubles
    expect_success(degs(
        {"scene", "generate", "object", "--gaussians", "2000", "--out", folder / "scene.ply"}));
    const auto begin = std::chrono::steady_clock::now();
    const Outcome outcome =
        degs(boot(GetParam(), {"--scene", folder / "scene.ply", "--camera", "1", "--width", "320",
                               "--crop", "37,20,250x150", "--out", folder / "soc"}));
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    expect_success(outcome);
    EXPECT_LT(taken.count(), 60) << "seconds";
    std::printf("degs soc --cpu riscv took %.1f s\n", taken.count());
    expect_success(degs({"run", config(GetParam()), "--scene", folder / "scene.ply", "--camera",
                         "1", "--width", "320", "--crop", "37,20,250x150", "--no-reference",
                         "--out", folder / "run"}));
    const auto run = nlohmann::json::parse(read_file(folder / "run/report.json"));
    const auto soc = nlohmann::json::parse(read_file(folder / "soc/soc.json"));
    EXPECT_EQ(soc["console"], "image " + run["image"]["crc32"].get<std::string>() + "\n");
    EXPECT_EQ(soc["status"], 0);
    EXPECT_GT(soc["instructions"], 250 * 150 * 3);
    EXPECT_NE(outcome.out.find(soc["console"].get<std::string>()), std::string::npos);
}

INSTANTIATE_TEST_SUITE_P(Designs, SmallRunBoot,
                         testing::Values("degs-64", "gscore-64", "gbu-64", "gcc-64"));

// Not SmallRuns: the address sanitizer does not know the stacks of SystemC, from which these end.
// addi x1, x0, 3; lui x2, 0x20000; sw x1, 4(x2); wfi. The store that ends the simulation does not
// retire.
TEST(FirmwareOfUsers, AStatusOfFirmwareIsAnError) {
    const Folder folder;
    write_bytes(folder / "three.elf", executable({0x00300093, 0x20000137, 0x00112223, 0x10500073}));
    const Outcome outcome = degs(boot("degs-16", {"--scene", kBootScene, "--firmware",
                                                  folder / "three.elf", "--out", folder / "out"}));
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.err, "degs: The firmware ended with status 3.\n");
    EXPECT_NE(outcome.out.find("ended with status 3 · 2 instructions"), std::string::npos)
        << outcome.out;
}

TEST(FirmwareOfUsers, FirmwareThatSleepsForEverIsAnError) {
    const Folder folder;
    write_bytes(folder / "sleep.elf", executable({0x10500073}));
    const Outcome outcome = degs(boot("degs-16", {"--scene", kBootScene, "--firmware",
                                                  folder / "sleep.elf", "--out", folder / "out"}));
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.err, "degs: The firmware waits for an interrupt that never comes.\n");
    EXPECT_NE(outcome.out.find("sleeps for ever · 1 instructions"), std::string::npos)
        << outcome.out;
}

/// What firmware of these instructions ends with.
void expect_end(const std::vector<std::uint32_t>& code, const std::vector<std::string>& more,
                const std::string& sentence) {
    const Folder folder;
    write_bytes(folder / "code.elf", executable(code));
    std::vector<std::string> words{"--scene",           kBootScene, "--firmware",
                                   folder / "code.elf", "--out",    folder / "out"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = degs(boot("degs-16", words));
    EXPECT_EQ(outcome.code, 2);
    EXPECT_EQ(outcome.err, "degs: " + sentence + "\n");
}

// An illegal word, ecall behind a nop, a jump to where no memory is (lui x1, 0x40000; jr x1).
TEST(FirmwareOfUsers, ATrapWithoutAVectorEndsTheRun) {
    expect_end(
        {0x00000000}, {},
        "The firmware has stopped: an illegal instruction (mcause 0x2) at 0x00000000, and no "
        "trap vector is set.");
    expect_end(
        {0x00000013, 0x00000073}, {},
        "The firmware has stopped: a call of the environment (mcause 0xb) at 0x00000004, and "
        "no trap vector is set.");
    expect_end({0x400000B7, 0x00008067}, {},
               "The firmware has stopped: no memory to execute (mcause 0x1) at 0x40000000, and no "
               "trap vector is set.");
}

// A jump to itself; csrw mtvec, x0 and an illegal word, whose handler is the program.
TEST(FirmwareOfUsers, FirmwareThatNeverEndsMeetsTheLimit) {
    for (const std::vector<std::uint32_t>& code :
         {std::vector<std::uint32_t>{0x0000006F}, std::vector<std::uint32_t>{0x30501073, 0}}) {
        expect_end(code, {"--limit-ms", "0.02"},
                   "The firmware has not ended after 0.0200 ms of simulated time, the limit; "
                   "--limit-ms sets another one.");
    }
}

TEST(HostileFirmware, IsRefusedInASentence) {
    const Folder folder;
    const auto refused = [&](const std::string& name, const std::vector<unsigned char>& bytes,
                             const std::string& sentence) {
        write_bytes(folder / name, bytes);
        expect_mistake(degs(boot("degs-16", {"--scene", kBootScene, "--firmware", folder / name})),
                       "degs: " + (folder / name) + sentence + "\n");
    };
    auto wide = executable({0x10500073});
    wide[EI_CLASS] = ELFCLASS64;
    auto large = executable({0x10500073});
    auto late = large;
    const std::size_t memory_size = sizeof(Elf32_Ehdr) + offsetof(Elf32_Phdr, p_memsz);
    large[memory_size + 2] = 2; // 0x20004 bytes
    late[offsetof(Elf32_Ehdr, e_entry)] = 4;
    refused("text", {'h', 'e', 'l', 'l', 'o'}, " is no ELF file.");
    refused("empty", {}, ": the file is empty.");
    refused("wide", wide,
            " is a program of 64 bits, and the core has 32: compile with -march=rv32im.");
    refused("large", large,
            " is too large: it takes memory up to address 131076, and the core has 131072 bytes of "
            "its own.");
    refused("late", late, " has no entry: no code lies where it says that it starts.");
    expect_mistake(
        degs(boot("degs-16", {"--scene", kBootScene, "--firmware", folder / "nowhere.elf"})),
        "nowhere.elf");
}

TEST(HostileFirmware, OptionsOfTheOtherPlatformAreRefused) {
    expect_mistake(degs(boot("degs-16", {"--scene", kBootScene, "--load", "5"})),
                   "degs: --load has no meaning with --cpu riscv, whose platform has the core and "
                   "the accelerator alone.\n");
    expect_mistake(degs({"soc", config("degs-16"), "--scene", kBootScene, "--firmware", "x.elf"}),
                   "degs: --firmware needs --cpu riscv.\n");
    expect_mistake(degs({"soc", config("degs-16"), "--scene", kBootScene, "--limit-ms", "1"}),
                   "degs: --limit-ms needs --cpu riscv.\n");
}

} // namespace
} // namespace degs::sim_test
