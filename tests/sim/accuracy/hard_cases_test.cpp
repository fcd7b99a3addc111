// SPDX-License-Identifier: Apache-2.0
// The hard cases hold for every number set: all of them at 640x360, and in Long* at 720p and those
// that break at 8K.
#include <algorithm>

#include "sim/accuracy/hard_case_run.hpp"
#include "splat/numbers/number_set.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using sim::HardCaseRequest;
using sim::HardMeasure;
using sim::HardResult;

std::vector<HardResult> run_hard_cases(const std::vector<std::string>& only,
                                       const std::string& resolution) {
    const Folder folder;
    HardCaseRequest request;
    request.only = only;
    request.sets = number_set_names();
    request.resolutions = {resolution};
    return sim::run_hard_cases(request, folder / "");
}

void expect_holds(const std::vector<HardResult>& results) {
    for (const HardResult& result : results) {
        for (const std::string& failure : result.failures()) {
            ADD_FAILURE() << failure;
        }
    }
}

void expect_all_hold(const std::string& resolution) {
    const std::vector<HardResult> results = run_hard_cases({}, resolution);
    ASSERT_EQ(results.size(), 32U);
    expect_holds(results);
    for (const HardResult& result : results) {
        const std::string& id = result.hard->id;
        EXPECT_EQ(result.measures.size(), id == "H28" || id == "H29" ? 0U : 5U) << id;
        for (const HardMeasure& measure : result.measures) {
            EXPECT_GT(measure.pixels, 0U) << id;
        }
    }
}

TEST(HardCases, AllHold) {
    expect_all_hold("640x360");
}

TEST(LongHardCases, AllHoldAt720p) {
    expect_all_hold("720p");
}

TEST(LongHardCases, ThoseThatBreakHoldAt8k) {
    expect_holds(run_hard_cases({"H1", "H3", "H6", "H7", "H24", "H32"}, "8k"));
}

// What is found is what was built: the suite notices a wrong expectation and coarse numbers.
TEST(HardCases, CanFail) {
    const HardCase& near_plane = hard_cases()[4];
    ASSERT_EQ(near_plane.id, "H5");
    HardScene scene = near_plane.make(640, 360).front();
    EXPECT_EQ(scene.culled.near, 2U);
    scene.projection.near_plane = 0.05;
    const FrameWorkload work =
        make_frame_workload(scene.cloud, scene.camera, 32, TileMode::Exact, scene.projection);
    EXPECT_EQ(work.culled.near, 0U);
    HardCaseRequest request;
    request.only = {"H1"};
    request.sets = {"fp32"};
    request.resolutions = {"720p"};
    request.span_ends = "outward"; // draws what fp32's bound allows, but updates more pixels
    const Folder folder;
    const auto results = sim::run_hard_cases(request, folder / "");
    EXPECT_GT(results[0].measures[0].recounted, 0U);
}

TEST(HardCases, CommandWritesItsTable) {
    const Folder folder;
    const Outcome outcome = degs({"accuracy", "--hard-cases", "--only", "H5,H16,H28", "--numbers",
                                  "fp32,tuned", "--out", folder / "out"});
    expect_success(outcome);
    const std::string table = read_file(folder / "out/hard_cases.md");
    EXPECT_NE(table.find("| H5 |"), std::string::npos) << table;
    const auto cases = nlohmann::json::parse(read_file(folder / "out/hard_cases.json"));
    ASSERT_EQ(cases.size(), 3U);
    EXPECT_EQ(cases[0]["holds"], true);
    EXPECT_EQ(cases[0]["measures"].size(), 2U);
    EXPECT_EQ(cases[1]["holds"], true);
    EXPECT_EQ(cases[1]["measures"].size(), 2U);
    EXPECT_EQ(cases[2]["holds"], true);
}

} // namespace
} // namespace degs::sim_test
