// SPDX-License-Identifier: Apache-2.0
// GCC from its configuration files to its reports, on trained scenes.
#include <cmath>

#include "baselines/gcc/config.hpp"
#include "config/config_document.hpp"
#include "sim/design/run_config.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using nlohmann::json;

gcc::Config load_gcc(const std::string& name) {
    const sim::RunConfig run =
        sim::load_run_config(std::string(DEGS_CONFIGS) + "/" + name + ".yaml", {});
    EXPECT_EQ(run.problem(), "") << name;
    return dynamic_cast<const gcc::Config&>(run.accelerator());
}

TEST(GccConfigs, ScalingPoints) {
    struct Row {
        int pes, window;
    };
    for (const Row& row : {Row{16, 4}, Row{64, 8}, Row{256, 16}, Row{1024, 32}}) {
        const gcc::Config config = load_gcc("gcc-" + std::to_string(row.pes));
        EXPECT_EQ(config.pes(), row.pes);
        EXPECT_EQ(config.array.window, row.window);
        EXPECT_EQ(config.view_size, 16 * row.window);
        EXPECT_EQ(config.tile_contexts(), 1);
        // 190 KB at 64 PEs (DeGS, Table I), linear in the PEs.
        EXPECT_EQ(config.image_buffer.bytes + config.group_buffer_bytes, 190 * 16 * row.pes);
    }
}

TEST(GccConfigs, Gcc64IsTheDefault) {
    const std::string file = std::string(DEGS_CONFIGS) + "/gcc-64.yaml";
    const Folder folder;
    std::ofstream(folder / "bare.yaml") << "accelerator: gcc\n";
    EXPECT_EQ(resolved(sim::load_run_config(file, {})).dump(2),
              resolved(sim::load_run_config(folder / "bare.yaml", {})).dump(2));
}

TEST(HostileConfigGcc, MistakesNameTheirKey) {
    for (const auto& [setting, key] : std::vector<std::pair<std::string, std::string>>{
             {"array.window=0", "array.window"},
             {"array.window=65", "array.window"},
             {"array.window=1", "array.window"},
             {"array.skip_cycles=-1", "array.skip_cycles"},
             {"array.discovery_cycles=0", "array.discovery_cycles"},
             {"colour.block=1", "colour.block"},
             {"projection.group=4096", "group_buffer_bytes"},
             {"image_buffer.bytes=131071", "image_buffer.bytes"},
             {"traffic.burst_bytes=0", "traffic.burst_bytes"},
             {"scheduler.banks=8", "scheduler"}}) {
        expect_mistake(degs({"run", config("gcc-64"), "--scene", "synthetic:object,gaussians=10",
                             "--set", setting}),
                       key);
    }
}

class SceneGcc : public testing::TestWithParam<const char*> {};

// Single precision against the double reference; all but 1e-5 of its pixel updates.
TEST_P(SceneGcc, MatchesTheReference) {
    const fs::path scene = trained_scenes() / GetParam() / "scene.ply";
    if (!fs::exists(scene)) {
        GTEST_SKIP() << scene << " is not there; set DEGS_SCENES";
    }
    for (const char* camera : {"1", "2"}) {
        const Folder folder;
        const Outcome outcome = degs({"run", config("gcc-64"), "--scene", scene.string(),
                                      "--camera", camera, "--out", folder / "out"});
        expect_success(outcome);
        const json report = report_in(folder / "out");
        EXPECT_GE(report["image"]["psnr_db"].get<double>(), 90.0) << camera;
        const auto useful = report["slots"]["useful"].get<double>();
        const auto fragments = report["workload"]["fragments"].get<double>();
        EXPECT_LE(std::abs(useful - fragments), 1e-5 * fragments) << camera;
    }
}

INSTANTIATE_TEST_SUITE_P(Trained, SceneGcc, testing::Values("flowers", "seal", "skull"));

} // namespace
} // namespace degs::sim_test
