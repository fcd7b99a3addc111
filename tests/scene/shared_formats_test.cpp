// SPDX-License-Identifier: Apache-2.0
// Every file of a scene format among the shared scenes loads, with the Gaussians it is known to
// have, or with any number in a folder that is not known here.
#include <algorithm>
#include <map>

#include "scene/scene.hpp"
#include "scene/scene_formats.hpp"
#include "tests/scene/scene_fixture.hpp"

namespace degs {
namespace {

TEST(SharedFormats, AllLoad) {
    DEGS_NEEDS_SCENE("formats");
    const std::map<std::string, std::size_t> sizes{
        {"garden-crop", 138766},  {"skull", 94936},      {"flowers", 210422},
        {"flowers-small", 26895}, {"st-peter", 133618},  {"guitar", 90854},
        {"seal", 101780},         {"fruit-drops", 4721}, {"formats", 4}};
    const std::vector<std::string> extensions = scene_extensions();
    int files = 0;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(test::scenes())) {
        const std::string extension = entry.path().extension().string();
        if (std::find(extensions.begin(), extensions.end(), extension) == extensions.end()) {
            continue;
        }
        ++files;
        const Scene scene = load_scene(entry.path().string());
        const std::string folder = entry.path().parent_path().filename().string();
        const bool single = entry.path().stem() == "spz-in-gltf-basic";
        if (single || sizes.count(folder) != 0) {
            EXPECT_EQ(scene.cloud.size(), single ? 1 : sizes.at(folder)) << entry.path();
        }
        EXPECT_EQ(scene.dropped.total(), 0U) << entry.path();
    }
    EXPECT_GE(files, 19);
}

} // namespace
} // namespace degs
