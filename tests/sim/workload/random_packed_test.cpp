// SPDX-License-Identifier: Apache-2.0
// Random designs: what `workload pack` writes, `run --workload` takes with the same keys.
#include <random>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using Words = std::vector<std::string>;

class PackedDesign : public testing::TestWithParam<unsigned> {};

/// Keys of one design, each left out as often as it is there.
Words keys_of(std::mt19937& draw) {
    const auto one_of = [&draw](const Words& words) { return words[draw() % words.size()]; };
    const std::vector<std::pair<const char*, Words>> all{
        {"pipeline.rules.cut", {"0", "0.01", "0.3", "1", "2", "3.7", "5", "7", "9", "11.5"}},
        {"pipeline.rules.low_pass", {"0", "0.1", "1"}},
        {"pipeline.rules.near", {"0", "0.01", "1"}},
        {"pipeline.rules.order", {"depth", "distance"}},
        {"pipeline.rules.antialiasing", {"scene", "on", "off"}},
        {"pipeline.rules.projection", {"linear", "unscented"}},
        {"pipeline.rules.lens", {"camera", "pinhole"}},
        {"pipeline.rules.sigma_kappa", {"0", "1", "20"}},
        {"pipeline.rules.sigma_beta", {"2", "3", "50"}},
        {"pipeline.numbers", {"fp32", "fp64", "fp16", "paper", "tuned"}},
        {"pipeline.tiles", {"exact", "square", "box", "tight"}},
    };
    Words keys;
    for (const auto& [key, values] : all) {
        if (draw() % 2 == 0) {
            keys.insert(keys.end(), {"--set", key + ("=" + one_of(values))});
        }
    }
    return keys;
}

TEST_P(PackedDesign, RunsFromItsFile) {
    std::mt19937 draw(GetParam());
    const Folder folder;
    const Words bases{"degs-16", "degs-64-tuned", "gscore-16", "gbu-16", "gcc-16", "orange-o1"};
    const std::string design = config(bases[draw() % bases.size()]);
    const Words keys = keys_of(draw);
    const auto call = [&](Words words, const Words& more) {
        words.insert(words.end(), keys.begin(), keys.end());
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = degs(words);
        std::string line;
        for (const std::string& word : words) {
            line += word + " ";
        }
        ASSERT_EQ(outcome.code, 0) << line << outcome.err;
    };
    const Words view{"--scene", "synthetic:dense,gaussians=200", "--width", "52", "--camera", "2"};
    const std::string file = folder / "f.degsw";
    ASSERT_NO_FATAL_FAILURE(call({"workload", "pack", design, "--out", file}, view));
    ASSERT_NO_FATAL_FAILURE(
        call({"run", design, "--workload", file, "--out", folder / "packed"}, {}));
    ASSERT_NO_FATAL_FAILURE(call({"run", design, "--no-cache", "--out", folder / "scene"}, view));
    EXPECT_TRUE(read_file(folder / "packed/image.exr") == read_file(folder / "scene/image.exr"));
    auto packed = nlohmann::json::parse(read_file(folder / "packed/report.json"));
    auto scene = nlohmann::json::parse(read_file(folder / "scene/report.json"));
    for (auto* const report : {&packed, &scene}) {
        report->erase("host");
        (*report)["scene"].erase("source");
        (*report)["scene"].erase("workload_xxh128");
    }
    EXPECT_EQ(packed.dump(), scene.dump());
}

INSTANTIATE_TEST_SUITE_P(Random, PackedDesign, testing::Range(0U, 40U));

} // namespace
} // namespace degs::sim_test
