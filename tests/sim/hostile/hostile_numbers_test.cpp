// SPDX-License-Identifier: Apache-2.0
// Numbers of the command line: decimal, finite, and in no other notation.
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

Outcome render(const Folder& folder, const std::string& option, const std::string& value) {
    return degs({"render", "--scene", "synthetic:single", "--out", folder / "out", option, value});
}

TEST(HostileNumbers, LeadingZerosAreDecimal) {
    const Folder folder;
    for (const char* width : {"032", "0032", "32"}) {
        expect_success(render(folder, "--width", width));
        const auto rendered = nlohmann::json::parse(read_file(folder / "out/render.json"));
        EXPECT_EQ(rendered["camera"]["width"], 32) << width;
    }
    expect_success(render(folder, "--camera", "00"));
}

TEST(HostileNumbers, OtherNotationsOfIntegersAreRefused) {
    const Folder folder;
    for (const char* width :
         {"0x10", "0b1", "0o17", "1e2", "32.0", "1'000", "+32", " 32", "-", ""}) {
        const Outcome outcome = render(folder, "--width", width);
        expect_mistake(outcome, "--width");
        EXPECT_NE(outcome.err.find("decimal"), std::string::npos) << outcome.err;
    }
    EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(HostileNumbers, UnsignedNumbersHaveNoSign) {
    const Folder folder;
    const std::string memory = std::string(DEGS_CONFIGS) + "/memory/lpddr5-3200x128.yaml";
    for (const char* seed : {"-1", "-0", "0x1"}) {
        expect_mistake(degs({"memory", memory, "--out", folder / "out", "--seed", seed}), "--seed");
    }
    expect_mistake(degs({"memory", memory, "--out", folder / "out", "--requests", "-1"}),
                   "--requests");
    expect_mistake(degs({"accuracy", "--single-gaussian", "--out", folder / "out", "--seed", "-1"}),
                   "--seed");
    EXPECT_FALSE(fs::exists(folder / "out"));
}

TEST(NumbersOfOptions, RealNumbersAreFinite) {
    const Folder folder;
    for (const char* value : {"nan", "inf", "-inf", "NAN", "0x1p3", "1e999", "1,5", ""}) {
        const std::vector<std::pair<std::vector<std::string>, std::string>> commands{
            {{"soc"}, "--load"},
            {{"soc"}, "--refresh"},
            {{"run", "--frames", "2"}, "--path-step"},
            {{"run"}, "--eyes"},
            {{"run", "--eyes", "0.1"}, "--units-per-metre"},
            {{"compare", "--frames", "2"}, "--path-step"}};
        for (const auto& [head, option] : commands) {
            std::vector<std::string> arguments = head;
            arguments.insert(arguments.end(), {config("degs-64"), "--scene", "synthetic:single",
                                               "--out", folder / "out", option, value});
            expect_mistake(degs(arguments), option);
        }
    }
    EXPECT_FALSE(fs::exists(folder / "out"));
}

} // namespace
} // namespace degs::sim_test
