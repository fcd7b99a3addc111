// SPDX-License-Identifier: Apache-2.0
// The schema of designs knows what a number format is.
#include <regex>

#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

TEST(FormatSchema, TakesWhatTheProgramTakes) {
    const Outcome outcome = degs({"config", "--schema", "design"});
    ASSERT_EQ(outcome.code, 0);
    const auto schema = nlohmann::json::parse(outcome.out);
    const auto formats = schema["properties"]["pipeline"]["properties"]["formats"]["properties"];
    std::size_t found = 0;
    for (const auto& [key, leaf] : formats.items()) {
        if (!leaf.contains("pattern") || leaf["type"] != "string") {
            EXPECT_FALSE(leaf.contains("type") && leaf["type"].is_array() &&
                         leaf["type"].dump().find("boolean") != std::string::npos)
                << key;
            continue;
        }
        ++found;
        const std::regex pattern(leaf["pattern"].get<std::string>());
        for (const char* name : {"fp64", "fp32", "fp16", "bf16", "e5m10", "ue8m23", "e4m3b7",
                                 "q16.8", "uq0.16", "uq2.0"}) {
            EXPECT_TRUE(std::regex_match(name, pattern)) << key << " " << name;
        }
        for (const char* name : {"banana", "", "fp33", "16", "true", "e9m3", "e1m3", "e4m24", "q8",
                                 "q8.", "xfp16", "fp16 ", "uuq1.1"}) {
            EXPECT_FALSE(std::regex_match(name, pattern)) << key << " " << name;
        }
        EXPECT_TRUE(std::regex_match(leaf["default"].get<std::string>(), pattern)) << key;
    }
    EXPECT_GT(found, 25U);
}

} // namespace
} // namespace degs::sim_test
