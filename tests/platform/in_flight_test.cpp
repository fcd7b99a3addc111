// SPDX-License-Identifier: Apache-2.0
// The bound on LT transactions that are not answered yet.
#include "modules/degs/config.hpp"
#include "platform/in_flight.hpp"
#include "tests/platform/accelerator_bench.hpp"
#include "tests/tlm/script.hpp"

namespace degs::test {
namespace {

sc_core::sc_time nanoseconds(double value) {
    return {value, sc_core::SC_NS};
}

TEST(InFlight, AdmitsWhenTheOldestHasEnded) {
    InFlight two(2);
    EXPECT_EQ(two.admit(nanoseconds(5)), nanoseconds(5));
    two.add(nanoseconds(30));
    EXPECT_EQ(two.admit(nanoseconds(5)), nanoseconds(5));
    two.add(nanoseconds(20));
    EXPECT_EQ(two.admit(nanoseconds(6)), nanoseconds(20)) << "the one that ends first";
    EXPECT_EQ(two.admit(nanoseconds(20)), nanoseconds(20));
    two.add(nanoseconds(40));
    EXPECT_EQ(two.admit(nanoseconds(21)), nanoseconds(30));
    EXPECT_FALSE(InFlight(0).bounded());
}

/// Dates of accesses, and how many of them are under way at a time.
struct Dates {
    std::vector<sc_core::sc_time> begun;
    void watch(PlainMemory& memory) {
        memory.on_access = [this](std::uint64_t) { begun.push_back(sc_core::sc_time_stamp()); };
    }
    std::size_t most_at_once(const sc_core::sc_time& latency) const {
        std::size_t most = 0, oldest = 0;
        for (std::size_t i = 0; i < begun.size(); ++i) {
            while (begun[oldest] + latency <= begun[i]) {
                ++oldest;
            }
            most = std::max(most, i - oldest + 1);
        }
        return most;
    }
};

// 4 KiB in bursts of 64 B: a round of `bound` bursts takes the latency, and up to a cycle more,
// because bursts go out half a cycle after an edge.
class SmallRunInFlight : public ::testing::TestWithParam<unsigned> {};

TEST_P(SmallRunInFlight, BoundedAccessesTakeALatencyPerRound) {
    const unsigned bound = GetParam();
    const Timebase time;
    PlainMemory memory("memory", 8192, Timing::Annotated);
    MemoryGateway::Options options;
    options.burst_bytes = 64;
    options.lt_outstanding = bound;
    MemoryGateway gateway("gateway", options);
    MemoryPort port("port", time);
    gateway.out.bind(memory.in);
    gateway.connect({{&port, {"geometry", StreamData::Own, ""}}});
    Dates dates;
    dates.watch(memory);
    const Script script("script", [&] {
        Process process(time);
        port.read(process, 0, 4096);
    });
    sc_core::sc_start();
    ASSERT_EQ(dates.begun.size(), 64U);
    EXPECT_EQ(dates.most_at_once(memory.latency), bound);
    const double rounds = 64.0 / bound;
    const sc_core::sc_time took = dates.begun.back() + memory.latency - dates.begun.front();
    EXPECT_GE(took, nanoseconds(50 * rounds));
    EXPECT_LE(took, nanoseconds(51 * rounds));
}
INSTANTIATE_TEST_SUITE_P(Bounds, SmallRunInFlight, ::testing::Values(1U, 4U, 64U));

class SmallRunBoundedFrames : public ::testing::TestWithParam<Pacing> {};

// A bounded frame has the same pixels and takes longer, and never has more in flight.
TEST_P(SmallRunBoundedFrames, HaveTheSamePixels) {
    const GaussianCloud cloud = test_cloud();
    const Camera camera = test_camera();
    Accelerator::Options free;
    free.memory.burst_bytes = 64;
    free.memory.pacing = GetParam();
    Accelerator::Options few = free;
    few.memory.lt_outstanding = 3;
    const DegsConfig config;
    const auto memory = [](const char* name) {
        return std::make_unique<PlainMemory>(name, kMemoryBytes, Timing::Annotated);
    };
    Platform a("a", config, cloud, memory("a_memory"), free);
    Platform b("b", config, cloud, memory("b_memory"), few);
    Dates dates;
    dates.watch(*b.memory);
    std::uint64_t cycles[2] = {};
    Platform* const platforms[] = {&a, &b};
    for (int i = 0; i < 2; ++i) {
        platforms[i]->host.script = [&, i](Host& host) {
            program(host, cloud, camera);
            EXPECT_TRUE(host.render());
            cycles[i] = host.read_pair(Register::Cycles);
        };
    }
    sc_core::sc_start();
    ASSERT_TRUE(a.host.finished && b.host.finished);
    EXPECT_EQ(a.frame(camera), b.frame(camera));
    EXPECT_EQ(a.memory->accesses, b.memory->accesses);
    EXPECT_GT(cycles[1], cycles[0]);
    if (GetParam() == Pacing::Exact) {
        EXPECT_EQ(dates.most_at_once(b.memory->latency), 3U);
    }
}
INSTANTIATE_TEST_SUITE_P(Pacings, SmallRunBoundedFrames,
                         ::testing::Values(Pacing::Exact, Pacing::Annotated),
                         [](const auto& pacing) {
                             return pacing.param == Pacing::Exact ? "Exact" : "Annotated";
                         });

} // namespace
} // namespace degs::test
