// SPDX-License-Identifier: Apache-2.0
// A run without a scoreboard says that hazards made its image wrong, and by how much.
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using nlohmann::json;

struct HazardRun {
    json report;
    std::string exr, text, errors;
};

HazardRun run_in_fp64(const std::vector<std::string>& more) {
    const Folder folder;
    std::vector<std::string> arguments{"run",     config("degs-64"),
                                       "--scene", "synthetic:dense,gaussians=2000",
                                       "--width", "120",
                                       "--out",   folder / "out",
                                       "--set",   "pipeline.numbers=fp64",
                                       "--set",   "pipeline.span_ends=exact"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = degs(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err; // a warning stands on stderr
    json report = report_in(folder / "out");
    report.erase("host");
    return {report, read_file(folder / "out/image.exr"), outcome.out, outcome.err};
}

TEST(HazardRuns, SayWhyTheImageIsWrongAndByHowMuch) {
    const HazardRun kept = run_in_fp64({});
    const HazardRun early = run_in_fp64({"--set", "scheduler.scoreboard=false"});
    EXPECT_EQ(kept.report["slots"]["hazards"], 0);
    EXPECT_TRUE(kept.report["image"]["psnr_db"] == "inf" || kept.report["image"]["psnr_db"] > 120);
    EXPECT_EQ(kept.text.find("hazards"), std::string::npos) << kept.text;

    const json& hazards = early.report["slots"]["hazards"];
    EXPECT_GT(hazards, 1000);
    ASSERT_TRUE(early.report["image"]["psnr_db"].is_number());
    EXPECT_LT(early.report["image"]["psnr_db"], 50);
    EXPECT_GT(early.report["image"]["max_abs_error"], 0.05);
    EXPECT_NE(early.text.find("wrong because of"), std::string::npos) << early.text;
    ASSERT_EQ(early.report["warnings"].size(), 1U);
    const std::string warning = early.report["warnings"][0];
    EXPECT_NE(warning.find("scheduler.scoreboard is false"), std::string::npos) << warning;
    EXPECT_NE(early.errors.find(warning), std::string::npos) << early.errors;
}

TEST(HazardRuns, ExactAndStrictAgreeToTheByte) {
    const HazardRun exact = run_in_fp64({"--set", "scheduler.scoreboard=false"});
    const HazardRun strict =
        run_in_fp64({"--set", "scheduler.scoreboard=false", "--fidelity", "strict"});
    EXPECT_EQ(exact.report, strict.report);
    EXPECT_EQ(exact.exr, strict.exr);
}

} // namespace
} // namespace degs::sim_test
