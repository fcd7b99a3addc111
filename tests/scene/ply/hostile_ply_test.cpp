// SPDX-License-Identifier: Apache-2.0
// Broken and malicious PLY files: one sentence each, under the sanitizers too, and no memory for
// what a header merely claims.
#include "scene/ply/ply.hpp"

#include <cmath>
#include <limits>

#include "scene/scene.hpp"
#include "tests/scene/ply/ply_builder.hpp"
#include "tests/scene/scene_fixture.hpp"

namespace degs {
namespace {

using test::IsSentenceWith;
using test::PlyBuilder;

PlyBuilder good(int rest_count = 0) {
    PlyBuilder ply = PlyBuilder::splat(rest_count);
    for (int row = 0; row < 3; ++row) {
        ply.add_row([](const std::string&) { return 0.5; });
    }
    return ply;
}

std::string complaint_about_ply(const std::string& bytes) {
    const test::Folder folder;
    const std::string path = folder.write("bad.ply", bytes);
    std::string sentence = test::complaint([&] { read_ply(path); });
    EXPECT_EQ(sentence.rfind(path + ": ", 0), 0U) << sentence; // the file comes first
    return sentence;
}

TEST(HostilePly, TruncatedAnywhereIsOneSentence) {
    for (const char* const format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        PlyBuilder ply = good(9);
        ply.format = format;
        ply.before = "element path 1\nproperty list uchar int points\n";
        ply.body_before = ply.encode("uchar", 2) + ply.encode("int", 1) + ply.encode("int", 2);
        const std::string file = ply.file();
        // The last number of an ASCII file stays a number when it loses digits: stop before it.
        const std::size_t most = file.size() - (ply.format == "ascii" ? 6 : 1);
        const test::Folder folder;
        for (std::size_t size = most; size > 0; size -= std::min<std::size_t>(size, 3)) {
            const std::string path = folder.write("cut.ply", file.substr(0, size));
            ASSERT_THAT(test::complaint([&] { read_ply(path); }), IsSentenceWith("cut.ply: "))
                << format << " " << size;
        }
    }
}

TEST(HostilePly, CountsThatLie) {
    for (const char* const format : {"ascii", "binary_little_endian"}) {
        for (const char* const count : {"4", "5000000000", "9223372036854775808",
                                        "18446744073709551615", "74380793853442111"}) {
            PlyBuilder ply = good();
            ply.format = format;
            ply.count = count;
            EXPECT_THAT(complaint_about_ply(ply.file()),
                        IsSentenceWith(std::string(format) == "ascii" && std::string(count) == "4"
                                           ? "truncated"
                                           : count));
        }
    }
    for (const char* const count : {"-1", "18446744073709551616", "3.5", "many", "0x10"}) {
        PlyBuilder ply = good();
        ply.count = count;
        EXPECT_THAT(complaint_about_ply(ply.file()), IsSentenceWith("is not an integer"));
    }
}

TEST(HostilePly, CountsThatLieBeforeTheVertices) {
    for (const char* const properties :
         {"property float a\n", "property list uchar int a\n", "property double a\n"}) {
        PlyBuilder ply = good();
        ply.before = std::string("element other 9223372036854775808\n") + properties;
        EXPECT_THAT(complaint_about_ply(ply.file()), IsSentenceWith("9223372036854775808"));
    }
    PlyBuilder ply = good(); // rows of nothing cost nothing
    ply.before = "element other 9223372036854775808\n";
    const test::Folder folder;
    EXPECT_EQ(read_ply(folder.write("ok.ply", ply.file())).cloud.size(), 3U);
}

TEST(HostilePly, ListsThatLie) {
    PlyBuilder ply = good();
    ply.before = "element path 1\nproperty list uint double points\n";
    ply.body_before = ply.encode("uint", 4e9);
    EXPECT_THAT(complaint_about_ply(ply.file()), IsSentenceWith("32000000000 bytes"));
    ply.before = "element path 1\nproperty list int double points\n";
    ply.body_before = ply.encode("int", -1);
    EXPECT_THAT(complaint_about_ply(ply.file()), IsSentenceWith("length of the list"));
    ply.before = "element path 1\nproperty list float double points\n";
    EXPECT_THAT(complaint_about_ply(ply.file()), IsSentenceWith("integer type"));
    ply.format = "ascii";
    ply.before = "element path 1\nproperty list int double points\n";
    for (const char* const length : {"1e30 ", "nan ", "-1 ", "0.5 "}) {
        ply.body_before = length;
        EXPECT_THAT(complaint_about_ply(ply.file()), IsSentenceWith("length of the list"));
    }
}

TEST(HostilePly, MissingPropertiesAreAllNamed) {
    const PlyBuilder complete = good();
    for (const PlyBuilder::Property& property : complete.properties) {
        PlyBuilder ply = PlyBuilder::splat();
        ply.remove(property.name);
        if (property.name[0] != 'n' && property.name != "scale_2") { // properties that are needed
            EXPECT_THAT(complaint_about_ply(ply.file()), IsSentenceWith("'" + property.name + "'"));
        }
    }
    PlyBuilder ply = PlyBuilder::splat();
    ply.remove("rot_3");
    ply.remove("y");
    EXPECT_THAT(complaint_about_ply(ply.file()), IsSentenceWith("'y', 'rot_3'"));
    ply = PlyBuilder::splat();
    ply.properties[0].type = "list uchar float"; // x as a list is no x
    EXPECT_THAT(complaint_about_ply(ply.file()), IsSentenceWith("'x'"));
}

TEST(HostilePly, WrongNumbersOfRestCoefficients) {
    for (const int count : {1, 8, 10, 44, 46, 71, 73, 105}) {
        EXPECT_THAT(complaint_about_ply(good(count).file()),
                    IsSentenceWith("has " + std::to_string(count) + " properties f_rest_*"));
    }
    PlyBuilder ply = good(9); // nine, but not 0 to 8
    ply.properties[9].name = "f_rest_99999999999999999999";
    EXPECT_THAT(complaint_about_ply(ply.file()), IsSentenceWith("'f_rest_0'"));
}

TEST(HostilePly, FilesOfAnotherKind) {
    const std::string xyz = "property float x\nproperty float y\nproperty float z\n";
    const std::string start = "ply\nformat ascii 1.0\n";
    const std::pair<std::string, std::string> cases[] = {
        {start + "element vertex 1\n" + xyz + "property uchar red\nend_header\n1 2 3 4\n",
         "plain point cloud"},
        {start + "element vertex 1\n" + xyz +
             "element face 0\nproperty list uchar int vertex_indices\nend_header\n1 2 3\n",
         "triangle mesh"},
        {start + "element chunk 1\nproperty float min_x\nelement vertex 1\n"
                 "property uint packed_position\nend_header\n0 0\n",
         "'min_y'"},
        {start + "element vertex 1\n" + xyz + "property float trbf_center\nend_header\n0 0 0 0\n",
         "sequences of one still PLY file per frame"},
        {start + "element vertex 1\n" + xyz + "property float scale_t\nend_header\n0 0 0 0\n",
         "native 4D Gaussians, which is not supported; supported are the lite model"},
        {start + "element vertex 1\n" + xyz + "property float f_anchor_feat_0\nend_header\n0 0 0\n",
         "neural network"},
        {start + "element points 1\n" + xyz + "end_header\n1 2 3\n", "no element 'vertex'"},
        {start + "end_header\n", "no element 'vertex'"},
        {"glTF\x02", "not a PLY file"},
        {"PLY\n", "not a PLY file"},
        {std::string(100, '\0') + "\n", "not a PLY file"},
        {"<!doctype html>\n<html>\n", "not a PLY file"},
        {std::string(5000, 'x'), "longer than"},
    };
    for (const auto& [file, sentence] : cases) {
        EXPECT_THAT(complaint_about_ply(file), IsSentenceWith(sentence));
    }
}

TEST(HostilePly, HeadersThatMakeNoSense) {
    const std::string start = "ply\nformat ascii 1.0\n";
    const std::pair<std::string, std::string> cases[] = {
        {"ply\n", "not closed"},
        {"ply\nelement vertex 1\n", "here must stand 'format'"},
        {"ply\nformat ascii 2.0\n", "here must stand 'format'"},
        {"ply\nformat binary 1.0\n", "here must stand 'format'"},
        {start + "property float x\n", "before the first element"},
        {start + "element vertex\n", "needs a name and a count"},
        {start + "element vertex 1\nproperty half x\n", "type 'half' is unknown"},
        {start + "element vertex 1\nproperty float\n", "'property TYPE NAME'"},
        {start + "element vertex 1\nproperty list uchar x\n", "'property TYPE NAME'"},
        {start + "element vertex 1\nproperty float x\nproperty int x\n", "declared twice"},
        {start + "element vertex 1\nelement vertex 1\n", "declared twice"},
        {start + "elephant \x01\xff\n", "'elephant' is unknown"},
        {start + "ele\x01phant\n", "'ele?phant' is unknown"},
        {start + std::string(3000, 'e') + "\n", "line 3"},
        {start + "comment " + std::string(5000, 'c') + "\n", "longer than"},
    };
    for (const auto& [file, sentence] : cases) {
        EXPECT_THAT(complaint_about_ply(file), IsSentenceWith(sentence));
    }
}

TEST(HostilePly, HeadersWithoutEnd) {
    const std::string start = "ply\nformat ascii 1.0\nelement vertex 1\n";
    std::string comments = start;
    std::string properties = start;
    std::string elements = start;
    for (int i = 0; i < 30000; ++i) {
        comments += "comment this header goes on and on and on\n";
        elements += "element e" + std::to_string(i) + " 0\n";
    }
    for (int i = 0; i < 5000; ++i) {
        properties += "property float p" + std::to_string(i) + "\n";
    }
    EXPECT_THAT(complaint_about_ply(comments), IsSentenceWith("not closed"));
    EXPECT_THAT(complaint_about_ply(properties), IsSentenceWith("more than 4096 properties"));
    EXPECT_THAT(complaint_about_ply(elements), IsSentenceWith("more than 64 elements"));
}

TEST(HostilePly, AsciiThatIsNoNumber) {
    for (const char* const word : {"abc", "1,5", "0x10", "1.5f", "--1", "+-1", "1e", "'", "\x80"}) {
        PlyBuilder ply = good();
        ply.format = "ascii";
        ply.count = "1";
        ply.rows.clear();
        ply.body_after = "0 0 0 0 0 0 0 0 0 " + std::string(word) + " 0 0 0 1 0 0 0\n";
        EXPECT_THAT(complaint_about_ply(ply.file()),
                    IsSentenceWith("row 0 of element 'vertex', property 'opacity'"));
        ply.body_after = std::string(600, '1') + " ";
        EXPECT_THAT(complaint_about_ply(ply.file()), IsSentenceWith("longer than 512"));
    }
}

TEST(HostilePly, BadValuesLoadAndAreDroppedWithACount) {
    constexpr double kNoNumber = std::numeric_limits<double>::quiet_NaN();
    constexpr double kEndless = std::numeric_limits<double>::infinity();
    PlyBuilder ply = PlyBuilder::splat();
    const auto add = [&](const std::string& property, double value, double others = 0.5) {
        ply.add_row([&](const std::string& name) { return name == property ? value : others; });
    };
    add("x", 3); // the only good one; its rotation is not of unit length
    add("rot_2", kNoNumber);
    add("scale_0", kEndless);
    add("scale_0", 100); // exp overflows float
    add("opacity", kNoNumber);
    add("y", kEndless);
    add("f_dc_1", -kEndless);
    add("x", 3, 0); // rotation of length zero
    const test::Folder folder;
    const Scene scene = load_scene(folder.write("bad.ply", ply.file()));
    ASSERT_EQ(scene.cloud.size(), 1U);
    EXPECT_EQ(scene.cloud.means[0].x, 3);
    EXPECT_EQ(scene.cloud.rotations[0], glm::vec4(0.5F));
    EXPECT_EQ(scene.dropped.non_finite, 6U);
    EXPECT_EQ(scene.dropped.zero_rotation, 1U);
    EXPECT_EQ(scene.dropped.total(), 7U);
}

TEST(HostilePly, EmptyScenesAreRefused) {
    const test::Folder folder;
    EXPECT_THAT(
        test::complaint([&] { load_scene(folder.write("none.ply", PlyBuilder::splat().file())); }),
        IsSentenceWith("holds no Gaussians"));
    PlyBuilder ply = PlyBuilder::splat();
    ply.add_row([](const std::string&) { return 0.0; });
    EXPECT_THAT(test::complaint([&] { load_scene(folder.write("zero.ply", ply.file())); }),
                IsSentenceWith("none of the 1 Gaussians can be drawn"));
}

} // namespace
} // namespace degs
