// SPDX-License-Identifier: Apache-2.0
// Images of the modelled data path: against the reference, and a part against the whole. That they
// are those of a run is tested with the modules.
#include <cmath>

#include "accuracy/data_path_renderer.hpp"
#include "splat/reference/reference_renderer.hpp"
#include "tests/splat/frame/brute_force.hpp"

namespace degs {
namespace {

FrameWorkload random_view(int tile_size) {
    return make_frame_workload(test::random_cloud(300, 5), test::make_camera(100, 70, 80),
                               tile_size, TileMode::Exact);
}

/// Where a part's pixels differ from the same ones of the whole image.
int differences(const Image& whole, const Image& part, const PixelBox& box) {
    int count = 0;
    for (int y = box.y0; y <= box.y1; ++y) {
        for (int x = box.x0; x <= box.x1; ++x) {
            const std::size_t a = whole.at(x, y);
            const std::size_t b = part.at(x - box.x0, y - box.y0);
            bool same = whole.transmittance[a] == part.transmittance[b] &&
                        whole.fragments[a] == part.fragments[b];
            for (std::size_t c = 0; c < 3; ++c) {
                same = same && whole.rgb[3 * a + c] == part.rgb[3 * b + c];
            }
            count += same ? 0 : 1;
        }
    }
    return count;
}

TEST(DataPathRenderer, DoublePrecisionIsTheReference) {
    for (const int tile_size : {1, 16, 48, 128}) {
        const FrameWorkload work = random_view(tile_size);
        DataPathRender options;
        options.numbers.numbers = Arithmetic::Fp64;
        ReferenceCounts wanted;
        DataPathRenderer renderer(work, options);
        const Image image = renderer.render(all_tiles(work));
        const Image reference = render_reference(work, wanted);
        EXPECT_EQ(renderer.counts().useful, wanted.fragments);
        EXPECT_EQ(renderer.counts().boundary, 0U);
        EXPECT_EQ(image.fragments, reference.fragments);
        for (std::size_t i = 0; i < image.rgb.size(); ++i) {
            ASSERT_NEAR(image.rgb[i], reference.rgb[i], 1e-6) << "tile size " << tile_size;
        }
    }
}

TEST(DataPathRenderer, AWindowIsAPartOfTheImage) {
    const FrameWorkload work = random_view(16);
    ReferenceCounts wanted;
    DataPathRenderer renderer(work, {});
    const Image image = renderer.render(all_tiles(work));
    const Image reference = render_reference(work, wanted);
    for (const PixelBox& wish : {PixelBox{0, 0, 0, 0}, PixelBox{17, 20, 40, 33},
                                 PixelBox{90, 60, 99, 69}, PixelBox{0, 0, 99, 69}}) {
        const TileWindow window = tiles_around(work, wish);
        const PixelBox box = pixels_of(work, window);
        EXPECT_LE(box.x0, wish.x0);
        EXPECT_GE(box.x1, wish.x1);
        EXPECT_LE(box.y1, 69);
        const Image part = renderer.render(window);
        EXPECT_EQ(part.width, box.x1 - box.x0 + 1);
        EXPECT_EQ(part.height, box.y1 - box.y0 + 1);
        EXPECT_EQ(differences(image, part, box), 0);
        EXPECT_EQ(differences(reference, render_reference(work, wanted, window), box), 0);
    }
}

TEST(DataPathRenderer, TellsItsProgress) {
    const FrameWorkload work = random_view(16);
    std::vector<double> shares;
    DataPathRender options;
    options.progress = [&](double share) { shares.push_back(share); };
    DataPathRenderer(work, options).render(all_tiles(work));
    ASSERT_EQ(shares.size(), 5U); // rows of tiles
    for (std::size_t i = 0; i < shares.size(); ++i) {
        EXPECT_DOUBLE_EQ(shares[i], static_cast<double>(i + 1) / 5);
    }
}

} // namespace
} // namespace degs
