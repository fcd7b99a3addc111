// SPDX-License-Identifier: Apache-2.0
// Axes whose values are files: degs sweep over technologies and memories.
#include <map>
#include <sstream>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

/// Files of configs/cost lie beside the study, so that its paths are relative.
std::string study_of_files(const Folder& folder, const std::string& axes,
                           const std::string& design = "") {
    for (const char* node : {"28nm", "16nm", "7nm"}) {
        fs::copy_file(fs::path(DEGS_CONFIGS) / "cost" / (std::string(node) + ".yaml"),
                      folder / (std::string(node) + ".yaml"), fs::copy_options::skip_existing);
    }
    const std::string file = folder / "files.yaml";
    std::ofstream(file) << "study: files\ndesigns:\n  - include: " << config("degs-64")
                        << "\n    name: degs-64\n"
                        << design
                        << "scenes: synthetic:object,gaussians=300\nwidth: 64\nreference: false\n"
                        << "axes:\n"
                        << axes;
    return file;
}

nlohmann::json swept(const std::string& file, const std::string& out) {
    const Outcome outcome = degs({"sweep", file, "--out", out});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    return nlohmann::json::parse(read_file(out + "/results.json"));
}

TEST(FileAxes, VaryTheTechnology) {
    const Folder folder;
    const std::string file =
        study_of_files(folder, "  cost.include: [28nm.yaml, 16nm.yaml, 7nm.yaml]\n");
    const nlohmann::json found = swept(file, folder / "o");
    EXPECT_EQ(found["keys"], nlohmann::json{"cost.include"});
    ASSERT_EQ(found["runs"].size(), 3U); // 28 nm is what the design has anyway
    EXPECT_EQ(found["variants"][found["baseline"].get<std::size_t>()]["name"], "degs-64");
    EXPECT_EQ(found["variants"][0]["keys"]["cost.include"], "28nm");
    EXPECT_EQ(found["variants"][2]["name"], "degs-64 cost.include=7nm");
    const nlohmann::json& own = found["runs"][0];
    const nlohmann::json& seven = found["runs"][2];
    EXPECT_EQ(own["cycles"], seven["cycles"]);
    EXPECT_NEAR(seven["area_mm2"].get<double>() / own["area_mm2"].get<double>(), 0.03143, 1e-6);
    EXPECT_LT(seven["energy"]["nj_per_frame"].get<double>(),
              own["energy"]["nj_per_frame"].get<double>());
    // A design that includes the file has the same numbers.
    const Folder other;
    const nlohmann::json included =
        swept(study_of_files(other, "  span.count: [8]\n", "    cost: { include: 7nm.yaml }\n"),
              other / "o");
    ASSERT_EQ(included["runs"].size(), 1U);
    EXPECT_EQ(included["runs"][0]["area_mm2"], seven["area_mm2"]);
    EXPECT_EQ(included["runs"][0]["energy"], seven["energy"]);
    std::istringstream csv(read_file(folder / "o/results.csv"));
    std::string head;
    std::getline(csv, head);
    EXPECT_EQ(head.rfind("point,design,cost.include,", 0), 0U) << head;
    EXPECT_NE(head.find(",area_mm2,"), std::string::npos);
    EXPECT_NE(head.find(",energy.nj_per_frame,"), std::string::npos);
}

TEST(FileAxes, LeaveOtherAxesTheLastWord) {
    const Folder folder;
    const nlohmann::json found =
        swept(study_of_files(folder, "  cost.area_factor: [0.5, 1]\n"
                                     "  node:\n    keys:\n"
                                     "      cost.include: [28nm.yaml, 7nm.yaml]\n"
                                     "      clock_ghz: [1, 1.25]\n"),
              folder / "o");
    ASSERT_EQ(found["runs"].size(), 4U);
    EXPECT_EQ(found["variants"][1]["name"],
              "degs-64 cost.area_factor=0.5 cost.include=7nm clock_ghz=1.25");
    EXPECT_EQ(found["runs"][0]["area_mm2"], found["runs"][1]["area_mm2"]);
    EXPECT_NE(found["runs"][0]["energy"], found["runs"][1]["energy"]);
}

/// PSNR of degs-64 by its variants, in number sets that the study names.
std::map<std::string, double> psnr_of(const std::string& file, const std::string& out) {
    const nlohmann::json found = swept(file, out);
    std::map<std::string, double> psnr;
    for (std::size_t v = 0; v < found["variants"].size(); ++v) {
        psnr[found["variants"][v]["name"]] = found["runs"][v]["image"]["psnr_db"];
    }
    return psnr;
}

// A number file lies beside the study, and what counts is what it says.
TEST(FileAxes, VaryNumberSetsByTheirContent) {
    const Folder folder;
    const auto write = [&folder](const std::string& alpha) {
        fs::create_directories(folder / "numbers");
        std::ofstream(folder / "numbers/coarse.yaml") << "base: paper\nalpha: " << alpha << "\n";
    };
    const std::string file = folder / "study.yaml";
    std::ofstream(file) << "designs:\n  - include: " << config("degs-64")
                        << "\n    name: a\n  - include: " << config("degs-64")
                        << "\n    name: b\n    pipeline: { numbers: numbers/coarse.yaml }\n"
                        << "scenes: synthetic:object,gaussians=300\nwidth: 64\naxes:\n"
                        << "  pipeline.numbers: [paper, numbers/coarse.yaml]\n";
    write("uq0.4");
    const std::string coarse = "a pipeline.numbers=numbers/coarse.yaml";
    const auto first = psnr_of(file, folder / "o");
    EXPECT_LT(first.at(coarse), first.at("a") - 10);
    EXPECT_EQ(first.at(coarse), first.at("b pipeline.numbers=numbers/coarse.yaml"));
    EXPECT_EQ(first.at("a"), first.at("b pipeline.numbers=paper"));
    write("uq0.8"); // kept points of the other content do not count
    const auto second = psnr_of(file, folder / "o");
    EXPECT_GT(second.at(coarse), first.at(coarse) + 10);
    EXPECT_EQ(second.at("a"), first.at("a"));
    write("coarse");
    const Outcome refused = degs({"sweep", file, "--list"});
    EXPECT_EQ(refused.code, 2);
    EXPECT_EQ(refused.err.rfind("degs: " + (folder / "numbers/coarse.yaml") +
                                    ":2: key 'alpha' is 'coarse', but must be ",
                                0),
              0U)
        << refused.err;
}

TEST(HostileFileAxes, EndInASentence) {
    const auto refuses = [](const std::string& axes, const std::string& words) {
        const Folder folder;
        std::ofstream(folder / "odd.yaml") << "nodes_of_the_foundry: 7 nm\n";
        const std::string file = study_of_files(folder, axes);
        expect_mistake(degs({"sweep", file, "--out", folder / "o"}), words);
        EXPECT_FALSE(fs::exists(folder / "o"));
    };
    refuses("  cost.include: [28nm.yaml, 6nm.yaml]\n", "6nm.yaml");
    refuses("  cost.include: [odd.yaml]\n", "odd.yaml:1: ");
    refuses("  cost.include: 1..3 +1\n", "key 'cost.include' needs names of files");
    refuses("  span.count.include: [28nm.yaml]\n", "'span.count' is no section");
    refuses("  technology.include: [28nm.yaml]\n", "key 'technology' is unknown");
    refuses("  cost.include: [28nm.yaml, 28nm.yaml]\n", "twice");
    refuses("  memory:\n    random: 2\n    keys: { cost.include: 1..2 }\n",
            "key 'cost.include' needs names of files");
}

} // namespace
} // namespace degs::sim_test
