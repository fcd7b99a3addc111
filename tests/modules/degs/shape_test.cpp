// SPDX-License-Identifier: Apache-2.0
// The shape of the design space: more of anything does not hurt. Scheduling anomalies are real, so
// half a percent is allowed.
#include "tests/modules/degs/run_fixture.hpp"

namespace degs {
namespace {

using test::DegsRun;

/// Two medium frames: many small splats (memory and front end matter), fewer large ones (the array
/// does).
FrameWorkload medium_frame(bool large) {
    std::mt19937 random(large ? 21 : 22);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<ProjectedSplat> splats;
    for (int i = 0; i < (large ? 700 : 6000); ++i) {
        const double size = (large ? 5 : 0.8) * std::exp(1.2 * unit(random));
        splats.push_back(test::make_splat(352 * unit(random), 224 * unit(random),
                                          size * (1 + 2 * unit(random)), size, 6.3 * unit(random),
                                          0.05 + 0.9 * unit(random)));
    }
    return test::make_frame(splats, 352, 224, 32);
}

struct Change {
    const char* name;
    void (*apply)(DegsConfig& config);
};

std::ostream& operator<<(std::ostream& out, const Change& change) {
    return out << change.name;
}

class ShapeOfBuffers : public ::testing::TestWithParam<std::tuple<bool, Change>> {};

TEST_P(ShapeOfBuffers, HalfTheSizeIsNotFaster) {
    const FrameWorkload frame = medium_frame(std::get<0>(GetParam()));
    DegsConfig config;
    config.pixel_buffer.bytes *= 2; // two tile contexts, so that half is possible
    DegsConfig half = config;
    std::get<1>(GetParam()).apply(half);
    const DegsRun whole("whole", config, {&frame});
    const DegsRun halved("halved", half, {&frame});
    sc_core::sc_start();
    test::expect_sound(halved);
    EXPECT_TRUE(test::same_bytes(whole.image(), halved.image()));
    const auto cycles = static_cast<double>(whole.degs().finished());
    EXPECT_GE(static_cast<double>(halved.degs().finished()), 0.995 * cycles);
}

INSTANTIATE_TEST_SUITE_P(
    Halved, ShapeOfBuffers,
    ::testing::Combine(
        ::testing::Bool(),
        ::testing::Values(
            Change{"gaussian_buffer", [](DegsConfig& c) { c.gaussian_buffer.bytes /= 2; }},
            Change{"span_buffer", [](DegsConfig& c) { c.span_buffer.bytes /= 2; }},
            Change{"packing", [](DegsConfig& c) { c.packing.bytes /= 2; }},
            Change{"feature_buffer", [](DegsConfig& c) { c.feature_buffer.bytes /= 2; }},
            Change{"pixel_buffer", [](DegsConfig& c) { c.pixel_buffer.bytes /= 2; }},
            Change{"queue", [](DegsConfig& c) { c.scheduler.queue_segments_per_pe /= 2; }},
            Change{"crossbar", [](DegsConfig& c) { c.span.crossbar_depth /= 2; }},
            Change{"records_in_flight", [](DegsConfig& c) { c.fetching.chunks_in_flight /= 2; }},
            Change{"geometry_in_flight", [](DegsConfig& c) { c.projection.chunks_in_flight /= 2; }},
            Change{"writes_in_flight", [](DegsConfig& c) { c.binning.writes_in_flight /= 2; }})),
    [](const auto& pair) {
        return std::string(std::get<1>(pair.param).name) +
               (std::get<0>(pair.param) ? "_large" : "_small");
    });

/// A run for each of `values`, to which `apply` sets the default design.
template <class Value, class Apply>
std::vector<std::unique_ptr<DegsRun>> run_series(const FrameWorkload& frame,
                                                 const std::vector<Value>& values, Apply apply) {
    std::vector<std::unique_ptr<DegsRun>> runs;
    for (const Value value : values) {
        DegsConfig config;
        apply(config, value);
        runs.push_back(std::make_unique<DegsRun>("degs" + std::to_string(runs.size()), config,
                                                 std::vector<const FrameWorkload*>{&frame}));
    }
    sc_core::sc_start();
    return runs;
}

class ShapeOfPacking : public ::testing::TestWithParam<bool> {};

// Where the bytes decide how many segments wait, 1 to 300 per bank here, time falls with them until
// they stop to matter.
TEST_P(ShapeOfPacking, TimeFollowsTheBytes) {
    const FrameWorkload frame = medium_frame(GetParam());
    const std::vector<int> bytes{3200, 3296, 3456, 3840, 4608, 6144, 12288, 32768};
    const auto runs = run_series(frame, bytes, [](DegsConfig& config, int size) {
        config.scheduler.queue_segments_per_pe = 0;
        config.packing.bytes = size;
        config.packing.lead_packets = 3;
        config.scheduler.scan = DomainScan::Oldest;
    });
    const auto cycles = [&runs](std::size_t i) {
        return static_cast<double>(runs[i]->degs().finished());
    };
    for (std::size_t i = 1; i < runs.size(); ++i) {
        EXPECT_LE(cycles(i), 1.005 * cycles(i - 1)) << bytes[i];
        EXPECT_TRUE(test::same_bytes(runs[0]->image(), runs[i]->image()));
    }
    EXPECT_LT(cycles(3), 0.95 * cycles(0));
    EXPECT_NEAR(cycles(runs.size() - 1), cycles(runs.size() - 2), 0.005 * cycles(0));
}

INSTANTIATE_TEST_SUITE_P(Frames, ShapeOfPacking, ::testing::Bool(),
                         [](const auto& large) { return large.param ? "large" : "small"; });

class ShapeOfMemory : public ::testing::TestWithParam<bool> {};

// Time falls with bandwidth until something else limits, and never under the time of the bytes.
TEST_P(ShapeOfMemory, TimeFollowsTheBandwidth) {
    const FrameWorkload frame = medium_frame(GetParam());
    const std::vector<double> bandwidths{1, 2, 4, 8, 16, 51.2, 102.4, 204.8};
    const auto runs = run_series(frame, bandwidths, [](DegsConfig& config, double bandwidth) {
        config.memory.bandwidth_gb_per_s = bandwidth;
    });
    for (std::size_t i = 0; i < runs.size(); ++i) {
        const auto cycles = static_cast<double>(runs[i]->degs().finished());
        const MemoryStreams::Traffic traffic = runs[i]->degs().streams().total();
        const AcceleratorResult result = runs[i]->result();
        const double busy_ns = // at 1 GHz
            result.memory_utilization * static_cast<double>(result.memory_window);
        EXPECT_GE(cycles, busy_ns);
        EXPECT_NEAR(busy_ns * bandwidths[i],
                    static_cast<double>(traffic.bytes_read + traffic.bytes_written), 1);
        if (i != 0) {
            EXPECT_LE(cycles, 1.005 * static_cast<double>(runs[i - 1]->degs().finished()));
        }
    }
    // At 1 GB/s the bus is what limits.
    EXPECT_GT(runs[0]->result().memory_utilization, 0.8);
}

INSTANTIATE_TEST_SUITE_P(Frames, ShapeOfMemory, ::testing::Bool(),
                         [](const auto& large) { return large.param ? "large" : "small"; });

} // namespace
} // namespace degs
