// SPDX-License-Identifier: Apache-2.0
#include "scene/dynamic_scene.hpp"

#include "scene/ply/ply.hpp"
#include "scene/scene.hpp"
#include "scene/synthetic/synthetic.hpp"
#include "tests/scene/scene_fixture.hpp"

namespace degs {
namespace {

using test::IsSentenceWith;

std::string put_frame(const test::Folder& folder, const std::string& name, std::uint64_t seed) {
    folder.write(name, "");
    write_ply(make_synthetic({"uniform", 20, seed, {}}).cloud, folder.path(name));
    return folder.path(name);
}

TEST(Sequences, AreInNaturalOrder) {
    const test::Folder folder;
    for (const char* name : {"f/a10.ply", "f/a2.ply", "f/a01.ply", "f/b1.ply", "f/a2.txt"}) {
        folder.write(name, "");
    }
    const auto in = [&](const std::string& name) { return folder.path("f/" + name); };
    EXPECT_EQ(sequence_files(in("a*.ply")),
              (std::vector<std::string>{in("a01.ply"), in("a2.ply"), in("a10.ply")}));
    EXPECT_EQ(sequence_files(in("*1*.*y")),
              (std::vector<std::string>{in("a01.ply"), in("a10.ply"), in("b1.ply")}));
    EXPECT_EQ(sequence_files(folder.path("f")).size(), 4U); // scene files alone
    EXPECT_TRUE(sequence_files(in("a2.ply")).empty());
    EXPECT_TRUE(sequence_files(in("absent.ply")).empty());
}

TEST(Sequences, HaveAFramePerFile) {
    const test::Folder folder;
    for (int k = 0; k < 3; ++k) {
        put_frame(folder, "walk/frame_" + std::to_string(k) + ".ply", k + 1);
    }
    folder.write("walk/cameras.json", R"([{"width":9,"height":9,"fx":5,"fy":5,"img_name":"j",
        "position":[0,0,0],"rotation":[[1,0,0],[0,1,0],[0,0,1]]}])");
    for (const char* spec : {"walk/*.ply", "walk", "walk/frame_*.ply?axes=rdf"}) {
        const auto dynamic = open_dynamic_scene(folder.path(spec));
        ASSERT_NE(dynamic, nullptr);
        ASSERT_EQ(dynamic->frames(), 3);
        for (int k = 0; k < 3; ++k) {
            const Scene still = load_scene(folder.path("walk/frame_" + std::to_string(k) + ".ply"));
            EXPECT_EQ(dynamic->frame(k).means, still.cloud.means);
        }
        const Scene scene = load_scene(folder.path(spec));
        EXPECT_EQ(scene.name, "walk");
        EXPECT_EQ(scene.cloud.means, dynamic->frame(0).means);
        EXPECT_EQ(scene.cameras.at(0).name, "j");
        EXPECT_EQ(camera_count(folder.path(spec)), 1U);
    }
    EXPECT_EQ(open_dynamic_scene(folder.path("walk/frame_1.ply")), nullptr);
}

TEST(HostileSequences, EveryMistakeHasItsSentence) {
    const test::Folder folder;
    put_frame(folder, "good.ply", 1);
    folder.write("sub/readme.txt", "x");
    const auto complain = [](const std::string& spec) {
        return test::complaint([&] { load_scene(spec); });
    };
    EXPECT_THAT(complain(folder.path("x*.ply")), IsSentenceWith("no file matches this pattern"));
    EXPECT_THAT(complain(folder.path("none/*.ply")),
                IsSentenceWith("no file matches this pattern"));
    EXPECT_THAT(complain(folder.path("sub")),
                IsSentenceWith("this is a folder without scene files"));
    EXPECT_THAT(complain(folder.path("*.ply") + "?time=0.5"),
                IsSentenceWith("not a function of time"));
    folder.write("good2.ply", "ply\n");
    const auto dynamic = open_dynamic_scene(folder.path("good*.ply"));
    ASSERT_EQ(dynamic->frames(), 2);
    EXPECT_THAT(test::complaint([&] { dynamic->frame(1); }), IsSentenceWith("good2.ply: "));
}

} // namespace
} // namespace degs
