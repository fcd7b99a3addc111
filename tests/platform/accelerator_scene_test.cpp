// SPDX-License-Identifier: Apache-2.0
// degs::Accelerator with a trained scene in a platform's memory: the pixels are those of a closed
// job of the same configuration, which is what `degs run` renders.
#include "modules/degs/config.hpp"
#include "scene/scene.hpp"
#include "tests/platform/accelerator_bench.hpp"
#include "tests/scene/scene_fixture.hpp"
#include "tests/tlm/at_memory.hpp"

namespace degs::test {
namespace {

constexpr std::uint64_t kMiB = 1U << 20U;
constexpr std::uint64_t kSceneSh = 4 * kMiB, kSceneWorkspace = 8 * kMiB, kSceneFrame = 56 * kMiB;
constexpr std::uint64_t kSceneMemory = 64 * kMiB;

void put(const GaussianCloud& cloud, std::vector<unsigned char>& memory) {
    std::vector<unsigned char> geometry;
    std::vector<unsigned char> sh;
    encode_scene(cloud, geometry, sh);
    ASSERT_LE(geometry.size(), kSceneSh);
    ASSERT_LE(sh.size(), kSceneWorkspace - kSceneSh);
    std::copy(geometry.begin(), geometry.end(), memory.begin());
    std::copy(sh.begin(), sh.end(), memory.begin() + kSceneSh);
}

std::vector<unsigned char> pixels_in(const std::vector<unsigned char>& memory,
                                     const Camera& camera) {
    const auto begin = memory.begin() + kSceneFrame;
    return {begin, begin + camera.width * camera.height * 4};
}

TEST(AcceleratorOnATrainedScene, RendersTheImageOfAClosedJobThroughLtAndAt) {
    DEGS_NEEDS_SCENE("flowers-small");
    const Scene scene = load_scene((scenes() / "flowers-small" / "scene.ply").string());
    Camera camera = select_camera(scene, 2);
    constexpr int kShrink = 8;
    camera.width /= kShrink;
    camera.height /= kShrink;
    camera.fx /= kShrink;
    camera.fy /= kShrink;

    const DegsConfig config;
    const FrameWorkload workload =
        make_frame_workload(scene.cloud, camera, config.tile_size_px(), config.tile_mode());
    RenderJob job = make_render_job({&workload}, config);
    const Timebase time{ClockDomain(1.0), Fidelity::Exact};
    const auto engine = config.build("closed", time, job, {});

    Accelerator::Options four_phases;
    four_phases.memory.transport = Transport::At;
    PlainMemory lt_memory("lt_memory", kSceneMemory, Timing::Annotated);
    AtMemory at_memory("at_memory", kSceneMemory);
    at_memory.ending = Ending::Mixed;
    Platform lt("lt", config, scene.cloud, nullptr);
    Platform at("at", config, scene.cloud, nullptr, four_phases);
    lt.mem().bind(lt_memory.in);
    at.mem().bind(at_memory.in);
    put(scene.cloud, lt_memory.bytes);
    put(scene.cloud, at_memory.bytes);
    lt.host.script = at.host.script = [&](Host& host) {
        program(host, scene.cloud, camera, kSceneFrame);
        host.write_pair(Register::Sh, kSceneSh);
        host.write_pair(Register::Workspace, kSceneWorkspace);
        host.write_pair(Register::WorkspaceBytes, kSceneFrame - kSceneWorkspace);
        EXPECT_TRUE(host.render()) << "error " << host.read(Register::ErrorCode);
        EXPECT_EQ(host.read(Register::Dropped), 0U);
    };
    sc_core::sc_start();
    ASSERT_TRUE(lt.host.finished && at.host.finished);
    const std::vector<unsigned char> expected = rgba8(job.images.front());
    ASSERT_GT(std::count_if(expected.begin(), expected.end(), [](auto b) { return b != 0; }),
              static_cast<std::ptrdiff_t>(expected.size() / 4));
    EXPECT_EQ(pixels_in(lt_memory.bytes, camera), expected);
    EXPECT_EQ(pixels_in(at_memory.bytes, camera), expected);
}

// Eight transactions in flight per stream, each a naturally aligned power of two.
TEST(AcceleratorOnATrainedScene, AtTakesNearlyTheTimeOfAnnotatedLt) {
    DEGS_NEEDS_SCENE("flowers-small");
    const Scene scene = load_scene((scenes() / "flowers-small" / "scene.ply").string());
    Camera camera = select_camera(scene, 2);
    camera.width = 960;
    camera.height = 540;
    camera.fx /= 2;
    camera.fy /= 2;
    const DegsConfig config;
    Accelerator::Options four_phases;
    four_phases.memory.transport = Transport::At;
    four_phases.memory.outstanding = 1000;
    four_phases.memory.outstanding_per_stream = 8;
    four_phases.memory.burst_bytes = 256;
    PlainMemory lt_memory("lt_memory", kSceneMemory, Timing::Annotated);
    AtMemory at_memory("at_memory", kSceneMemory);
    at_memory.aligned_only = true;
    Platform lt("lt", config, scene.cloud, nullptr);
    Platform at("at", config, scene.cloud, nullptr, four_phases);
    lt.mem().bind(lt_memory.in);
    at.mem().bind(at_memory.in);
    put(scene.cloud, lt_memory.bytes);
    put(scene.cloud, at_memory.bytes);
    std::uint64_t lt_cycles = 0;
    std::uint64_t at_cycles = 0;
    const auto render = [&](std::uint64_t& cycles) {
        return [&](Host& host) {
            program(host, scene.cloud, camera, kSceneFrame);
            host.write_pair(Register::Sh, kSceneSh);
            host.write_pair(Register::Workspace, kSceneWorkspace);
            host.write_pair(Register::WorkspaceBytes, kSceneFrame - kSceneWorkspace);
            EXPECT_TRUE(host.render()) << "error " << host.read(Register::ErrorCode);
            cycles = host.read_pair(Register::Cycles);
        };
    };
    lt.host.script = render(lt_cycles);
    at.host.script = render(at_cycles);
    sc_core::sc_start();
    EXPECT_EQ(pixels_in(lt_memory.bytes, camera), pixels_in(at_memory.bytes, camera));
    EXPECT_GT(lt_cycles, 100000U);
    EXPECT_LE(at_cycles, lt_cycles + lt_cycles * 3 / 10);
}

} // namespace
} // namespace degs::test
