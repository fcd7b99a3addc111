// SPDX-License-Identifier: Apache-2.0
// What is counted of the streams of an accelerator.
#include "modules/kit/memory/memory_streams.hpp"

#include <gtest/gtest.h>

namespace degs {
namespace {

/// A memory whose initiators have the traffic that a test sets.
class ToldMemory : public MainMemory {
public:
    explicit ToldMemory(std::vector<MemoryTraffic> told) : told_(std::move(told)) {}
    void connect(const std::vector<MemoryStream>& /*streams*/) override {}
    MemoryTraffic traffic(std::size_t initiator) const override { return told_[initiator]; }
    double peak_gb_per_s() const override { return 0; }
    std::vector<std::string> explain() const override { return {}; }

private:
    std::vector<MemoryTraffic> told_;
};

// Two initiators write pixels and read some back; a third one carries lists.
TEST(MemoryStreams, InitiatorsOfOneNameAreOneStream) {
    const StreamKind pixels{"pixels", StreamData::Own, "Pixels."};
    const StreamKind lists{"lists", StreamData::Own, "Lists."};
    const Timebase time;
    MemoryPort first("first", time), second("second", time), third("third", time);
    MemoryStreams streams;
    streams.connect(first, pixels);
    streams.connect(second, lists);
    streams.connect(third, pixels);
    ToldMemory memory({{1, 20, 300, 4000}, {7, 7, 7, 7}, {5, 60, 700, 8000}});
    BuildOptions options;
    options.memory = &memory;
    const MainMemoryConfig config;
    streams.build("memory", config, time, options);
    AcceleratorResult result;
    streams.collect(result);
    ASSERT_EQ(result.streams.size(), 2U);
    const StreamUse& both = result.streams[0];
    EXPECT_EQ(both.name, "pixels");
    EXPECT_EQ(both.bytes_read, 1000U);
    EXPECT_EQ(both.bytes_written, 12000U);
    EXPECT_EQ(both.requests, 86U);
    EXPECT_EQ(result.streams[1].bytes_written, 7U);
    EXPECT_EQ(result.streams[1].requests, 14U);
    EXPECT_EQ(streams.total().writes, 87U);
}

} // namespace
} // namespace degs
