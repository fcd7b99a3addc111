// SPDX-License-Identifier: Apache-2.0
// Scenes much of which cannot be drawn, and values that look as if they had been activated already.
#include "scene/scene.hpp"

#include <algorithm>

#include "tests/scene/gltf/glb_builder.hpp"
#include "tests/scene/ply/ply_builder.hpp"
#include "tests/scene/scene_fixture.hpp"
#include "tests/scene/spz/spz_builder.hpp"

namespace degs {
namespace {

using test::IsSentenceWith;
using test::PlyBuilder;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

/// `zeros` of `rows` rows hold nothing but zeros, as a truncated export does.
std::string ply_with_zeros(int rows, int zeros) {
    PlyBuilder ply = PlyBuilder::splat();
    for (int row = 0; row < rows; ++row) {
        ply.add_row([&](const std::string&) { return row < zeros ? 0.0 : -0.5; });
    }
    return ply.file();
}

Scene scene_of(const std::string& name, const std::string& bytes) {
    const test::Folder folder;
    return load_scene(folder.write(name, bytes));
}

std::string refusal_of(const std::string& name, const std::string& bytes) {
    return test::complaint([&] { scene_of(name, bytes); });
}

TEST(DroppedGaussians, NearlyAllAreAWarning) {
    const Scene scene = scene_of("a.ply", ply_with_zeros(300, 299));
    EXPECT_EQ(scene.cloud.size(), 1U);
    EXPECT_THAT(scene.notes, Contains(IsSentenceWith("299 of the 300 Gaussians of the file")));
}

TEST(DroppedGaussians, ManyAreAWarningAndFewAreCounted) {
    const Scene many = scene_of("a.ply", ply_with_zeros(100, 1));
    EXPECT_THAT(many.notes, Contains(IsSentenceWith("1 of the 100 Gaussians of the file cannot")));
    EXPECT_EQ(many.dropped.total(), 1U);
    const Scene few = scene_of("a.ply", ply_with_zeros(101, 1));
    EXPECT_THAT(few.notes, Not(Contains(HasSubstr("dropped"))));
    EXPECT_EQ(few.dropped.total(), 1U);
    EXPECT_THAT(scene_of("a.ply", ply_with_zeros(12, 5)).notes, Contains(HasSubstr("5 of the 12")));
}

TEST(DroppedGaussians, LogarithmsInAGltfAreNamed) {
    test::Glb glb = test::two_splats();
    glb.attribute("SCALE") = glb.add({0.1F, 0.2F, 0.3F, -1, -2, -3}, "VEC3");
    EXPECT_THAT(refusal_of("a.glb", glb.bytes()), IsSentenceWith("seem to be logarithms"));
}

std::string ply_of(double opacity, double scale, const std::string& format) {
    PlyBuilder ply = PlyBuilder::splat();
    ply.format = format;
    for (int row = 0; row < 200; ++row) {
        ply.add_row([&](const std::string& name) {
            return name == "opacity" ? opacity : name.rfind("scale_", 0) == 0 ? scale : 0.25;
        });
    }
    return ply.file();
}

TEST(DroppedGaussians, ActivatedValuesOfAPlyAreAWarning) {
    for (const char* const format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        EXPECT_THAT(scene_of("a.ply", ply_of(0.9, 0.2, format)).notes,
                    Contains(IsSentenceWith("seems to hold both as they are")));
        EXPECT_THAT(scene_of("a.ply", ply_of(3, -2, format)).notes,
                    Not(Contains(HasSubstr("as they are"))));
    }
}

// One may have been activated without the other.
TEST(DroppedGaussians, ActivatedScalesOrOpacitiesOfAPlyAreAWarning) {
    for (const char* const format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        EXPECT_THAT(scene_of("a.ply", ply_of(3, 0.2, format)).notes,
                    Contains(IsSentenceWith("No scale is negative, so the file seems to hold its "
                                            "scales as they are; they were read as logarithms,")));
        EXPECT_THAT(scene_of("a.ply", ply_of(0.9, -2, format)).notes,
                    Contains(IsSentenceWith("No opacity is outside 0 to 1, so the file seems to "
                                            "hold its opacities as they are; they were read as "
                                            "logits,")));
    }
}

// Three Gaussians say nothing.
TEST(DroppedGaussians, FewGaussiansSayNothing) {
    PlyBuilder ply = PlyBuilder::splat();
    for (int row = 0; row < 3; ++row) {
        ply.add_row([](const std::string&) { return 0.5; });
    }
    EXPECT_THAT(scene_of("a.ply", ply.file()).notes, Not(Contains(HasSubstr("as they are"))));
}

TEST(DroppedGaussians, ActivatedScalesOfSpzAreAWarning) {
    for (const unsigned version : {2U, 3U, 4U}) {
        test::SpzBuilder spz = test::SpzBuilder::scene(version, 5, 0);
        std::string& scales = spz.attributes[3];
        ASSERT_EQ(scales.size(), 15U);
        std::fill(scales.begin(), scales.end(), static_cast<char>(163)); // exp(0.1875)
        EXPECT_THAT(scene_of("a.spz", spz.file()).notes,
                    Contains(IsSentenceWith("hold its scales as they are")));
        scales[7] = static_cast<char>(159);
        EXPECT_THAT(scene_of("a.spz", spz.file()).notes, Not(Contains(HasSubstr("as they are"))));
    }
}

TEST(DroppedGaussians, ActivatedDiscsAreAWarning) {
    PlyBuilder ply = PlyBuilder::splat();
    ply.remove("scale_2");
    for (int row = 0; row < 4; ++row) {
        ply.add_row([](const std::string&) { return 0.5; });
    }
    EXPECT_THAT(scene_of("a.ply", ply.file()).notes, Contains(HasSubstr("as they are")));
}

/// 60 Gaussians in a cube of that side, whose values of scale, one after the other, fill a range.
std::string cube_ply(double side, double low, double high, const std::string& format) {
    PlyBuilder ply = PlyBuilder::splat();
    ply.format = format;
    for (int row = 0; row < 60; ++row) {
        ply.add_row([&](const std::string& name) {
            const double at = row * 7 % 60 / 59.0;
            return name.rfind("scale_", 0) == 0 ? low + (high - low) * at
                   : name == "opacity"          ? 3
                   : name == "x"                ? side * (row / 59.0 - 0.5)
                                                : 0.25;
        });
    }
    return ply.file();
}

bool says_activated(const Scene& scene) {
    return std::any_of(scene.notes.begin(), scene.notes.end(), [](const std::string& note) {
        return note.find("hold its scales as they are") != std::string::npos;
    });
}

// In large units of length all logarithms are positive; sizes that fit the scene are no reason for
// a warning.
TEST(ActivatedScales, AreToldFromLargeUnitsByTheExtentOfTheScene) {
    for (const char* const format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        const auto says = [&](double side, double low, double high) {
            return says_activated(scene_of("a.ply", cube_ply(side, low, high, format)));
        };
        EXPECT_FALSE(says(78, 0.7, 2)); // 2 to 7 units
        EXPECT_FALSE(says(300, 0.1, 4));
        EXPECT_FALSE(says(1e5, 2, 8));
        EXPECT_TRUE(says(2, 0.2, 0.5)); // as logarithms, most are larger than half the scene
        EXPECT_TRUE(says(10, 0.01, 3));
        EXPECT_TRUE(says(300, 0.001, 0.1)); // as logarithms, all are as large as a unit
        EXPECT_TRUE(says(1e5, 0.001, 0.05));
        EXPECT_FALSE(says(2, -5, 0.5));
    }
}

// A few positions far away make no scene large.
TEST(ActivatedScales, AreNotExcusedByAFarPosition) {
    PlyBuilder ply = PlyBuilder::splat();
    for (int row = 0; row < 60; ++row) {
        ply.add_row([&](const std::string& name) {
            return name == "x" ? (row == 0 ? 1e6 : row / 30.0) : name == "opacity" ? 3 : 0.3;
        });
    }
    EXPECT_TRUE(says_activated(scene_of("a.ply", ply.file())));
}

} // namespace
} // namespace degs
