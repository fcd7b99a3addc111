// SPDX-License-Identifier: Apache-2.0
// Tiles in the hole of a camera list nothing; all others are as they are without one.
#include "splat/frame/tile_grid.hpp"

#include "splat/reference/reference_renderer.hpp"
#include "tests/splat/frame/brute_force.hpp"

namespace degs {
namespace {

bool lies_in(const PixelBox& box, const PixelBox& hole) {
    return hole.holds(box.x0, box.y0) && hole.holds(box.x1, box.y1);
}

std::uint64_t area(const PixelBox& box) {
    return std::uint64_t{1} * box.width() * box.height();
}

TEST(HiddenTiles, AreThoseWhoseEveryPixelLiesInTheHole) {
    std::mt19937 random(7);
    const auto below = [&random](int end) { return static_cast<int>(random() % end); };
    int hidden = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        Camera camera = test::make_camera(1 + below(70), 1 + below(70), 50);
        if (trial % 2 == 0) {
            const int x = below(camera.width), y = below(camera.height);
            camera =
                camera.cropped({x, y, x + below(camera.width - x), y + below(camera.height - y)});
        }
        const int x = below(80) - 5, y = below(80) - 5;
        camera.hole = {x, y, x + below(60), y + below(60)};
        const TileGrid grid(camera, 1 + below(20));
        std::uint64_t tiles = 0, pixels = 0;
        for (int tile = 0; tile < grid.tiles_x() * grid.tiles_y(); ++tile) {
            const PixelBox inside = grid.image_pixels_of(tile);
            ASSERT_EQ(grid.is_hidden(tile), lies_in(inside, camera.hole));
            tiles += grid.is_hidden(tile) ? 0 : 1;
            pixels += grid.is_hidden(tile) ? 0 : area(inside);
        }
        ASSERT_EQ(grid.shown_tiles(), tiles);
        ASSERT_EQ(grid.shown_pixels(), pixels);
        hidden += grid.hidden().empty() ? 0 : 1;
    }
    EXPECT_GT(hidden, 200);
}

class HiddenTilesOf : public testing::TestWithParam<TileMode> {
protected:
    GaussianCloud cloud = test::random_cloud(1500, 5, 1);
    Camera camera = test::make_camera(150, 101, 120);
    FrameWorkload whole = make_frame_workload(cloud, camera, 16, GetParam());
    FrameWorkload holed = with_hole();

    FrameWorkload with_hole() {
        camera.hole = {40, 20, 110, 100};
        return make_frame_workload(cloud, camera, 16, GetParam());
    }
    static std::vector<std::uint32_t> ids_of(const FrameWorkload& frame, int tile) {
        std::vector<std::uint32_t> ids;
        for (std::uint64_t i = frame.tile_begin[tile]; i < frame.tile_begin[tile + 1]; ++i) {
            ids.push_back(frame.splats[frame.tile_splats[i]].id);
        }
        return ids;
    }
};

TEST_P(HiddenTilesOf, AWorkloadListNothing) {
    const TileGrid grid = holed.grid();
    int hidden = 0;
    for (int tile = 0; tile < holed.tiles(); ++tile) {
        const std::vector<std::uint32_t> ids = ids_of(holed, tile);
        EXPECT_EQ(ids, grid.is_hidden(tile) ? std::vector<std::uint32_t>() : ids_of(whole, tile));
        hidden += grid.is_hidden(tile) ? 1 : 0;
    }
    EXPECT_EQ(hidden, 3 * 5); // columns 48 .. 95, rows from 32 to the lower border
    EXPECT_LT(holed.splats.size(), whole.splats.size());
    EXPECT_EQ(holed.culled.off_screen - whole.culled.off_screen,
              whole.splats.size() - holed.splats.size());
    for (const std::uint32_t touched : holed.tiles_touched) {
        EXPECT_GT(touched, 0U);
    }
}

TEST_P(HiddenTilesOf, AnImageAreBackground) {
    ReferenceCounts counts, whole_counts;
    const Image image = render_reference(holed, counts);
    const Image full = render_reference(whole, whole_counts);
    std::uint64_t fragments = 0;
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            const std::size_t at = image.at(x, y);
            const bool hidden = holed.grid().is_hidden(holed.grid().tile_of_pixel(x, y));
            EXPECT_EQ(image.rgb[3 * at], hidden ? 0 : full.rgb[3 * at]);
            EXPECT_EQ(image.fragments[at], hidden ? 0 : full.fragments[at]);
            fragments += image.fragments[at];
        }
    }
    EXPECT_EQ(counts.fragments, fragments);
}
INSTANTIATE_TEST_SUITE_P(Modes, HiddenTilesOf,
                         testing::Values(TileMode::Exact, TileMode::Square, TileMode::Box,
                                         TileMode::Tight));

} // namespace
} // namespace degs
