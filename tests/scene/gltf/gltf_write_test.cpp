// SPDX-License-Identifier: Apache-2.0
#include <cmath>
#include <cstring>

#include "scene/cameras/lens_terms.hpp"
#include "scene/ply/ply.hpp"
#include "scene/scene.hpp"
#include "tests/scene/gltf/glb_builder.hpp"
#include "tests/splat/frame/brute_force.hpp"

namespace degs {
namespace {

/// The rows of a PLY that write_ply() has written: everything behind the header.
std::vector<float> rows_of(const std::string& path) {
    const std::string bytes = test::bytes_of(path);
    const std::string end = "end_header\n";
    const std::size_t begin = bytes.find(end) + end.size();
    std::vector<float> values((bytes.size() - begin) / sizeof(float));
    std::memcpy(values.data(), bytes.data() + begin, values.size() * sizeof(float));
    return values;
}

class WrittenGlb : public testing::TestWithParam<const char*> {};

/// PLY -> GLB -> memory: every bit of what the PLY gave, so the image is the same, too.
TEST_P(WrittenGlb, KeepsEveryBitOfTheCloud) {
    DEGS_NEEDS_SCENE(GetParam());
    const Scene scene = load_scene((test::scenes() / GetParam() / "scene.ply").string());
    const test::Folder folder;
    const std::string path = folder.path("scene.glb");
    write_glb(scene.cloud, scene.cameras, {}, path);
    const Scene back = load_scene(path);
    EXPECT_EQ(back.cloud.means, scene.cloud.means);
    EXPECT_EQ(back.cloud.scales, scene.cloud.scales);
    EXPECT_EQ(back.cloud.rotations, scene.cloud.rotations);
    EXPECT_EQ(back.cloud.opacities, scene.cloud.opacities);
    EXPECT_EQ(back.cloud.sh, scene.cloud.sh);
    EXPECT_TRUE(back.notes.empty());
    ASSERT_EQ(back.cameras.size(), scene.cameras.size());
    for (std::size_t i = 0; i < back.cameras.size(); ++i) {
        const Camera& a = scene.cameras[i];
        const Camera& b = back.cameras[i];
        EXPECT_EQ(b.name, a.name);
        EXPECT_EQ(b.width, a.width);
        EXPECT_EQ(b.height, a.height);
        EXPECT_NEAR(b.fx / a.fx, 1, 1e-14);
        EXPECT_NEAR(b.fy / a.fy, 1, 1e-14);
        EXPECT_EQ(b.position, a.position);
        for (int column = 0; column < 3; ++column) {
            EXPECT_LT(glm::length(b.camera_to_world[column] - a.camera_to_world[column]), 1e-6);
        }
    }
}
INSTANTIATE_TEST_SUITE_P(Shared, WrittenGlb,
                         testing::Values("fruit-drops", "skull", "flowers-small", "guitar"),
                         [](const auto& row) {
                             std::string name = row.param;
                             name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
                             return name;
                         });

TEST(WrittenGlb, KeepsLenses) {
    GaussianCloud cloud = test::random_cloud(3, 1);
    const test::Folder folder;
    const std::string path = folder.path("scene.glb");
    std::vector<Camera> cameras(4, test::make_camera(64, 48, 50));
    cameras[1].lens = open_cv_lens({0.1, -0.02, 1e-3, 2e-3});
    cameras[2].lens = open_cv_lens({0.1, -0.02, 1e-3, 2e-3, 1e-4, 0.3, 0.2, 0.1});
    cameras[3].lens = fisheye_lens({0.01, 0.02, 0.03, 0.04});
    write_glb(cloud, cameras, {}, path);
    const Scene back = load_scene(path);
    ASSERT_EQ(back.cameras.size(), cameras.size());
    EXPECT_TRUE(back.cameras[0].lens.is_pinhole());
    for (std::size_t i = 1; i < cameras.size(); ++i) {
        EXPECT_EQ(terms_of(back.cameras[i].lens).model, terms_of(cameras[i].lens).model);
        EXPECT_EQ(terms_of(back.cameras[i].lens).terms, terms_of(cameras[i].lens).terms);
    }
}

/// PLY -> GLB -> PLY against PLY -> PLY: the same file, byte for byte. Against the values of the
/// original file, means and SH keep their bits; rotations do if they had length 1; logarithms and
/// logits come back within what a float of the linear value can tell apart.
TEST(WrittenGlbAsPly, EqualsThePly) {
    DEGS_NEEDS_SCENE("fruit-drops");
    const std::string original = (test::scenes() / "fruit-drops/scene.ply").string();
    const test::Folder folder;
    const Scene scene = load_scene(original);
    write_ply(scene.cloud, folder.path("direct.ply"));
    write_glb(scene.cloud, {}, {}, folder.path("scene.glb"));
    write_ply(load_scene(folder.path("scene.glb")).cloud, folder.path("back.ply"));
    EXPECT_EQ(test::bytes_of(folder.path("back.ply")), test::bytes_of(folder.path("direct.ply")));

    const std::vector<float> before = rows_of(original);
    const std::vector<float> after = rows_of(folder.path("back.ply"));
    ASSERT_EQ(before.size(), after.size());
    constexpr int kRow = 62, kOpacity = 54, kRotation = 58;
    std::size_t scales = 0, same_scales = 0, logits = 0, same_logits = 0;
    double worst_scale = 0, worst_logit = 0;
    for (std::size_t i = 0; i < before.size(); ++i) {
        const int column = static_cast<int>(i % kRow);
        if (column < kOpacity) {
            ASSERT_EQ(before[i], after[i]) << column; // means, normals, SH
        } else if (column == kOpacity) {
            const double opacity = 1 / (1 + std::exp(-double{before[i]}));
            ++logits;
            same_logits += before[i] == after[i];
            worst_logit =
                std::max(worst_logit, std::abs(double{after[i]} - before[i]) * (1 - opacity));
        } else if (column < kRotation) {
            ++scales;
            same_scales += before[i] == after[i];
            worst_scale = std::max(worst_scale, std::abs(double{after[i]} - before[i]));
        }
    }
    EXPECT_GT(same_scales, 99 * scales / 100);
    EXPECT_GT(same_logits, 75 * logits / 100);
    EXPECT_LT(worst_scale, 1.2e-7); // half a unit in the last place of the linear value
    EXPECT_LT(worst_logit, 2.5e-7);
}

TEST(WrittenGlb, StatesItsBounds) {
    GaussianCloud cloud;
    for (int i = 0; i < 3; ++i) {
        cloud.means.push_back({i, -i, 0.5});
        cloud.scales.push_back({1, 1, 1});
        cloud.rotations.push_back({1, 0, 0, 0});
        cloud.opacities.push_back(0.5F);
        cloud.sh.insert(cloud.sh.end(), {0, 1, 2});
    }
    const test::Folder folder;
    write_glb(cloud, {}, {}, folder.path("scene.glb"));
    const std::string bytes = test::bytes_of(folder.path("scene.glb"));
    const auto json = nlohmann::json::parse(bytes.substr(20, bytes.find("BIN") - 24));
    EXPECT_EQ(json["accessors"][0]["min"], nlohmann::json({0, -2, 0.5}));
    EXPECT_EQ(json["accessors"][0]["max"], nlohmann::json({2, 0, 0.5}));
    EXPECT_EQ(json["asset"]["generator"], "DeGS");
    EXPECT_EQ(json["extensionsUsed"], nlohmann::json({"KHR_gaussian_splatting"}));
    EXPECT_EQ(bytes.size() % 4, 0U);
}

TEST(HostileGlbWriter, SaysWhatItCannotWrite) {
    const test::Folder folder;
    EXPECT_THAT(test::complaint([&] { write_glb({}, {}, {}, folder.path("a.glb")); }),
                test::IsSentenceWith("a GLB needs at least one Gaussian."));
    EXPECT_EQ(folder.entries(), 0U);
}

} // namespace
} // namespace degs
