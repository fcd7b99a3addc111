// SPDX-License-Identifier: Apache-2.0
// What a study may say: values, units, ranges, linked keys and samples.
#include <fstream>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "degs/error.hpp"
#include "scene/scene.hpp"
#include "sim/cache/digest.hpp"
#include "sim/sweep/study_plan.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

/// A study of degs-64 with these axes (YAML, indented by two) and other lines.
StudyPlan plan_with(const std::string& axes, const std::string& more = "") {
    const sim_test::Folder folder;
    const std::string file = folder / "s.yaml";
    std::ofstream(file) << "designs:\n  - include: " << sim_test::config("degs-64")
                        << "\n    name: d\nscenes: synthetic:single\n"
                        << (axes.empty() ? "" : "axes:\n") << axes << more;
    return plan_study(read_study(file));
}

/// The values of the first key, of all variants.
std::vector<std::string> values_with(const std::string& axes) {
    std::vector<std::string> values;
    for (const StudyVariant& variant : plan_with(axes).variants) {
        values.push_back(variant.values.at(0));
    }
    return values;
}

std::string mistake_with(const std::string& axes, const std::string& more = "") {
    try {
        plan_with(axes, more);
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

// A set that cannot be built is left out, as other designs that cannot; a word that is none is a
// mistake.
TEST(StudyAxes, NumberSetsMustBeSpelledAsSuch) {
    EXPECT_THAT(values_with("  pipeline.numbers: [paper, \"tuned:alpha=uq1.15\"]\n"),
                ElementsAre("paper", "tuned:alpha=uq1.15"));
    EXPECT_THAT(mistake_with("  pipeline.numbers: [fp32, papr]\n"),
                HasSubstr("s.yaml:6: key 'pipeline.numbers' is 'papr', but must be fp32, fp64, "
                          "ideal, fp16, paper, tuned, or a number file"));
    EXPECT_THAT(mistake_with("  pipeline.numbers: [\"tuned:alpha\"]\n"),
                HasSubstr("key 'pipeline.numbers' is 'tuned:alpha', but must be "));
    const StudyPlan plan = plan_with("  pipeline.numbers: [paper, \"tuned:alpha=q99\"]\n");
    ASSERT_EQ(plan.skipped.size(), 1U);
    EXPECT_THAT(plan.skipped[0].why,
                HasSubstr("s.yaml:6: key 'pipeline.numbers': alpha=q99: key 'alpha' is 'q99', "));
}

TEST(StudyAxes, RangesMultiplyOrAdd) {
    EXPECT_THAT(values_with("  gaussian_buffer.bytes: 18KB..144KB x2\n"),
                ElementsAre("18432", "36864", "73728", "147456"));
    EXPECT_THAT(values_with("  array.writeback_cycles: 2..4 +1\n"), ElementsAre("2", "3", "4"));
    EXPECT_THAT(values_with("  memory.bandwidth_gb_per_s: 102.4..300 +102.4\n"),
                ElementsAre("102.4", "204.8")); // the end need not be met
    EXPECT_THAT(values_with("  memory.bandwidth_gb_per_s: 204.8..205.1 +0.1\n"),
                ElementsAre("204.8", "204.9", "205", "205.1"));
}

// Writers of JSON put every text in quotes, and some writers of YAML do.
TEST(StudyAxes, QuotesChangeNoRange) {
    for (const std::string& range : {std::string("x1/2..x2 x2"), std::string("18KB..144KB x2"),
                                     std::string("20000..24000 +1000")}) {
        const std::vector<std::string> values =
            values_with("  gaussian_buffer.bytes: " + range + "\n");
        EXPECT_GT(values.size(), 2U);
        EXPECT_EQ(values_with("  gaussian_buffer.bytes: '" + range + "'\n"), values);
        EXPECT_EQ(values_with("  gaussian_buffer.bytes: [\"" + range + "\"]\n"), values);
    }
}

TEST(StudyAxes, UnitsAreThoseOfTheKey) {
    EXPECT_THAT(values_with("  gaussian_buffer.bytes: [73728, 36 KB, 18KiB, 1MB, 6144B]\n"),
                ElementsAre("73728", "36864", "18432", "1048576", "6144"));
    EXPECT_THAT(values_with("  memory.bandwidth_gb_per_s: [204.8GB/s, 0.1TB/s, 51200MB/s]\n"),
                ElementsAre("204.8", "100", "51.2"));
    EXPECT_THAT(values_with("  gaussian_buffer.sort_share: [50%, 0.25]\n"),
                testing::Contains("0.25"));
    EXPECT_THAT(values_with("  clock_ghz: [1, 500MHz]\n"), ElementsAre("1", "0.5"));
}

TEST(StudyAxes, FactorsAreOfTheDesign) {
    const auto values = values_with("  gaussian_buffer.bytes: x1/4..x4 x2\n");
    EXPECT_THAT(values, ElementsAre("18432", "36864", "73728", "147456", "294912"));
    const StudyPlan plan = plan_with("  all: { keys: [gaussian_buffer.bytes, packing.bytes], "
                                     "values: [x1, x0.5] }\n");
    EXPECT_THAT(plan.variants.at(1).values, ElementsAre("36864", "16384"));
    EXPECT_EQ(plan.variants[0].name, "d");
    EXPECT_EQ(plan.variants[1].name, "d gaussian_buffer.bytes=36864 packing.bytes=16384");
}

TEST(StudyAxes, LinkedKeysChangeTogether) {
    const StudyPlan plan =
        plan_with("  shape: { keys: { scheduler.banks: [8, 16], array.pes_per_bank: [8, 4] } }\n"
                  "  clock_ghz: [1, 2]\n");
    ASSERT_EQ(plan.variants.size(), 4U);
    EXPECT_THAT(plan.keys, ElementsAre("scheduler.banks", "array.pes_per_bank", "clock_ghz"));
    EXPECT_THAT(plan.variants[1].values, ElementsAre("8", "8", "2")); // the last axis is fastest
    EXPECT_THAT(plan.variants[2].values, ElementsAre("16", "4", "1"));
}

TEST(StudyDigest, DependsOnTheContentOfScenesAndCameras) {
    const sim_test::Folder folder;
    const std::string scene = folder / "scene.ply";
    const auto digest = [&scene] {
        Digest of_scene;
        of_scene.add_scene(scene);
        return of_scene.text();
    };
    const std::string none = digest();
    std::ofstream(scene) << "one";
    const std::string one = digest();
    std::ofstream(scene) << "two"; // of the same size
    const std::string two = digest();
    std::ofstream(folder / "cameras.json") << "[]";
    EXPECT_EQ((std::set<std::string>{none, one, two, digest()}).size(), 4U);
    EXPECT_EQ(digest(), digest());
}

TEST(StudyDigest, DependsOnTheBuffersOfAGltf) {
    const sim_test::Folder folder;
    const std::string scene = folder / "scene.gltf";
    std::ofstream(scene) << R"({"asset":{"version":"2.0"},)"
                         << R"("buffers":[{"byteLength":3,"uri":"data.bin"}]})";
    const auto digest_with = [&](const char* data) {
        std::ofstream(folder / "data.bin") << data;
        Digest of_scene;
        of_scene.add_scene(scene);
        return of_scene.text();
    };
    const std::string one = digest_with("one");
    EXPECT_NE(digest_with("two"), one);
    EXPECT_EQ(digest_with("one"), one);
}

TEST(StudyAxes, SamplesComeFromTheSeed) {
    const auto sample = [](const std::string& seed) {
        return plan_with("  some: { random: 6, seed: " + seed +
                         ", keys: { clock_ghz: 500MHz..2000MHz, packing.bytes: [16KB, 32KB], "
                         "memory.bandwidth_gb_per_s: 25..400 log, array.writeback_cycles: 2..4 } "
                         "}\n");
    };
    const StudyPlan plan = sample("3");
    ASSERT_EQ(plan.variants.size() + plan.skipped.size(), 7U); // the baseline is not among them
    EXPECT_EQ(plan.baseline, 0U);
    EXPECT_EQ(plan.variants[0].name, "d");
    EXPECT_EQ(plan.digest, sample("3").digest);
    EXPECT_NE(plan.digest, sample("4").digest);
    for (const StudyVariant& variant : plan.variants) {
        const double clock = std::stod(variant.values[0]);
        EXPECT_GE(clock, 0.5);
        EXPECT_LE(clock, 2);
        EXPECT_THAT(variant.values[3], testing::AnyOf("2", "3", "4"));
    }
}

TEST(StudyAxes, CoincidingSamplesCountOnce) {
    const StudyPlan plan =
        plan_with("  some: { random: 40, keys: { array.writeback_cycles: 2..4 } }\n");
    EXPECT_EQ(plan.variants.size() + plan.skipped.size(), 3U);
}

TEST(StudyPlans, TheBaselineIsTheUnchangedDesign) {
    const StudyPlan within = plan_with("  clock_ghz: [0.5, 1, 2]\n");
    EXPECT_EQ(within.baseline, 1U);
    EXPECT_EQ(within.variants.size(), 3U);
    const StudyPlan added = plan_with("  clock_ghz: [0.5, 2]\n");
    EXPECT_EQ(added.baseline, 0U);
    EXPECT_THAT(added.variants.at(0).values, ElementsAre("1"));
    EXPECT_EQ(added.points.size(), 3U);
}

TEST(StudyPlans, AxesMayVaryOneAtATime) {
    const StudyPlan plan = plan_with("  clock_ghz: [0.5, 1, 2]\n  packing.bytes: [16KB, 32KB]\n",
                                     "combine: one_at_a_time\n");
    std::vector<std::string> names;
    for (const StudyVariant& variant : plan.variants) {
        names.push_back(variant.name);
    }
    EXPECT_THAT(names,
                ElementsAre("d", "d clock_ghz=0.5", "d clock_ghz=2", "d packing.bytes=16384"));
    EXPECT_EQ(plan.baseline, 0U);
    EXPECT_THAT(plan.variants[3].values, ElementsAre("1", "16384"));
}

TEST(StudyPlans, SkipWhatCannotBeBuilt) {
    const StudyPlan plan = plan_with("  pixel_buffer.bytes: [16KB, 64B]\n");
    EXPECT_EQ(plan.variants.size(), 1U);
    ASSERT_EQ(plan.skipped.size(), 1U);
    EXPECT_THAT(plan.skipped[0].why, HasSubstr("s.yaml:6: key 'pixel_buffer.bytes' is 64"));
    EXPECT_THAT(mistake_with("  pixel_buffer.bytes: [64B, 32B]\n"),
                HasSubstr("No point of the study can be built"));
}

TEST(StudyPlans, ViewsMultiply) {
    const StudyPlan plan = plan_with("  clock_ghz: [1, 2]\n", "cameras: [0]\nresolutions: [720p, "
                                                              "1080p]\n");
    EXPECT_EQ(plan.points.size(), 4U);
    EXPECT_EQ(plan.points[1].variant, 1U);
    EXPECT_EQ(plan.points[2].size, 1U);
    EXPECT_EQ(plan_with("", "cameras: all\n").points.size(), camera_count("synthetic:single"));
}

TEST(HostileStudies, Values) {
    const auto says = [](const std::string& axis, const std::string& words) {
        EXPECT_THAT(mistake_with("  " + axis + "\n"), HasSubstr(words)) << axis;
    };
    says("gaussian_buffer.byts: [1]", "did you mean 'gaussian_buffer.bytes'?");
    says("nonsense: [1]", "s.yaml:6: key 'nonsense' is unknown to the design 'd'");
    says("gaussian_buffer: [1]", "is a section");
    says("gaussian_buffer.bytes: [2GB/s]", "the unit 'GB/s' does not fit key");
    says("gaussian_buffer.bytes: [2parsec]", "its units: B, KB, MB, GB, KiB, MiB, GiB.");
    says("gaussian_buffer.bytes: [0x20]", "unit 'x20'");
    says("gaussian_buffer.bytes: [many]", "must be a number with an optional unit");
    says("gaussian_buffer.bytes: [inf]", "must be a number");
    says("gaussian_buffer.bytes: [x1/0]", "must be a number");
    says("gaussian_buffer.bytes: []", "must be a list of values");
    says("gaussian_buffer.bytes: [[1]]", "must be a list of values");
    says("gaussian_buffer.bytes:", "must be a list of values");
    says("gaussian_buffer.bytes: [72KB, 73728]", "given twice");
    says("scheduler.termination: [never]", "must be one of segment, task, pixel");
    says("scheduler.termination: 1..2 +1", "is no number");
    says("monitor.cancel: [yes]", "must be one of true, false");
}

TEST(HostileStudies, Ranges) {
    const auto says = [](const std::string& range, const std::string& words) {
        EXPECT_THAT(mistake_with("  packing.bytes: " + range + "\n"), HasSubstr(words)) << range;
    };
    says("16KB..256KB", "needs a step");
    says("16KB..256KB 2", "needs a step");
    says("16KB..256KB x", "needs a step");
    says("16KB..256KB +4", "needs a step"); // 4 bytes or 4 KB?
    says("16..256KB x2", "the same unit at both bounds");
    says("256KB..16KB x2", "ends below its beginning");
    says("16KB..256KB x1", "needs a factor above 1");
    says("0KB..256KB x2", "bounds above 0");
    says("16KB..256KB +0KB", "needs a step above 0");
    says("1..1000000 +1", "has more than 4096 values");
    says("1.. +1", "has the bound ''");
    says("1..z +1", "has the bound 'z'");
}

TEST(HostileStudies, Axes) {
    const auto says = [](const std::string& axis, const std::string& words) {
        EXPECT_THAT(mistake_with("  " + axis + "\n"), HasSubstr(words)) << axis;
    };
    says("a: { values: [1] }", "needs 'keys'");
    says("a: { keys: [] , values: [1] }", "has no keys");
    says("a: { keys: [clock_ghz] }", "needs 'values'");
    says("a: { keys: [clock_ghz, clock_ghz], values: [1] }", "twice");
    says("a: { keys: { clock_ghz: [1, 2], name: [a] } }", "as many as each other");
    says("a: { keys: { clock_ghz: [1] }, values: [1] }", "key 'values' is unknown in axis 'a'");
    says("a: { random: 0, keys: { clock_ghz: 1..2 } }", "key 'random' is '0'");
    says("a: { random: 3, seed: -1, keys: { clock_ghz: 1..2 } }", "key 'seed' is '-1'");
    says("a: { random: 3, keys: { clock_ghz: [1, 2] } }", "fewer combinations");
    says("a: { random: 3, keys: { clock_ghz: 0..2 log } }", "above 0 for log");
    says("clock_ghz: [1]\n  b: { keys: [clock_ghz], values: [2] }",
         "two axes, 'clock_ghz' and 'b'");
    EXPECT_THAT(mistake_with("  clock_ghz: 0.0001..0.4 +0.0001\n"
                             "  packing.bytes: 10000..14000 +1\n"),
                HasSubstr("16 004 000 points; at most 100 000 are allowed"));
}

TEST(HostileStudies, Files) {
    const auto says = [](const std::string& line, const std::string& words) {
        EXPECT_THAT(mistake_with("", line + "\n"), HasSubstr(words)) << line;
    };
    says("axis: {}", "did you mean 'axes'?");
    says("axes: [1]", "must be a section");
    says("points: []", "mean the same list");
    says("baseline: e", "The baseline 'e' is none of the study's designs");
    says("cameras: [0, 0]", "given twice");
    says("cameras: 99", "Camera 99 does not exist");
    says("cameras: {a: 1}", "must be a word or a list of words");
    says("resolutions: [3k]", "'3k'");
    says("resolutions: 720p\nwidth: 64", "exclude each other");
    says("combine: sum", "one of product, one_at_a_time");
    says("width: 0", "key 'width' is '0'");
    says("frames: 0", "key 'frames' is '0'");
    says("array_only: maybe", "key 'array_only' is 'maybe'");
    EXPECT_THAT(mistake_with("", ""), "no error");
}

TEST(StudyAxes, ValuesGoByName) {
    EXPECT_THAT(values_with("  scheduler.termination: [segment, pixel]\n"),
                ElementsAre("segment", "pixel"));
    EXPECT_THAT(values_with("  monitor.cancel: [true, false]\n"), ElementsAre("true", "false"));
}

} // namespace
} // namespace degs::sim
