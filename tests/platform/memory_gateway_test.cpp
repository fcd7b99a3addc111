// SPDX-License-Identifier: Apache-2.0
// The memory of a platform as an accelerator sees it.
#include "tests/platform/accelerator_bench.hpp"
#include "tests/tlm/script.hpp"

namespace degs::test {
namespace {

/// Two streams whose names say nothing, on a memory that holds bytes of 0xA5.
class SmallRunMemoryGateway : public ::testing::Test {
protected:
    Timebase time;
    PlainMemory memory{"memory", 4096, Timing::Annotated};
    MemoryPort first{"first", time}, second{"second", time};
    MemoryGateway gateway{"gateway"};
    std::vector<std::uint64_t> seen; ///< addresses that the observer was called with

    void run(const std::function<void(Process&)>& body) {
        gateway.out.bind(memory.in);
        gateway.observe_scene(
            [this](std::uint64_t address, const unsigned char* data, std::uint64_t) {
                seen.push_back(address);
                EXPECT_EQ(data[0], 0xA5);
            });
        gateway.connect({{&first, {"records", StreamData::Scene, ""}},
                         {&second, {"geometry", StreamData::Own, ""}}});
        Script script("script", [&] {
            Process process(time);
            body(process);
        });
        sc_core::sc_start();
    }
};

TEST_F(SmallRunMemoryGateway, OnlyStreamsThatCarryTheSceneAreObserved) {
    run([this](Process& process) {
        first.read(process, 64, 32);
        second.read(process, 128, 32);
        second.write(process, 256, 32);
    });
    EXPECT_EQ(seen, (std::vector<std::uint64_t>{64}));
}

TEST_F(SmallRunMemoryGateway, CountsByInitiatorAndSaysThatItKnowsNoMore) {
    run([this](Process& process) {
        first.read(process, 64, 32);
        first.read(process, 96, 16);
        second.write(process, 256, 8);
    });
    EXPECT_EQ(gateway.traffic(0).reads, 2U);
    EXPECT_EQ(gateway.traffic(0).bytes_read, 48U);
    EXPECT_EQ(gateway.traffic(1).bytes_written, 8U);
    EXPECT_EQ(gateway.total().writes, 1U);
    EXPECT_EQ(gateway.peak_gb_per_s(), 0);
    ASSERT_EQ(gateway.explain().size(), 1U);
    EXPECT_NE(gateway.explain().front().find("belongs to the platform"), std::string::npos);
}

} // namespace
} // namespace degs::test
