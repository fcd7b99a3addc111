// SPDX-License-Identifier: Apache-2.0
// Parts of studies by hand: draws, options of views, shards, keys of points and tables.
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "sim/study/study_options.hpp"
#include "sim/sweep/design_space.hpp"
#include "sim/sweep/sweep_results.hpp"
#include "sim/sweep/sweep_session.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim {
namespace {

using testing::ElementsAre;
using testing::EndsWith;

std::string drawn_at(double position, const std::string& type) {
    AxisValue value{"a test", "", {}, Draw{{1, "", false}, {4, "", false}, false, position}};
    return value_text(value, {"span.count", type, "1", "", "Units that solve spans"});
}

// Every integer from 1 to 4 has a quarter of the positions.
TEST(Draws, OfIntegersReachBothEnds) {
    std::vector<std::string> found;
    for (const double position : {0.0, 0.24, 0.26, 0.49, 0.51, 0.74, 0.76, 0.9999}) {
        found.push_back(drawn_at(position, "integer"));
    }
    EXPECT_THAT(found, ElementsAre("1", "1", "2", "2", "3", "3", "4", "4"));
    EXPECT_EQ(drawn_at(0.5, "real"), "2.5");
}

// The crop of a study is of images in its own size.
TEST(StudyViews, LoseTheirCropWithTheirSize) {
    StudyViews views;
    views.crop = "8,8,16x16";
    ViewOptions options;
    options.cameras = "1";
    replace_views(options, views);
    EXPECT_EQ(views.crop, "8,8,16x16");
    options.width = 320;
    replace_views(options, views);
    EXPECT_EQ(views.crop, "");
    options.crop = "0,0,32x32";
    replace_views(options, views);
    EXPECT_EQ(views.crop, "0,0,32x32");
}

TEST(StudyViews, TurnAboutTheNearestOfTheNearPlanes) {
    std::vector<NamedConfig> configs;
    for (const char* near : {"0.3", "0.1", "0.2"}) {
        configs.push_back(
            {near, default_run_config("degs", {std::string("pipeline.rules.near=") + near})});
    }
    EXPECT_DOUBLE_EQ(nearest_plane(configs), 0.1);
}

TEST(Shards, HoldEveryPointOnce) {
    for (const std::size_t points : {0U, 2U, 3U, 10U, 11U}) {
        std::size_t next = 0;
        for (std::size_t k = 1; k <= 3; ++k) {
            const PointRange range = shard_of(points, k, 3);
            EXPECT_EQ(range.begin, next);
            EXPECT_LE(range.end - range.begin, points / 3 + 1);
            EXPECT_GE(range.end - range.begin, points / 3);
            next = range.end;
        }
        EXPECT_EQ(next, points);
    }
}

Study study_with(const sim_test::Folder& folder, const std::string& more) {
    const std::string file = folder / "s.yaml";
    std::ofstream(file) << "designs:\n  - include: " << sim_test::config("degs-16")
                        << "\n    name: a\n  - include: " << sim_test::config("degs-64")
                        << "\n    name: b\nscenes: synthetic:object,gaussians=10\n"
                        << more;
    return read_study(file);
}

// A key stands for everything that decides a result, so whatever changes it changes the key.
TEST(PointKeys, HaveTheSampleAndTheCamera) {
    const sim_test::Folder folder;
    Study study = study_with(folder, "cameras: [0, 1]\nwidth: 64\n");
    study.sampling = SamplingRequest{0.01, 0, "timing.cycles", 1};
    const StudyPlan first = plan_study(study);
    ASSERT_EQ(first.points.size(), 4U);
    EXPECT_NE(first.points[0].key, first.points[1].key); // another design
    EXPECT_NE(first.points[0].key, first.points[2].key); // another camera
    study.sampling->seed = 2;
    EXPECT_NE(first.points[0].key, plan_study(study).points[0].key);
    study.sampling->seed = 1;
    EXPECT_EQ(first.points[0].key, plan_study(study).points[0].key);
}

// The baseline comes first, and what was there before is found behind it.
TEST(DesignSpace, FindsDesignsBehindALateBaseline) {
    const sim_test::Folder folder;
    const Study study = study_with(folder, "axes:\n  span.count: [3, 5]\nwidth: 64\n");
    StudyPlan plan = plan_views(study);
    DesignSpace space(study, plan);
    const DesignSpace::Added first = space.add({0, 0}), second = space.add({1, 1});
    EXPECT_EQ(first.variant, 0U);
    EXPECT_EQ(second.variant, 1U);
    space.add_baseline();
    EXPECT_EQ(plan.baseline, 0U);
    const DesignSpace::Added again = space.add({0, 0});
    EXPECT_FALSE(again.is_new);
    EXPECT_EQ(plan.variants.at(*again.variant).name, first.name);
    EXPECT_EQ(plan.variants.at(*space.add({1, 1}).variant).name, second.name);
}

/// Two designs on one view: the second has no stage "grouping", and its second point has failed.
SweepResults results_by_hand(StudyPlan& plan) {
    plan.name = "made up";
    for (const char* name : {"first", "second"}) {
        plan.variants.push_back({name, name, {}});
        plan.request.configs.push_back({name, default_run_config("degs", {})});
    }
    plan.points = {{0, 0, 0, 0, "a"}, {1, 0, 0, 0, "b"}, {0, 0, 0, 1, "c"}, {1, 0, 0, 1, "d"}};
    SweepResults results;
    results.verdicts.resize(2);
    results.comparison.configs = {{"first", "degs", 64, 32, 2.5}, {"second", "degs", 64, 32, 2.5}};
    results.comparison.views.emplace_back();
    results.comparison.rows.resize(2);
    results.comparison.rows[0].stages = {{"span", 0.5}, {"grouping", 0.25}};
    results.comparison.rows[1].config = 1;
    results.comparison.rows[1].stages = {{"span", 0.75}};
    results.points = {0, 1};
    results.failed = {{3, {kUserError, "It cannot be."}}};
    return results;
}

TEST(SweepTables, CountPointsFromOneAndLeaveMissingStagesEmpty) {
    const sim_test::Folder folder;
    StudyPlan plan;
    const SweepResults results = results_by_hand(plan);
    write_results(plan, results, OutputFolder(folder / "out", sweep_files()));
    std::istringstream csv(sim_test::read_file(folder / "out/results.csv"));
    std::vector<std::string> lines;
    for (std::string line; std::getline(csv, line);) {
        lines.push_back(line);
    }
    ASSERT_EQ(lines.size(), 3U);
    EXPECT_THAT(lines[0], EndsWith(",stages.span.busy,stages.grouping.busy"));
    EXPECT_THAT(lines[1], EndsWith(",0.5,0.25"));
    EXPECT_THAT(lines[2], EndsWith(",0.75,"));
    const auto json = nlohmann::json::parse(sim_test::read_file(folder / "out/results.json"));
    EXPECT_EQ(json["runs"][1]["point"], 2);
    EXPECT_EQ(json["failed"][0]["point"], 4);
    EXPECT_EQ(json["failed"][0]["variant"], 1);
    EXPECT_THAT(results_text(plan, results), testing::HasSubstr("failed: point 4: It cannot be."));
}

} // namespace
} // namespace degs::sim
