// SPDX-License-Identifier: Apache-2.0
// Files that stand where a scene was expected.
#include "scene/scene.hpp"
#include "tests/scene/scene_fixture.hpp"

namespace degs {
namespace {

std::string complaint_about(const std::string& name, const std::string& bytes) {
    const test::Folder folder;
    const std::string file = folder.write(name, bytes);
    return test::complaint([&] { load_scene(file); });
}

TEST(StandIn, IsCalledWhatItIs) {
    const std::string pointer =
        "version https://git-lfs.github.com/spec/v1\noid sha256:0\nsize 1\n";
    for (const char* name : {"s.ply", "s.glb", "s.gltf", "s.spz", "s.splat", "meta.json"}) {
        EXPECT_THAT(complaint_about(name, pointer), test::IsSentenceWith("Git LFS")) << name;
        EXPECT_THAT(complaint_about(name, "<!DOCTYPE html><html></html>"),
                    test::IsSentenceWith("page of HTML"))
            << name;
    }
    for (const char* page : {"{\"message\": \"Not Found\", \"status\": 404}", "{}", "{\"a\": ["}) {
        for (const char* name : {"s.ply", "s.glb", "s.splat"}) {
            const std::string words = complaint_about(name, page);
            EXPECT_THAT(words, test::IsSentenceWith("this is JSON text")) << name;
        }
    }
    const std::string lcc = complaint_about("s.lcc", "{\"version\": \"5.0\", \"totalSplats\": 1}");
    EXPECT_THAT(lcc, test::IsSentenceWith("the LCC format"));
}

} // namespace
} // namespace degs
