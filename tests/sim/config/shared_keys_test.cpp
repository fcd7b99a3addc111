// SPDX-License-Identifier: Apache-2.0
// degs config --keys: what all accelerators have in common is listed once.
#include <set>

#include "config/config_document.hpp"
#include "sim/config/shared_keys.hpp"
#include "sim/simulation/run_config.hpp"
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
        std::set<std::string> both = paths(keys(name, "shared"));
        const std::set<std::string> own = paths(keys(name, "own"));
        const std::size_t size = both.size() + own.size();
        both.insert(own.begin(), own.end());
        EXPECT_EQ(both.size(), size) << name << ": a key stands in both parts";
        EXPECT_EQ(both, paths(keys(name, "all"))) << name;
    }
}

TEST(SharedKeys, ADefaultOfItsOwnMakesAKeyTheAccelerators) {
    EXPECT_EQ(paths(keys("gbu", "shared")).count("memory.bandwidth_gb_per_s"), 1U);
    EXPECT_EQ(paths(keys("gbu", "shared")).count("projection.latency_cycles"), 0U);
    for (const std::string& name : sim::accelerator_names()) {
        EXPECT_EQ(paths(keys(name, "own")).count("projection.latency_cycles"), 1U) << name;
    }
}

TEST(SharedKeys, OfAFileHaveItsValues) {
    const Outcome file = degs({"config", config("degs-64"), "--set",
                               "memory.bandwidth_gb_per_s=12.5", "--keys", "shared"});
    EXPECT_EQ(file.code, 0) << file.err;
    EXPECT_NE(file.out.find("memory.bandwidth_gb_per_s = 12.5\n"), std::string::npos);
    EXPECT_EQ(file.out.find("span.count"), std::string::npos);
    const Outcome yaml = degs({"config", "gbu", "--keys", "own", "--format", "yaml"});
    EXPECT_EQ(yaml.code, 2);
    EXPECT_NE(yaml.err.find("--keys has the formats text and markdown"), std::string::npos);
}

} // namespace
} // namespace degs::sim_test
