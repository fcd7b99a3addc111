// SPDX-License-Identifier: Apache-2.0
// degs soc, as a user calls it.
#include "tests/sim/child.hpp"

namespace degs::sim_test {
namespace {

TEST(SmallRunSoc, LatencyRisesWithTheLoadAndPixelsStay) {
    const Folder folder;
    const Outcome outcome =
        degs({"soc", config("degs-16"), "--scene", "synthetic:object,gaussians=3000", "--width",
              "160", "--load", "0", "120", "--cores", "2", "--out", folder / "out"});
    expect_success(outcome);
    EXPECT_NE(outcome.out.find("the same under every load"), std::string::npos) << outcome.out;
    const auto written = nlohmann::json::parse(read_file(folder / "out/soc.json"));
    ASSERT_EQ(written["points"].size(), 2U);
    const auto& alone = written["points"][0];
    const auto& loaded = written["points"][1];
    EXPECT_EQ(alone["cpu_gb_per_s"], 0.0);
    EXPECT_GT(loaded["cpu_gb_per_s"], 10.0);
    EXPECT_LE(loaded["cpu_gb_per_s"], 121.0); // offered, and one line per core more
    EXPECT_GT(loaded["latency_ns"], alone["latency_ns"]);
    EXPECT_EQ(loaded["bytes_written"], alone["bytes_written"]);
    EXPECT_EQ(loaded["fragments"], alone["fragments"]);
    EXPECT_GT(written["psnr_db"], 45.0); // 8 bits alone: 20 log10(255 sqrt 12) = 58.9 dB
    EXPECT_NE(read_file(folder / "out/soc.svg").find("<svg"), std::string::npos);
}

TEST(HostileSoc, BadArgumentsAreOneSentence) {
    EXPECT_EQ(degs({"soc"}).code, 2);
    EXPECT_EQ(degs({"soc", config("degs-16"), "--scene", "synthetic:object", "--load", "-1"}).code,
              2);
    EXPECT_EQ(
        degs({"soc", config("degs-16"), "--scene", "synthetic:object", "--memory", "none.yaml"})
            .code,
        2);
}

} // namespace
} // namespace degs::sim_test
