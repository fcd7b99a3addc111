// SPDX-License-Identifier: Apache-2.0
#include "scene/ply/ply.hpp"

#include <cmath>

#include "tests/scene/ply/ply_builder.hpp"
#include "tests/scene/scene_fixture.hpp"

namespace degs {
namespace {

using test::Folder;
using test::PlyBuilder;

/// A value that differs for every property and row.
double marker(const std::string& name, int row) {
    const std::size_t digits = name.find_last_not_of("0123456789") + 1;
    const double index = digits < name.size() ? std::stod(name.substr(digits)) : 0;
    if (name.rfind("f_rest_", 0) == 0) {
        return row + index / 64;
    }
    return 0.125 * row + 0.25 * index + (name == "y" ? 0.5 : name == "z" ? 0.75 : 0);
}

void fill(PlyBuilder& ply, int rows) {
    for (int row = 0; row < rows; ++row) {
        ply.add_row([&](const std::string& name) { return marker(name, row); });
    }
}

/// What `fill` must turn into.
void expect_markers(const GaussianCloud& cloud, std::size_t rows, int degree) {
    ASSERT_EQ(cloud.size(), rows);
    ASSERT_EQ(cloud.sh_degree, degree);
    const int rest = cloud.sh_coefficients() - 1;
    ASSERT_EQ(cloud.sh.size(), rows * static_cast<std::size_t>(rest + 1) * 3);
    for (std::size_t i = 0; i < rows; ++i) {
        const double base = 0.125 * static_cast<double>(i);
        EXPECT_EQ(cloud.means[i], glm::dvec3(base, base + 0.5, base + 0.75));
        EXPECT_FLOAT_EQ(cloud.opacities[i], static_cast<float>(1 / (1 + std::exp(-base))));
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_FLOAT_EQ(cloud.scales[i][axis],
                            static_cast<float>(std::exp(base + 0.25 * axis)));
            EXPECT_EQ(cloud.sh_of(i)[axis], static_cast<float>(base + 0.25 * axis));
            for (int k = 1; k <= rest; ++k) { // channel-major in the file
                EXPECT_EQ(
                    cloud.sh_of(i)[k * 3 + axis],
                    static_cast<float>(static_cast<double>(i) + (axis * rest + k - 1) / 64.0));
            }
        }
        for (int k = 0; k < 4; ++k) { // w x y z, not normalised by the reader
            EXPECT_EQ(cloud.rotations[i][k], static_cast<float>(base + 0.25 * k));
        }
    }
}

GaussianCloud read(const PlyBuilder& ply) {
    const Folder folder;
    return read_ply(folder.write("scene.ply", ply.file())).cloud;
}

class PlyDegree : public testing::TestWithParam<int> {};

TEST_P(PlyDegree, FollowsFromTheNumberOfRestCoefficients) {
    const int degree = GetParam();
    PlyBuilder ply = PlyBuilder::splat(3 * ((degree + 1) * (degree + 1) - 1));
    fill(ply, 5);
    expect_markers(read(ply), 5, degree);
}
INSTANTIATE_TEST_SUITE_P(Degrees, PlyDegree, testing::Values(0, 1, 2, 3));

class PlyEncoding : public testing::TestWithParam<const char*> {};

TEST_P(PlyEncoding, GivesTheSameCloud) {
    PlyBuilder ply = PlyBuilder::splat(9);
    ply.format = GetParam();
    fill(ply, 7);
    expect_markers(read(ply), 7, 1);
}

TEST_P(PlyEncoding, MayHaveDoublesExtrasAnyOrderAndNoNormals) {
    PlyBuilder ply = PlyBuilder::splat(9);
    for (const char* const normal : {"nx", "ny", "nz"}) {
        ply.remove(normal);
    }
    ply.add({"red", "green"}, "uchar");
    ply.add({"segment_id"}, "int");
    ply.add({"label"}, "int16");
    std::reverse(ply.properties.begin(), ply.properties.end());
    for (std::size_t i = 0; i < ply.properties.size(); i += 2) {
        if (ply.properties[i].type == "float") {
            ply.properties[i].type = "double";
        }
    }
    fill(ply, 6);
    expect_markers(read(ply), 6, 1);
}

TEST_P(PlyEncoding, SkipsElementsBeforeAndIgnoresElementsAfter) {
    PlyBuilder ply = PlyBuilder::splat();
    ply.format = GetParam();
    ply.before = "element camera 2\nproperty float f\nproperty uchar id\n"
                 "element path 3\nproperty list uchar int points\nproperty short tag\n";
    ply.after = "element face 99\nproperty list uchar int vertex_indices\n";
    for (int i = 0; i < 2; ++i) {
        ply.body_before += ply.encode("float", 1.5) + ply.encode("uchar", i);
    }
    for (int points = 0; points < 3; ++points) {
        ply.body_before += ply.encode("uchar", points);
        for (int i = 0; i < points; ++i) {
            ply.body_before += ply.encode("int", 1000 * i);
        }
        ply.body_before += ply.encode("short", -7);
    }
    fill(ply, 4);
    expect_markers(read(ply), 4, 0);
}

TEST_P(PlyEncoding, MayHaveListsAmongTheVertexProperties) {
    PlyBuilder ply = PlyBuilder::splat();
    ply.format = GetParam();
    PlyBuilder with_list = ply;
    const PlyBuilder::Property list{"list uchar float", "neighbours"};
    with_list.properties.insert(with_list.properties.begin() + 2, list);
    std::string body; // row by row, because lists differ in length
    for (int row = 0; row < 3; ++row) {
        for (std::size_t i = 0; i < ply.properties.size(); ++i) {
            if (i == 2) {
                body += ply.encode("uchar", row);
                for (int k = 0; k < row; ++k) {
                    body += ply.encode("float", 9.75);
                }
            }
            body += ply.encode("float", marker(ply.properties[i].name, row));
        }
    }
    with_list.count = "3";
    with_list.body_after = body;
    expect_markers(read(with_list), 3, 0);
}

TEST_P(PlyEncoding, MayEndItsHeaderLinesWithCarriageReturns) {
    PlyBuilder ply = PlyBuilder::splat();
    ply.format = GetParam();
    ply.line_end = "\r\n";
    ply.before = "obj_info padded   \ncomment  element vertex 5\n";
    fill(ply, 3);
    expect_markers(read(ply), 3, 0);
}
INSTANTIATE_TEST_SUITE_P(Formats, PlyEncoding,
                         testing::Values("ascii", "binary_little_endian", "binary_big_endian"));

TEST(Ply, KnowsBothNamesOfEveryType) {
    const std::pair<const char*, double> types[] = {
        {"char", -3},    {"int8", -3},      {"uchar", 200},    {"uint8", 200},
        {"short", -300}, {"int16", -300},   {"ushort", 60000}, {"uint16", 60000},
        {"int", -70000}, {"int32", -70000}, {"uint", 4e9},     {"uint32", 4e9},
        {"float", 0.25}, {"float32", 0.25}, {"double", 0.1},   {"float64", 0.1},
    };
    for (const char* const format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        for (const auto& [type, value] : types) {
            PlyBuilder ply = PlyBuilder::splat();
            ply.format = format;
            ply.properties[0].type = type; // x, which is kept in double
            const double x = value;
            ply.add_row([&](const std::string& name) { return name == "x" ? x : 0.5; });
            EXPECT_EQ(read(ply).means.at(0), glm::dvec3(value, 0.5, 0.5)) << type << " " << format;
        }
    }
}

TEST(Ply, ReadsAsciiNumbersOfAllKinds) {
    PlyBuilder ply = PlyBuilder::splat();
    ply.format = "ascii";
    ply.count = "1";
    // x y z, normals, f_dc, opacity, scales, rotation; no newline at the end
    ply.body_after = "+1.5e1\t-2 \n 1e-400 0 0 0  nan inf 3\r\n -inf 1e400 0 -1e400 1 0 0 0";
    const GaussianCloud cloud = read(ply);
    ASSERT_EQ(cloud.size(), 1U);
    EXPECT_EQ(cloud.means[0], glm::dvec3(15, -2, 0));
    EXPECT_TRUE(std::isnan(cloud.sh[0]));
    EXPECT_TRUE(std::isinf(cloud.sh[1]));
    EXPECT_EQ(cloud.opacities[0], 0);
    EXPECT_TRUE(std::isinf(cloud.scales[0].x));
    EXPECT_EQ(cloud.scales[0].y, 1);
    EXPECT_EQ(cloud.scales[0].z, 0);
}

TEST(Ply, SpansManyBlocksInEveryFormat) {
    for (const char* const format : {"ascii", "binary_little_endian", "binary_big_endian"}) {
        PlyBuilder ply = PlyBuilder::splat(9);
        ply.format = format;
        fill(ply, 20011); // 2 MB and more: blocks and strips end in the middle
        expect_markers(read(ply), 20011, 1);
    }
}

TEST(Ply, FusesTheFilterOfMipSplatting) {
    PlyBuilder ply = PlyBuilder::splat();
    ply.add({"filter_3D"});
    for (const double filter : {0.0, 0.75}) {
        ply.add_row([&](const std::string& name) {
            return name == "filter_3D" ? filter : name == "scale_2" ? std::log(2.0) : 0.0;
        });
    }
    const GaussianCloud cloud = read(ply);
    EXPECT_EQ(cloud.opacities[0], 0.5F);
    EXPECT_EQ(cloud.scales[0], glm::vec3(1, 1, 2));
    const double wide = std::sqrt(4 + 0.5625); // sqrt(s^2 + f^2); 1.25 for the other two
    EXPECT_FLOAT_EQ(cloud.scales[1].x, 1.25F);
    EXPECT_FLOAT_EQ(cloud.scales[1].z, static_cast<float>(wide));
    EXPECT_FLOAT_EQ(cloud.opacities[1], static_cast<float>(0.5 * 0.64 * 2 / wide));
}

GaussianCloud extreme_cloud() {
    GaussianCloud cloud;
    cloud.sh_degree = 2;
    const float opacities[] = {0, 1e-6F, 0.25F, 0.999999F, 1};
    for (int i = 0; i < 5; ++i) {
        cloud.means.emplace_back(i, -2 * i, 0.5 * i);
        cloud.scales.emplace_back(0, 1e-9F * static_cast<float>(i + 1), 3);
        cloud.rotations.emplace_back(0.5F, -0.5F, 0.5F, -0.5F);
        cloud.opacities.push_back(opacities[i]);
        for (int k = 0; k < 27; ++k) {
            cloud.sh.push_back(static_cast<float>(k + 100 * i) / 7);
        }
    }
    return cloud;
}

TEST(Ply, WritesWhatItReads) {
    const Folder folder;
    const GaussianCloud cloud = extreme_cloud();
    write_ply(cloud, folder.path("out.ply"));
    EXPECT_EQ(folder.entries(), 1U); // no temporary file stays behind
    const GaussianCloud back = read_ply(folder.path("out.ply")).cloud;
    EXPECT_EQ(back.sh_degree, 2);
    EXPECT_EQ(back.means, cloud.means);
    EXPECT_EQ(back.rotations, cloud.rotations);
    EXPECT_EQ(back.sh, cloud.sh);
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        // A logit or log of magnitude v, rounded to float, moves the value by v 2^-24 relative.
        EXPECT_NEAR(back.opacities[i], cloud.opacities[i], cloud.opacities[i] * 15 * 0x1p-23);
        EXPECT_EQ(back.scales[i].x, 0);
        EXPECT_NEAR(back.scales[i].y, cloud.scales[i].y, cloud.scales[i].y * 21 * 0x1p-23);
    }
    EXPECT_EQ(back.opacities.front(), 0);
    EXPECT_EQ(back.opacities.back(), 1);
    const std::string bytes = test::bytes_of(folder.path("out.ply"));
    EXPECT_EQ(bytes.find("inf"), std::string::npos);
}

TEST(Ply, IsWrittenWithFiniteLogitsForOtherReaders) {
    const Folder folder;
    write_ply(extreme_cloud(), folder.path("out.ply"));
    const std::string bytes = test::bytes_of(folder.path("out.ply"));
    const std::size_t body = bytes.find("end_header\n") + 11;
    ASSERT_EQ((bytes.size() - body) % 4, 0U);
    for (std::size_t at = body; at < bytes.size(); at += 4) {
        float value = 0;
        std::memcpy(&value, bytes.data() + at, 4);
        EXPECT_TRUE(std::isfinite(value)) << "byte " << at;
    }
}

TEST(Ply, CannotBeWrittenJustAnywhere) {
    const Folder folder;
    const GaussianCloud cloud = extreme_cloud();
    EXPECT_THAT(test::complaint([&] { write_ply(cloud, folder.path("none/out.ply")); }),
                test::IsSentenceWith("does not exist"));
    EXPECT_THAT(test::complaint([&] { write_ply(cloud, folder.path("")); }),
                test::IsSentenceWith("folder"));
    EXPECT_THAT(test::complaint([&] { write_ply(cloud, ""); }), test::IsSentenceWith("name"));
}

} // namespace
} // namespace degs
