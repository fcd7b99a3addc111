// SPDX-License-Identifier: Apache-2.0
// Attributes and extensions of splats in glTF.
#include <cmath>

#include "scene/scene.hpp"
#include "splat/model/spherical_harmonics.hpp"
#include "tests/scene/gltf/glb_builder.hpp"

namespace degs {
namespace {

using test::Glb;
using test::two_splats;
using testing::ElementsAre;
using testing::HasSubstr;

TEST(Gltf, ReadsEveryAttribute) {
    const SceneContent content = test::read(two_splats());
    const GaussianCloud& cloud = content.cloud;
    ASSERT_EQ(cloud.size(), 2U);
    EXPECT_EQ(cloud.sh_degree, 0);
    EXPECT_EQ(cloud.means[0], glm::dvec3(1, 2, 3));
    EXPECT_EQ(cloud.scales[1], glm::vec3(1, 2, 3));
    EXPECT_EQ(cloud.rotations[0], glm::vec4(1, 0, 0, 0)); // w x y z
    EXPECT_EQ(cloud.rotations[1], glm::vec4(0.8F, 0.6F, 0, 0));
    EXPECT_THAT(cloud.opacities, ElementsAre(0.25F, 1));
    EXPECT_THAT(cloud.sh, ElementsAre(0.5F, -0.5F, 1, 2, 0, -1));
    EXPECT_THAT(content.notes, ElementsAre());
    EXPECT_EQ(content.axes, Axes{});
}

Glb with_degree(int degree) {
    Glb glb = two_splats();
    for (int l = 1; l <= degree; ++l) {
        for (int n = 0; n <= 2 * l; ++n) {
            const auto value = static_cast<float>(10 * l + n);
            glb.attribute("SH_DEGREE_" + std::to_string(l) + "_COEF_" + std::to_string(n)) =
                glb.add({value, value + 0.25F, value + 0.5F, -value, 0, 0}, "VEC3");
        }
    }
    return glb;
}

TEST(Gltf, OrdersCoefficientsByDegree) {
    for (int degree = 1; degree <= 3; ++degree) {
        const GaussianCloud cloud = test::read(with_degree(degree)).cloud;
        ASSERT_EQ(cloud.sh_degree, degree);
        for (int l = 1; l <= degree; ++l) {
            for (int n = 0; n <= 2 * l; ++n) {
                const int k = l * l + n;
                const auto value = static_cast<float>(10 * l + n);
                EXPECT_EQ(cloud.sh_of(0)[k * 3 + 1], value + 0.25F);
                EXPECT_EQ(cloud.sh_of(1)[k * 3], -value);
            }
        }
    }
}

TEST(Gltf, TakesADegreeWholeOrNotAtAll) {
    Glb incomplete = with_degree(2);
    incomplete.primitive()["attributes"].erase("KHR_gaussian_splatting:SH_DEGREE_2_COEF_3");
    EXPECT_THAT(test::complaint_about(incomplete),
                test::IsSentenceWith("has 4 of the 5 coefficients of SH degree 2"));
    Glb gap = with_degree(3);
    for (int n = 0; n < 5; ++n) {
        gap.primitive()["attributes"].erase("KHR_gaussian_splatting:SH_DEGREE_2_COEF_" +
                                            std::to_string(n));
    }
    EXPECT_THAT(test::complaint_about(gap),
                test::IsSentenceWith("7 of the 7 coefficients of SH degree 3 and all of degree 1"));
    Glb fourth = with_degree(3);
    fourth.attribute("SH_DEGREE_4_COEF_0") = fourth.attribute("SH_DEGREE_3_COEF_0");
    EXPECT_THAT(test::read(fourth).notes, ElementsAre(HasSubstr("above degree 3 are ignored")));
}

TEST(Gltf, NotesWhatItDoesNotKnow) {
    Glb glb = two_splats();
    glb.extension() = {{"kernel", "box"},
                       {"colorSpace", "BT.709-sRGB"},
                       {"projection", "fisheye"},
                       {"sortingMethod", "none"}};
    EXPECT_THAT(test::read(glb).notes,
                ElementsAre(HasSubstr("kernel 'box'"), HasSubstr("projection 'fisheye'"),
                            HasSubstr("sortingMethod 'none'")));
    glb.extension() = {{"kernel", 3}, {"colorSpace", "lin_rec709_display"}};
    EXPECT_THAT(test::read(glb).notes,
                ElementsAre(HasSubstr("kernel ''"), HasSubstr("in linear light")));
    glb.extension() = nlohmann::json::object();
    EXPECT_THAT(test::read(glb).notes,
                ElementsAre(HasSubstr("no 'kernel'"), HasSubstr("no 'colorSpace'")));
}

TEST(Gltf, ReadsDraftsOf2025) {
    Glb glb = two_splats();
    nlohmann::json renamed = {{"POSITION", 0},
                              {"_ROTATION", glb.attribute("ROTATION")},
                              {"_SCALE", glb.attribute("SCALE")}};
    renamed["COLOR_0"] =
        glb.add(std::vector<std::uint8_t>{255, 0, 51, 255, 0, 255, 0, 51}, 5121, "VEC4", true);
    glb.primitive()["attributes"] = renamed;
    const SceneContent content = test::read(glb);
    EXPECT_EQ(content.cloud.scales[1], glm::vec3(1, 2, 3));
    EXPECT_THAT(content.cloud.opacities, ElementsAre(1, 0.2F));
    EXPECT_NEAR(0.5 + kShY0 * content.cloud.sh[0], 1, 1e-6);
    EXPECT_NEAR(0.5 + kShY0 * content.cloud.sh[2], 0.2, 1e-6);
    EXPECT_NEAR(0.5 + kShY0 * content.cloud.sh[4], 1, 1e-6);
    EXPECT_THAT(content.notes, testing::Contains(HasSubstr("taken from COLOR_0")));
    EXPECT_THAT(content.notes, testing::Contains(HasSubstr("named as in drafts")));
}

TEST(Gltf, PrefersItsAttributesToColor) {
    Glb glb = two_splats();
    glb.primitive()["attributes"]["COLOR_0"] = glb.add({9, 9, 9, 9, 9, 9}, "VEC3");
    const SceneContent content = test::read(glb);
    EXPECT_THAT(content.cloud.sh, ElementsAre(0.5F, -0.5F, 1, 2, 0, -1));
    EXPECT_THAT(content.notes, ElementsAre());
    glb.primitive()["attributes"].erase("KHR_gaussian_splatting:OPACITY"); // VEC3 has no alpha
    EXPECT_THAT(test::complaint_about(glb),
                test::IsSentenceWith("COLOR_0 has elements of another type than VEC4"));
}

TEST(Gltf, ReadsBuffersBesideAndInside) {
    Glb glb = two_splats();
    const test::Folder folder;
    folder.write("data/part one.bin", glb.bin + "more than byteLength says");
    glb.json["buffers"][0]["uri"] = "data/part%20one.bin";
    const std::string path = folder.write("scene.gltf", glb.json.dump());
    EXPECT_EQ(read_gltf(path).cloud.means[1], glm::dvec3(-1, 0.5, 4));
    EXPECT_THAT(load_scene(path).cloud.opacities, ElementsAre(0.25F, 1));

    Glb inside = two_splats();
    inside.json["buffers"].push_back(
        {{"byteLength", 12}, {"uri", "data:application/octet-stream;base64,AACAPwAAAEAAAEBA"}});
    inside.json["bufferViews"].push_back({{"buffer", 1}, {"byteLength", 12}});
    inside.json["accessors"][0]["bufferView"] = inside.json["bufferViews"].size() - 1;
    for (auto& accessor : inside.json["accessors"]) {
        accessor["count"] = 1;
    }
    EXPECT_EQ(test::read(inside).cloud.means[0], glm::dvec3(1, 2, 3));
}

TEST(Gltf, IgnoresChunksAndBytesOfOthers) {
    const Glb glb = two_splats();
    std::string bytes = glb.bytes() + test::glb_chunk("XYZ1", "private", ' ');
    bytes.replace(8, 4, test::four_bytes(bytes.size()));
    const test::Folder folder;
    const SceneContent content = read_gltf(folder.write("scene.glb", bytes + "tail"));
    EXPECT_EQ(content.cloud.size(), 2U);
    EXPECT_THAT(content.notes, ElementsAre(HasSubstr("4 bytes after the end"),
                                           HasSubstr("1 chunk(s) of the GLB")));
}

TEST(Gltf, ReadsTheSceneOfThePly) {
    DEGS_NEEDS_SCENE("fruit-drops");
    const auto folder = test::scenes() / "fruit-drops";
    const GaussianCloud glb = load_scene((folder / "scene.glb").string()).cloud;
    const GaussianCloud ply = load_scene((folder / "scene.ply").string()).cloud;
    EXPECT_EQ(glb.means, ply.means);
    EXPECT_EQ(glb.sh, ply.sh);
    EXPECT_EQ(glb.opacities, ply.opacities);
    ASSERT_EQ(glb.size(), ply.size());
    for (std::size_t i = 0; i < glb.size(); ++i) {
        for (int axis = 0; axis < 3; ++axis) {
            ASSERT_NEAR(glb.scales[i][axis] / ply.scales[i][axis], 1, 2e-7);
        }
        for (int c = 0; c < 4; ++c) {
            ASSERT_NEAR(glb.rotations[i][c], ply.rotations[i][c], 2e-7);
        }
    }
}

TEST(Gltf, ReadsSpzOfAnotherProject) {
    DEGS_NEEDS_SCENE("formats/spz-in-gltf-basic.glb");
    const SceneContent content =
        read_gltf((test::scenes() / "formats/spz-in-gltf-basic.glb").string());
    ASSERT_EQ(content.cloud.size(), 1U);
    EXPECT_EQ(content.axes, *parse_axes("LUF"));
    // (1, 2, 3) in the SPZ data, turned to (-1, 2, -3), then by the node, which makes z up y up.
    EXPECT_EQ(content.cloud.means[0], glm::dvec3(-1, -3, -2));
    EXPECT_NEAR(content.cloud.opacities[0], 128.0 / 255, 1e-6);
    EXPECT_NEAR(content.cloud.scales[0].x, std::exp(3.0), 1e-4);
}

/// The SPZ file of a scene as a compressed primitive, under each of the three names.
TEST(Gltf, ReadsSpzUnderItsThreeNames) {
    DEGS_NEEDS_SCENE("fruit-drops");
    const auto spz_file = test::scenes() / "fruit-drops/scene-v3.spz";
    const std::string spz = test::bytes_of(spz_file.string());
    const GaussianCloud expected = load_scene(spz_file.string()).cloud;
    const std::string draft = "KHR_spz_gaussian_splats_compression";
    for (const std::string& name : {std::string("KHR_gaussian_splatting_compression_spz_2"),
                                    std::string("KHR_gaussian_splatting_compression_spz"), draft}) {
        Glb glb = two_splats();
        glb.add(std::vector<char>(spz.begin(), spz.end()), 5121, "SCALAR");
        const nlohmann::json data = {{"bufferView", glb.json["bufferViews"].size() - 1}};
        for (auto& accessor : glb.json["accessors"]) {
            accessor.erase("bufferView");
            accessor["count"] = expected.size();
        }
        if (name == draft) {
            glb.primitive()["extensions"] = {{name, data}};
        } else {
            glb.extension()["extensions"][name] = data;
        }
        const test::Folder folder;
        const Scene scene = load_scene(folder.write("scene.glb", glb.bytes()));
        EXPECT_EQ(scene.cloud.means, expected.means) << name;
        EXPECT_EQ(scene.cloud.sh, expected.sh) << name;
        EXPECT_EQ(scene.cloud.scales, expected.scales) << name;
        EXPECT_EQ(scene.cloud.opacities, expected.opacities) << name;
        glb.json["accessors"][0]["count"] = 7;
        EXPECT_THAT(test::complaint_about(glb), test::IsSentenceWith("has 7 elements")) << name;
    }
}

} // namespace
} // namespace degs
