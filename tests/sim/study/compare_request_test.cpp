// SPDX-License-Identifier: Apache-2.0
#include "sim/study/compare_request.hpp"

#include <fstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "config/config.hpp"
#include "degs/error.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim {
namespace {

using sim_test::config;
using testing::ElementsAre;
using testing::HasSubstr;

/// The sentence of the InputError that `act` throws.
template <class Act>
std::string mistake(const Act& act) {
    try {
        act();
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

TEST(LoadConfigs, AreCalledLikeTheirFilesOrAsAsked) {
    const auto configs = load_configs({config("degs-16"), "wide=" + config("degs-64")}, {});
    ASSERT_EQ(configs.size(), 2U);
    EXPECT_EQ(configs[0].name, "degs-16");
    EXPECT_EQ(configs[0].config.accelerator().pes(), 16);
    EXPECT_EQ(configs[1].name, "wide");
    EXPECT_EQ(configs[1].config.accelerator().pes(), 64);
}

TEST(LoadConfigs, OverridesAreForAllOrForOne) {
    const auto configs = load_configs({"a=" + config("degs-64"), "b=" + config("degs-64")},
                                      {"clock_ghz=0.5", "b:clock_ghz=2", "a:name=x:y=z"});
    EXPECT_EQ(configs[0].config.accelerator().clock_ghz, 0.5);
    EXPECT_EQ(configs[1].config.accelerator().clock_ghz, 2); // the later one
    EXPECT_EQ(configs[0].config.accelerator().name, "x:y=z");
}

TEST(LoadConfigs, AFileMayHaveAnEqualsSign) {
    const sim_test::Folder folder;
    const std::string file = folder / "a=b.yaml";
    std::ofstream(file) << "include: " << config("degs-64") << "\n";
    EXPECT_EQ(load_configs({file}, {})[0].name, "a=b");
}

TEST(LoadConfigs, AStudyIsAListOfConfigurations) {
    const auto points =
        load_compared({config("studies/bandwidth")}, {"degs-64@51.2:clock_ghz=2"}).configs;
    ASSERT_EQ(points.size(), 9U);
    EXPECT_EQ(points[0].name, "degs-64@204.8");
    EXPECT_EQ(points[2].name, "degs-64@51.2");
    EXPECT_EQ(points[2].config.accelerator().clock_ghz, 2);
    EXPECT_EQ(points[1].config.accelerator().clock_ghz, 1);
}

TEST(HostileLoadConfigs, Studies) {
    const sim_test::Folder folder;
    const std::string file = folder / "study.yaml";
    const auto sentence = [&file](const std::string& yaml) -> std::string {
        std::ofstream(file) << yaml;
        try {
            load_configs({file}, {});
        } catch (const InputError& error) {
            return error.what();
        }
        return "no error";
    };
    const std::string include = "include: " + config("degs-64");
    EXPECT_THAT(sentence("points:\n  - " + include + "\n    clock_ghz: 2\n"), "no error");
    EXPECT_THAT(sentence("points:\n  - clock_ghz: 2\n"), HasSubstr("needs a key 'name'"));
    EXPECT_THAT(sentence("pints: 1\npoints:\n  - name: a\n"), HasSubstr("'pints'"));
    EXPECT_THAT(sentence("points:\n  - name: a\n    nonsense: 1\n"), HasSubstr("nonsense"));
}

TEST(HostileLoadConfigs, Mistakes) {
    const std::string file = config("degs-64");
    const auto load = [](const std::vector<std::string>& words,
                         const std::vector<std::string>& overrides = {}) {
        return mistake([&] { load_configs(words, overrides); });
    };
    EXPECT_THAT(load({file, file}), HasSubstr("Two configurations are called 'degs-64'"));
    EXPECT_THAT(load({file, "degs-64=" + config("degs-16")}), HasSubstr("NAME=FILE"));
    EXPECT_THAT(load({"=" + file}), HasSubstr("empty name"));
    EXPECT_THAT(load({""}), HasSubstr("empty name"));
    EXPECT_THAT(load({file}, {"b:clock_ghz=1"}), HasSubstr("'b'"));
    EXPECT_THROW(load_configs({"absent.yaml"}, {}), InputError);
    EXPECT_THROW(load_configs({file}, {"degs-64:nonsense=1"}), InputError);
    EXPECT_THROW(load_configs({file}, {"nonsense"}), InputError);
}

TEST(ParseCameras, PositionsOrAll) {
    EXPECT_FALSE(parse_cameras("all"));
    EXPECT_THAT(*parse_cameras("0"), ElementsAre(0));
    EXPECT_THAT(*parse_cameras("2,0,11"), ElementsAre(2, 0, 11));
}

TEST(HostileParseCameras, Mistakes) {
    for (const char* text :
         {"", ",", "1,", "-1", "1.5", "one", "1 ", "99999999999", "ALL", "0,all", "cameras.json"}) {
        EXPECT_THAT(mistake([&] { parse_cameras(text); }),
                    HasSubstr("--camera is '" + std::string(text) + "'"));
    }
    EXPECT_THAT(mistake([] { parse_cameras("1,2,1"); }), HasSubstr("Camera 1 is given twice"));
}

TEST(ParseResolutions, AreHeights) {
    const auto sizes = parse_resolutions("1080p,4K");
    ASSERT_EQ(sizes.size(), 2U);
    EXPECT_EQ(sizes[0].height, 1080);
    EXPECT_EQ(sizes[1].height, 2160);
    EXPECT_FALSE(sizes[1].width);
    EXPECT_THAT(mistake([] { parse_resolutions("4k,3k"); }), HasSubstr("'3k'"));
    EXPECT_THAT(mistake([] { parse_resolutions("4k,4K"); }), HasSubstr("twice"));
    EXPECT_THAT(mistake([] { parse_resolutions("8x9,8X9"); }), HasSubstr("twice"));
    EXPECT_EQ(parse_resolutions("8x9,8x10,9x9").size(), 3U);
    EXPECT_THAT(mistake([] { parse_resolutions("4k,"); }), HasSubstr("''"));
}

TEST(HostileCheckScenes, Mistakes) {
    check_scenes({"a", "b"});
    EXPECT_EQ(mistake([] { check_scenes({"a", "b", "a"}); }), "The scene 'a' is given twice.");
    EXPECT_THAT(mistake([] { check_scenes({"a", ""}); }), HasSubstr("empty name"));
}

} // namespace
} // namespace degs::sim
