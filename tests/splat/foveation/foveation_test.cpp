// SPDX-License-Identifier: Apache-2.0
// Levels of foveated images: where they lie, what they see, and the image that they make up.
#include "splat/foveation/foveation.hpp"

#include "splat/foveation/coarse_samples.hpp"
#include "splat/foveation/compose.hpp"
#include "tests/splat/frame/brute_force.hpp"
#include "tests/splat/model/published_lens.hpp"

namespace degs {
namespace {

/// Cameras of any size, some of them off the centre or parts of larger ones, with a foveation.
class Draw {
public:
    explicit Draw(unsigned seed) : random_(seed) {}

    int below(int end) { return static_cast<int>(random_() % end); }
    double share() { return std::uniform_real_distribution<double>(0, 1)(random_); }
    Camera camera() {
        Camera camera = test::make_camera(1 + below(90), 1 + below(90), 5 + 100 * share());
        camera.fy = camera.fx * (0.5 + share());
        camera.camera_to_world = glm::dmat3(test::rotation_matrix(test::random_rotation(random_)));
        camera.position = {share(), share(), share()};
        if (below(3) == 0) {
            EXPECT_TRUE(camera.set_principal_point({200 * share() - 50, 200 * share() - 50}));
        }
        if (below(3) == 0) {
            const int x = below(camera.width), y = below(camera.height);
            camera = camera.cropped({x, y, camera.width - 1, camera.height - 1});
        }
        return camera;
    }
    Foveation foveation() {
        const double edges[] = {0, 1, 0.5, share()};
        const double angles[] = {1e-9, 90, 30 * share() + 0.1, 90 * share() + 0.1};
        const double a = angles[below(4)], b = angles[below(4)];
        return {{edges[below(4)], edges[below(4)]}, std::min(a, b), std::max(a, b)};
    }

private:
    std::mt19937 random_;
};

/// The samples of a level whose values are `value(x, y)` at the centres of its pixels, px of the
/// image; NaN where the level has none.
template <class Value>
Image drawn(const FoveatedLevel& level, const Value& value) {
    const Camera& camera = level.camera;
    Image image(camera.width, camera.height);
    for (int y = 0; y < camera.height; ++y) {
        for (int x = 0; x < camera.width; ++x) {
            const bool hole = camera.hole.holds(camera.origin.x + x, camera.origin.y + y);
            const double at_x = (level.first.x + x + 0.5) * level.scale;
            const double at_y = (level.first.y + y + 0.5) * level.scale;
            const double v = hole ? std::nan("") : value(at_x, at_y);
            const double colour[] = {v, v, v};
            image.put(image.at(x, y), colour, v, 1);
        }
    }
    return image;
}

// What lies in a hole is NaN here, so that the image would show it.
TEST(Foveation, ComposesEveryPixelFromSamplesThatAreDrawn) {
    Draw draw(3);
    std::array<int, 4> levels{};
    int holes = 0;
    for (int trial = 0; trial < 3000; ++trial) {
        const Camera camera = draw.camera();
        const std::vector<FoveatedLevel> parts = levels_of(camera, draw.foveation());
        ASSERT_LE(parts.size(), 3U);
        ++levels[parts.size()];
        std::vector<Image> images;
        std::vector<const Image*> pointers;
        for (const FoveatedLevel& part : parts) {
            ASSERT_TRUE(part.camera.has_sound_raster());
            images.push_back(drawn(part, [](double x, double y) { return 2 + 3 * x - y; }));
            holes += part.camera.hole.empty() ? 0 : 1;
        }
        for (const Image& image : images) {
            pointers.push_back(&image);
        }
        const Image image = compose(camera, parts, pointers);
        const std::vector<unsigned char> shown = shown_levels(camera, parts);
        for (int y = 0; y < camera.height; ++y) {
            for (int x = 0; x < camera.width; ++x) {
                const std::size_t at = image.at(x, y);
                const int scale = parts[shown[at]].scale;
                // A plane comes out as it is, but within half a sample of the border, which
                // repeats.
                const bool inside = 2 * x + 1 >= scale && 2 * y + 1 >= scale &&
                                    2 * x + 1 + scale <= 2 * camera.width &&
                                    2 * y + 1 + scale <= 2 * camera.height;
                const double plane = 2 + 3 * (x + 0.5) - (y + 0.5);
                ASSERT_NEAR(image.rgb[3 * at], plane, inside ? 1e-3 : 4.0 * scale);
                ASSERT_EQ(image.fragments[at], 1U);
            }
        }
    }
    EXPECT_GT(levels[1], 100);
    EXPECT_GT(levels[2], 100);
    EXPECT_GT(levels[3], 100);
    EXPECT_GT(holes, 500);
}

TEST(Foveation, HasTheWholeImageInAFoveaThatReachesItsCorners) {
    const Camera camera = test::make_camera(101, 67, 80);
    const std::vector<FoveatedLevel> levels = levels_of(camera, {{0.5, 0.5}, 90, 90});
    ASSERT_EQ(levels.size(), 1U);
    EXPECT_EQ(levels[0].camera.width, 101);
    EXPECT_EQ(levels[0].camera.shift, camera.shift);
    EXPECT_EQ(levels[0].camera.origin, camera.origin);
    EXPECT_TRUE(levels[0].camera.hole.empty());
}

TEST(Foveation, LeavesOutTheMiddleBetweenEqualAngles) {
    const std::vector<FoveatedLevel> levels =
        levels_of(test::make_camera(200, 100, 100), {{0.5, 0.5}, 10, 10});
    ASSERT_EQ(levels.size(), 2U);
    EXPECT_EQ(levels[0].scale, 1);
    EXPECT_EQ(levels[1].scale, 4);
}

// By hand: tan 10 degrees x 100 px = 17.6 px, tan 20 degrees x 100 px = 36.4 px.
TEST(Foveation, ReachesItsAnglesRoundedOutward) {
    const std::vector<FoveatedLevel> levels =
        levels_of(test::make_camera(200, 100, 100), {{0.25, 1}, 10, 20});
    ASSERT_EQ(levels.size(), 3U);
    EXPECT_EQ(levels[0].shown, (PixelBox{32, 82, 67, 99}));
    EXPECT_EQ(levels[1].shown, (PixelBox{13, 63, 86, 99}));
    EXPECT_EQ(levels[2].shown, (PixelBox{0, 0, 199, 99}));
    EXPECT_EQ(levels[1].first, glm::ivec2(6, 31)); // pixel 13 lies between samples 6 and 7
    EXPECT_EQ(levels[1].camera.width, 43 - 6 + 1);
    EXPECT_EQ(levels[2].camera.pixels(), 50U * 25U);
}

TEST(CoarsenedCamera, SeesEveryPointWhereTheCameraDoes) {
    Draw draw(8);
    for (int trial = 0; trial < 500; ++trial) {
        Camera camera = draw.camera();
        if (trial % 2 == 0) {
            camera.lens =
                test::published_lenses()[trial / 2 % test::published_lenses().size()].lens();
        }
        for (const int factor : {1, 2, 4}) {
            const Camera coarse = camera.coarsened(factor);
            EXPECT_EQ(coarse.width, (camera.width + factor - 1) / factor);
            EXPECT_TRUE(coarse.has_sound_raster());
            const glm::dvec3 seen(draw.share() - 0.5, draw.share() - 0.5, 2 + draw.share());
            const glm::dvec3 point = camera.camera_to_world * seen + camera.position;
            const auto fine = camera.landing_of(point), other = coarse.landing_of(point);
            ASSERT_EQ(fine.has_value(), other.has_value());
            if (fine) {
                const glm::dvec2 a = (*fine - glm::dvec2(camera.origin)) / double(factor);
                const glm::dvec2 b = *other - glm::dvec2(coarse.origin);
                EXPECT_NEAR(a.x, b.x, 1e-9);
                EXPECT_NEAR(a.y, b.y, 1e-9);
            }
        }
    }
}

TEST(CoarsenedCamera, OfEvenSizesIsTheScaledOne) {
    const Camera camera = test::make_camera(200, 100, 130);
    const Camera coarse = camera.coarsened(2), scaled = camera.scaled_to_width(100);
    EXPECT_EQ(coarse.height, scaled.height);
    EXPECT_EQ(coarse.fx, scaled.fx);
    EXPECT_EQ(coarse.shift, scaled.shift);
    EXPECT_EQ(coarse.origin, scaled.origin);
    EXPECT_TRUE(coarse.is_centred());
}

} // namespace
} // namespace degs
