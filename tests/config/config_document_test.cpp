// SPDX-License-Identifier: Apache-2.0
#include <limits>

#include "config/config_document.hpp"
#include "config/config_source.hpp"
#include "config_fixture.hpp"

namespace degs::config_test {
namespace {

TEST(ConfigResolved, IsNestedTypedAndNamesChoices) {
    Keys keys;
    keys.order = Order::hilbert;
    EXPECT_EQ(resolved(keys).dump(),
              R"({"banks":8,"seed":1,"order":"hilbert","title":"default","memory":)"
              R"({"latency_ns":100.5,"access_bytes":64,"refresh":true}})");
}

TEST(ConfigResolved, YamlIsReadableAndLoadsBack) {
    Keys keys;
    EXPECT_EQ(resolved_yaml(keys),
              "banks: 8  # Issue Banks\n"
              "seed: 1  # of the random numbers\n"
              "order: morton  # of the tiles; morton: a Z curve; hilbert: a curve without jumps\n"
              "title: \"default\"  # for the report\n"
              "memory:  # the memory behind the accelerator\n"
              "  latency_ns: 100.5  # ns, request to last byte\n"
              "  access_bytes: 64  # bytes, granularity\n"
              "  refresh: true  # whether | rows are refreshed\n");
    keys.seed = std::numeric_limits<std::int64_t>::min();
    keys.memory.latency_ns = 1.0 / 3.0;
    keys.title = "a \"b\"\n\\ : # \t\x01 caf\xc3\xa9";
    Keys back;
    ConfigSource::from_text("r.yaml", resolved_yaml(keys)).load(back);
    EXPECT_EQ(back.seed, keys.seed);
    EXPECT_EQ(back.memory.latency_ns, keys.memory.latency_ns);
    EXPECT_EQ(back.title, keys.title);
    EXPECT_EQ(resolved(back), resolved(keys));
}

TEST(ConfigDocument, ListsEveryKeyWithItsRange) {
    const std::vector<KeyDoc> keys = document(Keys());
    ASSERT_EQ(keys.size(), 8U);
    EXPECT_EQ(keys[0].path, "banks");
    EXPECT_EQ(keys[0].type, "integer");
    EXPECT_EQ(keys[0].default_value, "8");
    EXPECT_EQ(keys[0].allowed, "1 to 64");
    EXPECT_EQ(keys[0].doc, "Issue Banks");
    EXPECT_EQ(keys[1].allowed, "any");
    EXPECT_EQ(keys[2].default_value, "morton");
    EXPECT_EQ(keys[2].allowed, "row-major, morton, hilbert");
    EXPECT_EQ(keys[4].path, "memory");
    EXPECT_EQ(keys[4].type, "section");
    EXPECT_EQ(keys[5].path, "memory.latency_ns");
    EXPECT_EQ(keys[5].allowed, "0 to 1e+06");
    EXPECT_EQ(keys[7].allowed, "true, false");
}

TEST(ConfigDocument, MarkdownEscapesItsSeparator) {
    std::vector<KeyDoc> keys = document(Keys());
    keys.erase(keys.begin() + 1, keys.end() - 1);
    EXPECT_EQ(markdown_table(keys),
              "| Key | Default | Allowed | Meaning |\n|---|---|---|---|\n"
              "| `banks` | `8` | 1..64 | Issue Banks |\n"
              "| `memory.refresh` | `true` | true, false | whether \\| rows are "
              "refreshed |\n");
}

TEST(ConfigDocument, MarkdownHasNoRowForASection) {
    const std::string table = markdown_table(document(Keys()));
    EXPECT_NE(table.find("| `memory.latency_ns` |"), std::string::npos) << table;
    EXPECT_EQ(table.find("| `memory` |"), std::string::npos) << table;
}

struct OpenRanges {
    double positive = 1;
    int below = 0;
    void describe(ConfigVisitor& v) {
        v.real("positive", positive, 0, std::numeric_limits<double>::infinity(), "");
        v.integer("below", below, std::numeric_limits<int>::min(), 9, "");
    }
};

TEST(ConfigDocument, BoundsAtTheEndOfTheTypeAreNone) {
    const std::vector<KeyDoc> keys = document(OpenRanges());
    EXPECT_EQ(keys[0].allowed, "at least 0");
    EXPECT_EQ(keys[1].allowed, "at most 9");
}

struct TwiceNamed {
    int a = 1, b = 2;
    void describe(ConfigVisitor& v) {
        v.integer("same", a, 0, 9, "");
        v.integer("same", b, 0, 9, "");
    }
};

TEST(ConfigDocument, StructThatNamesAKeyTwiceIsAProgrammingError) {
    TwiceNamed twice;
    EXPECT_THROW(ConfigSource::from_overrides().load(twice), std::logic_error);
}

} // namespace
} // namespace degs::config_test
