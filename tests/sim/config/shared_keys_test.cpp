// SPDX-License-Identifier: Apache-2.0
// degs config --keys: what all accelerators have in common is listed once.
#include <set>

#include "config/config_document.hpp"
#include "sim/config/shared_keys.hpp"
#include "sim/design/run_config.hpp"
#include "splat/numbers/number_set.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

std::vector<KeyDoc> keys(const std::string& accelerator, const std::string& part) {
    return sim::keys_of_part(document(sim::default_run_config(accelerator, {})), part);
}

std::set<std::string> paths(const std::vector<KeyDoc>& keys) {
    std::set<std::string> found;
    for (const KeyDoc& key : keys) {
        found.insert(key.path);
    }
    return found;
}

TEST(SharedKeys, AreTheSameTableForEveryAccelerator) {
    const std::string first = markdown_table(keys("degs", "shared"));
    for (const std::string& name : sim::accelerator_names()) {
        EXPECT_EQ(markdown_table(keys(name, "shared")), first) << name;
    }
}

TEST(SharedKeys, MakeUpAllKeysWithThoseOfAnAccelerator) {
    for (const std::string& name : sim::accelerator_names()) {
        std::set<std::string> together;
        std::size_t size = 0;
        for (const char* part : {"shared", "similar", "own", "cost"}) {
            const std::set<std::string> found = paths(keys(name, part));
            size += found.size();
            together.insert(found.begin(), found.end());
        }
        EXPECT_EQ(together.size(), size) << name << ": a key stands in two parts";
        EXPECT_EQ(together, paths(keys(name, "all"))) << name;
    }
}

TEST(SharedKeys, ADefaultOfItsOwnMakesAKeySimilar) {
    EXPECT_EQ(paths(keys("gbu", "shared")).count("memory.bandwidth_gb_per_s"), 1U);
    EXPECT_EQ(paths(keys("gbu", "shared")).count("projection.latency_cycles"), 0U);
    for (const std::string& name : sim::accelerator_names()) {
        EXPECT_EQ(paths(keys(name, "similar")).count("projection.latency_cycles"), 1U) << name;
    }
}

TEST(SharedKeys, SimilarOnesHaveADefaultForEachAcceleratorThatHasThem) {
    const std::string table = sim::similar_keys_markdown();
    EXPECT_EQ(table.rfind("| Key | degs | gscore | gbu | gcc | orange | Allowed | Meaning |\n", 0),
              0U);
    EXPECT_NE(table.find("\n| `projection.latency_cycles` | `32` | `128` | `128` | `32` | `128` | "
                         "1..4096 |"),
              std::string::npos)
        << table;
    EXPECT_EQ(table.find("| `span.count`"), std::string::npos) << "DeGS alone has it";
    EXPECT_EQ(table.find("| `memory.bandwidth_gb_per_s`"), std::string::npos) << "it is shared";
}

TEST(SharedKeys, CostsAreARowForEachBlock) {
    const std::string table = sim::cost_keys_markdown();
    EXPECT_NE(table.find("\n| `cost.degs.span_engine` | 0.17 | 0.09 | 10 | | | | | "),
              std::string::npos)
        << table;
    EXPECT_NE(
        table.find("\n| `cost.degs.packing_buffer` | 0.16 | 0.02 | | 32768 | 2240 | 2 | 1 | "),
        std::string::npos)
        << table;
    EXPECT_EQ(paths(keys("degs", "own")).count("cost.degs.span_engine.area_mm2"), 0U);
    EXPECT_EQ(paths(keys("degs", "own")).count("cost.degs.segment_queue"), 1U);
}

TEST(SharedKeys, OfAFileHaveItsValues) {
    const Outcome file = degs({"config", config("degs-64"), "--set",
                               "memory.bandwidth_gb_per_s=12.5", "--keys", "shared"});
    EXPECT_EQ(file.code, 0) << file.err;
    EXPECT_NE(file.out.find("memory.bandwidth_gb_per_s = 12.5\n"), std::string::npos);
    EXPECT_EQ(file.out.find("span.count"), std::string::npos);
    const Outcome yaml = degs({"config", "gbu", "--keys", "own", "--format", "yaml"});
    EXPECT_EQ(yaml.code, 2);
    EXPECT_NE(
        yaml.err.find("--format yaml writes all keys, so it cannot be combined with --keys own."),
        std::string::npos);
}

// The parts of a number set are those of NumberSet::describe, with the values of the design's set.
TEST(NumberKeys, AreThePartsOfTheDesignsSet) {
    const Outcome parts =
        degs({"config", config("degs-64-tuned"), "--set", "pipeline.numbers=tuned:alpha=uq1.15",
              "--keys", "numbers", "--format", "markdown"});
    EXPECT_EQ(parts.code, 0) << parts.err;
    EXPECT_EQ(parts.out, markdown_table(document(number_set("tuned", {"alpha=uq1.15"}))));
    EXPECT_NE(parts.out.find("\n| `alpha` | `\"uq1.15\"` | number format | "), std::string::npos)
        << parts.out;
    const Outcome text = degs({"config", "gscore", "--keys", "numbers"});
    EXPECT_EQ(text.code, 0) << text.err;
    EXPECT_EQ(text.out.rfind("projection = \"fp64\"\n    format: all that makes splats ", 0), 0U)
        << text.out;
    EXPECT_NE(text.out.find("\nexp.entries = 0\n"), std::string::npos);
}

} // namespace
} // namespace degs::sim_test
