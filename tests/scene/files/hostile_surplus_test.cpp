// SPDX-License-Identifier: Apache-2.0
// Files that hold more than their headers say: one sentence each, because what is left over mostly
// means that everything was read from the wrong place.
#include "scene/files/input_file.hpp"
#include "scene/ply/ply.hpp"
#include "scene/scene.hpp"
#include "tests/scene/ply/ply_builder.hpp"
#include "tests/scene/scene_fixture.hpp"

namespace degs {
namespace {

using test::IsSentenceWith;
using test::PlyBuilder;

PlyBuilder three_rows(const std::string& format) {
    PlyBuilder ply = PlyBuilder::splat(9);
    ply.format = format;
    for (int row = 0; row < 3; ++row) {
        ply.add_row([row](const std::string& name) { return name == "x" ? row : -0.25; });
    }
    return ply;
}

std::string refusal_of_ply(const std::string& bytes) {
    const test::Folder folder;
    const std::string path = folder.write("s.ply", bytes);
    return test::complaint([&] { read_ply(path); });
}

TEST(HostileSurplus, BytesBehindTheLastElement) {
    for (const char* const format : {"binary_little_endian", "binary_big_endian"}) {
        for (const int extra : {1, 2, 3, 4, 5000}) {
            PlyBuilder ply = three_rows(format);
            ply.body_before = std::string(extra, '\x01'); // everything is shifted
            EXPECT_THAT(refusal_of_ply(ply.file()),
                        IsSentenceWith(std::to_string(extra) + " byte(s) are left over"));
            ply.body_before.clear();
            ply.body_after = std::string(extra, '\n');
            EXPECT_THAT(refusal_of_ply(ply.file()), IsSentenceWith("element 'vertex'"));
        }
    }
}

TEST(HostileSurplus, BytesBehindElementsThatAreSkipped) {
    PlyBuilder ply = three_rows("binary_little_endian");
    ply.after = "element path 2\nproperty list uchar int points\nelement end 1\nproperty char c\n";
    ply.body_after = ply.encode("uchar", 1) + ply.encode("int", 7) + ply.encode("uchar", 0) + "c";
    EXPECT_EQ(refusal_of_ply(ply.file()), "");
    ply.body_after += "d";
    EXPECT_THAT(refusal_of_ply(ply.file()), IsSentenceWith("1 byte(s) are left over"));
    ply.body_after.resize(ply.body_after.size() - 3);
    EXPECT_THAT(refusal_of_ply(ply.file()), IsSentenceWith("before all of its data was found"));
}

TEST(HostileSurplus, ValuesTooManyInAsciiRows) {
    PlyBuilder ply = three_rows("ascii");
    ply.body_after = "\n \t\r\n";
    EXPECT_EQ(refusal_of_ply(ply.file()), "");
    ply.body_after = "1 2\n3\n";
    EXPECT_THAT(refusal_of_ply(ply.file()), IsSentenceWith("3 value(s) are left over"));
    std::string every = ply.header();
    std::string one_moved = every;
    for (int row = 0; row < 3; ++row) {
        const std::string line = ply.body().substr(0, ply.body().find('\n'));
        every += line + "0\n";
        one_moved += row == 1   ? line.substr(line.find(' ') + 1) + "\n"
                     : row == 0 ? line + "0\n"
                                : line + "\n";
    }
    EXPECT_THAT(refusal_of_ply(every), IsSentenceWith("row 1 of element 'vertex'"));
    EXPECT_THAT(refusal_of_ply(one_moved), IsSentenceWith("row 1 of element 'vertex'"));
}

TEST(HostileSurplus, AsciiRowsMayTakeSeveralLinesAndShareThem) {
    const PlyBuilder ply = three_rows("ascii");
    std::string wrapped, joined;
    for (const char c : ply.body()) {
        wrapped += c == ' ' ? '\n' : c;
        joined += c == '\n' ? ' ' : c;
    }
    EXPECT_EQ(refusal_of_ply(ply.header() + wrapped), "");
    EXPECT_EQ(refusal_of_ply(ply.header() + joined), "");
    EXPECT_THAT(refusal_of_ply(ply.header() + joined + " 1"),
                IsSentenceWith("1 value(s) are left"));
}

TEST(HostileSurplus, EveryLineEndOfAHeaderIsRead) {
    const test::Folder folder;
    for (const char* const format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        PlyBuilder ply = three_rows(format);
        const GaussianCloud expected = read_ply(folder.write("lf.ply", ply.file())).cloud;
        for (const char* const line_end : {"\r\n", "\n\r", "\r"}) {
            ply.line_end = line_end;
            const GaussianCloud cloud = read_ply(folder.write("other.ply", ply.file())).cloud;
            EXPECT_EQ(cloud.means, expected.means) << format;
            EXPECT_EQ(cloud.scales, expected.scales) << format;
            EXPECT_EQ(cloud.sh, expected.sh) << format;
        }
    }
}

TEST(HostileSurplus, DataThatBeginsWithACarriageReturnKeepsIt) {
    const test::Folder folder;
    for (const char* const line_end : {"\n", "\r\n", "\n\r"}) {
        PlyBuilder ply = PlyBuilder::splat();
        ply.properties.insert(ply.properties.begin(), {"uchar", "tag"});
        ply.line_end = line_end;
        ply.add_row([](const std::string& name) { return name == "tag" ? '\r' : -0.5; });
        const GaussianCloud cloud = read_ply(folder.write("cr.ply", ply.file())).cloud;
        EXPECT_EQ(cloud.means[0], glm::dvec3(-0.5));
    }
}

TEST(HostileSurplus, NamesOfFilesEndAtNoZero) {
    const test::Folder folder;
    const std::string path = folder.write("s.ply", three_rows("ascii").file());
    EXPECT_THAT(test::complaint([&] { InputFile(path + std::string("\0.txt", 5)); }),
                IsSentenceWith("holds a zero"));
}

} // namespace
} // namespace degs
