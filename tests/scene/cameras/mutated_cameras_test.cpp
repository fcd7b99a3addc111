// SPDX-License-Identifier: Apache-2.0
// Camera files with bytes changed at random: each of them is either read or refused in one
// sentence.
#include <cmath>
#include <random>

#include "tests/scene/cameras/camera_builder.hpp"

namespace degs {
namespace {

constexpr int kMutants = 120; ///< of each file

const char* const kJson = R"([{"id": 7, "img_name": "left", "width": 640, "height": 480,
 "position": [1, -2.5, 3e-1], "rotation": [[0, 0, 1], [1, 0, 0], [0, 1, 0]], "fx": 500.25, "fy": 501}])";
const char* const kTransforms = R"({"w": 64, "h": 48, "fl_x": 50.5, "cx": 32.5, "k1": 0.1,
 "applied_transform": [[0,1,0,0],[1,0,0,0],[0,0,-1,0]], "frames": [{"file_path": "a/b.png",
 "transform_matrix": [[0,0,1,1],[1,0,0,2],[0,1,0,3],[0,0,0,1]]}, {"h": 3, "transform_matrix":
 [[0,0,1,1],[1,0,0,2],[0,1,0,3]]}]})";
const char* const kCamerasText = "# list\n1 PINHOLE 64 48 50.5 51 32 24\n2 RADIAL 8 8 5 4 4 0 1\n";
const char* const kImagesText = "1 1 0 0 0 1 2 3 1 a.jpg\n1 2 3\n2 0 1 0 0 1 2 3 2 b.jpg\n\n";

/// Up to three changes: another byte, one byte fewer or more, a piece twice, the end cut off.
std::string mutated(std::string bytes, std::mt19937& random) {
    const auto below = [&random](std::size_t end) {
        return std::uniform_int_distribution<std::size_t>(0, end - 1)(random);
    };
    for (std::size_t changes = 1 + below(3); changes > 0 && !bytes.empty(); --changes) {
        const std::size_t at = below(bytes.size());
        switch (below(5)) {
        case 0:
            bytes[at] = static_cast<char>(below(256));
            break;
        case 1:
            bytes.erase(at, 1 + below(8));
            break;
        case 2:
            bytes.insert(at, 1, "0-9.e[]{},\" \n\xff"[below(14)]);
            break;
        case 3:
            bytes.insert(at, bytes.substr(at, 1 + below(40)));
            break;
        default:
            bytes.resize(at);
        }
    }
    return bytes;
}

/// The cameras of a file that was accepted obey the rules all the same.
void expect_valid(const std::vector<Camera>& cameras) {
    ASSERT_FALSE(cameras.empty());
    for (const Camera& camera : cameras) {
        EXPECT_GE(camera.width, 1);
        EXPECT_LE(camera.height, 65536);
        EXPECT_GT(camera.fx, 0);
        EXPECT_LE(camera.fy, 1e9);
        EXPECT_TRUE(std::isfinite(glm::length(camera.position)));
        EXPECT_NEAR(glm::determinant(camera.camera_to_world), 1, 0.01);
    }
}

/// Writes mutants of one file of a folder; counts those that are read and those that are refused.
void expect_sentences(const test::Folder& folder, const std::string& name,
                      const std::string& path) {
    const std::string good = test::bytes_of(folder.path(name));
    expect_valid(test::read_cameras_of(path));
    std::mt19937 random(1);
    int refused = 0;
    for (int i = 0; i < kMutants; ++i) {
        folder.write(name, mutated(good, random));
        const std::string sentence =
            test::complaint([&] { expect_valid(test::read_cameras_of(path)); });
        if (!sentence.empty()) {
            EXPECT_THAT(sentence, test::IsSentenceWith(": "));
            ++refused;
        }
    }
    EXPECT_GT(refused, kMutants / 3) << name;
    folder.write(name, good);
}

TEST(HostileMutatedCameras, AreReadOrRefusedInASentence) {
    const test::Folder folder;
    expect_sentences(folder, "cameras.json", folder.write("cameras.json", kJson));
    expect_sentences(folder, "t/transforms.json", folder.write("t/transforms.json", kTransforms));
    folder.write("m/cameras.txt", kCamerasText);
    folder.write("m/images.txt", kImagesText);
    expect_sentences(folder, "m/cameras.txt", folder.path("m"));
    expect_sentences(folder, "m/images.txt", folder.path("m"));
    folder.write("b/cameras.bin", test::colmap_cameras({{}, {2, 3, 8, 8, {5, 4, 4, 0, 1}}}));
    folder.write("b/images.bin",
                 test::colmap_images({{}, {2, 2, {0, 1, 0, 0}, {1, 2, 3}, "b.jpg", 3}}));
    expect_sentences(folder, "b/cameras.bin", folder.path("b"));
    expect_sentences(folder, "b/images.bin", folder.path("b"));
}

} // namespace
} // namespace degs
