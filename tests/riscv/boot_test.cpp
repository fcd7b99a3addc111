// SPDX-License-Identifier: Apache-2.0
// examples/riscv as a user calls it: the driver on a core, against the accelerator.
#include <chrono>
#include <cstddef>
#include <cstdio>
#include <cstring>
#include <elf.h>
#include <regex>

#include "tests/riscv/elf_file.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

const std::string kBootScene = "synthetic:object,gaussians=2000";

Outcome boot(const std::string& design, const std::string& scene, const std::string& firmware,
             const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{config(design), scene, firmware};
    words.insert(words.end(), more.begin(), more.end());
    return outcome_of(RISCV_PROGRAM, words);
}

/// What a platform says that renders nothing: one sentence, which contains `words`.
void expect_refused(const Outcome& outcome, const std::string& words) {
    EXPECT_EQ(outcome.code, 1);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err.find('\n'), outcome.err.size() - 1) << outcome.err;
    EXPECT_NE(outcome.err.find(words), std::string::npos) << outcome.err;
}

void write_bytes(const std::string& path, const std::vector<unsigned char>& bytes) {
    std::ofstream file(path, std::ios::binary);
    file.write(reinterpret_cast<const char*>(bytes.data()), std::streamsize(bytes.size()));
}

/// An executable for the core that has these instructions at address 0.
std::vector<unsigned char> executable(const std::vector<std::uint32_t>& code) {
    std::vector<unsigned char> bytes(4 * code.size());
    std::memcpy(bytes.data(), code.data(), bytes.size());
    return rv32::test::elf_file(0, bytes, static_cast<std::uint32_t>(bytes.size()));
}

class SmallRunBoot : public testing::TestWithParam<const char*> {};

/// The view is a window, whose registers the firmware sets, too.
TEST_P(SmallRunBoot, PrintsTheChecksumOfARun) {
    if (!fs::exists(RISCV_FIRMWARE)) {
        GTEST_SKIP() << "the build had no riscv64-unknown-elf-gcc";
    }
    const Folder folder; // of floats, as memory holds them; generated scenes have doubles
    const std::string scene = folder / "scene.ply";
    expect_success(degs({"scene", "generate", "object", "--gaussians", "2000", "--out", scene}));
    const std::string crop = "237,170,250x150";
    const auto begin = std::chrono::steady_clock::now();
    const Outcome outcome =
        boot(GetParam(), scene, RISCV_FIRMWARE, {"--lpddr5", "--crop", crop, "1"});
    const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - begin;
    expect_success(outcome);
    EXPECT_LT(taken.count(), 60) << "seconds";
    std::printf("the platform took %.1f s\n", taken.count());
    expect_success(degs({"run", config(GetParam()), "--scene", scene, "--camera", "1", "--crop",
                         crop, "--no-reference", "--out", folder / "run"}));
    const std::string image = report_in(folder / "run")["image"]["crc32"];
    EXPECT_EQ(outcome.out.rfind("image " + image + "\n", 0), 0U) << outcome.out;
    EXPECT_EQ(outcome.out.find("image", 1), std::string::npos) << outcome.out;
    std::smatch instructions;
    ASSERT_TRUE(std::regex_search(outcome.out, instructions, std::regex("(\\d+) instructions")));
    EXPECT_GT(std::stoul(instructions[1]), 250 * 150 * 3);
}

INSTANTIATE_TEST_SUITE_P(Designs, SmallRunBoot,
                         testing::Values("degs-64", "gscore-64", "gbu-64", "gcc-64"));

/// What firmware of these instructions ends with.
Outcome end_of(const std::vector<std::uint32_t>& code, const std::vector<std::string>& more = {}) {
    const Folder folder;
    write_bytes(folder / "code.elf", executable(code));
    return boot("degs-16", kBootScene, folder / "code.elf", more);
}

void expect_end(const Outcome& outcome, const std::string& sentence) {
    EXPECT_EQ(outcome.code, 1);
    EXPECT_EQ(outcome.err, sentence + "\n");
}

// Not SmallRuns: the address sanitizer does not know the stacks of SystemC, from which these end.
// addi x1, x0, 3; lui x2, 0x20000; sw x1, 4(x2); wfi. The store that ends the simulation does not
// retire.
TEST(FirmwareOfUsers, AStatusOfFirmwareIsAnError) {
    const Outcome outcome = end_of({0x00300093, 0x20000137, 0x00112223, 0x10500073});
    expect_end(outcome, "The firmware ended with status 3.");
    EXPECT_NE(outcome.out.find("\n2 instructions"), std::string::npos) << outcome.out;
}

TEST(FirmwareOfUsers, FirmwareThatSleepsForEverIsAnError) {
    const Outcome outcome = end_of({0x10500073});
    expect_end(outcome, "The firmware waits for an interrupt that never comes.");
    EXPECT_EQ(outcome.out.rfind("1 instructions", 0), 0U) << outcome.out;
}

// An illegal word, ecall behind a nop, a jump to where no memory is (lui x1, 0x40000; jr x1).
TEST(FirmwareOfUsers, ATrapWithoutAVectorEndsTheRun) {
    expect_end(
        end_of({0x00000000}),
        "The firmware has stopped: an illegal instruction (mcause 0x2) at 0x00000000, and no "
        "trap vector is set.");
    expect_end(
        end_of({0x00000013, 0x00000073}),
        "The firmware has stopped: a call of the environment (mcause 0xb) at 0x00000004, and "
        "no trap vector is set.");
    expect_end(end_of({0x400000B7, 0x00008067}),
               "The firmware has stopped: no memory to execute (mcause 0x1) at 0x40000000, and no "
               "trap vector is set.");
}

// A jump to itself; csrw mtvec, x0 and an illegal word, whose handler is the program.
TEST(FirmwareOfUsers, FirmwareThatNeverEndsMeetsTheLimit) {
    for (const std::vector<std::uint32_t>& code :
         {std::vector<std::uint32_t>{0x0000006F}, std::vector<std::uint32_t>{0x30501073, 0}}) {
        expect_end(end_of(code, {"--limit-ms", "0.02"}),
                   "The firmware has not ended after 0.02 ms of simulated time, the limit; "
                   "--limit-ms sets another one.");
    }
}

TEST(HostileFirmware, IsRefusedInASentence) {
    const Folder folder;
    const auto refused = [&](const std::string& name, const std::vector<unsigned char>& bytes,
                             const std::string& sentence) {
        write_bytes(folder / name, bytes);
        expect_refused(boot("degs-16", kBootScene, folder / name),
                       (folder / name) + sentence + "\n");
    };
    auto wide = executable({0x10500073});
    wide[EI_CLASS] = ELFCLASS64;
    auto large = executable({0x10500073});
    auto late = large;
    const std::size_t memory_size = sizeof(Elf32_Ehdr) + offsetof(Elf32_Phdr, p_memsz);
    large[memory_size + 2] = 2; // 0x20004 bytes
    late[offsetof(Elf32_Ehdr, e_entry)] = 4;
    refused("text", {'h', 'e', 'l', 'l', 'o'}, " is no ELF file.");
    refused("empty", {}, " is no ELF file.");
    refused("wide", wide,
            " is a program of 64 bits, and the core has 32: compile with -march=rv32im.");
    refused("large", large,
            " is too large: it takes memory up to address 131076, and the core has 131072 bytes of "
            "its own.");
    refused("late", late, " has no entry: no code lies where it says that it starts.");
    for (const char* const missing : {"nowhere.elf", ""}) { // the latter is the folder itself
        expect_refused(boot("degs-16", kBootScene, folder / missing),
                       (folder / missing) + " is no file that can be read.\n");
    }
}

TEST(HostileFirmware, WordsThatMakeNoSenseAreRefused) {
    const Folder folder;
    const std::string firmware = folder / "sleep.elf";
    write_bytes(firmware, executable({0x10500073}));
    const auto refused = [&](const std::vector<std::string>& more, const std::string& words) {
        SCOPED_TRACE(more.front());
        expect_refused(boot("degs-16", kBootScene, firmware, more), words);
    };
    for (const char* const word : {"--load", "--memory", "first", "-1", ""}) {
        refused({word}, "usage: riscv ");
    }
    for (const char* const limit : {"0", "1s", "nan", "1e10", ""}) {
        refused({"--limit-ms", limit}, "usage: riscv ");
    }
    for (const char* const crop : {"0,0,8x0", "0,0,8x8x", "-1,0,8x8", "8x8"}) {
        refused({"--crop", crop}, "usage: riscv ");
    }
    for (const char* const crop : {"1,0,640x480", "0,1,640x480", "0,2147483647,1x1"}) {
        refused({"--crop", crop}, "--crop leaves the image of 640x480 pixels.\n");
    }
    refused({"99"}, "The scene has no camera 99.\n");
    refused(std::vector<std::string>(17, "0"), "The firmware renders at most 16 views.\n");
}

} // namespace
} // namespace degs::sim_test
