// SPDX-License-Identifier: Apache-2.0
#include "scene/scene_spec.hpp"

#include "scene/ply/ply.hpp"
#include "scene/scene.hpp"
#include "scene/synthetic/synthetic.hpp"
#include "tests/scene/scene_fixture.hpp"

namespace degs {
namespace {

using test::complaint;
using test::IsSentenceWith;

TEST(SceneSpecs, HaveOptionsBehindAQuestionMark) {
    const SceneSpec plain = parse_scene_spec("a/b.spz");
    EXPECT_EQ(plain.path, "a/b.spz");
    EXPECT_FALSE(plain.axes);
    EXPECT_FALSE(plain.synthetic);
    const SceneSpec turned = parse_scene_spec("a/what?.spz?axes=RuB");
    EXPECT_EQ(turned.path, "a/what?.spz");
    EXPECT_EQ(turned.axes->name(), "RUB");
    EXPECT_EQ(parse_scene_spec("a/what?.spz").path, "a/what?.spz");
    const SceneSpec made = parse_scene_spec("synthetic:object,seed=2");
    EXPECT_TRUE(made.synthetic);
    EXPECT_EQ(made.path, "synthetic:object,seed=2");
}

TEST(SceneSpecs, SayWhatIsAllowed) {
    const auto mistake = [](const std::string& text) {
        return complaint([&] { parse_scene_spec(text); });
    };
    EXPECT_THAT(mistake("a.ply?axis=rdf"), IsSentenceWith("allowed are axes=VALUE"));
    EXPECT_THAT(mistake("a.ply?axes=rdf,seed"), IsSentenceWith("'seed' is not an option"));
    EXPECT_THAT(mistake("a.ply?axes="), IsSentenceWith("three letters"));
    EXPECT_THAT(mistake("a.ply?axes=xyz"), IsSentenceWith("axes is 'xyz'"));
    EXPECT_THAT(mistake("a.ply?axes=rdf,axes=rub"), IsSentenceWith("repeats"));
    for (const char* const wrong : {"0", "-1", "1.5", "10001", "many", ""}) {
        EXPECT_THAT(mistake(std::string("a.ply?frames=") + wrong),
                    IsSentenceWith("must be an integer from 1 to 10000"));
    }
    EXPECT_THAT(mistake("a.ply?axes=rdf,"), IsSentenceWith("'' is not an option"));
}

TEST(SceneSpecs, FilesOfExactlyThatNameWin) {
    const test::Folder folder;
    const GaussianCloud cloud = make_synthetic({"object", 50, 1}).cloud;
    write_ply(cloud, folder.path("odd.ply"));
    write_ply(cloud, folder.path("odd.ply?axes=lub"));
    const Scene scene = load_scene(folder.path("odd.ply?axes=lub"));
    EXPECT_EQ(glm::vec3(scene.cloud.means[0]), glm::vec3(cloud.means[0]));
    EXPECT_THAT(complaint([&] { load_scene(folder.path("none.ply?axes=lub")); }),
                IsSentenceWith("none.ply: there is no such file"));
}

TEST(SceneSpecs, AxesTurnTheCloudAndKeepTheName) {
    const test::Folder folder;
    const GaussianCloud cloud = make_synthetic({"object", 50, 1}).cloud;
    const std::string file = folder.path("thing.ply");
    write_ply(cloud, file);
    const Scene scene = load_scene(file + "?axes=rub");
    EXPECT_EQ(scene.name, "thing");
    EXPECT_EQ(scene.source, file + "?axes=rub");
    for (std::size_t i = 0; i < cloud.size(); ++i) {
        EXPECT_EQ(glm::vec3(scene.cloud.means[i]),
                  glm::vec3(cloud.means[i] * glm::dvec3(1, -1, -1)));
    }
    EXPECT_EQ(camera_count(file + "?axes=rub"), 1U);
}

TEST(SceneSpecs, GuessedAxesAreSaidUnlessTheUserKnows) {
    DEGS_NEEDS_SCENE("fruit-drops");
    const std::string file = (test::scenes() / "fruit-drops" / "scene-v3.spz").string();
    const Scene guessed = load_scene(file), told = load_scene(file + "?axes=rub");
    ASSERT_EQ(guessed.notes.size(), 1U);
    EXPECT_THAT(guessed.notes[0], IsSentenceWith("RUB was assumed"));
    EXPECT_TRUE(told.notes.empty());
    EXPECT_EQ(told.cloud.means, guessed.cloud.means);
    EXPECT_NE(load_scene(file + "?axes=rdf").cloud.means, guessed.cloud.means);
    EXPECT_EQ(load_scene(file).cameras.size(), 3U);
}

} // namespace
} // namespace degs
