// SPDX-License-Identifier: Apache-2.0
// A number format that does not reach far enough for a scene is named.
#include <algorithm>

#include "sim/view/frame_warnings.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

/// One splat of 100 opaque ones is 5e5 scene units wide: r_x lies beyond 131 068 px, the largest
/// value of ue5m15b14.
std::string scene_with_a_giant(const Folder& folder) {
    std::vector<Splat> splats(100);
    for (std::size_t i = 0; i < splats.size(); ++i) {
        splats[i].mean = {0.01F * static_cast<float>(i), 0, 5};
    }
    splats.back().scale = {13, 13, 13};
    write_ply(folder / "giant.ply", splats);
    write_camera(folder / "cameras.json", {0, 0, 0});
    return folder / "giant.ply";
}

Outcome run(const Folder& folder, const std::string& numbers) {
    return degs({"run", config("degs-64-tuned"), "--scene", scene_with_a_giant(folder), "--width",
                 "64", "--set", "pipeline.numbers=" + numbers, "--out", folder / "out"});
}

TEST(SmallRunWarnings, NameTheFormatThatSaturates) {
    const Folder folder;
    const Outcome outcome = run(folder, "tuned");
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    const std::string sentence =
        "Stage radius saturates: 1 of 100 splats (1.00 %) lie beyond 131000, the largest value of "
        "ue5m15b14; ':radius=FORMAT' at the end of pipeline.numbers sets another.";
    EXPECT_NE(outcome.err.find("degs: warning: " + sentence + "\n"), std::string::npos)
        << outcome.err;
    const auto warnings = report_in(folder / "out").at("warnings");
    EXPECT_NE(std::find(warnings.begin(), warnings.end(), sentence), warnings.end()) << warnings;
}

/// The stages that a run without a reference says to saturate.
std::vector<std::string> saturated_in(const std::string& design, const std::string& scene,
                                      const std::vector<std::string>& sets = {}) {
    const Folder folder;
    std::vector<std::string> words{"run",     config(design), "--scene",    scene,
                                   "--width", "64",           "--no-cache", "--no-reference",
                                   "--out",   folder / "out"};
    for (const std::string& set : sets) {
        words.insert(words.end(), {"--set", set});
    }
    const Outcome outcome = degs(words);
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    std::vector<std::string> stages;
    const auto warnings = report_in(folder / "out").at("warnings");
    for (const auto& warning : warnings) {
        std::istringstream text(warning.get<std::string>());
        std::string word, stage, saturates;
        if (text >> word >> stage >> saturates && saturates == "saturates:") {
            EXPECT_NE(warning.get<std::string>().find("':" + stage + "=FORMAT' at the end"),
                      std::string::npos);
            stages.push_back(stage);
        }
    }
    return stages;
}

using Stages = std::vector<std::string>;

// A colour of 100 fits into the record of `tuned`, which ends at 128, and into nothing behind it:
// weights and sums end at 64.
TEST(SmallRunWarnings, NameWhatSaturatesBehindTheRecord) {
    const Folder folder;
    std::vector<Splat> splats(1);
    splats[0].mean = {0, 0, 5};
    splats[0].colour = {(100 - 0.5F) / 0.28209479F, 0, 0};
    write_ply(folder / "bright.ply", splats);
    write_camera(folder / "cameras.json", {0, 0, 0});
    EXPECT_EQ(saturated_in("degs-64-tuned", folder / "bright.ply"), (Stages{"weight", "sum"}));
    EXPECT_EQ(saturated_in("degs-64", folder / "bright.ply"), Stages{});
    EXPECT_EQ(saturated_in("degs-64", folder / "bright.ply", {"pipeline.numbers=fp32:sum=uq6.16"}),
              Stages{"sum"});
    EXPECT_EQ(saturated_in("gscore-64", folder / "bright.ply", {"pipeline.numbers=tuned"}),
              (Stages{"weight", "sum"}));
}

TEST(SmallRunWarnings, NameEveryStageThatSaturates) {
    const std::string scene = "synthetic:object,gaussians=300";
    const std::pair<const char*, const char*> formats[] = {
        {"distance", "q2.12"}, {"edge", "q4.12"}, {"g0", "uq2.13"},
        {"d0", "e4m11b19"},    {"term", "q1.13"}, {"weight", "uq0.2"}};
    for (const auto& [stage, format] : formats) {
        const Stages found =
            saturated_in("degs-64-tuned", scene,
                         {std::string("pipeline.numbers=tuned:") + stage + "=" + format});
        EXPECT_EQ(found, Stages{stage}) << format;
    }
}

TEST(SmallRunWarnings, SayNothingOfOrdinaryScenes) {
    for (const char* design : {"degs-64", "degs-64-tuned", "gbu-64", "orange-o1"}) {
        for (const char* scene : {"synthetic:object,gaussians=900",
                                  "synthetic:needles,gaussians=300", "synthetic:single"}) {
            EXPECT_EQ(saturated_in(design, scene), Stages{}) << design << " " << scene;
        }
    }
}

TEST(NearPlaneWarnings, TellOfTheFrameThatLosesMost) {
    std::vector<FrameWorkload> frames(3);
    const std::uint64_t lost[] = {2, 7, 0};
    for (std::size_t f = 0; f < frames.size(); ++f) {
        frames[f].gaussians = 10;
        frames[f].culled.near = frames[f].culled.near_in_view = lost[f];
    }
    sim::WorstNearPlane worst;
    for (const FrameWorkload& frame : frames) {
        worst.add(frame);
    }
    const std::vector<std::string>& sentences = worst.sentences();
    ASSERT_EQ(sentences.size(), 1U);
    EXPECT_NE(sentences[0].find("removes 7 of 10 Gaussians"), std::string::npos) << sentences[0];
    EXPECT_TRUE(sim::near_plane_warnings(frames[2]).empty());
}

TEST(SmallRunWarnings, SinglePrecisionHasNone) {
    const Folder folder;
    expect_success(run(folder, "fp32"));
    EXPECT_TRUE(report_in(folder / "out").at("warnings").empty());
}

TEST(SmallRunWarnings, OrdinaryScenesHaveNone) {
    const Folder folder;
    for (const char* design : {"degs-64", "degs-64-tuned"}) {
        expect_success(degs({"run", config(design), "--scene", "synthetic:object,gaussians=2000",
                             "--width", "100", "--out", folder / "out"}));
        EXPECT_TRUE(report_in(folder / "out").at("warnings").empty()) << design;
    }
}

TEST(SmallRunWarnings, BufferOfTheBinnerWithoutEffectIsNamed) {
    const auto warned = [](const std::string& entries) {
        const Folder folder;
        const Outcome outcome =
            degs({"run", config("degs-16"), "--scene", "synthetic:object,gaussians=50", "--width",
                  "32", "--set", "binning.entries=" + entries, "--set", "binning.buffer_bytes=4096",
                  "--out", folder / "out"});
        return outcome.err.find("'binning.buffer_bytes' has no effect") != std::string::npos;
    };
    EXPECT_TRUE(warned("stream"));
    EXPECT_FALSE(warned("combined"));
    EXPECT_TRUE(warned("entries"));
}

TEST(SmallRunWarnings, KeysWithoutEffectAreNamed) {
    const Folder folder;
    const std::vector<std::string> unused{"--set", "memory.model=lpddr5", "--set",
                                          "memory.bandwidth_gb_per_s=51.2"};
    const std::string sentence = "--set memory.bandwidth_gb_per_s=51.2: key "
                                 "'memory.bandwidth_gb_per_s' has no effect, because memory.model "
                                 "is lpddr5, which has keys of its own.";
    std::vector<std::string> run{"run",
                                 config("degs-16"),
                                 "--scene",
                                 "synthetic:object,gaussians=50",
                                 "--width",
                                 "32",
                                 "--no-reference",
                                 "--out",
                                 folder / "run"};
    run.insert(run.end(), unused.begin(), unused.end());
    const Outcome outcome = degs(run);
    EXPECT_EQ(outcome.code, 0);
    EXPECT_EQ(outcome.err, "degs: warning: " + sentence + "\n");
    EXPECT_EQ(report_in(folder / "run")["warnings"], nlohmann::json::array({sentence}));

    std::vector<std::string> compare{"compare",         config("degs-16"),
                                     "--scene",         "synthetic:object,gaussians=50",
                                     "--width",         "32",
                                     "--no-reference",  "--out",
                                     folder / "compare"};
    compare.insert(compare.end(), unused.begin(), unused.end());
    EXPECT_NE(degs(compare).err.find("degs: warning: degs-16: " + sentence), std::string::npos);

    const Outcome silent = degs({"config", config("degs-16"), "--set", "memory.model=lpddr5"});
    EXPECT_EQ(silent.err, ""); // the file's bandwidth is that of its own model
}

TEST(HostileMemory, SixteenBanksEndAt3200) {
    expect_mistake(degs({"config", config("degs-16"), "--set", "memory.model=lpddr5", "--set",
                         "memory.lpddr5.timing.bank_mode=16b"}),
                   "must be bg above 3200 MT/s");
}

} // namespace
} // namespace degs::sim_test
