// SPDX-License-Identifier: Apache-2.0
// Foveated frames of every accelerator: each level is drawn as by itself, but for what a finer one
// shows, and the image is that of the levels without holes.
#include "splat/foveation/foveation.hpp"

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <tuple>

#include "degs/design.hpp"
#include "splat/foveation/compose.hpp"
#include "tests/baselines/engine_run.hpp"
#include "tests/splat/frame/brute_force.hpp"

namespace degs {
namespace {

using test::EngineRun;

Camera foveated_camera() {
    Camera camera = test::make_camera(301, 179, 180);
    camera.fy = 170;
    return camera;
}

FrameWorkload frame_of(const Camera& camera, const AcceleratorConfig& design) {
    static const GaussianCloud cloud = test::random_cloud(700, 21, 2);
    return make_frame_workload(cloud, camera, design.tile_size_px(), design.tile_mode(),
                               projection_of(design.data_path(), false));
}

std::uint64_t frame_buffer_bytes(const AcceleratorResult& result) {
    for (const StreamUse& stream : result.streams) {
        if (stream.name == "frame_buffer") {
            return stream.bytes_written;
        }
    }
    return 0;
}

/// Pixels of hidden tiles are untouched, all others those of the image without a hole.
void expect_hidden_background(const Image& image, const Image& whole, const FrameWorkload& frame) {
    const TileGrid grid = frame.grid();
    const glm::ivec2 origin = frame.camera.origin;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const std::size_t at = image.at(x, y);
            const bool hidden = grid.is_hidden(grid.tile_of_pixel(origin.x + x, origin.y + y));
            ASSERT_EQ(image.fragments[at], hidden ? 0U : whole.fragments[at]);
            ASSERT_EQ(image.rgb[3 * at], hidden ? 0 : whole.rgb[3 * at]);
        }
    }
}

std::vector<const FrameWorkload*> addresses_of(const std::vector<FrameWorkload>& frames) {
    std::vector<const FrameWorkload*> list;
    for (const FrameWorkload& frame : frames) {
        list.push_back(&frame);
    }
    return list;
}

const std::array<Foveation, 4> kFoveations{
    {{{0.5, 0.5}, 9, 24}, {{0, 1}, 12, 30}, {{0.7, 0.2}, 15, 15}, {{0.5, 0.5}, 90, 90}}};

using FoveationRow = std::tuple<const char*, int>; // design, position among kFoveations

class SmallRunFoveation : public ::testing::TestWithParam<FoveationRow> {};

TEST_P(SmallRunFoveation, DrawsWhatTheLevelsByThemselvesDo) {
    const Design design =
        load_design(std::string(DEGS_CONFIGS) + "/" + std::get<0>(GetParam()) + ".yaml", {});
    const AcceleratorConfig& config = design.accelerator();
    const Camera camera = foveated_camera();
    const std::vector<FoveatedLevel> levels =
        levels_of(camera, kFoveations[std::get<1>(GetParam())]);
    std::vector<FrameWorkload> frames, whole;
    std::uint64_t pixels = 0, tiles = 0;
    for (const FoveatedLevel& level : levels) {
        frames.push_back(frame_of(level.camera, config));
        Camera filled = level.camera;
        filled.hole = {};
        whole.push_back(frame_of(filled, config));
        pixels += frames.back().grid().shown_pixels();
        tiles += frames.back().grid().shown_tiles();
    }
    const FrameWorkload full = frame_of(camera, config);
    const int views = static_cast<int>(levels.size());
    const EngineRun exact("exact", config, addresses_of(frames), Fidelity::Exact, {}, views);
    const EngineRun strict("strict", config, addresses_of(frames), Fidelity::Strict, {}, views);
    const EngineRun plain("plain", config, {&full});
    std::vector<std::unique_ptr<EngineRun>> alone;
    for (std::size_t l = 0; l < levels.size(); ++l) {
        alone.push_back(std::make_unique<EngineRun>("alone_" + std::to_string(l), config,
                                                    std::vector<const FrameWorkload*>{&whole[l]}));
    }
    sc_core::sc_start();

    exact.expect_sound();
    EXPECT_EQ(exact.words(), strict.words());
    const AcceleratorResult result = exact.result();
    EXPECT_EQ(result.tiles + result.background_tiles, tiles);
    std::uint64_t written = 0, all_pixels = 0;
    for (std::size_t l = 0; l < levels.size(); ++l) {
        written += frame_buffer_bytes(alone[l]->result());
        all_pixels += levels[l].camera.pixels();
        expect_hidden_background(exact.image(l), alone[l]->image(), frames[l]);
    }
    EXPECT_LE(result.fragments(), plain.result().fragments());
    EXPECT_GE(frame_buffer_bytes(result), pixels * config.records().pixel_bytes); // in bursts
    EXPECT_EQ(frame_buffer_bytes(result) < written, pixels < all_pixels);
    EXPECT_LE(pixels, full.grid().shown_pixels());

    std::vector<const Image*> parts, filled;
    for (std::size_t l = 0; l < levels.size(); ++l) {
        parts.push_back(&exact.image(l));
        filled.push_back(&alone[l]->image());
    }
    const Image image = compose(camera, levels, parts);
    const Image expected = compose(camera, levels, filled);
    EXPECT_TRUE(image.rgb == expected.rgb);
    EXPECT_TRUE(image.transmittance == expected.transmittance);
    EXPECT_TRUE(image.fragments == expected.fragments);
    const PixelBox& fovea = levels[0].shown;
    for (int y = fovea.y0; y <= fovea.y1; ++y) {
        for (int x = fovea.x0; x <= fovea.x1; ++x) {
            for (std::size_t c = 0; c < 3; ++c) {
                const std::size_t at = 3 * image.at(x, y) + c;
                ASSERT_EQ(image.rgb[at], plain.image().rgb[at]) << x << ", " << y;
            }
        }
    }
}

std::string foveation_row_name(const ::testing::TestParamInfo<FoveationRow>& row) {
    std::string name =
        std::string(std::get<0>(row.param)) + "_" + std::to_string(std::get<1>(row.param));
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(All, SmallRunFoveation,
                         ::testing::Combine(::testing::Values("degs-64", "gscore-64", "gbu-64",
                                                              "gcc-64", "orange-o1"),
                                            ::testing::Range(0, 4)),
                         foveation_row_name);

} // namespace
} // namespace degs
