// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "degs/error.hpp"
#include "sim/view/frame_facts.hpp"
#include "sim/view/view.hpp"
#include "sim/view/view_group.hpp"

namespace degs::sim {
namespace {

Camera full_hd() {
    Camera camera;
    camera.width = 1920;
    camera.height = 1080;
    camera.fx = 1500;
    camera.fy = 1510;
    return camera;
}

TEST(Resize, KeepsTheViewWithoutOptions) {
    const Camera same = resize(full_hd(), {}, {});
    EXPECT_EQ(same.width, 1920);
    EXPECT_EQ(same.height, 1080);
    EXPECT_EQ(same.fx, 1500);
}

TEST(Resize, OneSideScalesBoth) {
    for (const Camera& half : {resize(full_hd(), 960, {}), resize(full_hd(), {}, 540)}) {
        EXPECT_EQ(half.width, 960);
        EXPECT_EQ(half.height, 540);
        EXPECT_DOUBLE_EQ(half.fx, 750);
        EXPECT_DOUBLE_EQ(half.fy, 755);
    }
}

TEST(Resize, NoSideIsLongerThanThatOfACamera) {
    for (const char* text : {"65537x1", "1x65537", "1000000x1", "1x1000000"}) {
        EXPECT_THROW(image_size(text), InputError) << text;
    }
    EXPECT_EQ(image_size("65536x1").width, 65536);
    EXPECT_EQ(image_size("1x65536").height, 65536);
}

TEST(Resize, BothSidesCropAtTheScaleOfTheWidth) {
    const Camera square = resize(full_hd(), 960, 960);
    EXPECT_EQ(square.width, 960);
    EXPECT_EQ(square.height, 960);
    EXPECT_DOUBLE_EQ(square.fx, 750);
    EXPECT_DOUBLE_EQ(square.fy, 755);
}

TEST(Resize, LimitsThePixels) {
    EXPECT_EQ(resize(full_hd(), 7680, {}).height, 4320);
    EXPECT_EQ(resize(full_hd(), 8192, 4320).width, 8192); // just allowed
    EXPECT_THROW(resize(full_hd(), 8193, 4320), InputError);
    EXPECT_THROW(resize(full_hd(), 1, 40000000), InputError);
    EXPECT_THROW(resize(full_hd(), 0, {}), InputError);
    EXPECT_THROW(resize(full_hd(), {}, -1), InputError);
    Camera huge = full_hd();
    huge.width = huge.height = 60000; // a camera file may ask for too much, too
    EXPECT_THROW(resize(huge, {}, {}), InputError);
}

TEST(Crop, MayReachTheLastPixelAndNoFurther) {
    const Camera part = resize_and_crop(full_hd(), 192, {}, "182,98,10x10");
    EXPECT_EQ(part.width, 10);
    EXPECT_EQ(part.height, 10);
    EXPECT_THROW(resize_and_crop(full_hd(), 192, {}, "182,98,11x10"), InputError);
    EXPECT_THROW(resize_and_crop(full_hd(), 192, {}, "182,98,10x11"), InputError);
}

TEST(Eyes, AreApartInSceneUnits) {
    PathRequest path;
    path.frames = 2;
    path.group.eyes_m = 0.25;
    path.group.units_per_metre = 8;
    PathSource source;
    source.camera_at = [](int) { return full_hd(); };
    source.stands_still = true;
    const std::vector<Camera> eyes = cameras_of_frames(path, source);
    ASSERT_EQ(eyes.size(), 4U); // of each frame the left one first
    for (const std::size_t left : {0U, 2U}) {
        EXPECT_DOUBLE_EQ(glm::distance(eyes[left].position, eyes[left + 1].position), 2);
    }
}

/// Four tiles of 16 px in a row: the first lists a splat, and two are below another view.
TEST(WorkloadFacts, LeaveOutHiddenTiles) {
    FrameWorkload frame;
    frame.camera.width = 64;
    frame.camera.height = 16;
    frame.camera.hole = {16, 0, 47, 15};
    frame.tile_size = 16;
    frame.tiles_x = 4;
    frame.tiles_y = 1;
    frame.tile_begin = {0, 1, 1, 1, 1};
    const WorkloadFacts facts = facts_of(frame);
    EXPECT_EQ(facts.tiles, 2U);
    EXPECT_EQ(facts.empty_tiles, 1U);
    EXPECT_EQ(facts.pixels, 2U * 16 * 16);
}

TEST(Resolution, NamesAreHeights) {
    const std::vector<int> widths{1280, 1920, 2560, 3840, 7680};
    const std::vector<int> heights{720, 1080, 1440, 2160, 4320};
    const std::vector<std::string> names = resolution_names();
    ASSERT_EQ(names.size(), heights.size());
    for (std::size_t i = 0; i < names.size(); ++i) {
        const Camera camera = resize(full_hd(), {}, resolution_height(names[i]));
        EXPECT_EQ(camera.width, widths[i]) << names[i];
        EXPECT_EQ(camera.height, heights[i]) << names[i];
        EXPECT_DOUBLE_EQ(camera.fx, 1500.0 * heights[i] / 1080) << names[i];
        EXPECT_DOUBLE_EQ(camera.fy, 1510.0 * heights[i] / 1080) << names[i];
    }
}

TEST(Resolution, KeepsTheAspectRatioOfTheCamera) {
    Camera camera = full_hd();
    camera.width = 648;
    camera.height = 420;
    const Camera large = resize(camera, {}, resolution_height("4K"));
    EXPECT_EQ(large.height, 2160);
    EXPECT_EQ(large.width, 3333); // 648 / 420 of 2160 is 3332.57
    EXPECT_NEAR(large.fy / camera.fy, large.fx / camera.fx, 1e-12);
    EXPECT_NEAR(large.fx / camera.fx, 2160.0 / 420, 1e-3);
}

TEST(Resolution, MayBeAnySize) {
    const ImageSize headset = image_size("2064x2208");
    EXPECT_EQ(headset.width, 2064);
    EXPECT_EQ(headset.height, 2208);
    EXPECT_EQ(image_size("1X3").height, 3);
    EXPECT_EQ(image_size("4K").height, 2160);
    EXPECT_FALSE(image_size("4K").width);
    const Camera resized = resize(full_hd(), headset.width, headset.height);
    EXPECT_EQ(resized.width, 2064);
    EXPECT_EQ(resized.height, 2208);
    for (const char* text : {"0x5", "5x0", "-1x5", "5x-1", "x", "5x", "x5", "5x5x5", "5x5 ", "5 x5",
                             "99999999999x1", "5k", ""}) {
        EXPECT_THROW(image_size(text), InputError) << text;
    }
}

TEST(Resolution, UnknownNamesListTheKnown) {
    for (const char* name : {"", "4kk", "1080", "p"}) {
        try {
            resolution_height(name);
            FAIL() << name;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find("720p, 1080p, 2k, 4k, 8k"), std::string::npos);
        }
    }
}

} // namespace
} // namespace degs::sim
