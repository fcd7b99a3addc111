// SPDX-License-Identifier: Apache-2.0
// Real trained scenes, end to end: the program runs them, the report says how right and how busy it
// was. The core suite draws them smaller, which leaves fewer fragments of the same splats; Long*
// takes the resolutions of their cameras.
#include <algorithm>
#include <cmath>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using nlohmann::json;

const std::vector<std::string> kCloseUps{"flowers", "guitar", "seal", "skull", "st-peter"};
const std::vector<std::string> kSmallView{"--width", "360"};

json report_of(const std::string& configuration, const std::string& scene, int camera,
               const std::vector<std::string>& more = {}) {
    const Folder folder;
    std::vector<std::string> arguments{
        "run",      config(configuration),
        "--scene",  (trained_scenes() / scene / "scene.ply").string(),
        "--camera", std::to_string(camera),
        "--out",    folder / "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = degs(arguments);
    EXPECT_EQ(outcome.code, 0) << outcome.err; // a warning may name what has no effect
    return report_in(folder / "out");
}

double utilization(const json& report) {
    return report["slots"]["utilization"].get<double>();
}

double psnr(const json& report) {
    const json& value = report["image"]["psnr_db"];
    return value.is_string() ? INFINITY : value.get<double>(); // "inf": identical
}

#define DEGS_NEEDS(scene)                                                                          \
    if (!fs::exists(trained_scenes() / (scene) / "scene.ply")) {                                   \
        GTEST_SKIP() << "the trained scene " << (scene) << " is not in " << trained_scenes()       \
                     << "; set DEGS_SCENES";                                                       \
    }

// Exact span ends, single precision, the reference's stop rule: at least 90 dB against the double
// reference, and all but 1e-5 of its pixel updates (a threshold may flip).
void expect_reference(const char* design, const std::string& scene, int camera,
                      std::vector<std::string> more) {
    SCOPED_TRACE(scene + ", camera " + std::to_string(camera));
    more.insert(more.end(), {"--set", "pipeline.numbers=fp32"});
    const json report = report_of(design, scene, camera, more);
    EXPECT_GE(psnr(report), 90.0);
    const auto useful = report["slots"]["useful"].get<double>();
    const auto fragments = report["workload"]["fragments"].get<double>();
    EXPECT_LE(std::abs(useful - fragments), 1e-5 * fragments + 1);
    EXPECT_EQ(report["slots"].value("hazards", 0), 0);
}

class Scene : public testing::TestWithParam<std::string> {};
class LongScene : public testing::TestWithParam<std::string> {};

TEST_P(Scene, MatchesTheReference) {
    DEGS_NEEDS(GetParam());
    expect_reference("degs-64-tuned", GetParam(), 2, kSmallView);
}
TEST_P(LongScene, EveryCameraMatchesTheReference) {
    DEGS_NEEDS(GetParam());
    for (int camera = 0; camera < 3; ++camera) {
        expect_reference("degs-64-tuned", GetParam(), camera, {});
    }
}

const auto kAll = testing::Values("flowers", "flowers-small", "fruit-drops", "garden-crop",
                                  "guitar", "seal", "skull", "st-peter");
std::string name_of(const testing::TestParamInfo<std::string>& scene) {
    std::string name = scene.param;
    std::replace(name.begin(), name.end(), '-', '_');
    return name;
}
INSTANTIATE_TEST_SUITE_P(All, Scene, kAll, name_of);
INSTANTIATE_TEST_SUITE_P(All, LongScene, kAll, name_of);

TEST(Scenes, DoublePrecisionUpdatesExactlyTheReferencesPixels) {
    DEGS_NEEDS("flowers");
    for (const char* scene : {"flowers", "st-peter"}) {
        const json report = report_of("degs-64-tuned", scene, 2,
                                      {"--set", "pipeline.numbers=fp64", "--width", "360"});
        EXPECT_EQ(report["slots"]["useful"], report["workload"]["fragments"]) << scene;
    }
}

// Tests every pixel by itself, as a coupled array does: closer than span arithmetic.
TEST(Scenes, GbuMatchesTheReference) {
    DEGS_NEEDS("flowers");
    for (const char* scene : {"flowers", "guitar", "st-peter"}) {
        expect_reference("gbu-64", scene, 2, kSmallView);
    }
}

TEST(LongScenes, GbuMatchesTheReference) {
    DEGS_NEEDS("flowers");
    for (const char* scene : {"flowers", "guitar", "st-peter"}) {
        for (int camera = 1; camera < 3; ++camera) {
            expect_reference("gbu-64", scene, camera, {});
        }
    }
}

// Records of 27 B keep the image; in FP16 their means alone cost 40 dB.
TEST(LongScenes, RoundedRecordsCostWhatTheyLeaveOut) {
    DEGS_NEEDS("flowers");
    const auto rounded = [](const char* scene, const char* records) {
        return psnr(report_of("gscore-64", scene, 2,
                              {"--width", "360", "--set", "pipeline.round_records=true", "--set",
                               std::string("pipeline.records=") + records}));
    };
    for (const char* scene : {"flowers", "seal"}) {
        EXPECT_GE(rounded(scene, "tuned"), 80.0) << scene;
    }
    EXPECT_GE(rounded("flowers", "fp32"), 90.0);
    const double halves = rounded("flowers", "fp16");
    EXPECT_GE(halves, 40.0);
    EXPECT_LE(halves, 50.0);
}

TEST(Scenes, OutwardSpanEndsCostTensOfDecibels) {
    DEGS_NEEDS("flowers");
    const double literal = psnr(
        report_of("degs-64", "flowers", 2, {"--width", "360", "--set", "pipeline.numbers=fp32"}));
    EXPECT_GE(literal, 55.0);
    EXPECT_LE(literal, 80.0);
}

// `paper` has outward ends, too, and coarse formats; `tuned` has neither.
TEST(Scenes, HardwareNumbersOfTheConfigurations) {
    DEGS_NEEDS("flowers");
    const double paper = psnr(report_of("degs-64", "flowers", 2, {"--width", "480"}));
    EXPECT_GE(paper, 55.0);
    EXPECT_LE(paper, 80.0);
    EXPECT_GE(psnr(report_of("degs-64-tuned", "flowers", 2, kSmallView)), 80.0);
}

TEST(LongScenes, TunedArrayIsBusyOnCloseUps) {
    DEGS_NEEDS("skull");
    double logarithms = 0;
    for (const std::string& scene : kCloseUps) {
        logarithms +=
            std::log(utilization(report_of("degs-64-tuned", scene, 2, {"--no-reference"})));
    }
    EXPECT_GE(std::exp(logarithms / static_cast<double>(kCloseUps.size())), 0.88);
}

TEST(Scenes, MorePesFinishEarlierAndIdleMore) {
    DEGS_NEEDS("guitar");
    double last_utilization = 1.0;
    double last_cycles = INFINITY;
    for (const char* configuration : {"degs-16", "degs-64", "degs-256", "degs-1024"}) {
        const json report =
            report_of(configuration, "guitar", 2, {"--no-reference", "--width", "480"});
        EXPECT_LT(utilization(report), last_utilization) << configuration;
        EXPECT_LT(report["timing"]["cycles"].get<double>(), last_cycles) << configuration;
        last_utilization = utilization(report);
        last_cycles = report["timing"]["cycles"].get<double>();
    }
}

TEST(LongScenes, HalvingABufferNeverHelps) {
    DEGS_NEEDS("flowers");
    const json whole = report_of("degs-64", "flowers", 1, {"--no-reference", "--width", "360"});
    for (const char* half : {"gaussian_buffer.bytes=36864", "span_buffer.bytes=1024",
                             "packing.bytes=16384", "feature_buffer.bytes=4096"}) {
        const json less =
            report_of("degs-64", "flowers", 1, {"--no-reference", "--width", "360", "--set", half});
        EXPECT_GE(less["timing"]["cycles"].get<double>(),
                  0.995 * whole["timing"]["cycles"].get<double>())
            << half;
    }
}

TEST(LongScenes, LargestFrameFitsTwoGibibytes) {
    DEGS_NEEDS("skull");
    const json report = report_of("degs-64-tuned", "skull", 2);
    EXPECT_LE(report["host"]["peak_rss_bytes"].get<double>(), 2.0 * 1024 * 1024 * 1024);
}

} // namespace
} // namespace degs::sim_test
