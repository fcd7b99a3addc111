// SPDX-License-Identifier: Apache-2.0

#include <cmath>

#include <gtest/gtest.h>

#include "sim/simulation/completed_run.hpp"
#include "sim/simulation/foveated_image.hpp"
#include "sim/view/foveated_view.hpp"

namespace degs::sim {
namespace {

Image grey(const Camera& camera, float value) {
    Image image(camera.width, camera.height);
    std::fill(image.rgb.begin(), image.rgb.end(), value);
    return image;
}

// A difference of 0.1 in every channel of the fovea alone is 20 dB there, and as many squares less
// in the whole as it has other pixels.
TEST(FoveatedImage, ErrorsAreMeansOverTheChannelsOfAPart) {
    Camera camera;
    camera.width = camera.height = 64;
    camera.fx = camera.fy = 64;
    const FoveatedView view{camera, levels_of(camera, {{0.5, 0.5}, 5, 10})};
    ASSERT_EQ(view.levels.size(), 3U);
    std::vector<Image> images, references;
    for (const FoveatedLevel& level : view.levels) {
        images.push_back(grey(level.camera, level.scale == 1 ? 0.6F : 0.5F));
        references.push_back(grey(level.camera, 0.5F));
    }
    const auto pointers = [](const std::vector<Image>& all) {
        return std::vector<const Image*>{&all[0], &all[1], &all[2]};
    };
    FoveatedImage image = foveated_image(view, pointers(images));
    judge(image, pointers(references), grey(camera, 0.5F));
    ASSERT_EQ(image.parts.size(), 3U);
    EXPECT_NEAR(image.parts[0].psnr_db, 20, 1e-5);
    EXPECT_TRUE(std::isinf(image.parts[1].psnr_db));
    EXPECT_TRUE(std::isinf(image.parts[2].psnr_db));
    const auto fovea = static_cast<double>(image.shown[0]);
    EXPECT_NEAR(image.whole->psnr_db, 20 - 10 * std::log10(fovea / (64 * 64)), 1e-5);
    EXPECT_EQ(image.shown[0] + image.shown[1] + image.shown[2], std::uint64_t{64} * 64);
}

} // namespace
} // namespace degs::sim
