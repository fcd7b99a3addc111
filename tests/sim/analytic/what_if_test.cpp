// SPDX-License-Identifier: Apache-2.0
// degs run --what-if: the estimates of the changed designs, beside results that it leaves alone.
#include <cmath>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using nlohmann::json;
using Words = std::vector<std::string>;

/// The report of a run, or analytic.json, with the version of the terminal in `text`.
json run_of(const Words& more, bool analytic, std::string* text = nullptr) {
    const Folder folder;
    Words words{"run",
                config("degs-64"),
                "--scene",
                "synthetic:object,gaussians=2000",
                "--width",
                "320",
                "--no-reference",
                "--no-cache",
                "--out",
                folder / "out"};
    words.insert(words.end(), more.begin(), more.end());
    if (analytic) {
        words.insert(words.end(), {"--fidelity", "analytic"});
    }
    const Outcome outcome = degs(words);
    expect_success(outcome);
    if (text != nullptr) {
        *text = outcome.out;
    }
    return json::parse(read_file(folder / (analytic ? "out/analytic.json" : "out/report.json")));
}

double estimate_with(const Words& settings) {
    Words more;
    for (const std::string& setting : settings) {
        more.insert(more.end(), {"--set", setting});
    }
    return run_of(more, true)["timing"]["cycles"];
}

// The second change needs another projection of the view, and the third sets two keys.
TEST(WhatIf, GivesTheEstimatesOfTheChangedDesigns) {
    const std::vector<Words> changes{
        {"memory.bandwidth_gb_per_s=12.8"}, {"tile_size=16"}, {"span.count=2", "slicing.count=1"}};
    const Words asked{"--what-if", "memory.bandwidth_gb_per_s=12.8", "--what-if", "tile_size=16",
                      "--what-if", "span.count=2,slicing.count=1"};
    for (const bool analytic : {false, true}) {
        const json list = run_of(asked, analytic)["what_if"];
        ASSERT_EQ(list.size(), changes.size());
        for (std::size_t c = 0; c < changes.size(); ++c) {
            const double before = list[c]["estimated_before"];
            const double after = list[c]["estimated_after"];
            EXPECT_EQ(list[c]["set"], asked[2 * c + 1]);
            EXPECT_DOUBLE_EQ(before, estimate_with({}));
            EXPECT_DOUBLE_EQ(after, estimate_with(changes[c])) << changes[c].front();
            EXPECT_DOUBLE_EQ(list[c]["change"], after / before - 1);
            const double width = 0.01 + 0.2 * std::abs(after / before - 1);
            EXPECT_DOUBLE_EQ(list[c]["change_interval"][0], after / before - 1 - width);
            EXPECT_DOUBLE_EQ(list[c]["change_interval"][1], after / before - 1 + width);
        }
    }
}

TEST(WhatIf, LeavesTheRunAlone) {
    std::string text;
    json with = run_of({"--what-if", "tile_size=16"}, false, &text);
    json without = run_of({}, false);
    EXPECT_EQ(with.erase("what_if"), 1U);
    EXPECT_FALSE(without.contains("what_if"));
    with.erase("host");
    without.erase("host");
    EXPECT_EQ(with, without);
    EXPECT_NE(text.find("what if, estimated"), std::string::npos) << text;
    EXPECT_NE(text.find("tile_size=16 "), std::string::npos) << text;
}

TEST(WhatIf, RefusesKeysAsSetDoes) {
    const Folder folder;
    const auto said = [&folder](const Words& more) {
        Words words{"run",   config("degs-64"), "--scene", "synthetic:single",
                    "--out", folder / "out"};
        words.insert(words.end(), more.begin(), more.end());
        const Outcome outcome = degs(words);
        EXPECT_EQ(outcome.code, 2) << outcome.err;
        return outcome.err;
    };
    for (const std::string wrong : {"span.cuont=2", "span.count=0", "span.count", ""}) {
        std::string by_set = said({"--set", wrong});
        const std::size_t name = by_set.find("--set");
        ASSERT_NE(name, std::string::npos) << by_set;
        EXPECT_EQ(said({"--what-if", wrong}), by_set.replace(name, 5, "--what-if"));
    }
    EXPECT_NE(said({"--what-if", "span.count=8", "--array-only"}).find("--array-only"),
              std::string::npos);
    EXPECT_FALSE(fs::exists(folder / "out/report.json"));
}

} // namespace
} // namespace degs::sim_test
