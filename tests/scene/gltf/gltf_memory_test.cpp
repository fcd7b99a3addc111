// SPDX-License-Identifier: Apache-2.0
// What a glTF may cost: memory in proportion to its size. Not a Hostile suite, because the address
// sanitizer keeps what has been freed.
#include <algorithm>

#include "tests/scene/gltf/glb_builder.hpp"
#include "tests/scene/reading_cost.hpp"

namespace degs {
namespace {

// Bytes that every reader may keep (docs/scene-formats.md), and the pages of code that a child
// touches first.
constexpr double kBuffers = 8e6;

/// Bytes of memory that reading the file takes.
long bytes_to_read(const std::string& path) {
    const test::ReadingCost cost = test::cost_of_reading([&] { read_gltf(path); });
    EXPECT_TRUE(cost.ended) << path;
    return cost.bytes;
}

GaussianCloud many_gaussians(std::size_t count, int degree) {
    GaussianCloud cloud;
    cloud.sh_degree = degree;
    cloud.means.assign(count, {1, 2, 3});
    cloud.scales.assign(count, {1, 1, 1});
    cloud.rotations.assign(count, {1, 0, 0, 0});
    cloud.opacities.assign(count, 0.5F);
    cloud.sh.assign(count * cloud.sh_coefficients() * 3, 0.25F);
    return cloud;
}

TEST(LongGltfMemory, IsTwiceTheFileOrTheFileAndItsGaussians) {
    for (const int degree : {0, 3}) {
        const test::Folder folder;
        const std::string path = folder.path("scene.glb");
        write_glb(many_gaussians(degree == 0 ? 800000 : 200000, degree), {}, {}, path);
        const auto file = static_cast<double>(std::filesystem::file_size(path));
        ASSERT_GT(file, 40e6);
        const double gaussians = degree == 0 ? 800000.0 * 68 : 200000.0 * 248; // bytes in a cloud
        const auto taken = static_cast<double>(bytes_to_read(path));
        EXPECT_LT(taken, std::max(2 * file, file + gaussians) + kBuffers);
        EXPECT_GT(taken, file); // it measures something
    }
}

/// The costliest values: objects of a few bytes that the library turns into large structures.
TEST(LongGltfMemory, IsBoundedForJsonAlone) {
    for (const char* const list : {"nodes", "materials", "accessors", "meshes", "animations"}) {
        std::string text = "{\"asset\":{\"version\":\"2.0\"},\"" + std::string(list) + "\":[{}";
        for (int i = 0; i < 262000; ++i) {
            text += ",{}";
        }
        const test::Folder folder;
        const std::string path = folder.write("scene.gltf", text + "]}");
        EXPECT_LT(bytes_to_read(path), 1L << 30) << list;
    }
}

} // namespace
} // namespace degs
