// SPDX-License-Identifier: Apache-2.0
#include "splat/model/camera.hpp"

#include "degs/error.hpp"
#include "tests/splat/frame/brute_force.hpp"

namespace degs {
namespace {

TEST(CameraScaling, KeepsTheFieldOfViewAndRoundsTheHeight) {
    Camera camera = test::make_camera(640, 427, 500);
    camera.fy = 510;
    camera.name = "view";
    const Camera scaled = camera.scaled_to_width(1280);
    EXPECT_EQ(scaled.width, 1280);
    EXPECT_EQ(scaled.height, 854);
    EXPECT_EQ(scaled.fx, 1000);
    EXPECT_EQ(scaled.fy, 1020);
    EXPECT_EQ(scaled.name, "view");
    EXPECT_EQ(camera.scaled_to_width(320).height, 214); // 213.5
    EXPECT_EQ(camera.scaled_to_width(1).height, 1);     // never 0
    EXPECT_EQ(camera.scaled_to_width(640).fx, 500);
}

TEST(CameraScaling, MovesThePrincipalPointWithTheImage) {
    Camera camera = test::make_camera(640, 427, 500);
    ASSERT_TRUE(camera.set_principal_point({300, 220.5}));
    const Camera scaled = camera.scaled_to_width(1280);
    EXPECT_EQ(scaled.principal_point(), glm::dvec2(600, 441));
    EXPECT_EQ(scaled.origin, glm::ivec2(80, 0));
    EXPECT_EQ(scaled.raster_middle(), glm::dvec2(680, 441));
    const Camera centred = test::make_camera(640, 427, 500).scaled_to_width(321);
    EXPECT_TRUE(centred.is_centred());
    EXPECT_EQ(centred.raster_middle(), glm::dvec2(160.5, 107));
}

TEST(CameraWindow, IsPartOfTheSmallestCentredRaster) {
    Camera camera = test::make_camera(180, 100, 150);
    EXPECT_TRUE(camera.is_centred());
    EXPECT_EQ(camera.raster().x1, 179);
    ASSERT_TRUE(camera.set_principal_point({100, 50})); // right: the raster goes on to the right
    EXPECT_EQ(camera.origin, glm::ivec2(0, 0));
    EXPECT_EQ(camera.raster().x1, 199);
    ASSERT_TRUE(camera.set_principal_point({80, 50})); // left: it begins before the image
    EXPECT_EQ(camera.origin, glm::ivec2(20, 0));
    EXPECT_EQ(camera.raster().x1, 199);
    ASSERT_TRUE(camera.set_principal_point({89.7, 50})); // less than a column
    EXPECT_EQ(camera.origin, glm::ivec2(0, 0));
    EXPECT_EQ(camera.raster().x1, 179);
    EXPECT_FALSE(camera.set_principal_point({1e9, 50}));
    EXPECT_FALSE(camera.set_principal_point({80, std::nan("")}));
}

// A shifted frustum is a crop of the larger centred view, whatever of it is cropped first.
TEST(CameraWindow, OfACropHasTheRasterOfTheWhole) {
    const Camera whole = test::make_camera(203, 131, 150);
    const Camera part = whole.cropped({37, 21, 126, 90});
    EXPECT_EQ(part.width, 90);
    EXPECT_EQ(part.height, 70);
    EXPECT_EQ(part.raster_middle(), whole.raster_middle());
    EXPECT_EQ(part.raster().x1, 202);
    EXPECT_EQ(part.place_of(37, 22), 90U);
    const Camera smaller = part.cropped({5, 6, 14, 25});
    EXPECT_EQ(smaller.origin, glm::ivec2(42, 27));
    EXPECT_EQ(smaller.raster_middle(), whole.raster_middle());
    EXPECT_TRUE(smaller.has_sound_raster());
}

TEST(CameraScaling, RefusesImpossibleSizes) {
    const Camera camera = test::make_camera(100, 300, 100);
    EXPECT_THROW(camera.scaled_to_width(0), InputError);
    EXPECT_THROW(camera.scaled_to_width(-5), InputError);
    EXPECT_THROW(camera.scaled_to_width(65537), InputError);
    EXPECT_THROW(camera.scaled_to_width(30000), InputError); // 90000 high
    EXPECT_THROW(Camera{}.scaled_to_width(100), InputError);
}

} // namespace
} // namespace degs
