// SPDX-License-Identifier: Apache-2.0
// GSCore's configurations, and real scenes through the program.
#include <cmath>

#include "baselines/gscore/config.hpp"
#include "config/config_document.hpp"
#include "sim/design/run_config.hpp"
#include "sim/view/view.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using nlohmann::json;
using sim::load_run_config;
using sim::RunConfig;

RunConfig load_gscore(const std::string& name) {
    return load_run_config(config(name), {});
}

// Lanes and buffers follow the lanes, the rest stays: 272 N / 64 KB.
TEST(GscoreConfigs, ScaleByTheShadedRowsOfTableI) {
    for (const int lanes : {16, 64, 256, 1024}) {
        SCOPED_TRACE(lanes);
        const RunConfig file = load_gscore("gscore-" + std::to_string(lanes));
        const auto& c = dynamic_cast<const gscore::Config&>(file.accelerator());
        EXPECT_EQ(c.name, "gscore-" + std::to_string(lanes));
        EXPECT_EQ(c.pes(), lanes);
        EXPECT_EQ(c.tile_size_px(), std::max(16, 2 * static_cast<int>(std::sqrt(lanes))));
        EXPECT_EQ(c.tile_contexts(), 2);
        EXPECT_EQ(c.buffer.bytes, 272 * 1024 * lanes / 64);
        EXPECT_EQ(c.pixel_buffer.readout_pixels, lanes);
        EXPECT_EQ(c.projection.count, 4);
        EXPECT_EQ(c.sorting.count, 4);
        EXPECT_EQ(c.problem(), "");
    }
}

TEST(GscoreConfigs, SixtyFourLanesAreTheDefault) {
    const Folder folder;
    std::ofstream(folder / "c.yaml") << "accelerator: gscore\n";
    EXPECT_EQ(resolved(load_gscore("gscore-64")).dump(2),
              resolved(load_run_config(folder / "c.yaml", {})).dump(2));
}

Outcome run_gscore(const std::string& configuration, const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"run", config(configuration)};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return degs(arguments);
}

TEST(HostileConfigGscore, Mistakes) {
    const Folder folder;
    const auto with = [&folder](const std::string& set) {
        return run_gscore("gscore-64",
                          {"--scene", "synthetic:single", "--out", folder / "out", "--set", set});
    };
    expect_mistake(with("array.lanes=100"), "16, 64, 256 or 1024");
    expect_mistake(with("array.lanes=2048"), "16 to 1024");
    expect_mistake(with("array.clusters=3"), "1, 2 or 4");
    expect_mistake(with("clusters=0"), "1 to 64");
    expect_mistake(with("clusters=65"), "1 to 64");
    expect_mistake(with("array.subtile_skip=box"), "obb");
    expect_mistake(with("array.termination_cycles=0"), "1 to 1024");
    expect_mistake(with("scheduler.banks=8"), "scheduler");
    expect_mistake(with("sorting.merge_ways=4"), "merge_ways");
    // In range, but does not fit together.
    expect_mistake(with("array.lanes=1024"), "pixel_buffer.bytes");
    expect_mistake(with("pixel_buffer.bytes=1000000"), "buffer.bytes");
    expect_mistake(with("buffer.bytes=9000"), "buffer.bytes");
    expect_mistake(with("sorting.chunk=65536"), "sort_share");
}

struct View {
    const char* configuration;
    const char* scene;
    int camera;
};
std::ostream& operator<<(std::ostream& out, const View& v) {
    return out << v.configuration << ' ' << v.scene << ' ' << v.camera;
}
class SceneOnGscore : public testing::TestWithParam<View> {};

// The array tests every pixel by itself, so there are no span ends to differ by: 90 dB in single
// precision, all but 1e-5 of the pixel updates (a threshold may flip).
TEST_P(SceneOnGscore, MatchesTheReference) {
    const View& view = GetParam();
    const fs::path file = trained_scenes() / view.scene / "scene.ply";
    if (!fs::exists(file)) {
        GTEST_SKIP() << file << " is not there; set DEGS_SCENES";
    }
    const Folder folder;
    const Outcome outcome =
        run_gscore(view.configuration, {"--scene", file.string(), "--camera",
                                        std::to_string(view.camera), "--out", folder / "out"});
    expect_success(outcome);
    const json report = report_in(folder / "out");
    EXPECT_GE(report["image"]["psnr_db"].get<double>(), 90.0);
    const auto useful = report["slots"]["useful"].get<double>();
    const auto fragments = report["workload"]["fragments"].get<double>();
    EXPECT_LE(std::abs(useful - fragments), 1e-5 * fragments);
}
INSTANTIATE_TEST_SUITE_P(Views, SceneOnGscore,
                         testing::Values(View{"gscore-64", "flowers-small", 0},
                                         View{"gscore-16", "fruit-drops", 0},
                                         View{"gscore-1024", "guitar", 1}));

// Two arrays blend the same slots in less time, up to what the shared front end takes.
TEST(SceneOnGscoreClusters, RenderTheSameImageFaster) {
    const fs::path file = trained_scenes() / "flowers-small" / "scene.ply";
    if (!fs::exists(file)) {
        GTEST_SKIP() << file << " is not there; set DEGS_SCENES";
    }
    const Folder folder;
    const auto run = [&](const std::string& out, const std::vector<std::string>& more) {
        std::vector<std::string> arguments{"--scene", file.string(), "--width",       "512",
                                           "--out",   folder / out,  "--no-reference"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        expect_success(run_gscore("gscore-64", arguments));
    };
    run("one", {});
    run("two", {"--set", "clusters=2"});
    run("estimate", {"--set", "clusters=2", "--fidelity", "analytic"});
    EXPECT_EQ(read_file(folder / "one/image.exr"), read_file(folder / "two/image.exr"));
    const json one = report_in(folder / "one");
    const json two = report_in(folder / "two");
    for (const char* slots : {"useful", "boundary", "terminated"}) {
        EXPECT_EQ(one["slots"][slots], two["slots"][slots]) << slots;
    }
    const auto cycles = [](const json& report) { return report["timing"]["cycles"].get<double>(); };
    EXPECT_LT(cycles(two), 0.8 * cycles(one));
    const json estimate = json::parse(read_file(folder / "estimate/analytic.json"));
    EXPECT_NEAR(estimate["timing"]["cycles"].get<double>(), cycles(two), 0.25 * cycles(two));
}

} // namespace
} // namespace degs::sim_test
