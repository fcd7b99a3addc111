// SPDX-License-Identifier: Apache-2.0
// The output of a run: the contract of report.json and the invariants of its numbers.
#include <regex>
#include <set>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using nlohmann::json;

struct ReportedRun {
    json report;
    std::string exr, png, text;
};

ReportedRun reported_run(const std::vector<std::string>& more, const std::string& name = "degs-64",
                         const std::string& scene = "synthetic:object,gaussians=2000",
                         const std::string& width = "200") {
    const Folder folder;
    std::vector<std::string> arguments{"run",     config(name), "--scene", scene,
                                       "--width", width,        "--out",   folder / "out"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const Outcome outcome = degs(arguments);
    expect_success(outcome);
    return {report_in(folder / "out"), read_file(folder / "out/image.exr"),
            read_file(folder / "out/image.png"), outcome.out};
}

json without_host(json report) {
    report.erase("host");
    return report;
}

void expect_keys(const json& section, const std::vector<std::string>& keys) {
    for (const std::string& key : keys) {
        EXPECT_TRUE(section.contains(key)) << key;
    }
}

/// PEs x window, conservation, memory streams: whatever the configuration.
void expect_laws(const json& report) {
    const json& s = report["slots"];
    std::uint64_t sum = 0;
    for (const char* part :
         {"useful", "boundary", "terminated", "conflict", "starved", "blocked", "drain"}) {
        sum += s[part].get<std::uint64_t>();
    }
    const std::uint64_t window =
        s["window_last"].get<std::uint64_t>() - s["window_first"].get<std::uint64_t>() + 1;
    EXPECT_EQ(sum, s["total"]);
    EXPECT_EQ(s["pes"].get<std::uint64_t>() * window, s["total"]);
    EXPECT_EQ(report["timing"]["blending_cycles"], window);
    EXPECT_EQ(s["hazards"], 0);
    EXPECT_LE(s["window_last"], report["timing"]["cycles"]);
    EXPECT_LE(report["timing"]["preprocessing_cycles"], s["window_first"]);
    EXPECT_GE(report["conservation"].size(), 5U);
    for (const json& law : report["conservation"]) {
        EXPECT_EQ(law["left"], law["right"]) << law;
        EXPECT_GT(law["left"], 0) << law;
    }
    std::uint64_t read = 0;
    std::uint64_t written = 0;
    for (const json& stream : report["dram"]["streams"]) {
        read += stream["bytes_read"].get<std::uint64_t>();
        written += stream["bytes_written"].get<std::uint64_t>();
        EXPECT_GT(stream["requests"], 0);
    }
    EXPECT_EQ(report["dram"]["bytes_read"], read);
    EXPECT_EQ(report["dram"]["bytes_written"], written);
    for (const json& stage : report["stages"]) {
        if (stage.is_object()) {
            EXPECT_GT(stage["busy"], 0) << stage;
            EXPECT_LE(stage["busy"], 1) << stage;
        }
    }
}

TEST(SmallRunReport, HasEveryKeyOfTheContract) {
    const json report = reported_run({}).report;
    expect_keys(report,
                {"tool", "schema", "scene", "camera", "config", "workload", "timing", "stages",
                 "slots", "dram", "buffers", "energy", "area", "image", "host", "warnings"});
    EXPECT_EQ(report["schema"]["version"], 1);
    expect_keys(report["workload"], {"gaussians", "visible", "tile_pairs", "fragments", "culled",
                                     "dropped", "projection"});
    expect_keys(report["timing"], {"cycles", "latency_ms", "fps", "clock_ghz", "blending_cycles",
                                   "preprocessing_cycles", "frames", "throughput_fps"});
    expect_keys(report["slots"], {"total", "useful", "boundary", "terminated", "conflict",
                                  "starved", "blocked", "drain", "utilization", "frame_utilization",
                                  "window_first", "window_last", "hazards"});
    expect_keys(report["stages"], {"projection", "sorting", "fetching", "slicing", "span",
                                   "packing", "blending", "limited_by", "memory_bound"});
    expect_keys(report["dram"],
                {"bytes_read", "bytes_written", "utilization", "row_hit_rate", "streams"});
    for (const char* buffer : {"gaussian_buffer", "span_buffer", "packing_buffer"}) {
        expect_keys(report["buffers"][buffer],
                    {"bytes", "depth", "high_water", "mean_fill", "full_cycles", "empty_cycles"});
        EXPECT_LE(report["buffers"][buffer]["high_water"], report["buffers"][buffer]["depth"]);
    }
    expect_keys(report["buffers"], {"feature_buffer", "pixel_buffer", "crossbar"});
    expect_keys(report["image"], {"psnr_db", "ssim", "max_abs_error"});
    expect_keys(report["host"],
                {"load_s", "workload_s", "sim_s", "render_s", "wall_s", "fragments_per_s",
                 "peak_rss_bytes", "sim_over_render", "activations", "start_s"});
    expect_keys(report["energy"], {"covers", "total_nj", "dynamic_nj", "leakage_nj", "dram_nj",
                                   "nj_per_frame", "nj_per_pixel", "average_power_w", "blocks"});
    EXPECT_NEAR(report["area"]["mm2"], 2.72, 1e-9); // paper, Table I
}

/// Adds the names of all keys below `value`.
void collect_keys(const json& value, std::set<std::string>& keys) {
    for (const auto& [key, child] : value.items()) {
        if (value.is_object()) {
            keys.insert(key);
        }
        if (child.is_structured()) {
            collect_keys(child, keys);
        }
    }
}

/// The page of the report and the pages that it leads to: counters of a block stand on its own.
std::string pages_of_the_report() {
    const fs::path docs = fs::path(DEGS_CONFIGS).parent_path() / "docs";
    std::string pages = read_file(docs / "report.md");
    const std::string first = pages;
    const std::regex link("\\(([a-z-]+\\.md)[#)]");
    for (std::sregex_iterator at(first.begin(), first.end(), link), end; at != end; ++at) {
        pages += read_file(docs / (*at)[1].str());
    }
    return pages;
}

TEST(SmallRunReport, IsDocumentedKeyByKey) {
    json report = reported_run({}).report;
    report["config"] = json::object(); // `degs config` documents these
    std::set<std::string> keys;
    collect_keys(report, keys);
    EXPECT_GT(keys.size(), 100U);
    const std::string page = pages_of_the_report();
    for (const std::string& key : keys) {
        const std::regex word("\\b" + key + "\\b");
        EXPECT_TRUE(std::regex_search(page, word))
            << key << " is not in docs/report.md or a page that it leads to";
    }
}

TEST(SmallRunReport, DerivedNumbersFollowFromTheCounters) {
    const json report = reported_run({"--set", "clock_ghz=2"}).report;
    const auto cycles = report["timing"]["cycles"].get<double>();
    const auto useful = report["slots"]["useful"].get<double>();
    EXPECT_DOUBLE_EQ(report["timing"]["latency_ms"], cycles / 2e6);
    EXPECT_NEAR(report["timing"]["fps"].get<double>() * cycles / 2e9, 1.0, 1e-12);
    EXPECT_DOUBLE_EQ(report["slots"]["utilization"],
                     useful / report["slots"]["total"].get<double>());
    EXPECT_DOUBLE_EQ(report["slots"]["frame_utilization"], useful / (64 * cycles));
    const json& w = report["workload"];
    std::uint64_t accounted = w["visible"];
    for (const json& culled : w["culled"]) {
        accounted += culled.get<std::uint64_t>();
    }
    EXPECT_EQ(accounted, w["gaussians"]);
    EXPECT_EQ(report["config"]["clock_ghz"], 2);
    EXPECT_EQ(report["config"]["accelerator"], "degs");
}

class SmallRunLaws : public ::testing::TestWithParam<const char*> {};

TEST_P(SmallRunLaws, Hold) {
    expect_laws(reported_run({"--no-reference"}, GetParam()).report);
}

INSTANTIATE_TEST_SUITE_P(Configs, SmallRunLaws,
                         ::testing::Values("degs-16", "degs-64", "degs-64-tuned", "degs-256",
                                           "degs-1024"));

// Exact ends make no boundary tasks, double precision flips no threshold: what the PEs blend is
// what the reference blends, pixel by pixel.
TEST(SmallRunReport, DoublePrecisionCountsAndPaintsLikeTheReference) {
    for (const char* scene : {"synthetic:object,gaussians=2000", "synthetic:needles,gaussians=300",
                              "synthetic:dense,gaussians=2000"}) {
        const json report =
            reported_run({"--set", "pipeline.numbers=fp64", "--set", "pipeline.span_ends=exact"},
                         "degs-64", scene)
                .report;
        EXPECT_EQ(report["slots"]["useful"], report["workload"]["fragments"]) << scene;
        const json& psnr = report["image"]["psnr_db"];
        EXPECT_TRUE(psnr == "inf" || psnr > 120) << psnr;
    }
}

// ORANGE's PEs are multipliers, of which a fragment takes the depth of the product of matrices: the
// six coefficients of the exponent, a polynomial of second degree.
TEST(SmallRunReport, FragmentsOfOrangeTakeSixMultiplications) {
    const json report = reported_run({"--set", "pipeline.numbers=fp64"}, "orange-o1",
                                     "synthetic:needles,gaussians=300")
                            .report;
    EXPECT_EQ(report["slots"]["useful"].get<double>(),
              6 * report["workload"]["fragments"].get<double>());
    const std::string page = read_file(std::string(DEGS_CONFIGS) + "/../docs/report.md");
    EXPECT_NE(page.find("`useful` is six times"), std::string::npos);
}

TEST(SmallRunReport, ExactAndStrictAgreeToTheByte) {
    for (const char* name : {"degs-64", "degs-64-tuned"}) {
        const ReportedRun exact = reported_run({}, name);
        const ReportedRun strict = reported_run({"--fidelity", "strict"}, name);
        EXPECT_EQ(without_host(exact.report), without_host(strict.report)) << name;
        EXPECT_EQ(exact.exr, strict.exr) << name;
        EXPECT_EQ(exact.png, strict.png) << name;
        EXPECT_EQ(strict.report["host"]["fidelity"], "strict");
    }
}

TEST(SmallRunReport, TwoRunsAgreeToTheByte) {
    const ReportedRun first = reported_run({});
    const ReportedRun second = reported_run({});
    EXPECT_EQ(without_host(first.report).dump(), without_host(second.report).dump());
    EXPECT_EQ(first.exr, second.exr);
    EXPECT_EQ(first.png, second.png);
    EXPECT_NE(first.exr, reported_run({}, "degs-64", "synthetic:object,gaussians=2000,seed=2").exr);
}

TEST(SmallRunReport, WithoutReferenceItsNumbersAreNull) {
    const json with = reported_run({}).report;
    const json without = reported_run({"--no-reference"}).report;
    EXPECT_TRUE(without["workload"]["fragments"].is_null());
    EXPECT_TRUE(without["workload"]["fragments_per_splat"].is_null());
    EXPECT_TRUE(without["image"]["psnr_db"].is_null());
    EXPECT_TRUE(without["host"]["render_s"].is_null());
    EXPECT_TRUE(without["host"]["sim_over_render"].is_null());
    EXPECT_GT(with["workload"]["fragments"], 0);
    EXPECT_DOUBLE_EQ(with["workload"]["fragments_per_splat"].get<double>(),
                     with["workload"]["fragments"].get<double>() /
                         with["workload"]["visible"].get<double>());
    EXPECT_EQ(with["slots"], without["slots"]);
}

// docs/gaussian-slicing-unit.md: an outward end adds a pixel on rows that end beside the tile.
TEST(SmallRunReport, RowsOfTheTileChangeTheImageOfOutwardEndsAlone) {
    const auto image_of = [](const std::string& ends, const std::string& rows) {
        return reported_run({"--set", "pipeline.numbers=fp32", "--set",
                             "pipeline.span_ends=" + ends, "--set", "slicing.rows=" + rows});
    };
    EXPECT_EQ(image_of("exact", "tile").exr, image_of("exact", "splat").exr);
    const ReportedRun tile = image_of("outward", "tile");
    const ReportedRun splat = image_of("outward", "splat");
    EXPECT_NE(tile.exr, splat.exr);
    EXPECT_GT(tile.report["image"]["psnr_db"], splat.report["image"]["psnr_db"]);
    EXPECT_LT(tile.report["slots"]["boundary"], splat.report["slots"]["boundary"]);
}

TEST(SmallRunTerminal, SummaryAndExplanation) {
    const std::string text = reported_run({"--explain"}).text;
    for (const char* line : {"scene ", "design ", "frame ", "slots ", "stages ", "memory ",
                             "image ", "host ", "limited by: ", "culled", "tiles list no splat"}) {
        EXPECT_NE(text.find(line), std::string::npos) << line << "\n" << text;
    }
    EXPECT_EQ(text.find("SystemC 2"), std::string::npos) << "the kernel's banner";
    EXPECT_EQ(reported_run({}).text.find("left out"), std::string::npos);
}

TEST(SmallRunTerminal, TheExplanationOfLpddr5DoesNotContradictTheReport) {
    const ReportedRun run = reported_run({"--explain", "--set", "memory.model=lpddr5"});
    EXPECT_FALSE(run.report["dram"]["row_hit_rate"].is_null());
    EXPECT_FALSE(run.report["dram"]["energy_nj"].is_null());
    EXPECT_EQ(run.text.find("no row hit rate"), std::string::npos) << run.text;
    EXPECT_EQ(run.text.find("Energy is not reported"), std::string::npos) << run.text;
    EXPECT_NE(run.text.find("The memory is LPDDR5"), std::string::npos) << run.text;
    EXPECT_NE(run.text.find("\nenergy  "), std::string::npos) << run.text;
}

TEST(TrainedScene, DoublePrecisionCountsLikeTheReference) {
    const fs::path scene = trained_scenes() / "flowers-small" / "scene.ply";
    if (!fs::exists(scene)) {
        GTEST_SKIP() << "There is no trained scene " << scene << "; set DEGS_SCENES to their "
                     << "folder.";
    }
    const json report = reported_run({"--camera", "1", "--set", "pipeline.numbers=fp64"},
                                     "degs-64-tuned", scene.string(), "1280")
                            .report;
    expect_laws(report);
    EXPECT_EQ(report["slots"]["useful"], report["workload"]["fragments"]);
    EXPECT_GT(report["workload"]["fragments"], 1000000);
}

} // namespace
} // namespace degs::sim_test
