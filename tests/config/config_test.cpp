// SPDX-License-Identifier: Apache-2.0
// Values into structs, and every way in which a value can be wrong.
#include <cmath>
#include <limits>

#include "config/config_source.hpp"
#include "config_fixture.hpp"

namespace degs::config_test {
namespace {

Keys loaded(const std::string& yaml, const std::vector<std::string>& overrides = {}) {
    Keys keys;
    ConfigSource::from_text("a.yaml", yaml, overrides).load(keys);
    return keys;
}

std::string error_of(const std::string& yaml, const std::vector<std::string>& overrides = {}) {
    return sentence_of([&] { loaded(yaml, overrides); });
}

TEST(Config, ReadsEveryKindOfValueAndKeepsOtherDefaults) {
    const Keys keys = loaded("order: hilbert\nseed: -7\ntitle: \"64\"\n"
                             "memory:\n  latency_ns: 1.25e2\n  refresh: false\n");
    EXPECT_EQ(keys.order, Order::hilbert);
    EXPECT_EQ(keys.seed, -7);
    EXPECT_EQ(keys.title, "64");
    EXPECT_EQ(keys.memory.latency_ns, 125.0);
    EXPECT_FALSE(keys.memory.refresh);
    EXPECT_EQ(keys.banks, 8);
    EXPECT_EQ(keys.memory.access_bytes, 64);
}

TEST(Config, BoundsBelongToTheRange) {
    EXPECT_EQ(loaded("banks: 1").banks, 1);
    EXPECT_EQ(loaded("banks: 64").banks, 64);
    EXPECT_EQ(loaded("memory: {latency_ns: 0}").memory.latency_ns, 0.0);
    EXPECT_EQ(loaded("seed: 9223372036854775807").seed, INT64_MAX);
    EXPECT_EQ(loaded("seed: -9223372036854775808").seed, INT64_MIN);
}

TEST(Config, SectionWithoutKeysSetsNothing) {
    EXPECT_EQ(loaded("memory:\nbanks: 4").memory.access_bytes, 64);
    EXPECT_EQ(loaded("memory: {}").memory.access_bytes, 64);
}

TEST(Config, FailedLoadLeavesTheStructUntouched) {
    Keys keys;
    keys.banks = 3;
    const auto source = ConfigSource::from_text("a.yaml", "banks: 5\nmemory: {refresh: maybe}");
    EXPECT_THROW(source.load(keys), InputError);
    EXPECT_EQ(keys.banks, 3);
}

TEST(ConfigUnknown, NamesTheNearestAndAllKnownKeys) {
    EXPECT_EQ(error_of("banks: 4\nmemory:\n  latncy_ns: 3\n"),
              "a.yaml:3: key 'memory.latncy_ns' is unknown, did you mean 'memory.latency_ns'? "
              "(allowed in 'memory': latency_ns, access_bytes, refresh).");
    EXPECT_EQ(error_of("bank: 4"), "a.yaml:1: key 'bank' is unknown, did you mean 'banks'? "
                                   "(allowed at the top: banks, seed, order, title, memory).");
}

TEST(ConfigUnknown, PointsAtTheSectionAKeyBelongsTo) {
    EXPECT_EQ(error_of("\naccess_bytes: 32"),
              "a.yaml:2: key 'access_bytes' is unknown, did you mean 'memory.access_bytes'? "
              "(allowed at the top: banks, seed, order, title, memory).");
}

TEST(ConfigUnknown, OffersNothingFarFetched) {
    EXPECT_EQ(error_of("quantum_entanglement: 1"),
              "a.yaml:1: key 'quantum_entanglement' is unknown "
              "(allowed at the top: banks, seed, order, title, memory).");
}

TEST(ConfigUnknown, RejectsDottedKeysAndMergeKeysInAFile) {
    EXPECT_EQ(error_of("memory.refresh: true"),
              "a.yaml:1: key 'memory.refresh' is unknown, because 'refresh' has to stand in the "
              "section 'memory'. "
              "(allowed at the top: banks, seed, order, title, memory).");
    EXPECT_NE(error_of("<<: {banks: 3}").find("a.yaml:1: key '<<' is unknown"), std::string::npos);
}

TEST(ConfigInteger, RejectsEverythingThatIsNotPlainDigitsInRange) {
    const std::string end = ", but must be an integer in decimal digits, 1 to 64";
    EXPECT_EQ(error_of("seed: 2\nbanks: 65"), "a.yaml:2: key 'banks' is '65'" + end + ".");
    EXPECT_EQ(error_of("banks: 0"), "a.yaml:1: key 'banks' is '0'" + end + ".");
    EXPECT_EQ(error_of("banks: many"), "a.yaml:1: key 'banks' is 'many'" + end + ".");
    EXPECT_EQ(error_of("banks: 4.0"), "a.yaml:1: key 'banks' is '4.0'" + end + ".");
    EXPECT_EQ(error_of("banks: 010"), "a.yaml:1: key 'banks' is '010'" + end + ".");
    EXPECT_EQ(error_of("banks: +4"), "a.yaml:1: key 'banks' is '+4'" + end + ".");
    EXPECT_EQ(error_of("banks: true"), "a.yaml:1: key 'banks' is 'true'" + end + ".");
    EXPECT_EQ(error_of("banks: '4'"), "a.yaml:1: key 'banks' is the quoted text '4'" + end + ".");
    EXPECT_EQ(error_of("banks:"), "a.yaml:1: key 'banks' has no value" + end + ".");
    EXPECT_EQ(error_of("banks: ~"), "a.yaml:1: key 'banks' has no value" + end + ".");
    EXPECT_EQ(error_of("banks: [4]"), "a.yaml:1: key 'banks' is a list" + end + ".");
    EXPECT_EQ(error_of("banks:\n  x: 4"), "a.yaml:1: key 'banks' is a section" + end + ".");
}

TEST(ConfigInteger, WantsDigitsInsteadOfExponents) {
    const std::string end = ", but must be an integer in decimal digits, 64 bits.";
    EXPECT_EQ(error_of("seed: 1e3"), "a.yaml:1: key 'seed' is '1e3'" + end);
    EXPECT_EQ(error_of("seed: 0x10"), "a.yaml:1: key 'seed' is '0x10'" + end);
    EXPECT_EQ(error_of("seed: 1_000"), "a.yaml:1: key 'seed' is '1_000'" + end);
}

TEST(ConfigInteger, CatchesOverflowOfEitherWidth) {
    EXPECT_EQ(error_of("seed: 9223372036854775808"),
              "a.yaml:1: key 'seed' is '9223372036854775808', but must be an integer in decimal "
              "digits, 64 bits.");
    EXPECT_EQ(error_of("banks: 4294967304"), // 2^32 + 8 would pass as 8 in 32 bits
              "a.yaml:1: key 'banks' is '4294967304', but must be an integer in decimal digits, 1 "
              "to 64.");
}

TEST(ConfigReal, RejectsWhatIsNotFiniteOrOutOfRange) {
    for (const char* bad : {"-0.1",     "1000000.1", ".nan",   ".inf",  "-.inf", "nan", "inf",
                            "infinity", "1e999",     "1e-999", "0x1p3", "0x20",  "032", "00.5",
                            "-07",      "+5",        "1,5",    "1.2.3", "fast",  "true"}) {
        EXPECT_EQ(error_of(std::string("memory:\n  latency_ns: ") + bad),
                  std::string("a.yaml:2: key 'memory.latency_ns' is '") + bad +
                      "', but must be a finite decimal number, 0 to 1e+06.");
    }
    EXPECT_EQ(error_of("memory: {latency_ns: \"5\"}"),
              "a.yaml:1: key 'memory.latency_ns' is the quoted text '5', but must be a finite "
              "decimal number, 0 to 1e+06.");
    EXPECT_EQ(loaded("memory: {latency_ns: 0.5}").memory.latency_ns, 0.5);
}

TEST(ConfigBoolean, TakesTrueAndFalseOnly) {
    for (const char* bad : {"yes", "no", "on", "off", "1", "0", "True", "TRUE", "y"}) {
        EXPECT_EQ(error_of(std::string("memory:\n  refresh: ") + bad),
                  std::string("a.yaml:2: key 'memory.refresh' is '") + bad +
                      "', but must be true or false.");
    }
}

TEST(ConfigChoice, GoesByNameAndSuggestsTheNearest) {
    EXPECT_EQ(error_of("order: mortn"), "a.yaml:1: key 'order' is 'mortn', but must be one of "
                                        "row-major, morton, hilbert (did you mean 'morton'?).");
    EXPECT_EQ(error_of("order: 1"), "a.yaml:1: key 'order' is '1', but must be one of "
                                    "row-major, morton, hilbert.");
    EXPECT_EQ(error_of("order: [morton]"), "a.yaml:1: key 'order' is a list, but must be one of "
                                           "row-major, morton, hilbert.");
}

// A word that only one description has suggests the choice that is described.
TEST(ConfigChoice, IsFoundByAWordOfItsDescription) {
    const std::string sentence = "a.yaml:1: key 'order' is 'jumps', but must be one of row-major, "
                                 "morton, hilbert (did you mean 'hilbert'?).";
    EXPECT_EQ(error_of("order: jumps"), sentence);
    for (const char* vague : {"curve", "Z", "tiles", "jump"}) {
        const std::string start = std::string("a.yaml:1: key 'order' is '") + vague;
        EXPECT_EQ(error_of(std::string("order: ") + vague),
                  start + "', but must be one of row-major, morton, hilbert.");
    }
}

TEST(ConfigText, MayBeEmptyButNotMissing) {
    EXPECT_EQ(loaded("title: ''").title, "");
    EXPECT_EQ(loaded("title: 64 PEs, 2 tiles").title, "64 PEs, 2 tiles");
    EXPECT_EQ(error_of("title:"), "a.yaml:1: key 'title' has no value, but must be a text "
                                  "(\"\" for an empty one).");
}

TEST(ConfigSection, RejectsAScalarOrAListInItsPlace) {
    EXPECT_EQ(error_of("banks: 2\nmemory: 5"),
              "a.yaml:2: key 'memory' is '5', but must be a section of keys.");
    EXPECT_EQ(error_of("memory: [1, 2]"),
              "a.yaml:1: key 'memory' is a list, but must be a section of keys.");
}

TEST(ConfigRequire, BlamesTheKeyWhereItWasSet) {
    EXPECT_EQ(error_of("seed: 13"),
              "a.yaml:1: key 'seed' is 13, but must not leave 5 by banks; 12 would do.");
    EXPECT_EQ(error_of("seed: 2", {"seed=13"}),
              "--set seed=13: key 'seed' is 13, but must not leave 5 by banks; 12 would do.");
}

TEST(ConfigRequire, NamesTheLinesOfAllKeysThatDecide) {
    EXPECT_EQ(error_of("banks: 6\nseed: 11"),
              "a.yaml:2: key 'seed' is 11, but must not leave 5 by banks; 12 would do (banks is 6 "
              "at line 1).");
    EXPECT_EQ(error_of("banks: 4\nmemory:\n  access_bytes: 512\n", {"memory.latency_ns=7"}),
              "a.yaml:1: key 'banks' is 4, but must be at least 8 to keep up "
              "(memory.access_bytes is 512 at line 3, memory.latency_ns is 7 by --set).");
    EXPECT_EQ(error_of("memory:\n  access_bytes: 640\n"),
              "a.yaml:2: key 'banks' is 8 by default, but must be at least 10 to keep up "
              "(memory.access_bytes is 640).");
}

// A rule that fails because of a misspelt key is not what the user has to hear of.
TEST(ConfigRequire, ComesAfterSingleKeys) {
    EXPECT_NE(error_of("seed: 13\nbankz: 3").find("key 'bankz' is unknown"), std::string::npos);
    EXPECT_NE(error_of("seed: 13\nmemory: {refresh: 3}").find("true or false"), std::string::npos);
}

TEST(ConfigRequire, ChecksWhatAProgramFilled) {
    Keys keys;
    keys.seed = 13;
    EXPECT_EQ(sentence_of([&] { ConfigSource::from_overrides().load(keys); }),
              "default: key 'seed' is 13, but must not leave 5 by banks; 12 would do.");
}

TEST(ConfigDefaults, AreHeldToTheSameRanges) {
    Keys keys;
    keys.banks = 99;
    const auto source = ConfigSource::from_overrides();
    EXPECT_EQ(sentence_of([&] { source.load(keys); }),
              "default: key 'banks' is 99, but must be 1 to 64.");
    keys = Keys();
    keys.memory.latency_ns = std::numeric_limits<double>::quiet_NaN();
    EXPECT_EQ(sentence_of([&] { source.load(keys); }),
              "default: key 'memory.latency_ns' is nan, but must be 0 to 1e+06.");
    keys = Keys();
    keys.order = static_cast<Order>(3);
    EXPECT_EQ(sentence_of([&] { source.load(keys); }),
              "default: key 'order' is 3, but must be 0 to 2.");
}

TEST(ConfigSet, OverridesTheFileAndTheLastOneWins) {
    const Keys keys = loaded("banks: 4\nmemory: {access_bytes: 32}",
                             {"memory.access_bytes=128", "title=a=b", "banks=5", "banks=6"});
    EXPECT_EQ(keys.memory.access_bytes, 128);
    EXPECT_EQ(keys.title, "a=b");
    EXPECT_EQ(keys.banks, 6);
}

TEST(ConfigSet, NamesItselfInsteadOfALine) {
    EXPECT_EQ(error_of("banks: 4", {"banks=400"}),
              "--set banks=400: key 'banks' is '400', but must be an integer in decimal digits, 1 "
              "to 64.");
    EXPECT_EQ(
        error_of("banks: 4", {"banks="}),
        "--set banks=: key 'banks' is '', but must be an integer in decimal digits, 1 to 64.");
    EXPECT_EQ(error_of("banks: 4", {"memory.latncy_ns=3"}),
              "--set memory.latncy_ns=3: key 'memory.latncy_ns' is unknown, did you mean "
              "'memory.latency_ns'? (allowed in 'memory': latency_ns, access_bytes, refresh).");
    EXPECT_EQ(error_of("banks: 4", {"memry.refresh=true"}),
              "--set memry.refresh=true: key 'memry.refresh' is unknown, did you mean "
              "'memory.refresh'? (allowed at the top: banks, seed, order, title, memory).");
}

// What is strict in a file is strict in --set.
TEST(ConfigSet, TakesPlainDecimalNumbersOnly) {
    for (const char* bad : {"032", "0x20", "-4", "+4", "4.0", "1e1", "nan", "inf", " 4", "4 "}) {
        EXPECT_EQ(error_of("seed: 1", {std::string("banks=") + bad}),
                  std::string("--set banks=") + bad + ": key 'banks' is '" + bad +
                      "', but must be an integer in decimal digits, 1 to 64.");
    }
    for (const char* bad : {"032", "0x20", "-4", "+4", "nan", "-inf", ".5e", ""}) {
        EXPECT_EQ(error_of("seed: 1", {std::string("memory.latency_ns=") + bad}),
                  std::string("--set memory.latency_ns=") + bad + ": key 'memory.latency_ns' is '" +
                      bad + "', but must be a finite decimal number, 0 to 1e+06.");
    }
}

TEST(ConfigSet, TellsSectionsFromValues) {
    EXPECT_EQ(error_of("banks: 4", {"memory=3"}),
              "--set memory=3: key 'memory' is a section; set one of its keys: latency_ns, "
              "access_bytes, refresh.");
    EXPECT_EQ(
        error_of("banks: 4", {"banks.size=3"}),
        "--set banks.size=3: key 'banks.size' is unknown, because 'banks' is a single value.");
}

TEST(ConfigSet, MustBePathEqualsValue) {
    for (const char* bad : {"banks", "", "=3", ".banks=3", "memory.=3", "memory..refresh=true"}) {
        EXPECT_EQ(error_of("banks: 4", {bad}),
                  std::string("--set '") + bad +
                      "': this is not an override; path.to.key=value is expected.");
    }
}

TEST(ConfigPlace, TellsWhatDecidesAKey) {
    const auto source = ConfigSource::from_text("a.yaml", "banks: 2\nmemory:\n  refresh: true\n",
                                                {"seed=4", "banks=3"});
    EXPECT_EQ(source.place("memory.refresh"), "a.yaml:3");
    EXPECT_EQ(source.place("memory"), "a.yaml:2");
    EXPECT_EQ(source.place("banks"), "--set banks=3");
    EXPECT_EQ(source.place("order"), "default");
    EXPECT_EQ(source.place("memory.refresh.rate"), "default");
}

/// A bus or banks; only one of them counts.
struct EitherMemory {
    bool banked = false;
    int width = 8;
    struct Banks {
        int count = 4;
        void describe(ConfigVisitor& v) { v.integer("count", count, 1, 64, "banks"); }
    } banks;
    void describe(ConfigVisitor& v) {
        v.boolean("banked", banked, "which one counts");
        v.integer("width", width, 1, 64, "of the bus");
        v.section("banks", banks, "of the other");
        if (banked) {
            v.unused("width", "banked", "banked is true");
        } else {
            v.unused("banks", "banked", "banked is false");
        }
    }
};

std::vector<std::string> warnings_of(const std::string& yaml,
                                     const std::vector<std::string>& overrides) {
    EitherMemory config;
    return ConfigSource::from_text("file.yaml", yaml, overrides).load(config);
}

using Sentences = std::vector<std::string>;

TEST(UnusedKeys, AreNamedWithTheirPlaceAndTheReason) {
    EXPECT_EQ(warnings_of("banked: true\nwidth: 4\n", {}),
              Sentences{"file.yaml:2: key 'width' has no effect, because banked is true."});
    EXPECT_EQ(warnings_of("banked: true\n", {"width=4"}),
              Sentences{"--set width=4: key 'width' has no effect, because banked is true."});
    EXPECT_EQ(
        warnings_of("width: 4\n", {"banks.count=2"}),
        Sentences{
            "--set banks.count=2: key 'banks.count' has no effect, because banked is false."});
}

TEST(UnusedKeys, AreNoMistakeIfAStrongerChoiceCameOverThem) {
    EXPECT_EQ(warnings_of("width: 4\n", {"banked=true"}), Sentences{});
    EXPECT_EQ(warnings_of("banked: true\n", {}), Sentences{});
    EXPECT_EQ(warnings_of("width: 4\n", {}), Sentences{});
}

/// `row` has no effect, but `rows` has.
struct TwoRows {
    int row = 4, rows = 4;
    void describe(ConfigVisitor& v) {
        v.integer("row", row, 1, 64, "the first");
        v.integer("rows", rows, 1, 64, "all");
        v.unused("row", "rows", "rows count");
    }
};

TEST(UnusedKeys, AreNotThoseWhoseNamesBeginAlike) {
    TwoRows config;
    EXPECT_EQ(ConfigSource::from_text("a.yaml", "rows: 5\n", {"row=4"}).load(config), Sentences{});
    EXPECT_EQ(ConfigSource::from_text("a.yaml", "rows: 5\n", {"row=5"}).load(config),
              Sentences{"--set row=5: key 'row' has no effect, because rows count."});
}

/// A key with the name of a section that is no more, and a text of which more is read.
struct Renewed {
    std::string rule = "plain";
    std::string rules_text = "none";
    ConfigOrigin origin;
    void describe(ConfigVisitor& v) {
        v.text("rule", rule, "how");
        v.text("rules_text", rules_text, "in words");
        v.replaced("rules", "rule says it");
        origin = v.origin("rule");
    }
};

TEST(ReplacedKeys, AreRefusedWithAdvice) {
    const auto sentence = [](const std::string& yaml, const std::vector<std::string>& overrides) {
        Renewed config;
        return sentence_of(
            [&] { ConfigSource::from_text("a.yaml", yaml, overrides).load(config); });
    };
    EXPECT_EQ(sentence("rule: x\nrules:\n  first: 1\n", {}),
              "a.yaml:2: key 'rules' is unknown; rule says it.");
    EXPECT_EQ(sentence("rule: x\n", {"rules.first=1"}),
              "--set rules.first=1: key 'rules.first' is unknown; rule says it.");
    EXPECT_EQ(sentence("rules_text: x\n", {}), "");
    EXPECT_EQ(sentence("rules_texts: x\n", {}),
              "a.yaml:1: key 'rules_texts' is unknown, did you mean 'rules_text'? (allowed at the "
              "top: rule, rules_text).");
}

TEST(ConfigOrigins, AreThePlaceAndTheFolderOfAText) {
    Renewed config;
    ConfigSource::from_text("some/folder/a.yaml", "rule: x\n").load(config);
    EXPECT_EQ(config.origin.place, "some/folder/a.yaml:1: key 'rule'");
    EXPECT_EQ(config.origin.folder, "some/folder");
    ConfigSource::from_text("some/folder/a.yaml", "rule: x\n", {"rule=y"}).load(config);
    EXPECT_EQ(config.origin.place, "--set rule=y: key 'rule'");
    EXPECT_EQ(config.origin.folder, "");
}

} // namespace
} // namespace degs::config_test
