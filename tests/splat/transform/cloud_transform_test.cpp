// SPDX-License-Identifier: Apache-2.0
#include "splat/transform/cloud_transform.hpp"

#include <cmath>
#include <random>

#include <glm/gtc/quaternion.hpp>
#include <gtest/gtest.h>

#include "splat/model/spherical_harmonics.hpp"
#include "splat/transform/sh_rotation.hpp"

namespace degs {
namespace {

class Random {
public:
    double normal() { return normal_(engine_); }
    glm::dvec3 direction() { return glm::normalize(glm::dvec3(normal(), normal(), normal())); }
    glm::dquat rotation() {
        return glm::normalize(glm::dquat(normal(), normal(), normal(), normal()));
    }

private:
    std::mt19937 engine_{7};
    std::normal_distribution<double> normal_;
};

/// One Gaussian per set of scales, with random rotations and colours.
GaussianCloud make_cloud(Random& random, const std::vector<glm::vec3>& scales, int degree = 3) {
    GaussianCloud cloud;
    cloud.sh_degree = degree;
    for (const glm::vec3& scale : scales) {
        const glm::dquat q = random.rotation();
        cloud.means.push_back({random.normal(), random.normal(), random.normal()});
        cloud.scales.push_back(scale);
        cloud.rotations.push_back(glm::dvec4(q.w, q.x, q.y, q.z));
        cloud.opacities.push_back(0.5F);
    }
    for (std::size_t i = 0; i < scales.size() * cloud.sh_coefficients() * 3; ++i) {
        cloud.sh.push_back(static_cast<float>(random.normal()));
    }
    return cloud;
}

glm::dmat3 axes_of(const GaussianCloud& cloud, std::size_t i) {
    const glm::dvec4 q(cloud.rotations[i]);
    return glm::mat3_cast(glm::normalize(glm::dquat(q.x, q.y, q.z, q.w)));
}

glm::dmat3 covariance_of(const GaussianCloud& cloud, std::size_t i) {
    glm::dmat3 c = axes_of(cloud, i);
    for (int axis = 0; axis < 3; ++axis) {
        c[axis] *= double{cloud.scales[i][axis]};
    }
    return c * glm::transpose(c);
}

glm::dmat3 stretched(const glm::dmat3& rotation, const glm::dvec3& scale) {
    return {rotation[0] * scale.x, rotation[1] * scale.y, rotation[2] * scale.z};
}

double largest_element(const glm::dmat3& m) {
    double most = 0;
    for (int i = 0; i < 9; ++i) {
        most = std::max(most, std::abs(m[i / 3][i % 3]));
    }
    return most;
}

TEST(ShRotation, EqualsTheBasisInTheLocalFrame) {
    Random random;
    double worst = 0;
    for (int round = 0; round < 50; ++round) {
        const glm::dmat3 rotation = glm::mat3_cast(random.rotation());
        const GaussianCloud cloud = make_cloud(random, {glm::vec3(1)});
        std::vector<float> turned = cloud.sh;
        ShRotation(3, rotation).apply(turned.data());
        for (int i = 0; i < 20; ++i) {
            const glm::dvec3 direction = random.direction();
            const glm::dvec3 expected =
                evaluate_sh(3, cloud.sh.data(), glm::transpose(rotation) * direction);
            worst =
                std::max(worst, glm::length(evaluate_sh(3, turned.data(), direction) - expected));
        }
    }
    EXPECT_LT(worst, 1e-6); // float rounding of 16 coefficients of about 1
    EXPECT_GT(worst, 0);
}

TEST(ShRotation, LeavesDegreeZeroAlone) {
    Random random;
    const GaussianCloud cloud = make_cloud(random, {glm::vec3(1)});
    std::vector<float> turned = cloud.sh;
    ShRotation(3, glm::mat3_cast(random.rotation())).apply(turned.data());
    EXPECT_TRUE(std::equal(turned.begin(), turned.begin() + 3, cloud.sh.begin()));
    EXPECT_NE(turned[3], cloud.sh[3]);
}

/// Half a turn about y: x and z change sign, and with them the functions that are odd in one of the
/// two.
TEST(ShRotation, KnowsHalfATurn) {
    const glm::dmat3 rotation(-1, 0, 0, 0, 1, 0, 0, 0, -1);
    std::vector<float> ones(16 * 3, 1.0F);
    ShRotation(3, rotation).apply(ones.data());
    const int signs[16] = {1, 1, -1, -1, -1, -1, 1, 1, 1, 1, 1, 1, -1, -1, -1, -1};
    for (int k = 0; k < 16; ++k) {
        EXPECT_NEAR(ones[k * 3], signs[k], 1e-6) << k;
    }
}

TEST(CloudTransform, KeepsTheBitsThatItDoesNotMove) {
    Random random;
    const GaussianCloud cloud = make_cloud(random, {{1, 2, 3}, {0, 1, 1e-7F}});
    GaussianCloud same;
    same.sh_degree = 3;
    append_transformed(cloud, {}, same);
    EXPECT_EQ(same.means, cloud.means);
    EXPECT_EQ(same.scales, cloud.scales);
    EXPECT_EQ(same.rotations, cloud.rotations);
    EXPECT_EQ(same.sh, cloud.sh);
    EXPECT_EQ(same.opacities, cloud.opacities);
}

TEST(CloudTransform, ScalesUniformly) {
    Random random;
    const GaussianCloud cloud = make_cloud(random, {{1, 2, 3}});
    GaussianCloud moved;
    moved.sh_degree = 3;
    append_transformed(cloud, {glm::dmat3(2.0), {1, 2, 3}}, moved);
    EXPECT_EQ(moved.scales[0], glm::vec3(2, 4, 6));
    EXPECT_EQ(moved.means[0], cloud.means[0] * 2.0 + glm::dvec3(1, 2, 3));
    EXPECT_EQ(moved.rotations, cloud.rotations);
    EXPECT_EQ(moved.sh, cloud.sh);
}

TEST(CloudTransform, GivesTheCovarianceOfTheMap) {
    Random random;
    const std::vector<glm::vec3> shapes{{1, 1, 1},         {1, 2, 3},       {1, 1e-3F, 1e-6F},
                                        {1e-6F, 1, 1e-6F}, {0.5F, 0.5F, 0}, {0, 0, 1}};
    for (const glm::dvec3& stretch :
         {glm::dvec3(2), glm::dvec3(1, 2, 5), glm::dvec3(1e-3, 1, 1e3)}) {
        const glm::dmat3 map = stretched(glm::mat3_cast(random.rotation()), stretch);
        const GaussianCloud cloud = make_cloud(random, shapes);
        GaussianCloud moved;
        moved.sh_degree = 3;
        append_transformed(cloud, {map, {}}, moved);
        for (std::size_t i = 0; i < shapes.size(); ++i) {
            const glm::dmat3 expected = map * covariance_of(cloud, i) * glm::transpose(map);
            const double size = largest_element(expected);
            EXPECT_LT(largest_element(covariance_of(moved, i) - expected), 1e-6 * size)
                << i << " " << stretch.y;
            EXPECT_NEAR(glm::length(moved.rotations[i]), 1, 1e-6);
        }
    }
}

/// A needle of 1 : 1e-6 keeps the volume that the determinant gives it.
TEST(CloudTransform, KeepsThinAxes) {
    Random random;
    const glm::dmat3 map = stretched(glm::mat3_cast(random.rotation()), {1, 2, 5});
    const GaussianCloud cloud = make_cloud(random, {{1, 1e-3F, 1e-6F}, {1e-6F, 1e-6F, 1}});
    GaussianCloud moved;
    moved.sh_degree = 3;
    append_transformed(cloud, {map, {}}, moved);
    for (std::size_t i = 0; i < 2; ++i) {
        const glm::dvec3 from(cloud.scales[i]);
        const glm::dvec3 to(moved.scales[i]);
        EXPECT_NEAR(to.x * to.y * to.z / (from.x * from.y * from.z), 10, 1e-5);
    }
}

TEST(CloudTransform, FillsHigherDegreesWithZeros) {
    Random random;
    const GaussianCloud flat = make_cloud(random, {{1, 1, 1}, {1, 1, 1}}, 0);
    GaussianCloud rich;
    rich.sh_degree = 1;
    append_transformed(flat, {}, rich);
    ASSERT_EQ(rich.sh.size(), 24U);
    EXPECT_EQ(rich.sh_of(1)[2], flat.sh_of(1)[2]);
    EXPECT_EQ(rich.sh_of(1)[3], 0);
}

TEST(CloudTransform, TellsMapsWithoutRotationApart) {
    const glm::dmat3 turn =
        glm::mat3_cast(glm::angleAxis(0.3, glm::normalize(glm::dvec3(1, 2, 3))));
    const auto defect = [&](const glm::dmat3& m) { return find_transform_defect(turn * m); };
    EXPECT_EQ(defect(glm::dmat3(1)), TransformDefect::None);
    EXPECT_EQ(defect(stretched(turn, {1e-4, 1, 1e4})), TransformDefect::None);
    EXPECT_EQ(defect(stretched(turn, {-1, 1, 1})), TransformDefect::Mirrored);
    EXPECT_EQ(defect(stretched(turn, {-1, -1, 1})), TransformDefect::None);
    EXPECT_EQ(defect(stretched(turn, {0, 1, 1})), TransformDefect::Singular);
    EXPECT_EQ(defect({1, 0, 0, 1, 0, 0, 0, 0, 1}), TransformDefect::Singular);
    EXPECT_EQ(defect({1, 0, 0, 0.5, 1, 0, 0, 0, 1}), TransformDefect::Sheared);
    EXPECT_EQ(defect(glm::dmat3(NAN)), TransformDefect::NonFinite);
    EXPECT_EQ(defect(glm::dmat3(INFINITY)), TransformDefect::NonFinite);
}

} // namespace
} // namespace degs
