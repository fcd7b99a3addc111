// SPDX-License-Identifier: Apache-2.0
// The keys of the end of a frame: how fast background is written, and how late its end is known.
#include "modules/degs/config.hpp"
#include "tests/platform/accelerator_bench.hpp"

namespace degs::test {
namespace {

/// Cycles of one frame, by number of platform.
class SmallRunFrameEnd : public ::testing::Test {
protected:
    GaussianCloud cloud = test_cloud();
    Camera camera = test_camera();
    std::vector<std::unique_ptr<Platform>> platforms;
    std::vector<std::uint64_t> cycles;

    void run(const std::vector<FrameEndConfig>& ends) {
        cycles.resize(ends.size());
        for (std::size_t i = 0; i < ends.size(); ++i) {
            DegsConfig config;
            config.frame_end = ends[i];
            const std::string name = "platform" + std::to_string(i);
            platforms.push_back(std::make_unique<Platform>(name.c_str(), config, cloud));
            platforms.back()->host.script = [this, i](Host& host) {
                program(host, cloud, camera);
                EXPECT_TRUE(host.render());
                cycles[i] = host.read_pair(Register::Cycles);
            };
        }
        sc_core::sc_start();
    }
};

TEST_F(SmallRunFrameEnd, TheGateTellsTheEndThatMuchLater) {
    run({{1, 1}, {1, 2}, {1, 300}});
    EXPECT_EQ(cycles[1], cycles[0] + 1);
    EXPECT_EQ(cycles[2], cycles[0] + 299);
}

// An empty frame of 72 rows is three writes, one per row of tiles of 32: the first leaves when the
// scene has been read, the last two intervals after the first; it is acknowledged 50 cycles later,
// and a cycle later the gate reports the frame.
TEST_F(SmallRunFrameEnd, BackgroundIsWrittenAtItsRate) {
    camera.position.z = 50; // nothing to see
    run({{1, 1}, {900, 1}, {1000, 1}});
    EXPECT_GT(cycles[0], 50 + 2 * 1U + 50 + 1); // a Gaussian has been read before
    EXPECT_EQ(cycles[1], cycles[0] + 2 * 899);
    EXPECT_EQ(cycles[2], cycles[0] + 2 * 999);
}

} // namespace
} // namespace degs::test
