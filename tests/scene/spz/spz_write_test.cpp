// SPDX-License-Identifier: Apache-2.0
#include "scene/spz/spz_write.hpp"

#include <cmath>
#include <random>

#include "scene/scene.hpp"
#include "scene/spz/spz.hpp"
#include "scene/synthetic/synthetic.hpp"
#include "tests/scene/scene_fixture.hpp"

namespace degs {
namespace {

using test::IsSentenceWith;

/// Within every range of SPZ.
GaussianCloud moderate_cloud(int degree) {
    std::mt19937 random(degree);
    const auto number = [&](double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random);
    };
    GaussianCloud cloud;
    cloud.sh_degree = degree;
    for (int i = 0; i < 500; ++i) {
        cloud.means.emplace_back(number(-2047, 2047), number(-1, 1), number(-100, 100));
        cloud.scales.emplace_back(std::exp(number(-10, 5.9)), std::exp(number(-5, 0)), 1);
        const glm::vec4 q(number(-1, 1), number(-1, 1), number(-1, 1), number(-1, 1));
        cloud.rotations.push_back(glm::normalize(q));
        cloud.opacities.push_back(static_cast<float>(number(0, 1)));
        for (int k = 0; k < 3 * cloud.sh_coefficients(); ++k) {
            cloud.sh.push_back(static_cast<float>(k < 3 ? number(-3.3, 3.3) : number(-0.99, 0.99)));
        }
    }
    return cloud;
}

/// `step` of positions; that of everything else is fixed.
void expect_within_half_a_step(const GaussianCloud& read, const GaussianCloud& written,
                               double step) {
    ASSERT_EQ(read.size(), written.size());
    ASSERT_EQ(read.sh_degree, written.sh_degree);
    constexpr double kHalf = 0.5001;
    for (std::size_t i = 0; i < written.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            ASSERT_NEAR(read.means[i][axis], written.means[i][axis], kHalf * step);
            ASSERT_NEAR(std::log(read.scales[i][axis] / written.scales[i][axis]), 0, kHalf / 16);
        }
        ASSERT_NEAR(read.opacities[i], written.opacities[i], kHalf / 255);
        const double xyz = kHalf * std::sqrt(3.0) * std::sqrt(0.5) / 511;
        // The largest component is at least 1/2, so that its error is at most 3 times theirs.
        ASSERT_GT(std::abs(glm::dot(read.rotations[i], written.rotations[i])),
                  1 - 5.01 * xyz * xyz - 1e-6);
        for (int k = 0; k < 3 * written.sh_coefficients(); ++k) {
            ASSERT_NEAR(read.sh_of(i)[k], written.sh_of(i)[k],
                        k < 3 ? kHalf / 255 / 0.15 : kHalf / 128);
        }
    }
}

TEST(SpzWriting, ReturnsWithinHalfAStep) {
    const test::Folder folder;
    for (const int version : {3, 4}) {
        for (const int degree : {0, 1, 2, 3}) {
            const GaussianCloud cloud = moderate_cloud(degree);
            const std::string path = folder.path("scene.spz");
            EXPECT_TRUE(write_spz(cloud, path, {version, degree == 1}).empty());
            const Scene scene = load_scene(path);      // RUB becomes RDF again
            EXPECT_FALSE(read_spz(path).axes_assumed); // a record names them
            EXPECT_EQ(scene.traits.antialiased, degree == 1);
            expect_within_half_a_step(scene.cloud, cloud, 1.0 / 4096);
        }
    }
}

TEST(SpzWriting, WritesTheSameFileFromWhatItWrote) {
    const test::Folder folder;
    write_spz(moderate_cloud(3), folder.path("a.spz"));
    write_spz(load_scene(folder.path("a.spz")).cloud, folder.path("b.spz"));
    const Scene a = load_scene(folder.path("a.spz")), b = load_scene(folder.path("b.spz"));
    EXPECT_EQ(a.cloud.means, b.cloud.means);
    EXPECT_EQ(a.cloud.scales, b.cloud.scales);
    EXPECT_EQ(a.cloud.opacities, b.cloud.opacities);
    EXPECT_EQ(a.cloud.sh, b.cloud.sh);
}

TEST(SpzWriting, SaysWhatItClamped) {
    GaussianCloud cloud = moderate_cloud(1);
    cloud.scales[0].y = 0; // the logarithm is minus infinity
    cloud.scales[1].x = 1e4F;
    cloud.sh[0] = 4;
    cloud.sh[1] = -4;
    cloud.sh[2] = 3.34F; // half a code is rounded, not clamped
    cloud.sh[5] = 1.2F;
    const test::Folder folder;
    const std::vector<std::string> notes = write_spz(cloud, folder.path("a.spz"));
    ASSERT_EQ(notes.size(), 3U);
    EXPECT_THAT(notes[0], IsSentenceWith("2 scales left"));
    EXPECT_THAT(notes[1], IsSentenceWith("2 coefficients of degree 0 left"));
    EXPECT_THAT(notes[2], IsSentenceWith("1 higher coefficients left"));
    const GaussianCloud read = load_scene(folder.path("a.spz")).cloud;
    EXPECT_FLOAT_EQ(read.scales[0].y, std::exp(-10.0F));
    EXPECT_FLOAT_EQ(read.scales[1].x, std::exp(5.9375F));
    EXPECT_FLOAT_EQ(read.sh[0], 0.5F / 0.15F);
    EXPECT_FLOAT_EQ(read.sh[5], 1); // -1 has a code, and Y_1 changes its sign between the axes
}

TEST(SpzWriting, TakesFewerBitsForFarPositions) {
    const test::Folder folder;
    const std::pair<double, int> cases[] = {{2047.9998, 12}, {2048, 11}, {5e5, 4}, {8e6, 0}};
    for (const auto& [far, bits] : cases) {
        GaussianCloud cloud = moderate_cloud(0);
        cloud.means[7].y = -far;
        const std::vector<std::string> notes = write_spz(cloud, folder.path("far.spz"));
        EXPECT_EQ(notes.size(), bits < 12 ? 1U : 0U) << far;
        expect_within_half_a_step(load_scene(folder.path("far.spz")).cloud, cloud,
                                  std::ldexp(1, -bits));
    }
}

TEST(SpzWriting, RefusesWhatTheFormatCannotHold) {
    const test::Folder folder;
    const auto mistake = [&](const GaussianCloud& cloud, int version) {
        return test::complaint([&] { write_spz(cloud, folder.path("a.spz"), {version, false}); });
    };
    GaussianCloud cloud = moderate_cloud(0);
    EXPECT_THAT(mistake(cloud, 2), IsSentenceWith("version 2 cannot be written"));
    EXPECT_THAT(mistake({}, 3), IsSentenceWith("1 to 2147483647"));
    for (const double far : {8388608.0, static_cast<double>(NAN), static_cast<double>(INFINITY)}) {
        cloud.means[3].z = far;
        EXPECT_THAT(mistake(cloud, 3), IsSentenceWith("8388608 or more"));
    }
    EXPECT_EQ(folder.entries(), 0U);
}

} // namespace
} // namespace degs
