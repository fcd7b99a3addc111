// SPDX-License-Identifier: Apache-2.0
// Every accelerator of the project behind the registers of degs::Accelerator.
#include <algorithm>
#include <iterator>
#include <utility>

#include "baselines/accelerators.hpp"
#include "config/config_source.hpp"
#include "dram/lpddr5.hpp"
#include "tests/baselines/engine_run.hpp"
#include "tests/platform/accelerator_bench.hpp"

namespace degs {
/// Becomes part of the test's name.
inline void PrintTo(const AcceleratorKind& kind, std::ostream* out) {
    *out << kind.name;
}
} // namespace degs

namespace degs::test {
namespace {

class SmallRunFace : public ::testing::TestWithParam<AcceleratorKind> {
protected:
    std::unique_ptr<AcceleratorConfig> config = GetParam().make();
    GaussianCloud cloud = test_cloud(3, 200, 2);
    // Several tiles in both directions, also of GCC, whose views are 128 px wide.
    Camera camera = test_camera(200, 150);
    Camera second = test_camera(70, 140);

    FrameWorkload workload(const Camera& view) const {
        return make_frame_workload(cloud, view, config->tile_size_px(), config->tile_mode());
    }
};

TEST_P(SmallRunFace, RendersTheFramesOfClosedJobs) {
    Platform p("accelerator", *config, cloud);
    second.position.x = 1;
    const FrameWorkload first_work = workload(camera);
    const FrameWorkload second_work = workload(second);
    const EngineRun first("first", *config, {&first_work});
    const EngineRun other("other", *config, {&second_work});
    std::vector<std::vector<unsigned char>> frames;
    std::vector<std::uint64_t> cycles;
    p.host.script = [&](Host& host) {
        for (int frame = 0; frame < 4; ++frame) {
            const Camera& view = frame % 2 == 0 ? camera : second;
            program(host, cloud, view);
            EXPECT_TRUE(host.render());
            frames.push_back(p.frame(view));
            cycles.push_back(host.read_pair(Register::Cycles));
        }
    };
    sc_core::sc_start();
    ASSERT_TRUE(p.host.finished);
    EXPECT_EQ(frames[0], rgba8(first.image()));
    EXPECT_EQ(frames[1], rgba8(other.image()));
    EXPECT_EQ(frames[2], frames[0]);
    EXPECT_EQ(frames[3], frames[1]);
    EXPECT_EQ(p.memory->refused, 0U);
}

TEST_P(SmallRunFace, RendersTheSameBytesOnLpddr5) {
    Platform plain("plain", *config, cloud, Timing::Immediate);
    Platform p("accelerator", *config, cloud, nullptr);
    dram::Lpddr5 memory("lpddr5", dram::Config(), Timebase(), 1);
    p.mem().bind(memory.in[0]);
    const auto debug = [&](tlm::tlm_command command, std::uint64_t address,
                           std::vector<unsigned char>& bytes) {
        tlm::tlm_generic_payload payload;
        payload.set_command(command);
        payload.set_address(address);
        payload.set_data_ptr(bytes.data());
        payload.set_data_length(static_cast<unsigned int>(bytes.size()));
        EXPECT_EQ(p.accelerator.mem->transport_dbg(payload), bytes.size());
    };
    std::vector<unsigned char> pixels(200 * 150 * 4);
    std::uint64_t cycles = 0;
    std::uint64_t plain_cycles = 0;
    p.host.script = [&](Host& host) {
        std::vector<unsigned char> scene(plain.memory->bytes.begin(),
                                         plain.memory->bytes.begin() + kWorkspace);
        debug(tlm::TLM_WRITE_COMMAND, 0, scene);
        program(host, cloud, camera);
        EXPECT_TRUE(host.render());
        cycles = host.read_pair(Register::Cycles);
        debug(tlm::TLM_READ_COMMAND, kFrame, pixels);
    };
    plain.host.script = [&](Host& host) {
        program(host, cloud, camera);
        EXPECT_TRUE(host.render());
        plain_cycles = host.read_pair(Register::Cycles);
    };
    sc_core::sc_start();
    ASSERT_TRUE(p.host.finished && plain.host.finished);
    EXPECT_EQ(pixels, plain.frame(camera));
    EXPECT_GT(cycles, plain_cycles);
}

TEST_P(SmallRunFace, TouchesNothingOutsideItsRegions) {
    Platform p("accelerator", *config, test_cloud(4, 1, 0));
    cloud = test_cloud(4, 1, 0); // far shorter than any request of a block
    bool inside = true;
    const std::vector<unsigned char> before = p.memory->bytes;
    const std::pair<std::uint64_t, std::uint64_t> regions[] = {{0, 4 * kFloatGeometryBytes},
                                                               {kSh, 4 * 3 * kFloatBytes},
                                                               {kWorkspace, 3 * 4096},
                                                               {kFrame, 200 * 150 * 4}};
    p.memory->on_range = [&](std::uint64_t address, std::uint64_t bytes) {
        const bool own = std::any_of(std::begin(regions), std::end(regions), [&](const auto& r) {
            return address >= r.first && address + bytes <= r.first + r.second;
        });
        EXPECT_TRUE(own) << bytes << " B at " << address;
    };
    p.host.script = [&](Host& host) {
        program(host, cloud, camera);
        host.write_pair(Register::WorkspaceBytes, 3 * 4096);
        EXPECT_TRUE(host.render());
    };
    sc_core::sc_start();
    ASSERT_TRUE(p.host.finished);
    for (std::size_t i = 0; i < before.size(); ++i) {
        const bool own = (i >= kWorkspace && i < kWorkspace + 3 * 4096) ||
                         (i >= kFrame && i < kFrame + 200 * 150 * 4);
        inside = inside && (own || before[i] == p.memory->bytes[i]);
    }
    EXPECT_TRUE(inside);
}

// The records lie elsewhere: pixels and bytes are the same. GCC writes no splat records.
TEST_P(SmallRunFace, OrderOfRecordsMovesAddressesOnly) {
    const std::unique_ptr<AcceleratorConfig> morton = GetParam().make();
    ConfigSource::from_overrides({"memory.model=lpddr5", "memory.layout=morton"})
        .read([&](ConfigVisitor& visitor) { morton->describe(visitor); });
    Platform first("first", *config, cloud);
    Platform second_platform("second", *morton, cloud);
    using Ranges = std::vector<std::pair<std::uint64_t, std::uint64_t>>;
    Ranges ranges[2];
    std::uint64_t bytes[2] = {0, 0};
    Platform* const platforms[] = {&first, &second_platform};
    for (std::size_t i = 0; i < 2; ++i) {
        platforms[i]->memory->on_range = [&ranges, i](std::uint64_t address, std::uint64_t size) {
            ranges[i].emplace_back(address, size);
        };
        platforms[i]->host.script = [this, &bytes, i](Host& host) {
            program(host, cloud, camera);
            EXPECT_TRUE(host.render());
            bytes[i] = host.read_pair(Register::BytesRead) + host.read_pair(Register::BytesWritten);
        };
    }
    sc_core::sc_start();
    ASSERT_TRUE(first.host.finished && second_platform.host.finished);
    EXPECT_EQ(first.frame(camera), second_platform.frame(camera));
    EXPECT_EQ(bytes[0], bytes[1]);
    for (Ranges& each : ranges) { // the two may be served in another order at equal dates
        std::sort(each.begin(), each.end());
    }
    EXPECT_EQ(ranges[0] == ranges[1], std::string(GetParam().name) == "gcc");
}

INSTANTIATE_TEST_SUITE_P(Kinds, SmallRunFace, ::testing::ValuesIn(accelerator_kinds()),
                         [](const auto& kind) { return std::string(kind.param.name); });

} // namespace
} // namespace degs::test
