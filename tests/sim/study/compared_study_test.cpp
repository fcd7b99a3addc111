// SPDX-License-Identifier: Apache-2.0
// degs compare follows every key of a study, or refuses it.
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

std::string study_of_two(const Folder& folder, const std::string& lines,
                         const std::string& name = "two") {
    const std::string file = folder / (name + ".yaml");
    std::ofstream(file) << "designs:\n  - include: " << config("degs-16") << "\n    name: a" << name
                        << "\n  - include: " << config("gscore-16") << "\n    name: b" << name
                        << "\n"
                        << lines;
    return file;
}

nlohmann::json compared(const Folder& folder, const std::vector<std::string>& files,
                        const std::vector<std::string>& more = {}) {
    std::vector<std::string> words{"compare"};
    words.insert(words.end(), files.begin(), files.end());
    words.insert(words.end(), more.begin(), more.end());
    words.insert(words.end(), {"--out", folder / "o"});
    const Outcome outcome = degs(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return nlohmann::json::parse(read_file(folder / "o/compare.json"));
}

const char* const kViews = "scenes: synthetic:object,gaussians=300\ncameras: [2, 0]\nwidth: 64\n";

TEST(ComparedStudy, IsRunAsItSays) {
    const Folder folder;
    const nlohmann::json all =
        compared(folder, {study_of_two(folder, std::string(kViews) +
                                                   "array_only: true\nreference: false\nframes: 3\n"
                                                   "path_step: 0.25\n")});
    EXPECT_EQ(all["array_only"], true);
    EXPECT_EQ(all["frames"], 3);
    EXPECT_EQ(all["path_step_degrees"], 0.25);
    ASSERT_EQ(all["views"].size(), 2U);
    EXPECT_EQ(all["views"][0]["camera"], 2);
    EXPECT_EQ(all["views"][0]["width"], 64);
    EXPECT_TRUE(all["views"][0]["fragments"].is_null());
    EXPECT_TRUE(all["runs"][0]["image"]["psnr_db"].is_null());
}

TEST(ComparedStudy, OptionsReplaceItsViews) {
    const Folder folder;
    const std::string file =
        study_of_two(folder, std::string(kViews) + "quick: { cameras: 1, width: 32 }\n");
    const nlohmann::json other =
        compared(folder, {file}, {"--scene", "synthetic:single", "--camera", "0", "--width", "48"});
    ASSERT_EQ(other["views"].size(), 1U);
    EXPECT_EQ(other["views"][0]["scene"], "single");
    EXPECT_EQ(other["views"][0]["width"], 48);
    const nlohmann::json quick = compared(folder, {file}, {"--quick"});
    ASSERT_EQ(quick["views"].size(), 1U);
    EXPECT_EQ(quick["views"][0]["camera"], 1);
    EXPECT_EQ(quick["views"][0]["width"], 32);
}

// A study has the same numbers when it is compared as when it is swept, beside a plain
// configuration, too.
TEST(ComparedStudy, AgreesWithItsSweep) {
    const Folder folder;
    const std::string file =
        study_of_two(folder, std::string(kViews) + "array_only: true\nreference: false\n");
    const nlohmann::json own = compared(folder, {file, "c=" + config("degs-64")});
    ASSERT_EQ(own["runs"].size(), 6U);
    EXPECT_EQ(degs({"sweep", file, "--out", folder / "s"}).code, 0);
    const auto swept = nlohmann::json::parse(read_file(folder / "s/results.json"));
    EXPECT_EQ(own["runs"][0]["cycles"], swept["runs"][0]["cycles"]);
    EXPECT_EQ(own["runs"][4]["slots"]["utilization"], swept["runs"][3]["slots"]["utilization"]);
}

TEST(HostileComparedStudy, Mistakes) {
    const Folder folder;
    const auto refuses = [&folder](const std::vector<std::string>& files,
                                   const std::string& words) {
        std::vector<std::string> all{"compare", "--out", folder / "o"};
        all.insert(all.end(), files.begin(), files.end());
        expect_mistake(degs(all), words);
        EXPECT_FALSE(fs::exists(folder / "o"));
    };
    const std::string one = study_of_two(folder, kViews, "one");
    for (const char* line : {"array_only: true\n", "reference: false\n", "frames: 4\n"}) {
        const std::string key = std::string(line).substr(0, std::string(line).find(':'));
        refuses({one, study_of_two(folder, std::string(kViews) + line, "other")},
                "differ in '" + key + "'");
    }
    refuses({study_of_two(folder, "array_only: true\n")}, "names no scene");
    refuses({config("degs-16")}, "names no scene");
    refuses({one, "--quick"}, "needs a section 'quick'");
    refuses({config("degs-16"), "--scene", "synthetic:single", "--quick"}, "needs a study");
    refuses({study_of_two(folder, std::string(kViews) + "baseline: b\n")}, "'baseline'");
    refuses({study_of_two(folder, std::string(kViews) + "combine: product\n")}, "'combine'");
    refuses({study_of_two(folder, std::string(kViews) + "frames: none\n")}, "'frames'");
    std::ofstream(folder / "named.yaml")
        << "designs: [{include: " << config("degs-16") << ", name: [x]}]\n";
    refuses({folder / "named.yaml"}, "'name' of a design must be a word");
}

// 64^6 points, a product that no number holds, few variants on many views, and one at a time.
TEST(HostileStudySize, IsSaidAtOnce) {
    const Folder folder;
    const std::string file = folder / "large.yaml";
    const auto says = [&](int axes, const std::string& values, const std::string& more,
                          const std::string& words) {
        const char* keys[] = {"projection.count",       "sorting.count",
                              "slicing.rows_per_cycle", "span.cycles_per_row",
                              "scheduler.reuse_cycles", "array.writeback_cycles",
                              "gaussian_buffer.bytes",  "packing.bytes"};
        std::ofstream text(file);
        text << "designs:\n  - include: " << config("degs-64") << "\n    name: a\naxes:\n";
        for (int a = 0; a < axes; ++a) {
            text << "  " << keys[a] << ": " << values << "\n";
        }
        text << "scenes: synthetic:object,gaussians=300\nwidth: 48\n" << more;
        text.close();
        const Outcome outcome = degs({"sweep", file, "--out", folder / "o"}, [] { ::alarm(20); });
        expect_mistake(outcome, words);
    };
    says(6, "1..64 +1", "", "The study has 68 719 476 736 points; at most 100 000 are allowed.");
    says(8, "1..4096 +1", "", "has more than 18 446 744 073 709 551 615 points; at most 100 000");
    says(2, "1..300 +1", "cameras: [0, 1]\n", "has 180 000 points");
}

} // namespace
} // namespace degs::sim_test
