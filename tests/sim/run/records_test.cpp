// SPDX-License-Identifier: Apache-2.0
// What the records of Gaussians do to comparisons; docs/readings.md has the same on whole scenes.
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

double cycles_of(const std::string& design, int gaussians,
                 const std::vector<std::string>& records) {
    const Folder folder;
    std::vector<std::string> arguments{
        "run",           config(design),
        "--scene",       "synthetic:landscape,gaussians=" + std::to_string(gaussians),
        "--camera",      "2",
        "--width",       "480",
        "--out",         folder / "out",
        "--no-reference"};
    for (const std::string& setting : records) {
        arguments.insert(arguments.end(), {"--set", setting});
    }
    expect_success(degs(arguments));
    return report_in(folder / "out")["timing"]["cycles"].get<double>();
}

using Settings = std::vector<std::string>;

/// By how much the time of GSCore over that of DeGS grows from one size of the scene to four times
/// as many Gaussians.
double growth(const Settings& gscore, const Settings& degs) {
    constexpr int kFew = 150'000, kMany = 600'000;
    const auto ratio = [&](int gaussians) {
        return cycles_of("gscore-64", gaussians, gscore) / cycles_of("degs-64", gaussians, degs);
    };
    return ratio(kMany) / ratio(kFew);
}

TEST(LongShapeRecords, EqualRecordsMakeRatiosIndependentOfTheSizeOfTheScene) {
    const Settings all_fp32{"pipeline.records=fp32", "traffic.sh=all"};
    EXPECT_NEAR(growth({}, {}), 1, 0.1);
    EXPECT_NEAR(growth(all_fp32, all_fp32), 1, 0.1);
    EXPECT_GT(growth(all_fp32, {}), 1.08);
}

} // namespace
} // namespace degs::sim_test
