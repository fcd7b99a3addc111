// SPDX-License-Identifier: Apache-2.0
// A path takes memory for the frames that are in work, not for all of them.
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

nlohmann::json run_path(const std::string& configuration, int frames) {
    const Folder folder;
    const Outcome outcome =
        degs({"run", config(configuration), "--scene", "synthetic:object,gaussians=3000", "--width",
              "80", "--frames", std::to_string(frames), "--no-reference", "--out", folder / "out"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return report_in(folder / "out");
}

// A projected splat has 200 B and more of values, in the frame and in the data path, and 40 frames
// more would add as many times that.
TEST(FramesMemory, DoesNotGrowWithTheFrames) {
    const nlohmann::json few = run_path("degs-64", 20), many = run_path("degs-64", 60);
    EXPECT_EQ(many["timing"]["frame_finished_cycles"].size(), 60U);
    const double splats = many["workload"]["visible"].get<double>();
    ASSERT_GT(splats, 2000);
    const double all = 40 * splats * 200;
    EXPECT_LT(many["host"]["peak_rss_bytes"].get<double>() -
                  few["host"]["peak_rss_bytes"].get<double>(),
              all / 4);
}

} // namespace
} // namespace degs::sim_test
