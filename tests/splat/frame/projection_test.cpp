// SPDX-License-Identifier: Apache-2.0
#include "splat/frame/projection.hpp"

#include <limits>

#include "tests/splat/frame/brute_force.hpp"

namespace degs {
namespace {

using test::add_gaussian;
using test::brute_project;
using test::make_camera;

/// One Gaussian in front of a 64 x 48 camera of focal length 100.
struct OneGaussian {
    GaussianCloud cloud;
    Camera camera = make_camera(64, 48, 100);
    ProjectionOptions options;
    ProjectedSplat splat;

    explicit OneGaussian(const glm::dvec3& mean, const glm::vec3& scale = glm::vec3(0.1F),
                         float opacity = 0.5F, const glm::vec4& rotation = test::kNoTurn) {
        add_gaussian(cloud, mean, scale, rotation, opacity, test::kGrey);
    }
    Cull run() { return project(cloud, 0, camera, options, splat); }
};

TEST(Projection, MatchesTheTextbookFormulas) {
    std::mt19937 random(7);
    const GaussianCloud cloud = test::random_cloud(300, 7);
    Camera camera = make_camera(640, 360, 500);
    camera.fy = 450;
    camera.position = {0.3, -0.2, -0.5};
    camera.camera_to_world =
        glm::dmat3(test::rotation_matrix(glm::normalize(glm::vec4(1, 0.1F, -0.2F, 0.3F))));
    int compared = 0;
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        ProjectedSplat splat;
        if (project_anywhere(cloud, i, camera, {}, splat) != Cull::None) {
            continue;
        }
        const test::BruteSplat brute = brute_project(cloud, i, camera);
        const double size = static_cast<double>(brute.a + brute.c);
        EXPECT_NEAR(splat.mu_x, static_cast<double>(brute.mu_x),
                    1e-11 * (1 + std::abs(splat.mu_x)));
        EXPECT_NEAR(splat.mu_y, static_cast<double>(brute.mu_y),
                    1e-11 * (1 + std::abs(splat.mu_y)));
        EXPECT_NEAR(splat.cov_a, static_cast<double>(brute.a), 1e-13 * size);
        EXPECT_NEAR(splat.cov_b, static_cast<double>(brute.b), 1e-13 * size);
        EXPECT_NEAR(splat.cov_c, static_cast<double>(brute.c), 1e-13 * size);
        EXPECT_NEAR(splat.det / static_cast<double>(brute.det), 1, 1e-12);
        EXPECT_EQ(static_cast<float>(splat.depth), brute.depth);
        EXPECT_EQ(splat.id, i);
        ++compared;
    }
    EXPECT_GT(compared, 200);
}

TEST(Projection, IsotropicSplatAtTheCentre) {
    OneGaussian one({0, 0, 5}, glm::vec3(0.25F)); // 5 px
    ASSERT_EQ(one.run(), Cull::None);
    EXPECT_DOUBLE_EQ(one.splat.mu_x, 31.5); // between the two middle pixels
    EXPECT_DOUBLE_EQ(one.splat.mu_y, 23.5);
    EXPECT_NEAR(one.splat.cov_a, 25.3, 1e-12);
    EXPECT_NEAR(one.splat.cov_b, 0, 1e-12);
    EXPECT_NEAR(one.splat.det, 25.3 * 25.3, 1e-10);
    EXPECT_NEAR(one.splat.q_threshold, 2 * std::log(127.5), 1e-14);
    EXPECT_NEAR(one.splat.conic_a(), 1 / 25.3, 1e-15);
    EXPECT_NEAR(one.splat.conic_c(), 1 / 25.3, 1e-15);
}

// H1: a c - b^2 has lost all digits long before these lengths.
TEST(Projection, NeedleDeterminantKeepsItsDigits) {
    for (const double length : {1e2, 1e3, 1e4, 1e5}) {    // px, standard deviation
        for (const double thickness : {0.0, 0.01, 0.1}) { // px
            for (const double degrees : {0.0, 30.0, 45.0, 60.0, 90.0}) {
                const double px = 10.0 / 100; // scene units per pixel at z = 10
                const auto turn = test::turn_about_z(degrees * test::kPi / 180);
                OneGaussian one({0, 0, 10}, glm::vec3(length * px, thickness * px, 0), 0.5F, turn);
                ASSERT_EQ(one.run(), Cull::None);
                const long double l = static_cast<float>(length * px) / px;
                const long double t = static_cast<float>(thickness * px) / px;
                const long double exact = (l * l + 0.3L) * (t * t + 0.3L);
                EXPECT_NEAR(static_cast<double>(one.splat.det / exact), 1, 1e-12)
                    << length << " " << degrees;
            }
        }
    }
}

// H5, H4
TEST(Projection, NearPlaneIsStrictAndConfigurable) {
    OneGaussian at({0, 0, 0.2});
    EXPECT_EQ(at.run(), Cull::Near);
    OneGaussian beyond({0, 0, std::nextafter(0.2, 1.0)});
    EXPECT_EQ(beyond.run(), Cull::None);
    OneGaussian behind({0, 0, -1});
    EXPECT_EQ(behind.run(), Cull::Near);
    OneGaussian small({0, 0, 0.01}, glm::vec3(0.0001F));
    EXPECT_EQ(small.run(), Cull::Near);
    small.options.near_plane = 0.001;
    EXPECT_EQ(small.run(), Cull::None);
}

// H3: the projection of a splat larger than its distance is meaningless but must stay finite.
TEST(Projection, LargeSplatJustBehindTheNearPlaneIsFinite) {
    for (const float scale : {0.2F, 10.0F, 1e6F, 1e18F}) {
        OneGaussian one({0.1, 0.1, 0.2001}, glm::vec3(scale), 1.0F);
        ASSERT_EQ(one.run(), Cull::None);
        EXPECT_TRUE(std::isfinite(one.splat.conic_a()));
        EXPECT_GT(one.splat.det, 0);
        const PixelBox box = pixel_box(one.splat, {0, 0, 63, 47});
        EXPECT_EQ(box.x1 - box.x0, 63);
        EXPECT_EQ(box.y1 - box.y0, 47);
    }
}

// H6: 1.3 tan(fov/2) limits the Jacobian, not the position.
TEST(Projection, ClampAffectsTheJacobianOnly) {
    OneGaussian far_right({50, 0, 10}, glm::vec3(1, 0.01F, 2)); // x/z = 5, limit 0.416
    ASSERT_EQ(project_anywhere(far_right.cloud, 0, far_right.camera, {}, far_right.splat),
              Cull::None);
    EXPECT_NEAR(far_right.splat.mu_x, 5 * 100 + 31.5, 1e-10);
    const double limit = 1.3 * 64 / 200;
    EXPECT_NEAR(far_right.splat.cov_a, 100.0 * (1 + limit * limit * 4) + 0.3, 1e-10);
    EXPECT_EQ(far_right.run(), Cull::OffScreen);
    far_right.options.jacobian_clamp = 100;
    far_right.run();
    EXPECT_NEAR(far_right.splat.cov_a, 100.0 * (1 + 25 * 4) + 0.3, 1e-9);
}

// H10
TEST(Projection, OpacityAroundTheThreshold) {
    const float above = 1.0F / 255.0F; // rounds up
    OneGaussian faint({0, 0, 5}, glm::vec3(0.25F), above);
    ASSERT_EQ(faint.run(), Cull::OffScreen); // the centre lies between pixels: nothing to draw
    OneGaussian below({0, 0, 5}, glm::vec3(0.25F), std::nextafter(above, 0.0F));
    EXPECT_EQ(below.run(), Cull::Transparent);
    OneGaussian zero({0, 0, 5}, glm::vec3(0.25F), 0);
    EXPECT_EQ(zero.run(), Cull::Transparent);
    OneGaussian more({0, 0, 5}, glm::vec3(0.25F), 2);
    ASSERT_EQ(more.run(), Cull::None);
    EXPECT_NEAR(more.splat.q_threshold, 2 * std::log(510.0), 1e-14);
    OneGaussian exact({0, 0, 5}, glm::vec3(0.25F), 0.25F);
    exact.camera = make_camera(65, 49, 100);
    exact.options.alpha_min = 0.25;
    ASSERT_EQ(exact.run(), Cull::None);
    EXPECT_EQ(exact.splat.q_threshold, 0);
    const PixelBox box = pixel_box(exact.splat, {0, 0, 64, 48});
    EXPECT_EQ(box.x0, 32);
    EXPECT_EQ(box.x1, 32);
    EXPECT_EQ(box.y0, 24);
    EXPECT_EQ(box.y1, 24);
}

// H8, H9: `sanitize` removes these, but a projection must not rely on it.
TEST(Projection, NonFiniteInputIsDropped) {
    const float inf = std::numeric_limits<float>::infinity();
    const float nan = std::numeric_limits<float>::quiet_NaN();
    const glm::vec3 scale(0.1F);
    EXPECT_EQ(OneGaussian({nan, 0, 5}).run(), Cull::Near); // view z is NaN
    EXPECT_EQ(OneGaussian({0, 0, 5}, scale, nan).run(), Cull::Transparent);
    EXPECT_EQ(OneGaussian({0, 0, 5}, scale, inf).run(), Cull::Degenerate);
    EXPECT_EQ(OneGaussian({0, 0, 5}, {inf, 1, 1}).run(), Cull::Degenerate);
    EXPECT_EQ(OneGaussian({0, 0, 5}, {1, nan, 1}).run(), Cull::Degenerate);
    EXPECT_EQ(OneGaussian({0, 0, 5}, scale, 0.5F, glm::vec4(0)).run(), Cull::Degenerate);
    EXPECT_EQ(OneGaussian({0, 0, 5}, scale, 0.5F, glm::vec4(nan)).run(), Cull::Degenerate);
    EXPECT_EQ(OneGaussian({0, 0, inf}).run(), Cull::Degenerate);
    EXPECT_EQ(OneGaussian({inf, 0, 5}).run(), Cull::Near); // inf * 0 in the rotation
}

TEST(Projection, QuaternionLengthDoesNotMatter) {
    const glm::vec4 turn = glm::normalize(glm::vec4(0.4F, -0.2F, 0.7F, 0.1F));
    OneGaussian unit({0, 0, 5}, {0.3F, 0.1F, 0.02F}, 0.5F, turn);
    ASSERT_EQ(unit.run(), Cull::None);
    for (const float length : {1e-15F, 0.5F, 1e15F}) {
        OneGaussian other({0, 0, 5}, {0.3F, 0.1F, 0.02F}, 0.5F, turn * length);
        ASSERT_EQ(other.run(), Cull::None);
        EXPECT_NEAR(other.splat.cov_b / unit.splat.cov_b, 1, 1e-6); // float rounding of the product
        EXPECT_NEAR(other.splat.det / unit.splat.det, 1, 1e-6);
    }
}

TEST(Projection, WithoutDilationAFlatSplatIsDegenerate) {
    OneGaussian flat({0, 0, 5}, {0.1F, 0, 0});
    EXPECT_EQ(flat.run(), Cull::None);
    flat.options.dilation = 0;
    EXPECT_EQ(flat.run(), Cull::Degenerate);
}

TEST(Projection, OffScreenMeansNoPixelCentreInTheBox) {
    // Half extent of a dilated point: sqrt(0.3 Q_th); the last column is 63.
    const double reach = std::sqrt(0.3 * 2 * std::log(127.5));
    const auto right_of = [](double pixel) {
        OneGaussian one({(pixel - 31.5) * 0.05, 0, 5}, glm::vec3(0));
        return one.run();
    };
    EXPECT_EQ(right_of(63 + reach - 1e-4), Cull::None);
    EXPECT_EQ(right_of(63 + reach + 1e-4), Cull::OffScreen);
    EXPECT_EQ(right_of(-reach + 1e-4), Cull::None);
    EXPECT_EQ(right_of(-reach - 1e-4), Cull::OffScreen);
    EXPECT_EQ(right_of(1e15), Cull::OffScreen); // far beyond int
}

// H23: the camera is subtracted in double, so an offset that double can represent changes nothing.
TEST(Projection, LargeWorldOffsetChangesNothing) {
    for (const double offset : {0.0, 131072.0, 8388608.0}) {
        OneGaussian one({offset + 0.25, offset - 0.125, offset + 5}, glm::vec3(0.001F));
        one.camera.position = glm::dvec3(offset);
        ASSERT_EQ(one.run(), Cull::None);
        EXPECT_EQ(one.splat.mu_x, 100 * 0.25 / 5 + 31.5);
        EXPECT_EQ(one.splat.mu_y, -100 * 0.125 / 5 + 23.5);
        EXPECT_EQ(one.splat.depth, 5);
    }
}

// H22
TEST(Projection, ColourIsClampedBelowOnly) {
    GaussianCloud cloud;
    add_gaussian(cloud, {0, 0, 5}, glm::vec3(0.1F), test::kNoTurn, 0.5F, {-0.5F, 1.5F, 100});
    ProjectedSplat splat;
    shade(cloud, 0, make_camera(64, 48, 100), splat);
    EXPECT_EQ(splat.colour[0], 0);
    EXPECT_NEAR(splat.colour[1], 1.5, 1e-6);
    EXPECT_NEAR(splat.colour[2], 100, 1e-4);
}

TEST(Projection, ColourDependsOnTheDirectionFromTheCamera) {
    GaussianCloud cloud;
    cloud.sh_degree = 1;
    cloud.means.emplace_back(3, 4, 12);              // length 13
    cloud.sh = {0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1}; // Y_1 red, Y_2 green, Y_3 blue
    Camera camera = make_camera(64, 48, 100);
    camera.position = {6, 8, -12}; // direction (-3, -4, 24) / sqrt(601)
    ProjectedSplat splat;
    shade(cloud, 0, camera, splat);
    const double k = std::sqrt(3 / (4 * test::kPi)) / std::sqrt(601.0);
    EXPECT_NEAR(splat.colour[0], 0.5 + 4 * k, 1e-14);
    EXPECT_NEAR(splat.colour[1], 0.5 + 24 * k, 1e-14);
    EXPECT_NEAR(splat.colour[2], 0.5 + 3 * k, 1e-14);
}

} // namespace
} // namespace degs
