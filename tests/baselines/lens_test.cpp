// SPDX-License-Identifier: Apache-2.0
// Views through lenses in all accelerators: the fidelities agree, images are the reference's, and
// the projection takes as long as its passes.
#include <algorithm>
#include <tuple>

#include "degs/design.hpp"
#include "tests/baselines/engine_run.hpp"
#include "tests/splat/frame/brute_force.hpp"
#include "tests/splat/model/published_lens.hpp"

namespace degs {
namespace {

using test::EngineRun;

Camera view_through(const Lens& lens) {
    Camera camera = test::make_camera(150, 101, 90);
    camera.lens = lens;
    camera.set_principal_point({60.5, 55.25});
    return camera;
}

Design lens_design(const std::string& file, std::vector<std::string> changes) {
    changes.insert(changes.end(), {"pipeline.numbers=fp64", "pipeline.rules.projection=unscented",
                                   "pipeline.stop_rule=refuse"});
    if (file.rfind("degs", 0) == 0) {
        changes.emplace_back("pipeline.span_ends=exact");
    }
    return load_design(std::string(DEGS_CONFIGS) + "/" + file + ".yaml", changes);
}

FrameWorkload lens_frame(const AcceleratorConfig& config, const Camera& camera) {
    return make_frame_workload(test::random_cloud(500, 7, 1), camera, config.tile_size_px(),
                               config.tile_mode(), projection_of(config.data_path(), false));
}

double projecting(const AcceleratorResult& result) {
    for (const StageUse& stage : result.stages) {
        if (std::string(stage.name) == "projection") {
            return stage.busy_cycles;
        }
    }
    ADD_FAILURE() << "no stage 'projection'";
    return 0;
}

using LensRow = std::tuple<const char*, std::size_t>; // design, one of published_lenses()

class LensesOfDesigns : public ::testing::TestWithParam<LensRow> {};

TEST_P(LensesOfDesigns, HaveTheReferencesPixelsInEveryFidelity) {
    const auto& [file, lens] = GetParam();
    const Design design = lens_design(file, {}),
                 slow = lens_design(file, {"projection.unscented_passes=9"});
    const AcceleratorConfig& config = design.accelerator();
    const FrameWorkload frame =
        lens_frame(config, view_through(test::published_lenses().at(lens).lens()));
    ASSERT_GT(frame.splats.size(), 100U);
    const EngineRun exact("exact", config, {&frame}),
        strict("strict", config, {&frame}, Fidelity::Strict);
    const EngineRun passes("passes", slow.accelerator(), {&frame});
    sc_core::sc_start();
    exact.expect_sound();
    exact.expect_reference();
    EXPECT_EQ(exact.words(), strict.words());
    EXPECT_EQ(exact.image().rgb, strict.image().rgb);
    EXPECT_EQ(exact.image().rgb, passes.image().rgb);
    EXPECT_GT(projecting(passes.result()), projecting(exact.result()));
    EXPECT_GT(passes.result().cycles, exact.result().cycles);
}

/// Fewer passes need so many more arithmetic units; with the default the linear ones are reused.
TEST(BillsOfLenses, CostTheOperationsThatPassesLeave) {
    for (const char* file : {"degs-64", "gscore-64", "gbu-64", "gcc-64", "orange-o1"}) {
        SCOPED_TRACE(file);
        const auto block = [&](const std::vector<std::string>& changes) {
            return lens_design(file, changes).accelerator().bill().block("projection");
        };
        const cost::Block linear = block({"pipeline.rules.projection=linear"});
        const cost::Block usual = block({});
        EXPECT_EQ(usual.area_mm2, linear.area_mm2);
        EXPECT_EQ(usual.energy_pj, linear.energy_pj);
        const cost::Block one = block({"projection.unscented_passes=1"});
        EXPECT_NEAR(one.area_mm2, 3.99 * linear.area_mm2, 1e-9);   // ORANGE's is 0
        EXPECT_NEAR(one.energy_pj / linear.energy_pj, 3.99, 1e-9); // of a cycle
        EXPECT_NEAR(block({"projection.unscented_passes=3"}).area_mm2, 1.33 * linear.area_mm2,
                    1e-9);
        EXPECT_EQ(block({"projection.unscented_passes=9"}).area_mm2, linear.area_mm2);
    }
}

std::string lens_row_name(const ::testing::TestParamInfo<LensRow>& row) {
    std::string name = std::string(std::get<0>(row.param)) + "_" +
                       test::published_lenses().at(std::get<1>(row.param)).name;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(All, LensesOfDesigns,
                         ::testing::Combine(::testing::Values("degs-64", "gscore-64", "gbu-64",
                                                              "gcc-64", "orange-o1"),
                                            ::testing::Values(2U, 8U)),
                         lens_row_name);

} // namespace
} // namespace degs
