// SPDX-License-Identifier: Apache-2.0
#include "scene/sog/streamed_sog.hpp"

#include "scene/scene.hpp"
#include "scene/scene_formats.hpp"
#include "scene/scene_spec.hpp"
#include "tests/scene/scene_fixture.hpp"
#include "tests/scene/sog/streamed_builder.hpp"

namespace degs {
namespace {

using test::IsSentenceWith;
using test::StreamedBuilder;

/// Part of a bundled scene, as the reader of bundles has it.
struct Slice {
    const test::SogBuilder* made;
    std::size_t begin, end;
};

void expect_slices(const GaussianCloud& cloud, const std::vector<Slice>& slices) {
    std::size_t at = 0;
    for (const Slice& slice : slices) {
        GaussianCloud whole = test::sog_content_of(slice.made->file()).cloud;
        ASSERT_EQ(sanitize(whole).total(), 0U); // load_scene() normalises rotations, too
        ASSERT_LE(whole.sh_degree, cloud.sh_degree);
        for (std::size_t i = slice.begin; i < slice.end; ++i, ++at) {
            ASSERT_LT(at, cloud.size());
            EXPECT_EQ(cloud.means[at], whole.means[i]);
            EXPECT_EQ(cloud.scales[at], whole.scales[i]);
            EXPECT_EQ(cloud.rotations[at], whole.rotations[i]);
            EXPECT_EQ(cloud.opacities[at], whole.opacities[i]);
            const int known = 3 * whole.sh_coefficients();
            for (int k = 0; k < 3 * cloud.sh_coefficients(); ++k) {
                EXPECT_EQ(cloud.sh_of(at)[k], k < known ? whole.sh_of(i)[k] : 0.0F);
            }
        }
    }
    EXPECT_EQ(at, cloud.size());
}

TEST(StreamedSog, TheFinestLevelIsTheBundleOfIt) {
    const StreamedBuilder made;
    const test::Folder folder;
    const std::string index = made.write(folder);
    for (const char* const options : {"", "?lod=0", "?budget=19", "?budget=4294967295"}) {
        const Scene scene = load_scene(index + options);
        EXPECT_EQ(scene.cloud.sh_degree, 2);
        EXPECT_TRUE(scene.traits.antialiased);
        expect_slices(scene.cloud, {{&made.fine, 0, 19}});
        EXPECT_EQ(scene.name, "town");
    }
}

TEST(StreamedSog, LevelsAreChosen) {
    const StreamedBuilder made;
    const test::Folder folder;
    const Scene scene = load_scene(made.write(folder) + "?lod=1");
    EXPECT_EQ(scene.cloud.sh_degree, 1);
    expect_slices(scene.cloud, {{&made.coarse, 0, 8}});
}

TEST(StreamedSog, BudgetsMixLevels) {
    const StreamedBuilder made;
    const test::Folder folder;
    const std::string index = made.write(folder);
    const auto at = [&](const char* budget) { return load_scene(index + "?budget=" + budget); };
    expect_slices(at("18").cloud, {{&made.fine, 12, 19}, {&made.coarse, 0, 3}});
    expect_slices(at("10").cloud, {{&made.fine, 12, 19}, {&made.coarse, 0, 3}});
    expect_slices(at("9").cloud, {{&made.coarse, 0, 8}});
    expect_slices(at("8").cloud, {{&made.coarse, 0, 8}});
    EXPECT_THAT(at("10").notes.at(0), IsSentenceWith("1 at level 0, 1 at level 1"));
    EXPECT_THAT(test::complaint([&] { at("7"); }),
                IsSentenceWith("a budget of 7 Gaussians is too small; allowed are 8 and more"));
}

TEST(StreamedSog, LeavesMayLackLevels) {
    StreamedBuilder made;
    made.leaf(0).erase("1");
    made.leaf(1).erase("0");
    made.index.erase("counts"); // as older writers, with null for no environment
    made.index.erase("version");
    made.index["environment"] = nullptr;
    const test::Folder folder;
    const std::string index = made.write(folder);
    const Scene scene = load_scene(index);
    expect_slices(scene.cloud, {{&made.fine, 0, 12}, {&made.coarse, 3, 8}});
    EXPECT_THAT(scene.notes.at(0), IsSentenceWith("7 Gaussians belong to no leaf"));
    const Scene coarse = load_scene(index + "?lod=1");
    expect_slices(coarse.cloud, {{&made.coarse, 3, 8}});
    EXPECT_THAT(coarse.notes.at(0), IsSentenceWith("1 of the 2 parts of the scene have no"));
}

TEST(StreamedSog, TheEnvironmentIsAlwaysThere) {
    StreamedBuilder made;
    made.index["environment"] = "env/meta.json";
    const test::Folder folder;
    const std::string index = made.write(folder);
    expect_slices(load_scene(index + "?lod=1").cloud,
                  {{&made.coarse, 0, 8}, {&made.environment, 0, 17}});
    expect_slices(load_scene(index + "?budget=25").cloud,
                  {{&made.coarse, 0, 8}, {&made.environment, 0, 17}});
    EXPECT_THAT(test::complaint([&] { load_scene(index + "?budget=24"); }),
                IsSentenceWith("allowed are 25 and more"));
}

TEST(StreamedSog, PartsMayBeArchives) {
    StreamedBuilder made;
    made.index["filenames"] = {"fine.sog", "1_0/meta.json"};
    const test::Folder folder;
    const std::string index = made.write(folder);
    folder.write("town/fine.sog", made.fine.file());
    expect_slices(load_scene(index).cloud, {{&made.fine, 0, 19}});
}

TEST(StreamedSog, OnlyFilesThatAreNeededAreRead) {
    const StreamedBuilder made;
    const test::Folder folder;
    const std::string index = made.write(folder);
    EXPECT_EQ(scene_external_files(index, parse_scene_spec(index + "?budget=10").detail).size(),
              16U);
    std::filesystem::remove_all(folder.path("town/0_0"));
    expect_slices(load_scene(index + "?lod=1").cloud, {{&made.coarse, 0, 8}});
    EXPECT_EQ(scene_external_files(index, parse_scene_spec(index + "?lod=1").detail).size(), 8U);
    EXPECT_TRUE(scene_external_files(index).empty());
    EXPECT_THAT(test::complaint([&] { load_scene(index); }),
                IsSentenceWith("'0_0/meta.json', and there is no such file"));
}

TEST(StreamedSog, FoldersStandForTheirIndex) {
    const StreamedBuilder made;
    const test::Folder folder;
    std::filesystem::rename(made.write(folder), folder.path("town/levels.json"));
    expect_slices(load_scene(folder.path("town/levels.json") + "?lod=1").cloud,
                  {{&made.coarse, 0, 8}});
    std::filesystem::rename(folder.path("town/levels.json"), folder.path("town/lod-meta.json"));
    const Scene scene = load_scene(folder.path("town") + "?lod=1");
    EXPECT_EQ(scene.name, "town");
    expect_slices(scene.cloud, {{&made.coarse, 0, 8}});
    expect_slices(load_scene(folder.path("town/0_0")).cloud, {{&made.fine, 0, 19}});
    folder.write("town/frame.sog", made.coarse.file()); // of a sequence
    EXPECT_EQ(parse_scene_spec(folder.path("town")).path, folder.path("town"));
}

std::string refusal(const StreamedBuilder& made, const std::string& options = "") {
    const test::Folder folder;
    const std::string index = made.write(folder);
    folder.write("out/meta.json", made.fine.meta);
    return test::complaint([&] { load_scene(index + options); });
}

TEST(HostileStreamedSog, OptionsAreOfTheScene) {
    const StreamedBuilder made;
    EXPECT_THAT(refusal(made, "?lod=2"), IsSentenceWith("no level of detail 2; allowed are 0, 1"));
    EXPECT_THAT(refusal(made, "?lod=-1"), IsSentenceWith("an integer from 0, the finest, to 99"));
    EXPECT_THAT(refusal(made, "?budget=0"), IsSentenceWith("a number of Gaussians from 1"));
    EXPECT_THAT(refusal(made, "?budget=many"), IsSentenceWith("a number of Gaussians from 1"));
    EXPECT_THAT(refusal(made, "?lod=1,budget=9"), IsSentenceWith("exclude each other"));
    EXPECT_THAT(refusal(made, "?budget=9,lod=1"), IsSentenceWith("exclude each other"));
    const test::Folder folder;
    const std::string bundle = folder.write("a.sog", made.fine.file());
    EXPECT_THAT(test::complaint([&] { load_scene(bundle + "?lod=0"); }),
                IsSentenceWith("a.sog: this scene has no levels of detail; '?lod='"));
    EXPECT_THAT(test::complaint([&] { load_scene(bundle + "?budget=9"); }),
                IsSentenceWith("'?budget=' is for the lod-meta.json"));
}

TEST(HostileStreamedSog, FilesStayInTheFolder) {
    const auto with_file = [](const std::string& name) {
        StreamedBuilder made;
        made.index["filenames"][0] = name;
        return refusal(made);
    };
    EXPECT_THAT(with_file("../out/meta.json"), IsSentenceWith("only files in the folder"));
    EXPECT_THAT(with_file("/etc/hostname"), IsSentenceWith("only files in the folder"));
    EXPECT_THAT(with_file("none.json"), IsSentenceWith("'none.json', and there is no such file"));
    EXPECT_THAT(with_file(std::string("0_0/meta.json\0", 14)), IsSentenceWith("control character"));
    EXPECT_THAT(with_file("lod-meta.json"), IsSentenceWith("one SOG scene is needed"));
    EXPECT_THAT(with_file("0_0/l.webp"), IsSentenceWith("no JSON"));
    EXPECT_EQ(with_file("0_0/../0_0/meta.json"), "");
    StreamedBuilder made;
    made.index["environment"] = "../out/meta.json";
    EXPECT_THAT(refusal(made), IsSentenceWith("its environment lies in '../out/meta.json'; only"));
    made.index["environment"] = "0_0/../0_0/meta.json";
    EXPECT_THAT(refusal(made), IsSentenceWith("more than once"));
    for (const nlohmann::json& none : {nlohmann::json(7), nlohmann::json("")}) {
        made.index["environment"] = none;
        EXPECT_THAT(refusal(made), IsSentenceWith("'environment' that is no name"));
    }
    StreamedBuilder image;
    image.fine.meta.replace(image.fine.meta.find("u.webp"), 6, "../u.w");
    EXPECT_THAT(refusal(image), IsSentenceWith("only files in the folder of the scene"));
}

TEST(HostileStreamedSog, RunsLieInTheirFiles) {
    const auto with_run = [](int offset, int count, const std::string& options) {
        StreamedBuilder made;
        made.index.erase("counts");
        made.leaf(1)["0"] = StreamedBuilder::run(0, offset, count);
        return refusal(made, options);
    };
    EXPECT_EQ(with_run(12, 7, ""), "");
    EXPECT_THAT(with_run(12, 8, ""), IsSentenceWith("names Gaussians 12 to 19 of '0_0/meta.json', "
                                                    "which has 19"));
    EXPECT_THAT(with_run(2000000000, 7, ""), IsSentenceWith("which has 19"));
    EXPECT_THAT(with_run(11, 7, ""), IsSentenceWith("two leaves of its tree name Gaussian 11"));
    EXPECT_EQ(with_run(2000000000, 7, "?lod=1"), ""); // that file is not read
    EXPECT_THAT(with_run(-1, 7, ""), IsSentenceWith("'tree.children[1].lods.0.offset'"));
    EXPECT_THAT(with_run(0, -7, ""), IsSentenceWith("'tree.children[1].lods.0.count'"));
    StreamedBuilder twice;
    twice.index["filenames"] = {"0_0/meta.json", "0_0/./meta.json"};
    twice.leaf(1)["0"] = StreamedBuilder::run(1, 12, 7);
    EXPECT_THAT(refusal(twice), IsSentenceWith("more than once"));
}

TEST(HostileStreamedSog, LiesOfTheIndexAreOneSentence) {
    const auto with = [](const char* key, const nlohmann::json& value) {
        StreamedBuilder made;
        made.index[key] = value;
        return refusal(made);
    };
    EXPECT_THAT(with("version", 2), IsSentenceWith("a 'version' other than 1"));
    EXPECT_THAT(with("counts", {19, 9}), IsSentenceWith("sums of the Gaussians in its leaves"));
    EXPECT_THAT(with("counts", 27), IsSentenceWith("[19,8]"));
    EXPECT_THAT(with("lodLevels", 0), IsSentenceWith("allowed are 1 to 100"));
    EXPECT_THAT(with("lodLevels", 1), IsSentenceWith("has a level '1' in 'tree.children[0].lods'"));
    EXPECT_THAT(with("lodLevels", 4000000000U), IsSentenceWith("up to 100 in 'lodLevels'"));
    EXPECT_THAT(with("filenames", "a"), IsSentenceWith("a list 'filenames'"));
    EXPECT_THAT(with("filenames", {1, 2}), IsSentenceWith("no text"));
    EXPECT_THAT(with("filenames", {"0_0/meta.json"}), IsSentenceWith("names file 1 in 'tree."));
    EXPECT_THAT(with("tree", 1), IsSentenceWith("either 'children' or 'lods' in 'tree'"));
    EXPECT_THAT(with("tree", {{"children", 1}}), IsSentenceWith("a list in 'tree.children'"));
    EXPECT_THAT(with("tree", {{"lods", 1}}), IsSentenceWith("an object in 'tree.lods'"));
    EXPECT_THAT(with("tree", {{"lods", {{"0", 1}}}}), IsSentenceWith("in 'tree.lods.0'"));
    EXPECT_THAT(with("tree", {{"lods", {{"01", 1}}}}), IsSentenceWith("has a level '01'"));
    EXPECT_THAT(with("tree", nlohmann::json::parse(R"({"lods":{}})")),
                IsSentenceWith("without Gaussians"));
    EXPECT_THAT(with("tree", nlohmann::json::parse(R"({"lods":{},"children":[]})")),
                IsSentenceWith("either"));
}

TEST(HostileStreamedSog, DeepAndBrokenIndicesAreRefused) {
    const StreamedBuilder made;
    const test::Folder folder;
    const std::string whole = made.index.dump();
    made.write(folder);
    const auto attempt = [&](const std::string& text) {
        const std::string index = folder.write("town/lod-meta.json", text);
        return test::complaint([&] { load_scene(index); });
    };
    const auto deep = [&](std::size_t nodes) {
        const std::size_t at = whole.find("\"tree\":") + 7;
        const std::size_t end = whole.find(",\"version\"", at);
        std::string text = whole.substr(0, at);
        for (std::size_t i = 0; i < nodes; ++i) {
            text += "{\"children\":[";
        }
        text += whole.substr(at, end - at);
        for (std::size_t i = 0; i < nodes; ++i) {
            text += "]}";
        }
        return text + whole.substr(end);
    };
    EXPECT_EQ(attempt(deep(62)), ""); // and the root and the leaves
    EXPECT_THAT(attempt(deep(63)), IsSentenceWith("deeper than the 64"));
    EXPECT_THAT(attempt(deep(200000)), IsSentenceWith("deeper than the 64"));
    for (std::size_t size = 1; size < whole.size(); size += 7) {
        EXPECT_THAT(attempt(whole.substr(0, size)), IsSentenceWith("lod-meta.json")) << size;
    }
    EXPECT_THAT(attempt("[1]"), IsSentenceWith("not that of a scene file"));
    const std::string list = folder.write("town/lod-meta.json", "[1]");
    EXPECT_THAT(test::complaint([&] { read_streamed_sog(list, {}); }),
                IsSentenceWith("is no object"));
}

} // namespace
} // namespace degs
