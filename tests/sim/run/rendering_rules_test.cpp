// SPDX-License-Identifier: Apache-2.0
// Every accelerator draws by the rules that its configuration names, and its report says so.
#include <algorithm>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using Words = std::vector<std::string>;

const char* const kRuledScene = "synthetic:object,gaussians=3000";

nlohmann::json run_in(const std::string& out, const std::string& design, const Words& rules,
                      const Words& more) {
    Words arguments{"run",      config(design),
                    "--scene",  kRuledScene,
                    "--width",  "160",
                    "--camera", "1",
                    "--out",    out,
                    "--set",    "pipeline.numbers=fp64"};
    for (const std::string& rule : rules) {
        arguments.insert(arguments.end(), {"--set", "pipeline.rules." + rule});
    }
    if (design.rfind("degs", 0) == 0) {
        arguments.insert(arguments.end(), {"--set", "pipeline.span_ends=exact"});
    }
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_success(degs(arguments));
    auto report = report_in(out);
    report.erase("host");
    return report;
}

class RulesOfRun : public ::testing::TestWithParam<const char*> {};

TEST_P(RulesOfRun, ReachImageReferenceAndReport) {
    const Folder folder;
    const std::string design = GetParam();
    const auto image_in = [&folder](const char* name) {
        return read_file(fs::path(folder / name) / "image.exr");
    };
    run_in(folder / "plain", design, {}, {});
    for (const Words& rules :
         {Words{"order=distance"}, Words{"antialiasing=on"}, Words{"low_pass=0.1"}, Words{"cut=4"},
          Words{"preset=khr"},
          Words{"order=distance", "antialiasing=on", "low_pass=0.1", "cut=9"}}) {
        const auto exact = run_in(folder / "exact", design, rules, {});
        const auto strict = run_in(folder / "strict", design, rules, {"--fidelity", "strict"});
        EXPECT_EQ(exact, strict);
        EXPECT_EQ(image_in("exact"), image_in("strict"));
        EXPECT_NE(image_in("exact"), image_in("plain"));
        // The reference is drawn by the same rules.
        const auto& psnr = exact["image"]["psnr_db"];
        EXPECT_TRUE(psnr == "inf" || psnr > 120.0) << psnr;
        EXPECT_EQ(exact["workload"]["fragments"], exact["slots"]["useful"]);
        const auto has = [&rules](const char* rule) {
            return std::find(rules.begin(), rules.end(), rule) != rules.end();
        };
        const bool khr = has("preset=khr");
        EXPECT_EQ(exact["workload"]["order"], khr || has("order=distance") ? "distance" : "depth");
        EXPECT_EQ(exact["workload"]["cut"], has("cut=4") ? 4 : khr || has("cut=9") ? 9 : 12);
        EXPECT_EQ(exact["workload"]["antialiasing"], has("antialiasing=on") ? "on" : "off");
        EXPECT_EQ(exact["workload"]["low_pass"], has("low_pass=0.1") ? 0.1 : 0.3);
    }
}
INSTANTIATE_TEST_SUITE_P(Designs, RulesOfRun,
                         ::testing::Values("degs-16", "gscore-16", "gbu-16", "gcc-16"));

TEST(RulesOfEstimates, SampledAndAnalyticSeeThem) {
    const Folder folder;
    const Words distance{"--set", "pipeline.rules.order=distance", "--set",
                         "pipeline.rules.antialiasing=on"};
    for (const Words& fidelity : {Words{"--fidelity", "analytic"}, Words{"--within", "20%"}}) {
        Words arguments{"run", config("degs-16"), "--scene",   kRuledScene, "--width",
                        "640", "--out",           folder / "o"};
        arguments.insert(arguments.end(), fidelity.begin(), fidelity.end());
        arguments.insert(arguments.end(), distance.begin(), distance.end());
        expect_success(degs(arguments));
        const char* const file = fidelity[1] == "analytic" ? "o/analytic.json" : "o/report.json";
        const auto report = nlohmann::json::parse(read_file(folder / file));
        EXPECT_EQ(report["workload"]["order"], "distance");
        EXPECT_EQ(report["workload"]["antialiasing"], "on");
    }
}

// Designs of one comparison may have rules of their own; each is compared with its own reference.
TEST(RulesOfComparison, EachDesignHasItsReference) {
    const Folder folder;
    const std::string file = config("degs-16");
    const Outcome outcome =
        degs({"compare", "plain=" + file, "far=" + file, "short=" + file, "--scene", kRuledScene,
              "--width", "160", "--set", "pipeline.numbers=fp64", "--set",
              "pipeline.span_ends=exact", "--set", "far:pipeline.rules.order=distance", "--set",
              "short:pipeline.rules.cut=4", "--out", folder / "o"});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    int reports = 0;
    for (const auto& entry : fs::recursive_directory_iterator(folder / "o/reports")) {
        if (entry.is_regular_file()) {
            const auto report = nlohmann::json::parse(read_file(entry.path()));
            const bool far = entry.path().filename() == "2-far.json";
            const bool cut = entry.path().filename() == "3-short.json";
            EXPECT_EQ(report["workload"]["order"], far ? "distance" : "depth");
            EXPECT_EQ(report["workload"]["cut"], cut ? 4 : 12);
            EXPECT_EQ(report["image"]["psnr_db"], "inf");
            EXPECT_EQ(report["workload"]["fragments"], report["slots"]["useful"]);
            ++reports;
        }
    }
    EXPECT_EQ(reports, 3);
}

TEST(RulesOfRender, TheCommandHasThem) {
    const Folder folder;
    const auto image = [&folder](const Words& rules) {
        Words arguments{"render", "--scene", kRuledScene, "--width", "160", "--out", folder / "o"};
        arguments.insert(arguments.end(), rules.begin(), rules.end());
        expect_success(degs(arguments));
        return read_file(folder / "o/image.exr");
    };
    const std::string plain = image({});
    EXPECT_EQ(image({"--order", "depth", "--antialiasing", "scene", "--low-pass", "0.3"}), plain);
    EXPECT_NE(image({"--order", "distance"}), plain);
    EXPECT_NE(image({"--low-pass", "0.1"}), plain);
    EXPECT_NE(image({"--cut", "9"}), plain);
    const std::string khr = image({"--rules", "khr"});
    EXPECT_EQ(image({"--cut", "9", "--order", "distance"}), khr);
    EXPECT_EQ(image({"--cut", "12", "--order", "depth", "--rules", "khr"}), plain);
    EXPECT_EQ(image({"--rules", "inria"}), plain);
    EXPECT_NE(image({"--antialiasing", "on"}), plain);
    const auto report = nlohmann::json::parse(read_file(folder / "o/render.json"));
    EXPECT_EQ(report["workload"]["antialiasing"], "on");
    expect_mistake(degs({"render", "--scene", kRuledScene, "--order", "colour"}), "--order");
}

/// A preset replaces the rules that nothing else names, wherever it stands.
TEST(RulesOfPresets, StartTheOthers) {
    const auto lines = [](const Words& settings) {
        Words arguments{"config", config("degs-16")};
        for (const std::string& setting : settings) {
            arguments.insert(arguments.end(), {"--set", "pipeline.rules." + setting});
        }
        const Outcome outcome = degs(arguments);
        EXPECT_EQ(outcome.code, 0) << outcome.err;
        return outcome.out;
    };
    const auto has = [](const std::string& text, const char* rule) {
        return text.find(std::string("pipeline.rules.") + rule + "\n") != std::string::npos;
    };
    const std::string khr = lines({"preset=khr"});
    EXPECT_TRUE(has(khr, "order = distance"));
    EXPECT_TRUE(has(khr, "cut = 9"));
    EXPECT_TRUE(has(khr, "low_pass = 0.3"));
    const std::string mixed = lines({"order=depth", "preset=khr"});
    EXPECT_TRUE(has(mixed, "order = depth"));
    EXPECT_TRUE(has(mixed, "cut = 9"));
    EXPECT_TRUE(has(lines({}), "cut = 12"));
    EXPECT_EQ(lines({"preset=inria"}), lines({}));
    expect_mistake(degs({"config", config("degs-16"), "--set", "pipeline.rules.preset=gl"}),
                   "preset");
}

/// Number sets, whose PEs know a splat's end by its record: what a run draws is what it says, and
/// the error stays that of the numbers.
TEST(RulesOfNumbers, CutsHoldInEveryNumberSet) {
    const Folder folder;
    for (const std::string numbers : {"fp32", "fp16", "paper", "tuned"}) {
        std::vector<double> psnr;
        for (const char* const cut : {"12", "9"}) {
            const Words arguments{"run",      config("degs-16"),
                                  "--scene",  kRuledScene,
                                  "--width",  "160",
                                  "--camera", "1",
                                  "--set",    "pipeline.numbers=" + numbers,
                                  "--set",    std::string("pipeline.rules.cut=") + cut};
            const auto report = [&](const char* fidelity) {
                Words words = arguments;
                words.insert(words.end(), {"--out", folder / fidelity, "--fidelity", fidelity});
                expect_success(degs(words));
                auto document = report_in(folder / fidelity);
                document.erase("host");
                return document;
            };
            const auto exact = report("exact");
            EXPECT_EQ(exact, report("strict"));
            EXPECT_EQ(read_file(folder / "exact/image.exr"),
                      read_file(folder / "strict/image.exr"));
            psnr.push_back(exact["image"]["psnr_db"]);
        }
        EXPECT_GT(psnr[1], 30) << numbers;
    }
}

// A file that was trained with anti-aliasing is drawn so, unless the configuration overrules it.
TEST(RulesOfFile, DecideByDefault) {
    const Folder folder;
    const std::string plain = folder / "plain.ply";
    expect_success(degs({"scene", "generate", "object", "--gaussians", "2000", "--out", plain}));
    std::string bytes = read_file(plain);
    bytes.insert(bytes.find("element vertex"), "comment antialiased 1\n");
    const std::string flagged = folder / "flagged.ply";
    std::ofstream(flagged, std::ios::binary) << bytes;
    fs::copy_file(folder / "plain.cameras.json", folder / "flagged.cameras.json");
    const auto run = [&folder](const std::string& scene, const Words& more) {
        Words arguments{"run",   config("gscore-16"), "--scene", scene, "--width", "160",
                        "--out", folder / "o"};
        arguments.insert(arguments.end(), more.begin(), more.end());
        expect_success(degs(arguments));
        return read_file(folder / "o/image.exr");
    };
    const Words on{"--set", "pipeline.rules.antialiasing=on"};
    const Words off{"--set", "pipeline.rules.antialiasing=off"};
    const std::string faithful = run(flagged, {});
    EXPECT_TRUE(report_in(folder / "o")["scene"]["antialiased"]);
    EXPECT_EQ(report_in(folder / "o")["workload"]["antialiasing"], "on");
    EXPECT_EQ(run(plain, on), faithful);
    EXPECT_NE(run(plain, {}), faithful);
    const std::string overruled = run(flagged, off);
    EXPECT_EQ(run(plain, {}), overruled);
    EXPECT_FALSE(report_in(folder / "o")["scene"]["antialiased"]);
    const Outcome info = degs({"scene", "info", flagged});
    EXPECT_NE(info.out.find("trained with anti-aliasing"), std::string::npos) << info.out;
}

} // namespace
} // namespace degs::sim_test
