// SPDX-License-Identifier: Apache-2.0
// Off-centre views and their mirror images: a mirrored scene, and a camera with left-handed axes.
#include <array>

#include "splat/reference/reference_renderer.hpp"
#include "tests/splat/frame/brute_force.hpp"

namespace degs {
namespace {

constexpr int kWidth = 96, kHeight = 70;

/// Large splats, most of them beyond the limits of the Jacobian's slopes.
GaussianCloud wide_cloud() {
    GaussianCloud cloud = test::random_cloud(300, 11, 3);
    std::mt19937 random(5);
    std::uniform_real_distribution<double> slope(-2.5, 2.5);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        const double z = cloud.means[i].z + 0.5;
        cloud.means[i] = {slope(random) * z, 0.5 * slope(random) * z, z};
        cloud.scales[i] *= 8.0F;
    }
    return cloud;
}

/// x becomes -x: rotations keep their part about x, and functions of SH that are odd in x change
/// sign.
GaussianCloud mirrored(GaussianCloud cloud) {
    constexpr std::array<int, 6> kOddInX{3, 4, 7, 10, 13, 15};
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        cloud.means[i].x = -cloud.means[i].x;
        cloud.rotations[i] = {cloud.rotations[i].x, cloud.rotations[i].y, -cloud.rotations[i].z,
                              -cloud.rotations[i].w};
        for (const int k : kOddInX) {
            for (int channel = 0; channel < 3; ++channel) {
                float& sh = cloud.sh[(i * cloud.sh_coefficients() + k) * 3 + channel];
                sh = -sh;
            }
        }
    }
    return cloud;
}

/// The principal point lies `shift` px to the right of the middle, perhaps outside of the image.
Camera camera_at(double shift) {
    Camera camera = test::make_camera(kWidth, kHeight, 80);
    EXPECT_TRUE(camera.set_principal_point({0.5 * kWidth + shift, 0.5 * kHeight + 7}));
    return camera;
}

Image image_of(const GaussianCloud& cloud, const Camera& camera, ProjectionRule rule) {
    ProjectionOptions options;
    options.rule = rule;
    ReferenceCounts counts;
    return render_reference(make_frame_workload(cloud, camera, 16, TileMode::Exact, options),
                            counts);
}

/// The largest difference of a channel between an image and the other one seen in a mirror.
double mirror_error(const Image& a, const Image& b) {
    double most = 0;
    for (int y = 0; y < kHeight; ++y) {
        for (int x = 0; x < kWidth; ++x) {
            for (int channel = 0; channel < 3; ++channel) {
                const double one = a.rgb[3 * a.at(x, y) + channel];
                const double other = b.rgb[3 * b.at(kWidth - 1 - x, y) + channel];
                most = std::max(most, std::abs(one - other));
            }
        }
    }
    return most;
}

class MirroredViews : public testing::TestWithParam<std::tuple<ProjectionRule, double>> {};

TEST_P(MirroredViews, AreMirrorImages) {
    const auto& [rule, shift] = GetParam();
    const GaussianCloud cloud = wide_cloud();
    const Image image = image_of(cloud, camera_at(shift), rule);
    EXPECT_LT(mirror_error(image, image_of(mirrored(cloud), camera_at(-shift), rule)), 1e-6);
    Camera left_handed = camera_at(-shift);
    left_handed.camera_to_world[0] = -left_handed.camera_to_world[0];
    EXPECT_LT(mirror_error(image, image_of(cloud, left_handed, rule)), 1e-6);
    EXPECT_GT(mirror_error(image, image), 0.1);
}

// Outside of the image to the left, inside off the middle, in the middle, and outside to the right.
INSTANTIATE_TEST_SUITE_P(Shifts, MirroredViews,
                         testing::Combine(testing::Values(ProjectionRule::Linear,
                                                          ProjectionRule::Unscented),
                                          testing::Values(-90.0, -20.5, 0.0, 33.0, 120.0)));

/// The covariance far outside is that of a centred view of the raster's size, on both sides: the
/// limits of its slopes are 1.3 times those of the raster.
TEST(OffCentreViews, LimitSlopesByTheirRaster) {
    for (const double shift : {-120.0, -31.0, 31.0, 120.0}) {
        const Camera camera = camera_at(shift);
        const int raster = kWidth + static_cast<int>(2 * std::abs(shift));
        const Camera whole = test::make_camera(raster, kHeight + 14, 80);
        for (const double side : {-1.0, 1.0}) {
            const double limit = 1.3 * raster / (2.0 * 80);
            for (const double slope : {0.98 * limit, 1.05 * limit, 2 * limit}) {
                GaussianCloud cloud;
                test::add_gaussian(cloud, {side * slope * 3, 0.2, 3}, {0.3F, 0.1F, 0.2F},
                                   test::turn_about_z(0.4), 0.9F, test::kGrey);
                ProjectedSplat splat;
                make_projector(cloud, camera, {})->project_anywhere(0, splat);
                const test::BruteSplat brute = test::brute_project(cloud, 0, whole);
                EXPECT_NEAR(splat.cov_a, static_cast<double>(brute.a), 1e-9 * splat.cov_a);
                EXPECT_NEAR(splat.cov_b, static_cast<double>(brute.b), 1e-9 * splat.cov_a);
            }
        }
    }
}

} // namespace
} // namespace degs
