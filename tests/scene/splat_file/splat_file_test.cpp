// SPDX-License-Identifier: Apache-2.0
#include "scene/splat_file/splat_file.hpp"

#include <cmath>
#include <cstring>
#include <random>

#include "scene/scene.hpp"
#include "tests/scene/scene_fixture.hpp"

namespace degs {
namespace {

using test::IsSentenceWith;

std::string splat_record(const std::vector<float>& floats, const std::vector<int>& bytes) {
    std::string record(reinterpret_cast<const char*>(floats.data()), 4 * floats.size());
    for (const int byte : bytes) {
        record += static_cast<char>(byte);
    }
    return record;
}

TEST(SplatFile, DecodesEveryField) {
    const test::Folder folder;
    const std::string one =
        splat_record({1, -2, 3e6F, 0.5F, 1, 2}, {0, 128, 255, 51, 255, 0, 128, 64});
    const SceneContent content = read_splat_file(folder.write("a.splat", one + one));
    const GaussianCloud& cloud = content.cloud;
    ASSERT_EQ(cloud.size(), 2U);
    EXPECT_EQ(cloud.sh_degree, 0);
    EXPECT_EQ(cloud.means[1], glm::dvec3(1, -2, 3e6));
    EXPECT_EQ(cloud.scales[1], glm::vec3(0.5F, 1, 2));
    EXPECT_EQ(cloud.rotations[1], glm::vec4(127 / 128.0F, -1, 0, -0.5F)); // w x y z
    EXPECT_FLOAT_EQ(cloud.opacities[1], 0.2F);
    const double y0 = 0.28209479177387814;
    EXPECT_FLOAT_EQ(cloud.sh_of(1)[0], static_cast<float>(-0.5 / y0));
    EXPECT_FLOAT_EQ(cloud.sh_of(1)[1], static_cast<float>((128 / 255.0 - 0.5) / y0));
    EXPECT_FLOAT_EQ(cloud.sh_of(1)[2], static_cast<float>(0.5 / y0));
    EXPECT_TRUE(content.notes.empty());
}

TEST(SplatFile, ReadsThePublishedFixture) {
    DEGS_NEEDS_SCENE("formats");
    const Scene scene = load_scene((test::scenes() / "formats" / "minimal.splat").string());
    ASSERT_EQ(scene.cloud.size(), 4U);
    EXPECT_EQ(scene.cloud.means[0], glm::dvec3(-1, 0, -1));
    EXPECT_EQ(scene.cloud.scales[3], glm::vec3(0.1F));
    EXPECT_FLOAT_EQ(scene.cloud.opacities[2], 230 / 255.0F);
    EXPECT_EQ(scene.cloud.rotations[0], glm::vec4(0, 0, 0, 1)); // of unit length after loading
}

TEST(HostileSplatFile, OtherBytesAreNoScene) {
    const test::Folder folder;
    const auto mistake = [&](const std::string& bytes) {
        const std::string path = folder.write("bad.splat", bytes);
        return test::complaint([&] { load_scene(path); });
    };
    EXPECT_THAT(mistake("x"), IsSentenceWith("multiple of 32"));
    EXPECT_THAT(mistake(std::string(33, '\0')), IsSentenceWith("33 bytes"));
    EXPECT_THAT(mistake(std::string(3200, '\xff')), IsSentenceWith("0 of 100 records"));
    std::mt19937 random(3);
    std::string noise(32000, '\0');
    for (char& c : noise) {
        c = static_cast<char>(random());
    }
    EXPECT_THAT(mistake(noise), IsSentenceWith("no .splat file"));
}

// Files are read in blocks of 2^15 records. Half of the first block is good, and so is the first
// record of all; the only one of the second block is not.
TEST(HostileSplatFile, RecordsOfEveryBlockAreLookedAt) {
    constexpr std::size_t kBlock = 32768;
    const test::Folder folder;
    std::string bytes;
    for (std::size_t i = 0; i < kBlock / 2; ++i) {
        bytes += splat_record({1, 2, 3, 1, 1, 1}, {0, 0, 0, 255, 255, 128, 128, 128});
    }
    bytes.append((kBlock / 2 + 1) * 32, '\xff');
    const std::string path = folder.write("bad.splat", bytes);
    EXPECT_THAT(test::complaint([&] { read_splat_file(path); }),
                IsSentenceWith("only 16384 of 32769 records"));
}

} // namespace
} // namespace degs
