// SPDX-License-Identifier: Apache-2.0
// The rules between keys: each is broken once, and what its sentence proposes must mend it.
#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>

#include <gtest/gtest.h>

#include "degs/error.hpp"
#include "sim/design/run_config.hpp"

namespace degs::sim {
namespace {

struct Broken {
    std::string design;
    std::vector<std::string> overrides;
    std::string key; ///< to change
};

std::ostream& operator<<(std::ostream& out, const Broken& broken) {
    return out << broken.design << " " << broken.key << " " << broken.overrides.front();
}

/// Every row of the cost model with less power than its area leaks.
std::vector<Broken> broken_rows() {
    std::vector<Broken> rows;
    for (const char* row : {"degs.projection",
                            "degs.sorting",
                            "degs.span_engine",
                            "degs.packing_scheduler",
                            "degs.blending",
                            "degs.gaussian_buffer",
                            "degs.feature_buffer",
                            "degs.span_buffer",
                            "degs.packing_buffer",
                            "degs.pixel_buffer",
                            "gscore.preprocessing",
                            "gscore.blending",
                            "gscore.sram",
                            "gbu.preprocessing",
                            "gbu.blending",
                            "gbu.scheduler",
                            "gbu.sram",
                            "gcc.preprocessing",
                            "gcc.blending",
                            "gcc.sram",
                            "orange.array",
                            "orange.vector_unit",
                            "orange.sram"}) {
        const std::string name = row;
        const std::string kind = name.substr(0, name.find('.'));
        const std::string key = "cost." + name + ".power_w";
        rows.push_back({kind + (kind == "orange" ? "-o4" : "-64"), {key + "=0"}, key});
    }
    // The area of the preprocessing is that of the vector units.
    const std::string shared = "cost.orange.preprocessing.";
    rows.push_back(
        {"orange-o4", {shared + "power_w=0", shared + "area_mm2=1"}, shared + "power_w"});
    return rows;
}

std::vector<Broken> make_broken_rules() {
    const std::string lpddr5 = "memory.lpddr5.";
    std::vector<Broken> all = {
        {"degs-64", {"slicing.distribution=broadcast", "slicing.count=3"}, "slicing.count"},
        {"degs-64", {"slicing.distribution=broadcast", "span.count=7"}, "slicing.count"},
        {"degs-64", {"scheduler.reuse_cycles=2"}, "scheduler.reuse_cycles"},
        {"degs-64", {"pixel_buffer.bytes=8191"}, "pixel_buffer.bytes"},
        {"degs-64",
         {"tile_size=4", "pixel_buffer.state_bytes=1", "pixel_buffer.bytes=1073741824"},
         "pixel_buffer.bytes"},
        {"degs-64",
         {"pixel_buffer.state_bytes=0", "pixel_buffer.bytes=8191"},
         "pixel_buffer.bytes"},
        {"degs-64", {"span_buffer.bytes=63"}, "span_buffer.bytes"},
        {"degs-64",
         {"gaussian_buffer.sort_share=0.95", "fetching.chunk=256"},
         "gaussian_buffer.bytes"},
        {"degs-64",
         {"gaussian_buffer.bytes=300", "gaussian_buffer.sort_share=0.05", "fetching.chunk=1"},
         "gaussian_buffer.bytes"},
        {"degs-64", {"feature_buffer.bytes=100"}, "feature_buffer.bytes"},
        {"degs-64", {"feature_buffer.bytes=1073741824"}, "feature_buffer.bytes"},
        {"degs-64", {"packing.lead_packets=2"}, "packing.lead_packets"},
        {"degs-64",
         {"packing.lead_packets=8", "pixel_buffer.ports=1", "pixel_buffer.sram_banks=2"},
         "packing.lead_packets"},
        {"degs-64",
         {"slicing.interleave=2", "pixel_buffer.bytes=32768", "slicing.count=1"},
         "slicing.interleave"},
        {"degs-64",
         {"slicing.distribution=broadcast_skip", "slicing.interleave=2", "slicing.count=6"},
         "slicing.count"},
        {"degs-64", {"slicing.interleave=2", "pixel_buffer.bytes=16383"}, "pixel_buffer.bytes"},
        {"degs-64",
         {"slicing.interleave=2", "pixel_buffer.bytes=32768", "feature_buffer.bytes=200"},
         "feature_buffer.bytes"},
        {"degs-64", {"front.splats_per_cycle=4", "front.fifo_splats=16"}, "front.fifo_splats"},
        {"degs-64", {"span.rows_per_cycle=2", "span.cycles_per_row=3"}, "span.rows_per_cycle"},
        {"degs-64", {"packing.bytes=4096"}, "packing.bytes"},
        {"degs-64", {"scheduler.banks=64"}, "packing.bytes"},
        {"degs-64",
         {"pipeline.numbers=paper:sh_rest=q1.15", "traffic.sh_value_bytes=1"},
         "traffic.sh_value_bytes"},
        {"gcc-64",
         {"pipeline.numbers=fp32:sh_dc=q3.5:sh_rest=q8.9", "traffic.sh_value_bytes=2"},
         "traffic.sh_value_bytes"},
        {"degs-64", {"traffic.geometry_bytes=21"}, "traffic.geometry_bytes"},
        {"gscore-64",
         {"pipeline.records=fp32", "traffic.geometry_bytes=43"},
         "traffic.geometry_bytes"},
        {"gcc-64", {"traffic.mean_bytes=5"}, "traffic.mean_bytes"},
        {"gcc-64",
         {"pipeline.numbers=fp32:gaussian_rotation=q1.17", "traffic.shape_bytes=16"},
         "traffic.shape_bytes"},
        {"gscore-64", {"array.subtiles=3"}, "array.subtiles"},
        {"gbu-64",
         {"pipeline.numbers=fp32:depth_key=ue4m12b3", "traffic.list_entry_bytes=3"},
         "traffic.list_entry_bytes"},
        {"degs-64", {"cost.leakage_mw_per_mm2=30"}, "cost.degs.span_buffer.power_w"},
        {"gbu-64", {"cost.logic.pe.power_w=0.0001"}, "cost.logic.pe.power_w"},
        {"gscore-64", {"array.lanes=100"}, "array.lanes"},
        {"gscore-64", {"array.clusters=3"}, "array.clusters"},
        {"gscore-16",
         {"clusters=64", "pixel_buffer.bytes=2100000", "buffer.bytes=4000000"},
         "pixel_buffer.bytes"},
        {"gscore-64", {"pixel_buffer.bytes=15"}, "pixel_buffer.bytes"},
        {"gscore-64", {"pixel_buffer.bytes=300000"}, "buffer.bytes"},
        {"gscore-64", {"buffer.bytes=8500", "buffer.sort_share=0.9"}, "buffer.bytes"},
        {"gscore-64", {"buffer.bytes=16000", "buffer.sort_share=0.05"}, "buffer.bytes"},
        {"gbu-64", {"engines.row_pes=33"}, "engines.row_pes"},
        {"gbu-64", {"pixel_buffer.bytes=8192"}, "pixel_buffer.bytes"},
        {"gbu-64", {"list_buffer.bytes=16"}, "list_buffer.bytes"},
        {"gbu-64", {"reuse_cache.bytes=63"}, "reuse_cache.bytes"},
        {"gcc-64", {"image_buffer.bytes=1000"}, "image_buffer.bytes"},
        {"gcc-64", {"view_size=4", "image_buffer.bytes=1073741824"}, "image_buffer.bytes"},
        {"gcc-64", {"array.window=1"}, "array.window"},
        {"gcc-64", {"colour.block=1"}, "colour.block"},
        {"gcc-64", {"projection.group=4096"}, "group_buffer_bytes"},
        {"orange-o4", {"pixel_buffer.bytes=64"}, "pixel_buffer.bytes"},
        {"orange-o4", {"scratchpad.bytes=1024"}, "scratchpad.bytes"},
        {"orange-o4", {"fetching.chunk=1024"}, "scratchpad.bytes"},
        {"degs-64", {lpddr5 + "channels=3"}, lpddr5 + "channels"},
        {"degs-64", {lpddr5 + "timing.bank_mode=16b"}, lpddr5 + "timing.bank_mode"},
        {"degs-64", {lpddr5 + "timing.burst_length=24"}, lpddr5 + "timing.burst_length"},
        {"degs-64", {lpddr5 + "timing.burst_length=32"}, lpddr5 + "timing.burst_length"},
        {"degs-64", {lpddr5 + "timing.banks=24"}, lpddr5 + "timing.banks"},
        {"degs-64", {lpddr5 + "timing.beats_per_ck=3"}, lpddr5 + "timing.beats_per_ck"},
        {"degs-64", {lpddr5 + "timing.page_bytes=3000"}, lpddr5 + "timing.page_bytes"},
        {"degs-64", {lpddr5 + "timing.burst_data_bytes=64"}, lpddr5 + "timing.burst_data_bytes"},
        {"degs-64", {lpddr5 + "timing.rows=1025"}, lpddr5 + "timing.rows"},
        {"degs-64", {lpddr5 + "timing.wl=200"}, lpddr5 + "timing.wl"},
        {"degs-64", {lpddr5 + "timing.refi=100"}, lpddr5 + "timing.refi"},
        {"degs-64", {lpddr5 + "timing.pbr2pbr=4000"}, lpddr5 + "timing.refi"},
        {"degs-64", {lpddr5 + "mapping.interleave_bytes=100"}, lpddr5 + "mapping.interleave_bytes"},
        {"degs-64", {lpddr5 + "mapping.order=row"}, lpddr5 + "mapping.order"},
        {"degs-64", {lpddr5 + "controller.write_low=0.9"}, lpddr5 + "controller.write_low"},
    };
    const std::vector<Broken> rows = broken_rows();
    all.insert(all.end(), rows.begin(), rows.end());
    return all;
}

const std::vector<Broken>& broken_rules() {
    static const std::vector<Broken> all = make_broken_rules();
    return all;
}

std::string sentence_of(const std::string& design, const std::vector<std::string>& overrides) {
    try {
        load_run_config(std::string(DEGS_CONFIGS) + "/" + design + ".yaml", overrides);
    } catch (const InputError& error) {
        return error.what();
    }
    return "";
}

/// The value that a sentence proposes.
std::string proposal(const std::string& sentence) {
    for (const char* form : {"; ([^;,]*?)(?:(?:,| or ).*)? would do", "must be at least ([0-9]+)",
                             "but must be ([0-9]+)"}) {
        std::smatch found;
        if (std::regex_search(sentence, found, std::regex(form))) {
            return found[1];
        }
    }
    return "";
}

class ConfigRules : public testing::TestWithParam<Broken> {};

TEST_P(ConfigRules, AreMendedByWhatTheirSentenceProposes) {
    Broken broken = GetParam();
    const std::string sentence = sentence_of(broken.design, broken.overrides);
    EXPECT_NE(sentence.find(": key '" + broken.key + "' is "), std::string::npos) << sentence;
    EXPECT_NE(sentence.find(", but must "), std::string::npos) << sentence;
    EXPECT_LE(sentence.size(), 400U) << sentence;
    const std::string value = proposal(sentence);
    ASSERT_FALSE(value.empty()) << sentence;
    broken.overrides.push_back(broken.key + "=" + value);
    EXPECT_EQ(sentence_of(broken.design, broken.overrides), "") << sentence;
}
INSTANTIATE_TEST_SUITE_P(All, ConfigRules, testing::ValuesIn(broken_rules()));

TEST(ConfigRuleSentences, NameBothLines) {
    const std::string file = std::string(DEGS_CONFIGS) + "/degs-64.yaml";
    const std::string sentence =
        sentence_of("degs-64", {"slicing.distribution=broadcast", "slicing.count=3"});
    EXPECT_EQ(sentence.find("--set slicing.count=3: key 'slicing.count' is 3, but must divide "
                            "span.count; 2 would do (span.count is 8 at " +
                            file + ":"),
              0U)
        << sentence;
}

/// Notes the keys that rules stand at.
class RuleKeys : public ConfigVisitor {
public:
    void begin_section(const char* key, const char*) override {
        path_.push_back(path_.back() + key + ".");
    }
    void end_section() override { path_.pop_back(); }
    void integer(const char*, std::int64_t&, std::int64_t, std::int64_t, const char*) override {}
    void real(const char*, double&, double, double, const char*) override {}
    void boolean(const char*, bool&, const char*) override {}
    void text(const char*, std::string&, const char*) override {}
    void choice(const char*, int&, const std::vector<const char*>&, const char*) override {}
    void require(bool, const ConfigRule& rule) override { keys.insert(path_.back() + rule.key); }
    void advise(bool, const ConfigRule& rule) override { advised.insert(path_.back() + rule.key); }
    void advise_if_set(bool, const ConfigRule& rule) override {
        advised.insert(path_.back() + rule.key);
    }
    std::set<std::string> keys, advised;

private:
    std::vector<std::string> path_{""};
};

// One rule says a formula in place of a value that would do, so that its sentence proposes none.
TEST(ConfigRuleSentences, EveryRuleIsInTheListAbove) {
    const std::string kRuleOfAFormula = "pipeline.rules.sigma_beta";
    EXPECT_NE(
        sentence_of("degs-64", {"pipeline.rules.sigma_alpha=0.1"})
            .find("key '" + kRuleOfAFormula + "' is 2 by default, but must be at least alpha"),
        std::string::npos);
    for (const char* design : {"degs-64", "gscore-64", "gbu-64", "gcc-64", "orange-o4"}) {
        RunConfig config = load_run_config(std::string(DEGS_CONFIGS) + "/" + design + ".yaml", {});
        RuleKeys rules;
        config.describe(rules);
        EXPECT_GT(rules.keys.size(), 8U);
        for (const std::string& key : rules.keys) {
            const auto& list = broken_rules();
            const bool tested = std::any_of(
                list.begin(), list.end(), [&](const Broken& broken) { return broken.key == key; });
            EXPECT_TRUE(tested || key == kRuleOfAFormula) << design << " " << key;
        }
    }
}

/// What is advised against: a design that runs with a warning.
struct Unbalanced {
    std::string design;
    std::vector<std::string> overrides;
    std::string key; ///< of the warning
};

const std::vector<Unbalanced>& advice() {
    static const std::vector<Unbalanced> all = {
        {"degs-1024", {"scheduler.issue_width=1"}, "scheduler.issue_width"},
        {"degs-1024", {"scheduler.segments_per_cycle=1"}, "scheduler.segments_per_cycle"},
        {"degs-64", {"span.count=1"}, "span.count"},
        {"degs-64", {"slicing.rows_per_cycle=3"}, "slicing.rows_per_cycle"},
        {"degs-64",
         {"scheduler.reuse_cycles=64", "scheduler.queue_segments_per_pe=3"},
         "scheduler.queue_segments_per_pe"},
        {"degs-64-tuned",
         {"scheduler.reuse_cycles=64", "scheduler.queue_segments_per_pe=0", "packing.bytes=8000"},
         "packing.bytes"},
        {"degs-64", {"packing.bytes=65536"}, "packing.bytes"},
        {"degs-64", {"pixel_buffer.bytes=20000"}, "pixel_buffer.bytes"},
        {"degs-64", {"pixel_buffer.readout_pixels=65"}, "pixel_buffer.readout_pixels"},
        {"degs-1024",
         {"pixel_buffer.rows_per_cycle=1", "pixel_buffer.readout_pixels=129"},
         "pixel_buffer.readout_pixels"},
        {"gscore-64", {"pixel_buffer.readout_pixels=4096"}, "pixel_buffer.readout_pixels"},
        {"gbu-64", {"pixel_buffer.readout_pixels=4096"}, "pixel_buffer.readout_pixels"},
        {"orange-o4", {"pixel_buffer.readout_pixels=65"}, "pixel_buffer.readout_pixels"},
        {"gcc-64", {"image_buffer.readout_pixels=4096"}, "image_buffer.readout_pixels"},
        {"gscore-64", {"pixel_buffer.bytes=9000"}, "pixel_buffer.bytes"},
        {"gbu-64", {"pixel_buffer.bytes=40000"}, "pixel_buffer.bytes"},
        {"gcc-64", {"image_buffer.bytes=140000"}, "image_buffer.bytes"},
    };
    return all;
}

std::vector<std::string> warnings_of(const std::string& design,
                                     const std::vector<std::string>& overrides) {
    return load_run_config(std::string(DEGS_CONFIGS) + "/" + design + ".yaml", overrides).warnings;
}

TEST(ConfigAdvice, NamesTheKey) {
    for (const Unbalanced& unbalanced : advice()) {
        const auto warnings = warnings_of(unbalanced.design, unbalanced.overrides);
        ASSERT_EQ(warnings.size(), 1U) << unbalanced.design << " " << unbalanced.key;
        EXPECT_NE(warnings.front().find(": key '" + unbalanced.key + "' is "), std::string::npos)
            << warnings.front();
        EXPECT_LE(warnings.front().size(), 400U) << warnings.front();
    }
}

TEST(ConfigAdvice, HasNothingToSayOfShippedDesigns) {
    for (const auto& entry : std::filesystem::directory_iterator(DEGS_CONFIGS)) {
        if (entry.is_regular_file()) {
            EXPECT_EQ(load_run_config(entry.path().string(), {}).warnings,
                      std::vector<std::string>{});
        }
    }
}

TEST(ConfigAdvice, IsAllInTheListAbove) {
    for (const char* design : {"degs-64", "gscore-64", "gbu-64", "gcc-64", "orange-o4"}) {
        RunConfig config = load_run_config(std::string(DEGS_CONFIGS) + "/" + design + ".yaml", {});
        RuleKeys advised;
        config.describe(advised);
        for (const std::string& key : advised.advised) {
            const auto& list = advice();
            EXPECT_TRUE(std::any_of(list.begin(), list.end(), [&](const Unbalanced& unbalanced) {
                return unbalanced.key == key;
            })) << key;
        }
    }
}

// A key that another one makes idle, in every block that has one.
TEST(ConfigAdvice, NamesIdleKeys) {
    const std::pair<const char*, const char*> idle[] = {
        {"degs-64", "slicing.feedback_cycles=7"},   {"degs-64", "gaussian_buffer.sram_banks=2"},
        {"degs-64", "feature_buffer.sram_banks=2"}, {"degs-64", "pixel_buffer.sram_banks=2"},
        {"degs-64-tuned", "pipeline.span_delta=2"},
    };
    for (const auto& [design, assignment] : idle) {
        const auto warnings = warnings_of(design, {assignment});
        ASSERT_EQ(warnings.size(), 1U) << assignment;
        EXPECT_NE(warnings.front().find("has no effect, because"), std::string::npos);
    }
    EXPECT_EQ(warnings_of("gbu-64", {"monitor.cancel=false", "monitor.latency_cycles=9"}).size(),
              1U);
    EXPECT_EQ(warnings_of("degs-64", {"memory.model=lpddr5", "memory.lpddr5.controller.qos_step=9"})
                  .size(),
              1U);
    EXPECT_EQ(warnings_of("gcc-64", {"colour.skip_ended=false", "colour.block=16",
                                     "colour.feedback_cycles=9"})
                  .size(),
              2U);
}

} // namespace
} // namespace degs::sim
