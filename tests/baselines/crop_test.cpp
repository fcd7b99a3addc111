// SPDX-License-Identifier: Apache-2.0
// A window of a raster shows what the whole raster shows there, in every accelerator and number
// set.
#include <algorithm>
#include <cctype>
#include <memory>
#include <tuple>

#include "degs/design.hpp"
#include "splat/reference/reference_renderer.hpp"
#include "tests/baselines/engine_run.hpp"
#include "tests/splat/frame/brute_force.hpp"

namespace degs {
namespace {

using test::EngineRun;

constexpr int kWidth = 203, kHeight = 131;

/// Aligned to tiles of 16, inside one tile, a column, a row, the last corner, and unaligned ones.
const std::vector<PixelBox>& crops() {
    static const std::vector<PixelBox> boxes{
        {16, 32, 79, 95},    {65, 37, 71, 45},  {29, 0, 29, 130}, {0, 77, 202, 77},
        {131, 75, 202, 130}, {37, 21, 126, 90}, {3, 2, 199, 128}};
    return boxes;
}

Camera whole_view() {
    Camera camera;
    camera.width = kWidth;
    camera.height = kHeight;
    camera.fx = 190;
    camera.fy = 185;
    return camera;
}

/// The pixels of `crop` equal those of `whole` there.
void expect_part(const Image& whole, const Image& crop, const PixelBox& part) {
    ASSERT_EQ(crop.width, part.width());
    ASSERT_EQ(crop.height, part.height());
    for (int y = part.y0; y <= part.y1; ++y) {
        for (int x = part.x0; x <= part.x1; ++x) {
            const std::size_t there = whole.at(x, y), here = crop.at(x - part.x0, y - part.y0);
            for (std::size_t channel = 0; channel < 3; ++channel) {
                ASSERT_EQ(whole.rgb[3 * there + channel], crop.rgb[3 * here + channel])
                    << "pixel " << x << ", " << y;
            }
            ASSERT_EQ(whole.transmittance[there], crop.transmittance[here])
                << "pixel " << x << ", " << y;
            ASSERT_EQ(whole.fragments[there], crop.fragments[here]) << "pixel " << x << ", " << y;
        }
    }
}

FrameWorkload frame_of(const GaussianCloud& cloud, const Camera& camera,
                       const AcceleratorConfig& design) {
    return make_frame_workload(cloud, camera, design.tile_size_px(), design.tile_mode(),
                               projection_of(design.data_path(), false));
}

/// Simulates the whole view and its crops, and compares their images.
void expect_crops(const AcceleratorConfig& design, Fidelity fidelity) {
    const GaussianCloud cloud = test::random_cloud(400, 7, 1);
    const Camera whole = whole_view();
    const FrameWorkload whole_frame = frame_of(cloud, whole, design);
    const EngineRun all("whole", design, {&whole_frame}, fidelity);
    std::vector<FrameWorkload> frames;
    for (const PixelBox& part : crops()) {
        frames.push_back(frame_of(cloud, whole.cropped(part), design));
    }
    std::vector<std::unique_ptr<EngineRun>> runs;
    for (std::size_t i = 0; i < frames.size(); ++i) {
        runs.push_back(std::make_unique<EngineRun>("crop_" + std::to_string(i), design,
                                                   std::vector<const FrameWorkload*>{&frames[i]},
                                                   fidelity));
    }
    sc_core::sc_start();
    all.expect_sound();
    for (std::size_t i = 0; i < runs.size(); ++i) {
        SCOPED_TRACE("crop " + std::to_string(i));
        runs[i]->expect_sound();
        expect_part(all.image(), runs[i]->image(), crops()[i]);
    }
}

using Row = std::tuple<const char*, const char*>; // design, numbers

class CropsOfDesigns : public ::testing::TestWithParam<Row> {};

TEST_P(CropsOfDesigns, HaveThePixelsOfTheWhole) {
    const auto& [file, numbers] = GetParam();
    const Design design = load_design(std::string(DEGS_CONFIGS) + "/" + file + ".yaml",
                                      {std::string("pipeline.numbers=") + numbers});
    expect_crops(design.accelerator(), Fidelity::Exact);
}

std::string row_name(const ::testing::TestParamInfo<Row>& row) {
    std::string name = std::string(std::get<0>(row.param)) + "_" + std::get<1>(row.param);
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(
    All, CropsOfDesigns,
    ::testing::Combine(::testing::Values("degs-64", "degs-64-tuned", "degs-1024-streams",
                                         "gscore-64", "gbu-64", "gcc-64", "orange-o1", "orange-o4"),
                       ::testing::Values("fp32", "paper")),
    row_name);
INSTANTIATE_TEST_SUITE_P(OtherNumbers, CropsOfDesigns,
                         ::testing::Combine(::testing::Values("degs-64", "gscore-64", "orange-o1"),
                                            ::testing::Values("fp64", "ideal", "fp16", "tuned")),
                         row_name);

class SmallRunCrops : public ::testing::TestWithParam<const char*> {};

TEST_P(SmallRunCrops, HaveThePixelsOfTheWholeInStrictRuns) {
    const Design design = load_design(std::string(DEGS_CONFIGS) + "/degs-64.yaml",
                                      {std::string("pipeline.numbers=") + GetParam()});
    expect_crops(design.accelerator(), Fidelity::Strict);
}

INSTANTIATE_TEST_SUITE_P(Numbers, SmallRunCrops, ::testing::Values("fp32", "paper", "tuned"));

TEST(Crops, HaveThePixelsOfTheWholeReference) {
    const GaussianCloud cloud = test::random_cloud(400, 8, 2);
    const Camera whole = whole_view();
    for (const TileMode mode :
         {TileMode::Exact, TileMode::Square, TileMode::Box, TileMode::Tight}) {
        ReferenceCounts counts;
        const Image image = render_reference(make_frame_workload(cloud, whole, 16, mode), counts);
        for (const PixelBox& part : crops()) {
            const FrameWorkload frame = make_frame_workload(cloud, whole.cropped(part), 16, mode);
            expect_part(image, render_reference(frame, counts), part);
        }
    }
}

} // namespace
} // namespace degs
