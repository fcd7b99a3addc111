// SPDX-License-Identifier: Apache-2.0
// Numbers with units, in files and overrides.
#include "config/config_source.hpp"
#include "config/quantity.hpp"
#include "config_fixture.hpp"

namespace degs::config_test {
namespace {

Keys keys_with(const std::string& yaml, const std::vector<std::string>& overrides = {}) {
    Keys keys;
    ConfigSource::from_text("a.yaml", yaml, overrides).load(keys);
    return keys;
}

std::string refusal_with(const std::string& yaml, const std::vector<std::string>& overrides = {}) {
    return sentence_of([&] { keys_with(yaml, overrides); });
}

TEST(Quantity, OfAKeyIsInTheUnitOfTheKey) {
    EXPECT_EQ(keys_with("banks: 64\nmemory: {access_bytes: 2KB}").memory.access_bytes, 2048);
    EXPECT_EQ(keys_with("banks: 64\nmemory: {access_bytes: 0.5 KiB}").memory.access_bytes, 512);
    EXPECT_EQ(keys_with("banks: 64\nmemory: {latency_ns: 1.1us}").memory.latency_ns, 1100.0);
    EXPECT_EQ(keys_with("banks: 64", {"memory.access_bytes=1KB"}).memory.access_bytes, 1024);
    EXPECT_EQ(keys_with("banks: 64", {"memory.latency_ns=80.5 ns"}).memory.latency_ns, 80.5);
    EXPECT_EQ(keys_with("banks: 64\nmemory: {latency_ns: 1us}", {"memory.latency_ns=7"})
                  .memory.latency_ns,
              7.0);
}

TEST(Quantity, OfAnotherMeaningIsRefusedWithTheUnitsOfTheKey) {
    const std::string bytes = "B, KB, MB, GB, KiB, MiB, GiB.";
    EXPECT_EQ(
        refusal_with("memory:\n  access_bytes: 2ns"),
        "a.yaml:2: the unit 'ns' does not fit key 'memory.access_bytes' (bytes, granularity); "
        "its units: " +
            bytes);
    EXPECT_EQ(refusal_with("banks: 64", {"memory.access_bytes=2kB"}),
              "--set memory.access_bytes=2kB: the unit 'kB' does not fit key 'memory.access_bytes' "
              "(bytes, granularity); its units: " +
                  bytes);
    EXPECT_EQ(refusal_with("banks: 64", {"memory.latency_ns=2GB/s"}),
              "--set memory.latency_ns=2GB/s: the unit 'GB/s' does not fit key 'memory.latency_ns' "
              "(ns, request to last byte); its units: ns, us.");
    EXPECT_EQ(refusal_with("banks: 4px"), "a.yaml:1: the unit 'px' does not fit key 'banks' (Issue "
                                          "Banks); its units: none.");
}

TEST(Quantity, IsHeldToTheRangeOfTheKey) {
    EXPECT_EQ(refusal_with("memory: {access_bytes: 8KB}"),
              "a.yaml:1: key 'memory.access_bytes' is '8KB = 8192', but must be an integer in "
              "decimal digits, 1 to 4096.");
    EXPECT_EQ(refusal_with("banks: 64", {"memory.access_bytes=0.3KB"}),
              "--set memory.access_bytes=0.3KB: key 'memory.access_bytes' is '0.3KB = 307.2', but "
              "must be an integer in decimal digits, 1 to 4096.");
}

TEST(Quantity, IsNoTextAndNoNumberWrittenWrong) {
    for (const char* const text :
         {"1e3", "0x10", "010", "01KB", "010KB", "\"8KB\"", "1.2.3", "x2"}) {
        EXPECT_NE(refusal_with("memory: {access_bytes: " + std::string(text) + "}")
                      .find("but must be an integer in decimal digits"),
                  std::string::npos)
            << text << ": " << refusal_with("memory: {access_bytes: " + std::string(text) + "}");
    }
}

TEST(Quantity, TextOfADecimalHasNoRounding) {
    EXPECT_EQ(decimal_text(0), "0");
    EXPECT_EQ(decimal_text(16384), "16384");
    EXPECT_EQ(decimal_text(12.3456789), "12.3456789");
    EXPECT_EQ(decimal_text(0.07 * 100), "7");
    EXPECT_EQ(decimal_text(51.2 * 4), "204.8");
    EXPECT_EQ(decimal_text(0.1 + 0.2), "0.3");
}

TEST(Quantity, IsAFactorWithAPartThatExists) {
    EXPECT_EQ(parse_quantity("x3/4")->number, 0.75);
    EXPECT_TRUE(parse_quantity("x3/4")->factor);
    for (const char* const text : {"x1/0", "x0/0", "x1/", "x/2", "x1/2/2"}) {
        EXPECT_FALSE(parse_quantity(text)) << text;
    }
}

// A sentence begins with the word of a unit, not with a longer one.
TEST(Quantity, HasTheUnitsOfWholeWords) {
    EXPECT_EQ(units_of({"a", "ns, of a cycle"}), (std::vector<std::string>{"ns", "us"}));
    EXPECT_EQ(units_of({"a", "share"}), std::vector<std::string>{"%"});
    EXPECT_TRUE(units_of({"a", "shares of all"}).empty());
    EXPECT_TRUE(units_of({"a", "GHz2"}).empty());
}

} // namespace
} // namespace degs::config_test
