// SPDX-License-Identifier: Apache-2.0
// What a single run warns of is said by whatever starts the same run.
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <random>
#include <set>
#include <sstream>

#include <gmock/gmock.h>

#include "splat/model/lens.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using testing::HasSubstr;
using testing::Not;

/// A study of a changed degs-64 on one small view.
std::string changed_study(const Folder& folder, const std::string& own, const std::string& axes) {
    const std::string file = folder / "study.yaml";
    std::ofstream(file) << "study: s\ndesigns:\n  - include: " << config("degs-64")
                        << "\n    name: d\n"
                        << own << "axes: {" << axes
                        << "}\nscenes: synthetic:single\nwidth: 32\nreference: false\n";
    return file;
}

std::string said_by(const std::string& command, const std::string& study,
                    const std::string& folder) {
    const Outcome outcome = degs({command, study, "--out", folder});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.err;
}

struct Change {
    const char* key;
    const char* section; ///< of the design
    const char* values;  ///< of an axis
    const char* sentence;
};

constexpr Change kChanges[] = {{"packing.bytes", "    packing: {bytes: 64KB}\n", "[8KB, 64KB]",
                                "key 'packing.bytes' is 65536, but has no effect above 8192"},
                               {"pixel_buffer.bytes", "    pixel_buffer: {bytes: 9000}\n",
                                "[8KB, 9000]", "bytes of it have no effect"}};

TEST(StudyWarnings, AreThoseOfSingleRuns) {
    for (const Change& change : kChanges) {
        for (const std::string command : {"sweep", "explore"}) {
            const Folder folder;
            const std::string axis = std::string(change.key) + ": " + change.values;
            EXPECT_THAT(said_by(command, changed_study(folder, "", axis), folder / "axis"),
                        HasSubstr(change.sentence));
            const std::string own = changed_study(folder, change.section, "span.count: [4]");
            EXPECT_THAT(said_by(command, own, folder / "own"), HasSubstr(change.sentence));
        }
    }
}

// The shipped files hold the paper's sizes, whatever of them is of use.
TEST(StudyWarnings, AreNotOfIncludedFiles) {
    const Folder folder;
    const std::string study = changed_study(folder, "", "span.count: [4, 8]");
    EXPECT_THAT(said_by("sweep", study, folder / "out"), Not(HasSubstr("no effect")));
}

/// "key 'x' is 3, but ..." of every warning, without the places.
std::multiset<std::string> warned_of(const std::string& said) {
    std::multiset<std::string> found;
    std::istringstream lines(said);
    for (std::string line; std::getline(lines, line);) {
        const std::size_t key = line.find(": key '");
        if (line.rfind("degs: warning: ", 0) == 0 && key != std::string::npos) {
            found.insert(line.substr(key + 2, line.find(" (", key) - key - 2));
        }
    }
    return found;
}

class StudyOfWarnings : public testing::TestWithParam<unsigned> {};

TEST_P(StudyOfWarnings, SaysWhatTheRunSays) {
    struct Drawn {
        const char* design;
        std::vector<std::array<const char*, 3>> keys; ///< section, key and value
    };
    static const std::vector<Drawn> all{
        {"degs-64",
         {{"packing", "bytes", "65536"},
          {"pixel_buffer", "bytes", "20000"},
          {"pixel_buffer", "readout_pixels", "4000"},
          {"span", "count", "1"},
          {"slicing", "rows_per_cycle", "3"},
          {"binning", "pairs_per_cycle", "4"}}},
        {"gscore-64",
         {{"pixel_buffer", "bytes", "9000"},
          {"pixel_buffer", "readout_pixels", "4000"},
          {"projection", "count", "2"}}},
        {"gbu-64",
         {{"pixel_buffer", "bytes", "40000"},
          {"pixel_buffer", "readout_pixels", "4000"},
          {"sorting", "count", "2"}}},
        {"gcc-64", {{"image_buffer", "readout_pixels", "4000"}, {"colour", "units", "2"}}}};
    std::mt19937 draw(GetParam());
    const Drawn& drawn = all[draw() % all.size()];
    const Folder folder;
    std::map<std::string, std::string> sections;
    std::vector<std::string> run{"run",
                                 config(drawn.design),
                                 "--scene",
                                 "synthetic:single",
                                 "--width",
                                 "32",
                                 "--no-reference",
                                 "--no-cache",
                                 "--out",
                                 folder / "run"};
    for (const auto& [section, key, value] : drawn.keys) {
        if (draw() % 2 == 0) {
            run.insert(run.end(), {"--set", std::string(section) + "." + key + "=" + value});
            std::string& text = sections[section];
            text += (text.empty() ? "" : ", ") + std::string(key) + ": " + value;
        }
    }
    std::ofstream study(folder / "study.yaml");
    study << "study: s\ndesigns:\n  - include: " << config(drawn.design) << "\n    name: d\n";
    for (const auto& [section, keys] : sections) {
        study << "    " << section << ": {" << keys << "}\n";
    }
    study << "axes: {clock_ghz: [1]}\nscenes: synthetic:single\nwidth: 32\nreference: false\n";
    study.close();
    const Outcome single = degs(run);
    EXPECT_EQ(single.code, 0) << single.err;
    EXPECT_EQ(warned_of(single.err),
              warned_of(said_by("sweep", folder / "study.yaml", folder / "sweep")))
        << single.err;
}

INSTANTIATE_TEST_SUITE_P(Random, StudyOfWarnings, testing::Range(0U, 40U));

/// What is said of a design whose cost section includes a file.
Outcome with_costs(const std::string& accelerator, const std::string& costs,
                   const std::vector<std::string>& more = {}) {
    const Folder folder;
    std::ofstream(folder / "costs.yaml") << costs;
    std::ofstream(folder / "design.yaml")
        << "accelerator: " << accelerator << "\ncost: {include: costs.yaml}\n";
    std::vector<std::string> words{"config", folder / "design.yaml"};
    words.insert(words.end(), more.begin(), more.end());
    return degs(words);
}

TEST(CostFiles, AreCheckedInTheRowsOfAllAccelerators) {
    expect_mistake(with_costs("degs", "gbu: {nothing: 1}\n"), "costs.yaml:1");
    expect_mistake(with_costs("gscore", "node: mine\ndegs:\n  projection: {area_mm2: -1}\n"),
                   "costs.yaml:3");
    expect_mistake(with_costs("degs", "orange: 3\n"), "costs.yaml:1");
    expect_mistake(with_costs("gcc", "gscore: {blending: {area_mm2: many}}\n"), "costs.yaml:1");
}

TEST(CostFiles, OfAllAcceleratorsAreTaken) {
    const std::string shipped = read_file(std::string(DEGS_CONFIGS) + "/cost/28nm.yaml");
    for (const std::string accelerator : {"degs", "gscore", "gbu", "gcc", "orange"}) {
        const Outcome outcome = with_costs(accelerator, shipped);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        EXPECT_EQ(outcome.err, "");
    }
    const Outcome outcome = with_costs("degs", "gbu: {blending: {area_mm2: 5, power_w: 0.001}}\n",
                                       {"--set", "cost.leakage_mw_per_mm2=0"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
}

/// What a run says whose camera has these OpenCV or fisheye coefficients.
std::string said_of_lens(const std::string& model, const std::string& coefficients) {
    const Folder folder;
    std::ofstream(folder / "cameras.json")
        << R"([{"id": 0, "img_name": "c", "width": 64, "height": 48, "fx": 60, "fy": 60,)"
        << R"("position": [0, 0, -4], "rotation": [[1, 0, 0], [0, 1, 0], [0, 0, 1]],)"
        << "\"camera_model\": \"" << model << "\", \"distortion\": [" << coefficients << "]}]";
    const Outcome outcome =
        degs({"run", config("degs-16"), "--scene", "synthetic:single", "--camera-file",
              folder / "cameras.json", "--set", "pipeline.rules.projection=unscented",
              "--no-reference", "--no-cache", "--out", folder / "out"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return outcome.err;
}

TEST(LensWarnings, ThePageNamesTheSteepestDirection) {
    const double degrees = std::atan(Lens::kMostSlope) * 180 / 3.141592653589793;
    char words[16];
    std::snprintf(words, sizeof words, "%.2f°", degrees);
    EXPECT_THAT(read_file(std::string(DEGS_CONFIGS) + "/../docs/cameras.md"), HasSubstr(words));
}

TEST(LensWarnings, TellLensesThatShowNextToNothing) {
    const std::string sentence = "degrees from the view axis to the corner of its image";
    EXPECT_THAT(said_of_lens("OPENCV", "1e24, 0, 0, 0"), HasSubstr(sentence));
    EXPECT_THAT(said_of_lens("OPENCV", "0, 1e24, 0, 0"), HasSubstr(sentence));
    EXPECT_THAT(said_of_lens("OPENCV_FISHEYE", "1e9, 0, 0, 0"), HasSubstr(sentence));
    EXPECT_THAT(said_of_lens("OPENCV", "0.3, 0.1, 0, 0"), Not(HasSubstr(sentence)));
    EXPECT_THAT(said_of_lens("OPENCV_FISHEYE", "0.05, 0, 0, 0"), Not(HasSubstr(sentence)));
}

} // namespace
} // namespace degs::sim_test
