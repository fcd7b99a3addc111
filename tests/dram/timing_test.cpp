// SPDX-License-Identifier: Apache-2.0
// Every constraint: blocked one CK before its gap has passed, legal then.
#include "tests/dram/fixture.hpp"

namespace degs {
namespace {

using test::Command;
using test::Lpddr5Reference;
using test::Relation;

class Lpddr5Speeds : public ::testing::TestWithParam<const char*> {};

// All pairs of commands in all relations, so a rule too many fails as well as one that is missing.
TEST_P(Lpddr5Speeds, EveryPairOfCommandsKeepsItsGap) {
    const dram::Config config = test::lpddr5_config(GetParam());
    const Lpddr5Reference reference = Lpddr5Reference::of(GetParam());
    const dram::RuleTable rules(config.timing);
    for (std::size_t a = 0; a < dram::kCommands; ++a) {
        for (std::size_t b = 0; b < dram::kCommands; ++b) {
            for (const auto& [relation, bank] : {std::pair{Relation::SameBank, 5U},
                                                 {Relation::SameGroup, 6U},
                                                 {Relation::Other, 10U}}) {
                const auto first = static_cast<Command>(a);
                const auto second = static_cast<Command>(b);
                dram::Dates dates(rules);
                dates.issue(first, 5, 1000);
                const dram::Ck earliest =
                    std::max<dram::Ck>(dates.earliest(second, bank), 1001); // one per CK
                EXPECT_EQ(earliest,
                          1000 + static_cast<dram::Ck>(reference.gap(first, second, relation)))
                    << dram::command_name(first) << " to " << dram::command_name(second)
                    << " in relation " << static_cast<int>(relation);
            }
        }
    }
}

TEST_P(Lpddr5Speeds, EveryRuleIsNeededSomewhere) {
    const dram::Config config = test::lpddr5_config(GetParam());
    const Lpddr5Reference reference = Lpddr5Reference::of(GetParam());
    for (const dram::Rule& rule : dram::rules(config.timing)) {
        int longest = 0; // among the relations that the rule's scope covers
        for (const Relation relation : {Relation::SameBank, Relation::SameGroup, Relation::Other}) {
            if (static_cast<int>(relation) <= static_cast<int>(rule.scope)) {
                longest = std::max(longest, reference.gap(rule.previous, rule.next, relation));
            }
        }
        EXPECT_LE(rule.gap, static_cast<dram::Ck>(longest)) << rule.name;
    }
}

TEST_P(Lpddr5Speeds, FourActivationsPerWindow) {
    const dram::Config config = test::lpddr5_config(GetParam(), {"timing.faw=40"});
    const dram::RuleTable rules(config.timing);
    dram::Dates dates(rules);
    for (const unsigned bank : {0U, 4U, 8U, 12U}) {
        EXPECT_LT(dates.earliest(Command::Act1, bank), 140U);
        dates.issue(Command::Act1, bank, 100 + bank);
    }
    EXPECT_EQ(dates.earliest(Command::Act1, 1), 140U);
    dates.issue(Command::Act1, 1, 140);
    EXPECT_EQ(dates.earliest(Command::Act1, 2), 144U); // the second one has left the window
}

INSTANTIATE_TEST_SUITE_P(Both, Lpddr5Speeds,
                         ::testing::Values("lpddr5-6400x256", "lpddr5-3200x128"));

TEST(Lpddr5Config, SpeedsHaveTheirPeaks) {
    EXPECT_DOUBLE_EQ(test::lpddr5_config("lpddr5-6400x256").peak_gb_per_s(), 204.8);
    EXPECT_DOUBLE_EQ(test::lpddr5_config("lpddr5-6400x128").peak_gb_per_s(), 102.4);
    EXPECT_DOUBLE_EQ(test::lpddr5_config("lpddr5-3200x128").peak_gb_per_s(), 51.2);
}

TEST(Lpddr5Config, RejectsWhatCannotBe) {
    for (const char* wrong :
         {"timing.burst_length=32", "timing.rows=1000", "channels=12", "timing.refi=200",
          "mapping.interleave_bytes=96", "controller.write_low=0.9", "controller.read_queue=65"}) {
        EXPECT_THROW(test::lpddr5_config("lpddr5-6400x256", {wrong}), InputError) << wrong;
    }
}

} // namespace
} // namespace degs
