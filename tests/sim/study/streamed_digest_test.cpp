// SPDX-License-Identifier: Apache-2.0
// The key of a cached scene follows from every file that loading it would read.
#include "scene/scene_formats.hpp"
#include "sim/cache/digest.hpp"
#include "tests/scene/sog/streamed_builder.hpp"

namespace degs::sim_test {
namespace {

namespace fs = std::filesystem;

std::string digest_of(const std::string& scene) {
    sim::Digest digest;
    digest.add_scene(scene);
    return digest.text();
}

/// How many of the files below `folder` change the digest of `scene` with a space behind their end.
std::size_t files_that_count(const fs::path& folder, const std::string& scene) {
    std::size_t changes = 0;
    for (const fs::directory_entry& file : fs::recursive_directory_iterator(folder)) {
        if (file.is_regular_file()) {
            const std::string before = digest_of(scene);
            std::ofstream(file.path(), std::ios::binary | std::ios::app) << " ";
            changes += digest_of(scene) == before ? 0 : 1;
        }
    }
    return changes;
}

TEST(StudyDigest, DependsOnTheFilesOfAStreamedScene) {
    test::StreamedBuilder made;
    made.index["environment"] = "env/meta.json";
    const test::Folder folder;
    const std::string index = made.write(folder);
    const std::size_t part = 8; // meta.json and seven images
    EXPECT_EQ(files_that_count(folder.path("town"), index), 1 + 2 * part); // level 0 and beyond it
    EXPECT_EQ(files_that_count(folder.path("town"), index + "?lod=1"), 1 + 2 * part);
    EXPECT_EQ(files_that_count(folder.path("town"), index + "?budget=30"), 1 + 3 * part);
    EXPECT_EQ(files_that_count(folder.path("town"), folder.path("town")), 1 + 2 * part);
    EXPECT_EQ(files_that_count(folder.path("town"), folder.path("town/env")), part);
    EXPECT_NE(digest_of(index), digest_of(index + "?lod=1"));
}

} // namespace
} // namespace degs::sim_test
