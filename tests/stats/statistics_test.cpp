// SPDX-License-Identifier: Apache-2.0
#include "stats/statistics_document.hpp"

#include <limits>
#include <memory>
#include <sstream>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "degs/error.hpp"

namespace degs {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

struct Unit {
    struct Stats {
        std::uint64_t rows = 0, deepest = 0;
        void describe(StatsVisitor& v) const {
            v.count("rows", rows, "rows", "Rows solved.");
            v.peak("deepest", deepest, "rows", "Most rows that waited.");
        }
    };
    const Stats& stats() const { return own; }
    Stats own;
};

std::vector<std::unique_ptr<Unit>> two_units() {
    std::vector<std::unique_ptr<Unit>> units;
    units.push_back(std::make_unique<Unit>(Unit{{3, 7}}));
    units.push_back(std::make_unique<Unit>(Unit{{4, 5}}));
    return units;
}

/// Two stages with a number in common, one number that may not exist, and one that does not.
void describe_house(StatsVisitor& v) {
    v.begin_section("house", "All of it.");
    for (const char* room : {"attic", "cellar"}) {
        v.begin_section(room, "A room.");
        v.real("warm", 0.5, "share", "Time in which it was warm.");
        v.count("bottles", std::uint64_t{2}, "bottles",
                std::string(room) == "attic" ? "Empty | ones." : "Full ones.");
        v.end_section();
    }
    v.text("best", "cellar", "Where people are.");
    v.end_section();
    v.nothing("garden", "There is none.");
    if (v.wants(false)) {
        v.truth("pool", true, "Some houses have one.");
    }
    v.real("view", std::numeric_limits<double>::infinity(), "km", "How far one sees.");
    v.real("smell", std::numeric_limits<double>::quiet_NaN(), "", "Not known.");
    v.list("doors", {1, 2}, "cm", "Widths.");
}

std::vector<std::string> paths(const std::vector<Statistic>& list) {
    std::vector<std::string> names;
    for (const Statistic& row : list) {
        names.push_back(row.path);
    }
    return names;
}

TEST(Counters, AddUpAndKeepTheHighest) {
    Counters counters;
    counters.add(two_units()).count("units", 2, "units", "Units.");
    const std::vector<Statistic> list =
        list_statistics([&](StatsVisitor& v) { counters.describe(v); });
    EXPECT_THAT(paths(list), ElementsAre("rows", "deepest", "units"));
    EXPECT_EQ(std::get<std::uint64_t>(list[0].value), 7U);
    EXPECT_EQ(std::get<std::uint64_t>(list[1].value), 7U);
    EXPECT_EQ(list[0].unit, "rows");
    EXPECT_EQ(list[1].sentence, "Most rows that waited.");
    EXPECT_THROW(counters.real("busy", 0.5, "share", "No whole number."), std::logic_error);
    EXPECT_THROW(counters.begin_section("part", ""), std::logic_error);
}

TEST(Statistics, InfinitiesHaveTheirSign) {
    const auto both = [](StatsVisitor& v) {
        v.real("most", std::numeric_limits<double>::infinity(), "dB", "Of equals.");
        v.real("least", -std::numeric_limits<double>::infinity(), "dB", "Of nothing.");
    };
    EXPECT_EQ(statistics_json(list_statistics(both)).dump(), R"({"most":"inf","least":"-inf"})");
}

TEST(Statistics, BecomeNestedJson) {
    const nlohmann::ordered_json json = statistics_json(list_statistics(describe_house));
    EXPECT_EQ(json.dump(),
              R"({"house":{"attic":{"warm":0.5,"bottles":2},"cellar":{"warm":0.5,"bottles":2},)"
              R"("best":"cellar"},"garden":null,"view":"inf","smell":null,"doors":[1,2]})");
    EXPECT_EQ(statistics_json(list_statistics([](StatsVisitor& v) {
                  v.begin_section("empty", "");
                  v.end_section();
              })).dump(),
              R"({"empty":{}})");
}

TEST(Statistics, TheManualListsWhatARunMayLack) {
    EXPECT_THAT(paths(list_statistics(describe_house)), testing::Not(testing::Contains("pool")));
    EXPECT_THAT(paths(document_statistics(describe_house)), testing::Contains("pool"));
}

TEST(Statistics, WhatSeveralHaveInCommonIsListedOnce) {
    EXPECT_THAT(paths(statistics_in(shared_once(list_statistics(describe_house)), "house")),
                ElementsAre("house", "house.*.warm", "house.attic", "house.attic.bottles",
                            "house.cellar", "house.cellar.bottles", "house.best"));
}

TEST(Statistics, AreFoundByNameOrSuggested) {
    const std::vector<Statistic> list = list_statistics(describe_house);
    EXPECT_EQ(std::get<double>(find_statistic(list, "house.attic.warm").value), 0.5);
    EXPECT_THAT(paths(statistics_in(list, "house.attic")),
                ElementsAre("house.attic", "house.attic.warm", "house.attic.bottles"));
    EXPECT_THAT(paths(statistics_in(list, "view")), ElementsAre("view"));
    EXPECT_EQ(statistics_in(list, "").size(), list.size());
    const auto sentence = [&list](const std::string& path) {
        try {
            find_statistic(list, path);
        } catch (const InputError& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    EXPECT_EQ(sentence("house.atic.warm"),
              "There is no statistic 'house.atic.warm' (did you mean 'house.attic.warm'?).");
    EXPECT_THAT(sentence("nonsense"), HasSubstr("degs config --stats"));
    EXPECT_NE(sentence("house"), "") << "a section is not a number";
    EXPECT_THROW(statistics_in(list, "hous"), InputError);
}

TEST(Statistics, TablesAndTextHaveUnitsAndSentences) {
    const std::vector<Statistic> list = list_statistics(describe_house);
    EXPECT_EQ(statistics_markdown(statistics_in(list, "house.attic"), "house.attic"),
              "| Key | Unit | Meaning |\n|---|---|---|\n"
              "| `warm` | share | Time in which it was warm. |\n"
              "| `bottles` | bottles | Empty \\| ones. |\n");
    EXPECT_EQ(statistics_text(statistics_in(list, "house.attic")),
              "house.attic: A room.\nhouse.attic.warm [share]\n    Time in which it was warm.\n"
              "house.attic.bottles [bottles]\n    Empty | ones.\n");
    std::string long_sentence = "word";
    for (int i = 0; i < 40; ++i) {
        long_sentence += " word";
    }
    std::istringstream lines(statistics_text({{"path", "m", long_sentence, false, {}}}));
    for (std::string line; std::getline(lines, line);) {
        EXPECT_LE(line.size(), 80U) << line;
    }
}

} // namespace
} // namespace degs
