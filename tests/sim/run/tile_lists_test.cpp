// SPDX-License-Identifier: Apache-2.0
// pipeline.tiles through the program, on every accelerator.
#include <map>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using nlohmann::json;

json run_with_tiles(const std::string& design, const std::string& tiles) {
    const Folder folder;
    std::vector<std::string> arguments{
        "run",     config(design), "--scene", "synthetic:object,gaussians=2000",
        "--width", "200",          "--out",   folder / "out"};
    for (const std::string& set :
         {std::string("pipeline.numbers=fp64"), "pipeline.tiles=" + tiles}) {
        arguments.insert(arguments.end(), {"--set", set});
    }
    if (design.rfind("degs", 0) == 0) {
        arguments.insert(arguments.end(), {"--set", "pipeline.span_ends=exact"});
    }
    expect_success(degs(arguments));
    return report_in(folder / "out");
}

class TileLists : public testing::TestWithParam<const char*> {};

// The image is that of the reference renderer with the same lists. Larger boxes list more tiles;
// those of 3 sigma miss fragments of opaque splats, which that of the ellipse does not.
TEST_P(TileLists, AreBlendedAsTheReferenceBlendsThem) {
    std::map<std::string, json> reports;
    for (const char* tiles : {"exact", "tight", "box", "square"}) {
        const json report = run_with_tiles(GetParam(), tiles);
        // ORANGE counts the pixels of its systolic array, which are more than fragments.
        if (std::string(GetParam()) != "orange-o1") {
            EXPECT_EQ(report["slots"]["useful"], report["workload"]["fragments"]);
        }
        const json& psnr = report["image"]["psnr_db"];
        EXPECT_TRUE(psnr == "inf" || psnr > 120) << psnr;
        reports[tiles] = report;
    }
    const auto pairs = [&](const char* tiles) {
        return reports[tiles]["workload"]["tile_pairs"].get<double>();
    };
    const auto fragments = [&](const char* tiles) {
        return reports[tiles]["workload"]["fragments"].get<double>();
    };
    EXPECT_GT(pairs("tight"), pairs("exact"));
    EXPECT_GT(pairs("box"), pairs("exact"));
    EXPECT_GT(pairs("square"), 1.1 * pairs("box"));
    EXPECT_EQ(fragments("tight"), fragments("exact"));
    EXPECT_LT(fragments("box"), fragments("square"));
    EXPECT_LT(fragments("square"), fragments("exact"));
    EXPECT_NE(reports["square"]["timing"]["cycles"], reports["exact"]["timing"]["cycles"]);
}
INSTANTIATE_TEST_SUITE_P(Designs, TileLists,
                         testing::Values("degs-64", "degs-64-tuned", "gscore-64", "gbu-64",
                                         "gcc-64", "orange-o1"));

// An estimate is one of the frame with the lists that the key names.
TEST(TileListNames, HoldForEstimates) {
    const Folder folder;
    const auto entries = [&](const std::string& tiles, const std::string& fidelity,
                             const std::string& file) {
        expect_success(degs({"run", config("degs-64"), "--scene", "synthetic:object,gaussians=500",
                             "--width", "100", "--set", "pipeline.tiles=" + tiles, "--fidelity",
                             fidelity, "--out", folder / "out"}));
        return json::parse(read_file(folder / "out/" + file))["workload"]["tile_pairs"]
            .get<std::uint64_t>();
    };
    for (const char* tiles : {"exact", "square", "box", "tight"}) {
        EXPECT_EQ(entries(tiles, "analytic", "analytic.json"),
                  entries(tiles, "exact", "report.json"))
            << tiles;
    }
}

// The former name of the square is a word of its description, and so it suggests the new one.
TEST(TileListNames, AreFoundByTheirDescriptions) {
    expect_mistake(degs({"run", config("gbu-64"), "--scene", "synthetic:single", "--set",
                         "pipeline.tiles=reference"}),
                   "exact, square, box, tight (did you mean 'square'?)");
}

} // namespace
} // namespace degs::sim_test
