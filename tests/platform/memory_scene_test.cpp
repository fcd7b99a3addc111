// SPDX-License-Identifier: Apache-2.0
// A scene file as the bytes that a platform puts into its memory.
#include <cstring>
#include <iterator>
#include <vector>

#include <gtest/gtest.h>

#include "degs/error.hpp"
#include "degs/scene.hpp"
#include "scene/scene.hpp"
#include "tests/scene/scene_fixture.hpp"

namespace degs::test {
namespace {

float float_at(const std::vector<unsigned char>& bytes, std::size_t index) {
    float value = 0;
    std::memcpy(&value, bytes.data() + 4 * index, sizeof value);
    return value;
}

TEST(MemoryScene, HasTheGaussiansAndViewsOfTheFile) {
    const std::string spec = "synthetic:object,gaussians=50";
    const MemoryScene memory = load_memory_scene(spec);
    const Scene scene = load_scene(spec);
    ASSERT_EQ(memory.gaussians, scene.cloud.size());
    EXPECT_EQ(memory.geometry.size(), 44U * memory.gaussians);
    const std::size_t values = 3U * (memory.sh_degree + 1) * (memory.sh_degree + 1);
    EXPECT_EQ(memory.sh.size(), 4 * values * memory.gaussians);
    EXPECT_EQ(memory.antialiased, scene.traits.antialiased);
    ASSERT_EQ(memory.views.size(), scene.cameras.size());
    for (std::size_t v = 0; v < memory.views.size(); ++v) {
        const Camera& camera = scene.cameras[v];
        EXPECT_EQ(memory.views[v].name, camera.name);
        EXPECT_EQ(memory.views[v].width, camera.width);
        EXPECT_EQ(memory.views[v].height, camera.height);
        EXPECT_EQ(memory.views[v].focal_x, camera.fx);
        EXPECT_EQ(memory.views[v].focal_y, camera.fy);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_EQ(memory.views[v].position[axis], camera.position[axis]);
            for (int i = 0; i < 3; ++i) {
                EXPECT_EQ(memory.views[v].axes[3 * axis + i], camera.camera_to_world[axis][i]);
            }
        }
    }
    for (std::size_t i = 0; i < memory.gaussians; ++i) {
        const float opacity = float_at(memory.geometry, 11 * i + 10);
        EXPECT_GT(opacity, 0) << i;
        EXPECT_LE(opacity, 1) << i;
    }
}

TEST(MemoryScene, HasTheLensesOfItsCameras) {
    const Folder folder;
    const std::string file = folder.write(
        "cameras.json", R"([{"width":64,"height":48,"position":[0,0,-6],"fx":50,"fy":50,)"
                        R"("rotation":[[1,0,0],[0,1,0],[0,0,1]],"camera_model":"FULL_OPENCV",)"
                        R"("distortion":[0.1,0.2,0.3,0.4,0.5,0.6,0.7,0.8,0.9]}])");
    const std::string spec = "synthetic:object,gaussians=50";
    const MemoryScene memory = load_memory_scene(spec, file);
    EXPECT_EQ(memory.notes, load_scene(spec, file).notes);
    const MemoryScene::View& view = memory.views.at(0);
    EXPECT_EQ(view.lens, LensKind::OpenCv);
    const auto list = [](const auto& values) {
        return std::vector<double>(std::begin(values), std::end(values));
    };
    EXPECT_EQ(list(view.radial), (std::vector<double>{0.1, 0.2, 0.5, 0.9}));
    EXPECT_EQ(list(view.denominator), (std::vector<double>{0.6, 0.7, 0.8}));
    EXPECT_EQ(list(view.tangential), (std::vector<double>{0.3, 0.4}));
}

TEST(HostileMemoryScene, AMistakeIsOneSentence) {
    EXPECT_THROW(load_memory_scene("/nowhere/scene.ply"), InputError);
    EXPECT_THROW(load_memory_scene("synthetic:nothing"), InputError);
    EXPECT_THROW(load_memory_scene("synthetic:object,gaussians=50", "/nowhere/cameras.json"),
                 InputError);
}

} // namespace
} // namespace degs::test
