// SPDX-License-Identifier: Apache-2.0
#include "scene/spz/spz.hpp"

#include <cmath>

#include "scene/scene.hpp"
#include "tests/scene/scene_fixture.hpp"
#include "tests/scene/spz/spz_builder.hpp"

namespace degs {
namespace {

using test::IsSentenceWith;
using test::SpzBuilder;

SpzBuilder one(std::uint32_t version = 3) {
    SpzBuilder spz = SpzBuilder::scene(version, 1, 0);
    // 1, -1/4096 and -2048
    spz.attributes = {version == 1 ? std::string("\x00\x3c\x00\x8c\x00\xe8", 6)
                                   : std::string("\x00\x10\x00\xff\xff\xff\x00\x00\x80", 9),
                      "\x80",
                      std::string("\x00\x80\xff", 3),
                      std::string("\x00\xa0\xff", 3),
                      version >= 3 ? SpzBuilder::u32(3U << 30) : std::string("\xff\x80\x80", 3),
                      ""};
    return spz;
}

SceneContent decoded(const SpzBuilder& spz) {
    return decode_spz("made.spz", spz.file());
}

TEST(Spz, DecodesEveryAttribute) {
    for (const std::uint32_t version : {1U, 2U, 3U, 4U}) {
        const SceneContent content = decoded(one(version));
        ASSERT_EQ(content.cloud.size(), 1U);
        EXPECT_EQ(content.cloud.means[0], glm::dvec3(1, -1.0 / 4096, -2048));
        EXPECT_EQ(content.cloud.opacities[0], static_cast<float>(128 / 255.0));
        EXPECT_FLOAT_EQ(content.cloud.sh[0], -0.5F / 0.15F);
        EXPECT_FLOAT_EQ(content.cloud.sh[1], static_cast<float>((128 / 255.0 - 0.5) / 0.15));
        EXPECT_FLOAT_EQ(content.cloud.sh[2], 0.5F / 0.15F);
        EXPECT_FLOAT_EQ(content.cloud.scales[0].x, std::exp(-10.0F));
        EXPECT_FLOAT_EQ(content.cloud.scales[0].y, 1);
        EXPECT_FLOAT_EQ(content.cloud.scales[0].z, std::exp(5.9375F));
        EXPECT_EQ(content.axes.name(), "RUB");
        EXPECT_FALSE(content.traits.antialiased);
        EXPECT_TRUE(content.axes_assumed);
        EXPECT_TRUE(content.notes.empty());
    }
}

TEST(Spz, RotationsOfVersions1And2HoldThreeComponents) {
    for (const std::uint32_t version : {1U, 2U}) {
        const glm::vec4 q = decoded(one(version)).cloud.rotations[0];
        EXPECT_EQ(q.y, 1); // x
        EXPECT_NEAR(q.z, 128 / 127.5 - 1, 1e-7);
        EXPECT_FLOAT_EQ(q.x, 0); // beyond the unit sphere: w is 0, not NaN
    }
}

/// Half floats: subnormal, largest and negative ones; the fractional bits of the header mean
/// nothing.
TEST(Spz, PositionsOfVersion1AreHalfFloats) {
    SpzBuilder spz = SpzBuilder::scene(1, 2, 1);
    spz.fractional_bits = 0;
    spz.attributes[0] = std::string("\x01\x00\xff\x03\x00\x04\xff\x7b\x55\xb5\x00\x80", 12);
    const SceneContent content = decoded(spz);
    ASSERT_EQ(content.cloud.size(), 2U);
    EXPECT_EQ(content.cloud.means[0],
              glm::dvec3(std::ldexp(1, -24), std::ldexp(1023, -24), std::ldexp(1, -14)));
    EXPECT_EQ(content.cloud.means[1], glm::dvec3(65504, -1365 / 4096.0, 0));
    EXPECT_EQ(content.cloud.sh_degree, 1); // what follows is found at its place
    EXPECT_EQ(content.cloud.opacities[0], static_cast<float>(1 / 255.0));
}

/// Version 1 has positions that no other version can hold: they go, and the file loads.
TEST(Spz, PositionsOfVersion1ThatAreNotFiniteAreDropped) {
    SpzBuilder spz = SpzBuilder::scene(1, 3, 0);
    spz.attributes[0].assign(
        "\x00\x3c\x00\x3c\x00\x3c\x00\x7c\x00\x3c\x00\x3c\x00\x3c\x01\xfe\x00\x3c", 18);
    const test::Folder folder;
    const Scene scene = load_scene(folder.write("v1.spz", spz.file()));
    ASSERT_EQ(scene.cloud.size(), 1U);
    EXPECT_EQ(scene.cloud.means[0], glm::dvec3(1, -1, -1)); // RUB to RDF
    EXPECT_EQ(scene.dropped.non_finite, 2U);
}

TEST(Spz, RotationsOfVersion3HoldTheThreeSmallest) {
    // Each component in turn is the largest; the others are +1/4, -1/8 and 0 of the code's range.
    for (const std::uint32_t largest : {0U, 1U, 2U, 3U}) {
        SpzBuilder spz = one();
        const std::uint32_t bits = largest << 30 | 256U << 20 | (512U | 128U) << 10;
        spz.attributes[4] = SpzBuilder::u32(bits);
        const glm::vec4 q = decoded(spz).cloud.rotations[0];
        const std::array<float, 4> xyzw{q.y, q.z, q.w, q.x};
        std::vector<float> others;
        for (std::uint32_t i = 0; i < 4; ++i) {
            if (i != largest) {
                others.push_back(xyzw[i]);
            }
        }
        const float unit = std::sqrt(0.5F) / 511;
        EXPECT_FLOAT_EQ(others[0], 256 * unit);
        EXPECT_FLOAT_EQ(others[1], -128 * unit);
        EXPECT_EQ(others[2], 0);
        EXPECT_NEAR(glm::dot(q, q), 1, 1e-6);
        EXPECT_GT(xyzw[largest], 0.5F);
    }
}

TEST(Spz, HarmonicsAreCoefficientMajor) {
    for (const int degree : {1, 2, 3}) {
        for (const std::uint32_t version : {1U, 2U, 3U, 4U}) {
            const SpzBuilder spz = SpzBuilder::scene(version, 3, degree);
            const GaussianCloud cloud = decoded(spz).cloud;
            ASSERT_EQ(cloud.sh_degree, degree);
            const std::size_t rest = std::size_t{3} * degree * (degree + 2);
            ASSERT_EQ(cloud.sh.size(), 3 * (rest + 3));
            for (std::size_t i = 0; i < 3 * rest; ++i) {
                const int byte = static_cast<unsigned char>(spz.attributes[5][i]);
                EXPECT_EQ(cloud.sh[i / rest * (rest + 3) + 3 + i % rest],
                          static_cast<float>(byte - 128) / 128);
            }
        }
    }
}

TEST(Spz, DegreeFourIsDroppedWithANote) {
    const SceneContent full = decoded(SpzBuilder::scene(4, 2, 4));
    EXPECT_EQ(full.cloud.sh_degree, 3);
    EXPECT_EQ(full.cloud.sh.size(), 2U * 48);
    ASSERT_EQ(full.notes.size(), 1U);
    EXPECT_THAT(full.notes[0], IsSentenceWith("degree 4"));
}

TEST(Spz, FractionalBitsScalePositions) {
    SpzBuilder spz = one();
    spz.fractional_bits = 8;
    EXPECT_EQ(decoded(spz).cloud.means[0], glm::dvec3(16, -1.0 / 256, -32768));
}

TEST(Spz, FlagsAndRecords) {
    for (const std::uint32_t version : {3U, 4U}) {
        SpzBuilder spz = one(version);
        spz.flags = 1 | 2;
        spz.records = SpzBuilder::record(0xADBE0002, std::string(12, '\0')) +
                      SpzBuilder::record(0xADBE0003, SpzBuilder::u32(6));
        const SceneContent content = decoded(spz);
        EXPECT_TRUE(content.traits.antialiased);
        EXPECT_EQ(content.axes.name(), "RDF");
        EXPECT_FALSE(content.axes_assumed);
        EXPECT_TRUE(content.notes.empty());
        spz.flags = 2 | 64;
        spz.records = SpzBuilder::record(0x12345678, "abc");
        const SceneContent other = decoded(spz);
        ASSERT_EQ(other.notes.size(), 2U);
        EXPECT_THAT(other.notes[0], IsSentenceWith("0x12345678 (3 bytes)"));
        EXPECT_THAT(other.notes[1], IsSentenceWith("66"));
    }
}

TEST(Spz, RecordsNameAllAxesThatPointUpOrDown) {
    const char* const names[] = {"LDB", "RDB", "LUB", "RUB", "LDF", "RDF", "LUF", "RUF"};
    for (std::uint32_t system = 1; system <= 8; ++system) {
        SpzBuilder spz = one();
        spz.flags = 2;
        spz.records = SpzBuilder::record(0xADBE0003, SpzBuilder::u32(system));
        EXPECT_EQ(decoded(spz).axes.name(), names[system - 1]);
    }
}

TEST(Spz, PublishedFixturesHoldFourGaussians) {
    DEGS_NEEDS_SCENE("formats");
    const auto read = [](const char* name) {
        return read_spz((test::scenes() / "formats" / name).string()).cloud;
    };
    const GaussianCloud v2 = read("minimal-v2.spz"), v3 = read("minimal-v3.spz"),
                        v4 = read("minimal-v4.spz");
    const std::vector<glm::dvec3> corners{{-1, 0, 1}, {0, 0, 1}, {-1, 0, 0}, {0, 0, 0}};
    EXPECT_EQ(v4.means, corners); // gzip and ZSTD of the same attributes
    EXPECT_EQ(v3.means, v4.means);
    EXPECT_EQ(v3.rotations, v4.rotations);
    EXPECT_EQ(v3.sh, v4.sh);
    ASSERT_EQ(v2.size(), 4U); // the writer of v2 mirrored z and took other colours
    for (const GaussianCloud* const other : {&v3, &v4}) {
        EXPECT_EQ(other->scales, v2.scales);
        EXPECT_EQ(other->opacities, v2.opacities);
        for (int i = 0; i < 4; ++i) {
            EXPECT_EQ(other->means[i] * glm::dvec3(1, 1, -1), v2.means[i]);
            EXPECT_GT(std::abs(glm::dot(other->rotations[i], v2.rotations[i])), 0.9999F);
        }
    }
}

/// Smallest |cos| of half the angle between a rotation and its code. Version 2 rounds x, y and z to
/// 1/127.5 and loses accuracy of w where w is small.
double worst_cosine(bool version_2, const glm::vec4& rotation) {
    const double xyz = std::sqrt(3.0) * (version_2 ? 0.5 / 127.5 : 0.5 * std::sqrt(0.5) / 511);
    const double w =
        version_2 ? std::min(2 * xyz / std::abs(rotation.x), std::sqrt(2 * xyz)) : 3 * xyz;
    return 1 - 0.55 * (xyz * xyz + w * w);
}

/// The quantisation that the README of the scenes states: half a step of each attribute.
TEST(Spz, AgreesWithThePlyItWasMadeFrom) {
    DEGS_NEEDS_SCENE("fruit-drops");
    const std::string folder = (test::scenes() / "fruit-drops").string();
    const Scene ply = load_scene(folder + "/scene.ply");
    for (const char* const name : {"/scene-v2.spz", "/scene-v3.spz"}) {
        const Scene spz = load_scene(folder + name);
        ASSERT_EQ(spz.cloud.size(), ply.cloud.size());
        const bool version_2 = std::string(name) == "/scene-v2.spz";
        for (std::size_t i = 0; i < ply.cloud.size(); ++i) {
            for (int axis = 0; axis < 3; ++axis) {
                ASSERT_NEAR(spz.cloud.means[i][axis], ply.cloud.means[i][axis], 0.5001 / 4096);
                const double log_scale = std::max(-10.0, std::log(ply.cloud.scales[i][axis] * 1.0));
                ASSERT_NEAR(std::log(spz.cloud.scales[i][axis] * 1.0), log_scale, 0.5001 / 16);
            }
            ASSERT_NEAR(spz.cloud.opacities[i], ply.cloud.opacities[i], 0.5001 / 255);
            const glm::vec4 a = spz.cloud.rotations[i], b = ply.cloud.rotations[i];
            ASSERT_GT(std::abs(glm::dot(a, b)), worst_cosine(version_2, b)) << i;
            for (int k = 0; k < 48; ++k) {
                const float from = ply.cloud.sh_of(i)[k], to = spz.cloud.sh_of(i)[k];
                const float inside = k < 3 ? std::min(std::max(from, -3.3334F), 3.3334F)
                                           : std::min(std::max(from, -1.0F), 127 / 128.0F);
                ASSERT_NEAR(to, inside, k < 3 ? 0.5001 / 255 / 0.15 : 0.5001 / 8) << i << " " << k;
            }
        }
    }
}

} // namespace
} // namespace degs
