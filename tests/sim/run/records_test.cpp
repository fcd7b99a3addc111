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

/// By how much the time of GSCore over that of DeGS grows from one size of the scene to four times
/// as many Gaussians.
double growth(const std::vector<std::string>& records) {
    constexpr int kFew = 150'000, kMany = 600'000;
    const auto ratio = [&records](int gaussians) {
        return cycles_of("gscore-64", gaussians, records) /
               cycles_of("degs-64", gaussians, records);
    };
    return ratio(kMany) / ratio(kFew);
}

TEST(ShapeRecords, EqualRecordsMakeRatiosIndependentOfTheSizeOfTheScene) {
    EXPECT_GT(growth({}), 1.08);
    EXPECT_NEAR(growth({"pipeline.records=fp32", "traffic.sh=all"}), 1, 0.1);
    EXPECT_NEAR(growth({"pipeline.records=fp16", "traffic.sh=visible"}), 1, 0.1);
}

} // namespace
} // namespace degs::sim_test
