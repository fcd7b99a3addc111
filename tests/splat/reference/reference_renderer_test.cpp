// SPDX-License-Identifier: Apache-2.0
#include "splat/reference/reference_renderer.hpp"

#include "tests/splat/frame/brute_force.hpp"

namespace degs {
namespace {

using test::add_gaussian;
using test::brute_render;
using test::BruteImage;
using test::BruteSplat;
using test::expect_same_image;
using test::make_camera;

struct Rendered {
    Image image;
    ReferenceCounts counts;
};

Rendered render(const GaussianCloud& cloud, const Camera& camera, int tile_size = 16,
                TileMode mode = TileMode::Exact, const ProjectionOptions& options = {}) {
    Rendered out;
    const FrameWorkload work = make_frame_workload(cloud, camera, tile_size, mode, options);
    out.image = render_reference(work, out.counts);
    return out;
}

/// The image, the counts and the count of stops against brute force.
void expect_brute_force(const GaussianCloud& cloud, const Camera& camera, int tile_size = 16,
                        const ProjectionOptions& options = {}) {
    const Rendered out = render(cloud, camera, tile_size, TileMode::Exact, options);
    const BruteImage brute = brute_render(cloud, camera, options);
    expect_same_image(out.image, brute);
    std::uint64_t fragments = 0;
    for (const std::uint32_t count : brute.fragments) {
        fragments += count;
    }
    EXPECT_EQ(out.counts.fragments, fragments);
    EXPECT_EQ(out.counts.terminated, brute.terminated);
}

TEST(ReferenceRenderer, OneIsotropicSplatFollowsTheFormula) {
    GaussianCloud cloud;
    add_gaussian(cloud, {0, 0, 5}, glm::vec3(0.25F), test::kNoTurn, 0.75F, {0.5F, 1, 2});
    const Rendered out = render(cloud, make_camera(65, 65, 100)); // sigma^2 = 25.3, centre (32, 32)
    std::uint64_t inside = 0;
    for (int y = 0; y < 65; ++y) {
        for (int x = 0; x < 65; ++x) {
            const double distance2 = (x - 32) * (x - 32) + (y - 32) * (y - 32);
            double alpha = 0.75 * std::exp(-0.5 * distance2 / 25.3);
            alpha = alpha < 1.0 / 255 ? 0 : alpha;
            inside += alpha > 0 ? 1 : 0;
            const std::size_t at = out.image.at(x, y);
            EXPECT_NEAR(out.image.transmittance[at], 1 - alpha, 1e-7);
            EXPECT_NEAR(out.image.rgb[3 * at], 0.5 * alpha, 1e-7);
            EXPECT_NEAR(out.image.rgb[3 * at + 1], alpha, 1e-7);
            EXPECT_NEAR(out.image.rgb[3 * at + 2], 2 * alpha, 2e-7);
            EXPECT_EQ(out.image.fragments[at], alpha > 0 ? 1U : 0U);
        }
    }
    EXPECT_EQ(out.counts.fragments, inside);
    EXPECT_EQ(out.counts.terminated, 0U);
}

class RandomScenes : public testing::TestWithParam<unsigned> {};

TEST_P(RandomScenes, EqualBruteForce) {
    const GaussianCloud cloud =
        test::random_cloud(500, GetParam(), static_cast<int>(GetParam() % 4));
    Camera camera = make_camera(61, 47, 40);
    camera.fy = 45;
    camera.position = {0.1, 0.2, -0.3};
    camera.camera_to_world = glm::dmat3(test::rotation_matrix(glm::vec4(1, 0.05F, -0.1F, 0.07F)));
    expect_brute_force(cloud, camera);
}

TEST_P(RandomScenes, OpaqueScenesTerminateLikeBruteForce) {
    GaussianCloud cloud = test::random_cloud(800, GetParam());
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        cloud.scales[i] *= 5;
        cloud.opacities[i] = 0.9F + 0.1F * cloud.opacities[i];
    }
    const Camera camera = make_camera(40, 30, 30);
    EXPECT_GT(render(cloud, camera).counts.terminated, 1000U);
    expect_brute_force(cloud, camera, 8);
}

TEST_P(RandomScenes, TileSizeDoesNotMatter) {
    const GaussianCloud cloud = test::random_cloud(2000, GetParam(), 1);
    const Camera camera = make_camera(150, 101, 100);
    const Rendered first = render(cloud, camera, 8);
    EXPECT_GT(first.counts.fragments, 10000U);
    for (const int tile_size : {1, 16, 32, 128, 1000}) {
        const Rendered other = render(cloud, camera, tile_size);
        EXPECT_EQ(first.image.rgb, other.image.rgb); // bit for bit
        EXPECT_EQ(first.image.transmittance, other.image.transmittance);
        EXPECT_EQ(first.image.fragments, other.image.fragments);
        EXPECT_EQ(first.counts.fragments, other.counts.fragments);
        EXPECT_EQ(first.counts.terminated, other.counts.terminated);
    }
}

INSTANTIATE_TEST_SUITE_P(Seeds, RandomScenes, testing::Values(1U, 2U, 3U, 4U));

// H1: lengths up to 10^4 px, aspect up to 10^5; most of each needle lies outside the image.
TEST(ReferenceRendererHardCases, Needles) {
    const double px = 10.0 / 100; // scene units per pixel at z = 10
    for (const double degrees : {0.0, 1.0, 45.0, 90.0, 135.0}) {
        GaussianCloud cloud;
        std::mt19937 random(5);
        std::uniform_real_distribution<double> uniform(-1, 1);
        for (const double length : {10.0, 100.0, 1e3, 1e4}) {
            for (const double aspect : {1e2, 1e3, 1e5}) {
                const double angle = degrees * test::kPi / 180;
                const double along = 0.5 * length * uniform(random);
                const glm::dvec3 mean(px * along * std::cos(angle) + uniform(random),
                                      px * along * std::sin(angle) + uniform(random), 10);
                const glm::vec3 scale(px * length, px * length / aspect, 0.001);
                add_gaussian(cloud, mean, scale, test::turn_about_z(angle), 0.9F,
                             {0.2F, 0.9F, 0.5F});
            }
        }
        const Camera camera = make_camera(100, 90, 100);
        EXPECT_GT(render(cloud, camera).counts.fragments, 1000U) << degrees;
        expect_brute_force(cloud, camera);
    }
}

// H3, H6: splats larger than their distance, and wide splats centred far outside the frustum.
TEST(ReferenceRendererHardCases, CloseAndOutside) {
    GaussianCloud cloud;
    for (int i = 0; i < 20; ++i) {
        const double z = 0.2001 + 0.005 * i;
        add_gaussian(cloud, {0.01 * i - 0.1, 0.05, z}, glm::vec3(0.2F, 0.3F, 0.5F),
                     test::turn_about_z(i), 0.1F, {0.1F, 0.5F, 0.9F});
        add_gaussian(cloud, {20.0 + i, -3, 5}, glm::vec3(10, 8, 3), test::turn_about_z(i), 0.3F,
                     {0.9F, 0.5F, 0.1F});
    }
    expect_brute_force(cloud, make_camera(50, 40, 40));
}

// H2 has no counterpart here (det is positive by construction); H4: a scene of a few centimetres.
TEST(ReferenceRendererHardCases, TinySceneNeedsItsOwnNearPlane) {
    GaussianCloud cloud = test::random_cloud(300, 21);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        cloud.means[i] *= 0.01;
        cloud.scales[i] *= 0.01F;
    }
    const Camera camera = make_camera(40, 40, 40);
    EXPECT_EQ(render(cloud, camera).counts.fragments, 0U);
    ProjectionOptions options;
    options.near_plane = 0.001;
    EXPECT_GT(render(cloud, camera, 16, TileMode::Exact, options).counts.fragments, 1000U);
    expect_brute_force(cloud, camera, 16, options);
}

// H10: just below, at and above 1/255; 1; above 1. All centred on a pixel.
TEST(ReferenceRendererHardCases, OpacityAtTheThreshold) {
    const float threshold = 1.0F / 255; // as float slightly above 1/255
    const auto fragments = [](float opacity) {
        GaussianCloud cloud;
        add_gaussian(cloud, {0, 0, 5}, glm::vec3(0.25F), test::kNoTurn, opacity, glm::vec3(1));
        return render(cloud, make_camera(65, 65, 100)).counts.fragments;
    };
    EXPECT_EQ(fragments(0), 0U);
    EXPECT_EQ(fragments(std::nextafter(threshold, 0.0F)), 0U);
    EXPECT_EQ(fragments(threshold), 1U);
    EXPECT_EQ(fragments(threshold * 1.05F), 9U); // q <= 0.0976: distance^2 <= 2.47
    GaussianCloud above;
    add_gaussian(above, {0, 0, 5}, glm::vec3(0.25F), test::kNoTurn, 3.0F, glm::vec3(1));
    expect_brute_force(above, make_camera(65, 65, 100));
}

// H11, H13: alpha is at most 0.99, and the splat that would push T under 1e-4 is not blended.
TEST(ReferenceRendererHardCases, SaturatedPixelRefusesTheCrossingSplat) {
    GaussianCloud cloud;
    for (int i = 0; i < 100; ++i) {
        add_gaussian(cloud, {0, 0, 5 + i}, glm::vec3(100), test::kNoTurn, 1.0F, glm::vec3(1));
    }
    const Rendered out = render(cloud, make_camera(20, 20, 20));
    EXPECT_EQ(out.counts.terminated, 400U);
    for (std::size_t i = 0; i < 400; ++i) {
        EXPECT_EQ(out.image.fragments[i], 2U); // 0.01 * 0.01 in double lies just above 1e-4
        EXPECT_NEAR(out.image.transmittance[i], 1e-4, 1e-11);
    }
}

TEST(ReferenceRendererHardCases, TheStopIsPermanent) {
    const auto centre = [](std::vector<float> opacities) {
        GaussianCloud cloud;
        double z = 5;
        for (const float opacity : opacities) {
            add_gaussian(cloud, {0, 0, z++}, glm::vec3(10), test::kNoTurn, opacity, glm::vec3(1));
        }
        const Rendered out = render(cloud, make_camera(1, 1, 10));
        return std::make_pair(out.image.fragments[0], out.counts.terminated);
    };
    using Pair = std::pair<std::uint32_t, std::uint64_t>;
    EXPECT_EQ(centre({0.99F, 0.989F, 0.05F}), Pair(3, 0));       // T 1.1e-4, then 1.045e-4
    EXPECT_EQ(centre({0.99F, 0.989F, 0.2F, 0.05F}), Pair(2, 1)); // refused, then nothing more
}

// H14: duplicates and equal depths in index order.
TEST(ReferenceRendererHardCases, EqualDepthsBlendInIndexOrder) {
    GaussianCloud cloud;
    add_gaussian(cloud, {0, 0, 5}, glm::vec3(10), test::kNoTurn, 0.5F, {1, 0, 0});
    add_gaussian(cloud, {0, 0, 5}, glm::vec3(10), test::kNoTurn, 0.5F, {0, 1, 0});
    add_gaussian(cloud, {0, 0, 5}, glm::vec3(10), test::kNoTurn, 0.5F, {0, 0, 1});
    const Rendered out = render(cloud, make_camera(1, 1, 10));
    EXPECT_NEAR(out.image.rgb[0], 0.5, 1e-6);
    EXPECT_NEAR(out.image.rgb[1], 0.25, 1e-6);
    EXPECT_NEAR(out.image.rgb[2], 0.125, 1e-6);
}

// H15
TEST(ReferenceRendererHardCases, HugeDepthRange) {
    GaussianCloud cloud = test::random_cloud(300, 31);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        const double factor = std::pow(10.0, static_cast<double>(i % 8));
        cloud.means[i] *= factor;
        cloud.scales[i] *= static_cast<float>(factor);
    }
    expect_brute_force(cloud, make_camera(50, 50, 40));
}

// H19: centres on pixels, between pixels and on tile corners.
TEST(ReferenceRendererHardCases, CentresOnTheGrid) {
    GaussianCloud cloud;
    const double px = 0.0625; // exact in binary: z = 4, focal length 64
    for (const double x : {0.0, 7.5, 8.0, 15.5, 16.0, 31.5, 32.0}) {
        for (const double y : {0.0, 7.5, 15.5, 16.0, 31.5}) {
            add_gaussian(cloud, {(x - 15.5) * px, (y - 15.5) * px, 4}, glm::vec3(0.05F),
                         test::kNoTurn, 0.6F, {0.3F, 0.6F, 0.9F});
        }
    }
    expect_brute_force(cloud, make_camera(32, 32, 64));
}

// H20: sizes that are not a multiple of the tile, down to a single pixel or line.
TEST(ReferenceRendererHardCases, OddSizes) {
    const GaussianCloud cloud = test::random_cloud(300, 41);
    for (const auto& [width, height] : {std::pair(1, 1), {1, 40}, {40, 1}, {17, 33}, {15, 31}}) {
        expect_brute_force(cloud, make_camera(width, height, 20));
    }
}

// H21
TEST(ReferenceRendererHardCases, EmptyScenesAreBackground) {
    GaussianCloud behind;
    add_gaussian(behind, {0, 0, -5}, glm::vec3(1), test::kNoTurn, 1, glm::vec3(1));
    for (const GaussianCloud& cloud : {GaussianCloud(), behind}) {
        const Rendered out = render(cloud, make_camera(33, 17, 20));
        EXPECT_EQ(out.image.rgb, std::vector<float>(33 * 17 * 3, 0.0F));
        EXPECT_EQ(out.image.transmittance, std::vector<float>(33 * 17, 1.0F));
        EXPECT_EQ(out.counts.fragments, 0U);
    }
}

// H22: negative colours are black, large ones are kept.
TEST(ReferenceRendererHardCases, ColoursAreNotClampedAbove) {
    GaussianCloud cloud;
    add_gaussian(cloud, {0, 0, 5}, glm::vec3(10), test::kNoTurn, 0.5F, {-3, 2, 1000});
    const Rendered out = render(cloud, make_camera(1, 1, 10));
    EXPECT_EQ(out.image.rgb[0], 0);
    EXPECT_NEAR(out.image.rgb[1], 1, 1e-6);
    EXPECT_NEAR(out.image.rgb[2], 500, 1e-3);
}

// H23: positions on a grid of 2^-10 stay exact in double at offsets of 2^23, so must the image.
TEST(ReferenceRendererHardCases, WorldOffsetsDoNotMoveAnything) {
    GaussianCloud cloud = test::random_cloud(300, 51, 2);
    Camera camera = make_camera(40, 40, 40);
    for (glm::dvec3& mean : cloud.means) {
        mean = glm::round(mean * 1024.0) / 1024.0;
    }
    const Rendered near = render(cloud, camera);
    const glm::dvec3 offset(8388608, -4194304, 131072);
    camera.position += offset;
    for (glm::dvec3& mean : cloud.means) {
        mean += offset;
    }
    const Rendered far = render(cloud, camera);
    EXPECT_GT(near.counts.fragments, 1000U);
    EXPECT_EQ(near.image.rgb, far.image.rgb);
    EXPECT_EQ(near.image.fragments, far.image.fragments);
}

/// The tile rectangle of the original, written down once more: 16 x 16 tiles of a 61 x 47 image.
bool in_original_tiles(const BruteSplat& s, int x, int y) {
    const long double mid = (s.a + s.c) / 2;
    const long double lambda = mid + std::sqrt(std::max(0.1L, mid * mid - s.det));
    const long double r = std::ceil(3 * std::sqrt(lambda));
    const auto inside = [r](long double mu, int pixel) {
        const int tile = pixel / 16;
        return tile >= static_cast<int>((mu - r) / 16) &&
               tile < static_cast<int>((mu + r + 15) / 16);
    };
    return inside(s.mu_x, x) && inside(s.mu_y, y);
}

TEST_P(RandomScenes, RefTilesEqualTheOriginalRectangles) {
    GaussianCloud cloud = test::random_cloud(500, GetParam());
    for (float& opacity : cloud.opacities) {
        opacity = 0.5F + 0.5F * opacity; // larger ellipses than squares: the lists matter
    }
    const Camera camera = make_camera(61, 47, 40);
    const Rendered square = render(cloud, camera, 16, TileMode::Square);
    expect_same_image(square.image, brute_render(cloud, camera, {}, in_original_tiles));
    EXPECT_LT(square.counts.fragments, render(cloud, camera).counts.fragments);
}

} // namespace
} // namespace degs
