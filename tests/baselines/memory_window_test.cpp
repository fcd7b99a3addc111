// SPDX-License-Identifier: Apache-2.0
// Bytes, time and peak bandwidth of a report belong together: no memory transfers more than its
// peak allows, and every byte of a request is somewhere.
#include "baselines/gscore/config.hpp"
#include "tests/baselines/engine_run.hpp"
#include "tests/baselines/gcc/gcc_run.hpp"

namespace degs {
namespace {

using test::EngineRun;

std::uint64_t bytes_of(const AcceleratorResult& result) {
    std::uint64_t bytes = 0;
    for (const StreamUse& stream : result.streams) {
        bytes += stream.bytes_read + stream.bytes_written;
    }
    return bytes;
}

/// Bytes that the peak bandwidth allows in the window, at 1 GHz.
double capacity(const AcceleratorResult& result) {
    return result.memory_gb_per_s * static_cast<double>(result.memory_window);
}

/// `on_bus` of the bytes of a result at 1 GHz went over the bus.
void expect_within_peak(const AcceleratorResult& result, std::uint64_t on_bus) {
    EXPECT_NEAR(result.memory_utilization, static_cast<double>(on_bus) / capacity(result), 1e-12);
    EXPECT_LE(result.memory_utilization, 1.0);
    EXPECT_GE(result.memory_window, result.cycles);
}

// The image is background and fits the write queues: the frame ends when they have it, before most
// of it has gone.
TEST(SmallRunMemoryWindow, PostedWritesAreQueuedNotTransferred) {
    gcc::Config config = test::gcc_of(64);
    config.memory.model = MemoryModel::Lpddr5;
    FrameWorkload frame = test::make_frame({}, 33, 140, config.tile_size_px());
    frame.gaussians = 1; // that nobody sees
    const EngineRun run("gcc", config, {&frame});
    sc_core::sc_start();
    run.expect_sound();
    const AcceleratorResult result = run.result();
    const dram::TransferAccount bytes = result.dram_transfers.value();
    EXPECT_EQ(bytes.total(), bytes_of(result));
    EXPECT_GT(bytes.queued, bytes.on_bus);
    EXPECT_GT(static_cast<double>(bytes.total()), capacity(result))
        << "of interest is what differs";
    expect_within_peak(result, bytes.on_bus);
}

/// Many long lists that nobody needs to the end.
FrameWorkload opaque_frame(int tile_size) {
    std::vector<ProjectedSplat> splats(5, test::blanket(32, 32, 1e3, 0.98));
    splats.resize(1500, test::blanket(32, 32, 30, 0.5));
    return test::make_frame(splats, 64, 64, tile_size);
}

// Splats of cancelled tiles are still on their way when the last pixel is in memory.
TEST(MemoryWindow, ReadsOfCancelledTilesProlongIt) {
    gscore::Config config;
    config.memory.model = MemoryModel::Lpddr5;
    config.traffic.burst_bytes = 4096;
    const FrameWorkload frame = opaque_frame(config.tile_size_px());
    const EngineRun run("gscore", config, {&frame});
    gscore::Config on_bus = config;
    on_bus.memory.model = MemoryModel::Bus;
    on_bus.memory.latency_ns = 0;
    on_bus.memory.bandwidth_gb_per_s = 20;
    const EngineRun bus("bus", on_bus, {&frame});
    sc_core::sc_start();
    run.expect_sound();
    bus.expect_sound();
    const AcceleratorResult result = run.result();
    EXPECT_GT(result.tiles_cancelled, 0U);
    EXPECT_GT(result.memory_window, result.cycles);
    expect_within_peak(result, result.dram_transfers.value().on_bus);
    expect_within_peak(bus.result(), bytes_of(bus.result()));
}

// 9.29289 GHz are 107.61 ps, simulated as 108.
TEST(SmallRunMemoryWindow, CountsCyclesAsTheyWereSimulated) {
    gscore::Config config;
    config.clock_ghz = 9.29289;
    config.memory.bandwidth_gb_per_s = 0.05;
    const FrameWorkload frame = test::random_frame(3, 40, 30, config.tile_size_px(), 60);
    const EngineRun run("gscore", config, {&frame});
    sc_core::sc_start();
    const AcceleratorResult result = run.result();
    const double window_ns = static_cast<double>(result.memory_window) * 0.108;
    EXPECT_NEAR(result.memory_utilization,
                static_cast<double>(bytes_of(result)) / (0.05 * window_ns), 1e-9);
    EXPECT_GT(result.memory_utilization, 0.99);
    EXPECT_LE(result.memory_utilization, 1.0);
}

} // namespace
} // namespace degs
