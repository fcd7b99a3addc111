// SPDX-License-Identifier: Apache-2.0
// pipeline.tiles through the program, on every accelerator.
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

// The image is that of the reference renderer with the same lists. Squares list more tiles, and
// they miss fragments of opaque splats.
TEST_P(TileLists, SquaresAreBlendedAsTheReferenceBlendsThem) {
    const json exact = run_with_tiles(GetParam(), "exact");
    const json square = run_with_tiles(GetParam(), "reference");
    for (const json* report : {&exact, &square}) {
        EXPECT_EQ((*report)["slots"]["useful"], (*report)["workload"]["fragments"]);
        const json& psnr = (*report)["image"]["psnr_db"];
        EXPECT_TRUE(psnr == "inf" || psnr > 120) << psnr;
    }
    const auto pairs = [](const json& report) {
        return report["workload"]["tile_pairs"].get<double>();
    };
    EXPECT_GT(pairs(square), 1.1 * pairs(exact));
    EXPECT_LT(square["workload"]["fragments"], exact["workload"]["fragments"]);
    EXPECT_NE(square["timing"]["cycles"], exact["timing"]["cycles"]);
}
INSTANTIATE_TEST_SUITE_P(Designs, TileLists,
                         testing::Values("degs-64", "degs-64-tuned", "gscore-64", "gbu-64",
                                         "gcc-64"));

// The name of a choice is a word of the page and of the program; the short one of old is gone.
TEST(TileListNames, AreExactAndReference) {
    expect_mistake(degs({"run", config("gbu-64"), "--scene", "synthetic:single", "--set",
                         "pipeline.tiles=ref"}),
                   "exact, reference");
}

} // namespace
} // namespace degs::sim_test
