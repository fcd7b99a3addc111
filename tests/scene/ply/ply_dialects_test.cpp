// SPDX-License-Identifier: Apache-2.0
// What other programs put into PLY files, and what becomes of it.
#include <cmath>

#include "scene/ply/ply.hpp"
#include "scene/scene.hpp"
#include "tests/scene/ply/ply_builder.hpp"
#include "tests/scene/scene_fixture.hpp"

namespace degs {
namespace {

using test::IsSentenceWith;
using test::PlyBuilder;

SceneContent content_of(PlyBuilder ply) {
    if (ply.rows.empty()) {
        ply.add_row([](const std::string&) { return 0.5; });
    }
    const test::Folder folder;
    return read_ply(folder.write("scene.ply", ply.file()));
}

PlyBuilder with_comments(const std::string& lines) {
    PlyBuilder ply = PlyBuilder::splat();
    ply.before = lines;
    return ply;
}

TEST(PlyDialect, RedGreenBlueReplaceMissingColours) {
    PlyBuilder ply = PlyBuilder::splat();
    for (const char* const name : {"f_dc_0", "f_dc_1", "f_dc_2"}) {
        ply.remove(name);
    }
    ply.add({"red", "green", "blue"}, "uchar");
    ply.add_row([](const std::string& name) {
        return name == "red" ? 255.0 : name == "green" ? 51.0 : 0.0;
    });
    const SceneContent content = content_of(ply);
    const double y0 = 0.28209479177387814;
    EXPECT_FLOAT_EQ(content.cloud.sh[0], static_cast<float>(0.5 / y0));
    EXPECT_FLOAT_EQ(content.cloud.sh[1], static_cast<float>(-0.3 / y0));
    EXPECT_FLOAT_EQ(content.cloud.sh[2], static_cast<float>(-0.5 / y0));
    ASSERT_EQ(content.notes.size(), 1U);
    EXPECT_THAT(content.notes[0], IsSentenceWith("red, green and blue were taken"));
    ply.add({"f_dc_0", "f_dc_1", "f_dc_2"}); // beside them they mean nothing
    ply.rows[0].insert(ply.rows[0].end(), {1, 2, 3});
    EXPECT_EQ(content_of(ply).cloud.sh, (std::vector<float>{1, 2, 3}));
    EXPECT_TRUE(content_of(ply).notes.empty());
}

TEST(PlyDialect, TwoScalesAreDiscs) {
    PlyBuilder ply = PlyBuilder::splat();
    ply.remove("scale_2");
    ply.add_row([](const std::string& name) { return name == "rot_0" ? 1.0 : 0.0; });
    const SceneContent content = content_of(ply);
    EXPECT_EQ(content.cloud.scales[0], glm::vec3(1, 1, 0));
    ASSERT_EQ(content.notes.size(), 1U);
    EXPECT_THAT(content.notes[0], IsSentenceWith("2D Gaussian Splatting"));
    const test::Folder folder;
    EXPECT_EQ(load_scene(folder.write("disc.ply", ply.file())).cloud.size(), 1U);
    ply.add({"filter_3D"});
    ply.rows[0].push_back(0.75);
    const GaussianCloud filtered = content_of(ply).cloud;
    EXPECT_EQ(filtered.scales[0], glm::vec3(1.25F, 1.25F, 0.75F));
    EXPECT_FLOAT_EQ(filtered.opacities[0], 0.32F);
}

TEST(PlyDialect, DegreeFourIsDroppedWithANote) {
    PlyBuilder ply = PlyBuilder::splat(72);
    ply.add_row([](const std::string& name) {
        return name.rfind("f_rest_", 0) == 0 ? std::stod(name.substr(7)) : 0.5;
    });
    const SceneContent content = content_of(ply);
    EXPECT_EQ(content.cloud.sh_degree, 3);
    for (int channel = 0; channel < 3; ++channel) {
        for (int k = 1; k < 16; ++k) {
            EXPECT_EQ(content.cloud.sh[k * 3 + channel], static_cast<float>(channel * 24 + k - 1));
        }
    }
    ASSERT_EQ(content.notes.size(), 1U);
    EXPECT_THAT(content.notes[0], IsSentenceWith("degree 4"));
}

TEST(PlyDialect, CommentsSelectAntialiasing) {
    const auto antialiased = [](const std::string& lines) {
        return content_of(with_comments(lines)).traits.antialiased;
    };
    EXPECT_FALSE(antialiased(""));
    EXPECT_TRUE(antialiased("comment SplatRenderMode: mip\n"));
    EXPECT_TRUE(antialiased("comment  splatrendermode:  MIP \n"));
    EXPECT_FALSE(antialiased("comment SplatRenderMode: mip\ncomment SplatRenderMode: default\n"));
    EXPECT_TRUE(antialiased("comment antialiased 1\n"));
    EXPECT_TRUE(antialiased("comment antialiased: true\n"));
    EXPECT_FALSE(antialiased("comment antialiased 1\ncomment antialiased 0\n"));
    EXPECT_FALSE(antialiased("comment is not antialiased 1\n"));
    PlyBuilder filtered = PlyBuilder::splat();
    filtered.add({"filter_3D"});
    EXPECT_TRUE(content_of(filtered).traits.antialiased); // trained by Mip-Splatting
}

TEST(PlyDialect, CommentsThatCannotBeFollowedAreNotes) {
    const auto only_note = [](const std::string& lines) {
        const std::vector<std::string> notes = content_of(with_comments(lines)).notes;
        return notes.size() == 1 ? notes[0] : std::to_string(notes.size()) + " notes";
    };
    EXPECT_THAT(only_note("comment SplatRenderMode: 2dgs\n"), IsSentenceWith("2D Gaussian"));
    EXPECT_THAT(only_note("comment SplatRenderMode: warp\x1b\n"), IsSentenceWith("warp"));
    EXPECT_THAT(only_note("comment Vertical axis: z\n"), IsSentenceWith("'Vertical axis: z'"));
    EXPECT_EQ(only_note("comment SH degree: 3\nobj_info antialiased 1\n"), "0 notes");
}

TEST(PlyDialect, RowsOfZerosAreDropped) {
    PlyBuilder ply = PlyBuilder::splat(9);
    for (int row = 0; row < 6; ++row) { // half of the file was never written
        ply.add_row([&](const std::string&) { return row < 3 ? 0.5 : 0.0; });
    }
    const test::Folder folder;
    const Scene scene = load_scene(folder.write("half.ply", ply.file()));
    EXPECT_EQ(scene.cloud.size(), 3U);
    EXPECT_EQ(scene.dropped.zero_rotation, 3U);
}

TEST(PlyDialect, HeadersMayBePaddedAndEndWithoutANewline) {
    PlyBuilder ply = PlyBuilder::splat();
    ply.format = "ascii";
    ply.before = "obj_info made by a program\n\n  comment padded \n";
    ply.add_row([](const std::string&) { return 0.5; });
    std::string file = ply.file();
    file.pop_back(); // the newline behind the last number
    const test::Folder folder;
    EXPECT_EQ(read_ply(folder.write("padded.ply", file)).cloud.size(), 1U);
}

TEST(PlyDialect, PropertyOfAnotherProgramIsSkipped) {
    DEGS_NEEDS_SCENE("fruit-drops");
    const auto read = [](const char* name) {
        return read_ply((test::scenes() / "fruit-drops" / name).string()).cloud;
    };
    const GaussianCloud source = read("source-extra-property.ply"), plain = read("scene.ply");
    EXPECT_EQ(source.means, plain.means);
    EXPECT_EQ(source.sh, plain.sh);
    EXPECT_EQ(source.rotations, plain.rotations);
}

} // namespace
} // namespace degs
