// SPDX-License-Identifier: Apache-2.0
// What scenes are called beside each other, and that every output of several scenes calls them so.
#include <set>

#include <gmock/gmock.h>

#include "sim/shell/scene_list.hpp"
#include "tests/sim/process/child.hpp"
#include "tests/sim/process/csv_rows.hpp"

namespace degs::sim_test {
namespace {

using Words = std::vector<std::string>;

Words labels_of(const Words& scenes) {
    return degs::sim::scene_labels(scenes);
}

TEST(SceneLabels, AreNamesWhereTheseDiffer) {
    EXPECT_EQ(labels_of({"a/vase.ply", "synthetic:object,seed=2", "a/scene.ply"}),
              (Words{"vase", "object", "a"}));
    EXPECT_EQ(labels_of({"x/garden/point_cloud/iteration_7/point_cloud.ply"}), Words{"garden"});
    EXPECT_EQ(labels_of({}), Words{});
}

TEST(SceneLabels, TakeTheFolderThatDiffers) {
    EXPECT_EQ(labels_of({"cup/splat.ply", "vase/splat.ply", "b/c.ply"}),
              (Words{"cup/splat", "vase/splat", "c"}));
    EXPECT_EQ(labels_of({"cup/out/splat.ply", "./vase/out/splat.ply"}),
              (Words{"cup/splat", "vase/splat"}));
    EXPECT_EQ(labels_of({"a/x/s.ply", "a/y/s.ply", "b/x/s.ply"}),
              (Words{"a/x/s", "a/y/s", "b/x/s"}));
    EXPECT_EQ(labels_of({"g/point_cloud/iteration_7/point_cloud.ply",
                         "g/point_cloud/iteration_30/point_cloud.ply"}),
              (Words{"g/iteration_7", "g/iteration_30"}));
    EXPECT_EQ(labels_of({"a/vase.ply", "a/vase.spz"}), (Words{"vase.ply", "vase.spz"}));
    EXPECT_EQ(labels_of({"a/object.ply", "synthetic:object"}),
              (Words{"a/object", "synthetic/object"}));
}

TEST(SceneLabels, TakeTheSettingsThatDiffer) {
    EXPECT_EQ(labels_of({"synthetic:object,gaussians=300,seed=2",
                         "synthetic:object,gaussians=900,seed=2", "synthetic:dense"}),
              (Words{"object gaussians=300", "object gaussians=900", "dense"}));
    EXPECT_EQ(labels_of({"synthetic:object", "synthetic:object,seed=2"}),
              (Words{"object", "object seed=2"}));
    EXPECT_EQ(labels_of({"a/s.ply?axes=rdf", "a/s.ply?axes=ruf"}),
              (Words{"s axes=rdf", "s axes=ruf"}));
}

// Words that differ in their spelling alone are called as they were written.
TEST(SceneLabels, AreDifferentForAllWords) {
    const std::vector<Words> all{
        {"a/s.ply", "./a/s.ply"},
        {"synthetic:object,seed=2,gaussians=3", "synthetic:object,gaussians=3,seed=2"},
        {"s.ply", "../s.ply", "/s.ply"},
        {"a/b/s.ply", "a/s.ply", "b/s.ply", "b/a/s.ply", "s.ply"},
        {"synthetic:nothing", "synthetic:object", "a/s.ply?axes=no"}};
    for (const Words& scenes : all) {
        const Words labels = labels_of(scenes);
        EXPECT_EQ((std::set<std::string>{labels.begin(), labels.end()}.size()), scenes.size())
            << testing::PrintToString(labels);
    }
}

/// Two scenes of one name and different sizes, on one small view.
const Words kTwoObjects{"--scene", "synthetic:object,gaussians=300", "--scene",
                        "synthetic:object,gaussians=900"};
const Words kLabels{"object gaussians=300", "object gaussians=900"};

Words scenes_in(const std::string& csv) {
    Words scenes;
    for (const CsvRow& row : rows_by_heading(read_file(csv))) {
        scenes.push_back(row.at("scene"));
    }
    return scenes;
}

Words and_objects(Words words) {
    words.insert(words.end(), kTwoObjects.begin(), kTwoObjects.end());
    return words;
}

TEST(SceneLabels, AreThoseOfACompare) {
    const Folder folder;
    const Outcome outcome =
        degs(and_objects({"compare", config("degs-16"), "--fidelity", "analytic", "--width", "64",
                          "--camera", "0", "--out", folder / "out"}));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(scenes_in(folder / "out/compare.csv"), kLabels);
    const auto json = nlohmann::json::parse(read_file(folder / "out/compare.json"));
    for (std::size_t view = 0; view < 2; ++view) {
        EXPECT_THAT(outcome.out, testing::HasSubstr(kLabels[view] + " · camera 0"));
        EXPECT_EQ(json["views"][view]["scene"], kLabels[view]);
    }
}

TEST(SceneLabels, AreThoseOfASweep) {
    const Folder folder;
    const std::string file = folder / "study.yaml";
    std::ofstream(file) << "study: two\ndesigns: [{include: " << config("degs-16")
                        << ", name: d}]\naxes: {span.count: [4]}\nscenes: "
                           "['synthetic:object,gaussians=300', 'synthetic:object,gaussians=900']\n"
                           "cameras: 0\nwidth: 64\nreference: false\nfidelity: analytic\n";
    const Outcome outcome = degs({"sweep", file, "--out", folder / "out"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(scenes_in(folder / "out/results.csv"), kLabels);
}

TEST(SceneLabels, AreThoseOfAccuracy) {
    const Folder folder;
    const Outcome outcome =
        degs(and_objects({"accuracy", "--single-gaussian", "--numbers", "fp16", "--splats", "10",
                          "--camera", "0", "--out", folder / "out"}));
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    for (const std::string& label : kLabels) {
        EXPECT_THAT(outcome.out, testing::HasSubstr(label));
    }
}

} // namespace
} // namespace degs::sim_test
