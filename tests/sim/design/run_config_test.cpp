// SPDX-License-Identifier: Apache-2.0
#include <filesystem>

#include <gtest/gtest.h>

#include "baselines/gbu/config.hpp"
#include "config/config_document.hpp"
#include "modules/degs/config.hpp"
#include "sim/design/run_config.hpp"

namespace degs::sim {
namespace {

namespace fs = std::filesystem;

RunConfig load(const std::string& name) {
    return load_run_config(std::string(DEGS_CONFIGS) + "/" + name + ".yaml", {});
}

DegsConfig load_degs(const std::string& name) {
    return dynamic_cast<const DegsConfig&>(load(name).accelerator());
}

TEST(Configs, EveryFileLoads) {
    int files = 0;
    for (const auto& entry : fs::directory_iterator(DEGS_CONFIGS)) {
        if (!entry.is_regular_file()) {
            continue;
        }
        SCOPED_TRACE(entry.path());
        const RunConfig config = load_run_config(entry.path().string(), {});
        EXPECT_EQ(config.problem(), "");
        EXPECT_EQ(config.accelerator().name, entry.path().stem().string());
        ++files;
    }
    EXPECT_GE(files, 17);
}

TEST(Configs, AnyMemoryFileGoesUnderAnyAccelerator) {
    const std::string folder = std::string(DEGS_CONFIGS) + "/";
    const std::pair<const char*, double> memories[] = {
        {"6400x256", 204.8}, {"6400x128", 102.4}, {"3200x128", 51.2}};
    for (const auto& [memory, peak] : memories) {
        const RunConfig config =
            load_run_config(folder + "degs-64.yaml", {"memory.lpddr5.timing.rl=20"},
                            folder + "memory/lpddr5-" + memory + ".yaml");
        const auto& degs = dynamic_cast<const DegsConfig&>(config.accelerator());
        EXPECT_EQ(degs.memory.model, MemoryModel::Lpddr5);
        EXPECT_DOUBLE_EQ(degs.memory.peak_gb_per_s(), peak);
        EXPECT_EQ(degs.memory.lpddr5.timing.rl, 20);
    }
    EXPECT_THROW(load_run_config(folder + "degs-64.yaml", {}, folder + "degs-64.yaml"), InputError);
}

/// What the configuration's data path computes with.
DataPathOptions numbers_with(const std::vector<std::string>& assignments, const char* name) {
    return load_run_config(std::string(DEGS_CONFIGS) + "/" + name + ".yaml", assignments)
        .accelerator()
        .data_path();
}

TEST(Configs, FormatsOfSingleStages) {
    for (const char* name : {"degs-64", "gscore-64", "gbu-64", "gcc-64"}) {
        EXPECT_FALSE(numbers_with({"pipeline.numbers=paper"}, name).set.has_value());
        const DataPathOptions options =
            numbers_with({"pipeline.numbers=paper:alpha=uq1.15:exp.entries=32:q_mask=true"}, name);
        ASSERT_TRUE(options.set.has_value());
        EXPECT_EQ(options.set->alpha, parse_format("uq1.15"));
        EXPECT_EQ(options.set->exp.entries, 32);
        EXPECT_TRUE(options.set->q_mask);
        EXPECT_EQ(options.set->term, number_set("paper").term);
        EXPECT_EQ(options.set->sqrt.entries, number_set("paper").sqrt.entries);
    }
}

// What a run computes with is what `degs accuracy` calls by the set's name, span ends included.
TEST(Configs, DegsComputesInHardwareNumbers) {
    const std::pair<const char*, const char*> designs[] = {{"degs-16", "paper"},
                                                           {"degs-64", "paper"},
                                                           {"degs-256", "paper"},
                                                           {"degs-1024", "paper"},
                                                           {"degs-64-tuned", "tuned"}};
    for (const auto& [file, numbers] : designs) {
        SCOPED_TRACE(file);
        const DataPathOptions own = numbers_with({}, file);
        const DataPathOptions named = named_numbers(numbers);
        EXPECT_EQ(own.numbers, named.numbers);
        EXPECT_EQ(own.ends, named.ends);
        EXPECT_EQ(own.delta, named.delta);
        EXPECT_EQ(own.stop, named.stop);
        EXPECT_FALSE(own.set.has_value());
    }
}

void expect_refused(const std::vector<std::string>& assignments, const std::string& sentence) {
    try {
        numbers_with(assignments, "degs-64");
        ADD_FAILURE() << sentence;
    } catch (const InputError& error) {
        EXPECT_NE(std::string(error.what()).find(sentence), std::string::npos) << error.what();
    }
}

TEST(Configs, WrongNumbersAreNamed) {
    const std::string key = "key 'pipeline.numbers'";
    for (const std::string value : {"papr", "paper:alpha=q99", "paper:aplha=fp16"}) {
        expect_refused({"pipeline.numbers=" + value},
                       "--set pipeline.numbers=" + value + ": " + key);
    }
    expect_refused({"pipeline.numbers=papr"}, key + " is 'papr', but must be fp32, fp64, ideal, "
                                                    "fp16, paper, tuned, or a number file, whose "
                                                    "path has a dot or a slash (did you mean "
                                                    "'paper'?).");
    expect_refused({"pipeline.numbers=tuned:distance=uq18.12"},
                   key + ": distance=uq18.12: key 'distance' is 'uq18.12', but must have a sign; "
                         "q18.12 would do.");
    expect_refused({"pipeline.formats.alpha=uq1.15"},
                   "--set pipeline.formats.alpha=uq1.15: key 'pipeline.formats.alpha' is unknown; "
                   "parts of a number set stand behind its name, as in pipeline.numbers: "
                   "tuned:alpha=uq1.15, or in a number file that pipeline.numbers names.");
    // This also holds for a value that does not come from a file or a command line.
    RunConfig design;
    EXPECT_THROW(design.set("pipeline.numbers", "papr"), InputError);
    EXPECT_EQ(design.get("pipeline.numbers"), "fp32");
    design.set("pipeline.numbers", "tuned:records=fp32:guard=1.0");
    EXPECT_EQ(design.get("pipeline.numbers"), "tuned:guard=1");
}

TEST(Configs, Degs64IsTheDefaultButForItsNumbers) {
    const std::string file = std::string(DEGS_CONFIGS) + "/degs-64.yaml";
    const RunConfig single =
        load_run_config(file, {"pipeline.numbers=fp32", "pipeline.span_ends=outward",
                               "pixel_buffer.state_bytes=16"});
    EXPECT_EQ(resolved(single).dump(2), resolved(RunConfig{}).dump(2));
}

TEST(Configs, SixtyFourPesHaveTheMemoryOfTableI) {
    for (const char* name : {"degs-64", "degs-64-tuned"}) {
        EXPECT_EQ(load_degs(name).bill().sram_bytes(), 130 * 1024) << name;
        EXPECT_EQ(load_degs(name).pes(), 64) << name;
    }
    EXPECT_EQ(load_degs("degs-64").contexts(), 2);
    EXPECT_EQ(load_degs("degs-64-tuned").contexts(), 2);
}

// Table III, and two tile contexts as the Pixel Buffer scales with the PEs.
TEST(Configs, ScalingPointsAreThoseOfThePaper) {
    struct Row {
        int pes, tile, slicing, spans, banks, width, segments;
    };
    for (const Row& row : {Row{16, 16, 1, 4, 4, 4, 1}, Row{64, 32, 2, 8, 8, 8, 2},
                           Row{256, 64, 4, 16, 16, 16, 3}, Row{1024, 128, 8, 32, 32, 32, 4}}) {
        SCOPED_TRACE(row.pes);
        const DegsConfig config = load_degs("degs-" + std::to_string(row.pes));
        EXPECT_EQ(config.pes(), row.pes);
        EXPECT_EQ(config.tile_size, row.tile);
        EXPECT_EQ(config.slicing.count, row.slicing);
        EXPECT_EQ(config.span.count, row.spans);
        EXPECT_EQ(config.scheduler.banks, row.banks);
        EXPECT_EQ(config.array.pes_per_bank, row.width);
        EXPECT_EQ(config.scheduler.issue_width, row.segments);
        EXPECT_EQ(config.scheduler.segments_per_cycle, row.segments);
        EXPECT_EQ(config.pixel_buffer.bytes, row.pes * 256);
        EXPECT_EQ(config.contexts(), 2);
        EXPECT_EQ(config.span_lane_depth(), 32);
        EXPECT_EQ(config.feature_entries(), 64);
    }
}

/// Tiles in flight of `design` whose Pixel Buffer, at `buffer`, has `bytes` and as many bits per
/// pixel as the numbers need.
int contexts_of(const std::string& design, const std::string& buffer, std::int64_t bytes,
                std::vector<std::string> changes) {
    changes.push_back(buffer + ".state_bytes=0");
    changes.push_back(buffer + ".bytes=" + std::to_string(bytes));
    return load_run_config(std::string(DEGS_CONFIGS) + "/" + design + ".yaml", changes)
        .accelerator()
        .tile_contexts();
}

// T and three colours: 4 x 32, 4 x 64, 4 x 16 bits, 18 + 3 x 22 bits with `tuned`, and 3 x 26 bits
// with other sums.
TEST(Configs, PixelStateIsAsWideAsItsNumbersNeed) {
    struct Numbers {
        const char* change;
        std::int64_t bits;
    };
    struct Design {
        const char *name, *buffer;
        int side;
    };
    for (const Design& design :
         {Design{"degs-64", "pixel_buffer", 32}, Design{"gscore-64", "pixel_buffer", 16},
          Design{"gbu-64", "pixel_buffer", 32}, Design{"gcc-64", "image_buffer", 128}}) {
        for (const Numbers& numbers : {Numbers{"numbers=fp32", 128}, Numbers{"numbers=fp64", 256},
                                       Numbers{"numbers=ideal", 256}, Numbers{"numbers=fp16", 64},
                                       Numbers{"numbers=paper", 64}, Numbers{"numbers=tuned", 84},
                                       Numbers{"numbers=paper:sum=q6.20", 3 * 26 + 16}}) {
            const std::string change = std::string("pipeline.") + numbers.change;
            SCOPED_TRACE(std::string(design.name) + " " + change);
            const std::int64_t four = 4 * numbers.bits * design.side * design.side / 8;
            EXPECT_EQ(contexts_of(design.name, design.buffer, four, {change}), 4);
            EXPECT_LT(contexts_of(design.name, design.buffer, four - 1, {change}), 4);
        }
    }
    EXPECT_EQ(contexts_of("degs-64", "pixel_buffer", 16384, {}), 2);
    EXPECT_EQ(contexts_of("degs-64-tuned", "pixel_buffer", 32768, {}), 3);
    EXPECT_EQ(contexts_of("degs-64-tuned", "pixel_buffer", 3 * 10752 - 1, {}), 2);
}

TEST(Configs, BufferBelowOnePixelStateIsNamedWithTheNumbers) {
    try {
        contexts_of("degs-64", "pixel_buffer", 8191, {"pipeline.numbers=paper"});
        ADD_FAILURE();
    } catch (const InputError& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("must be at least 8192 to hold 1 tile of 32 x 32 px"),
                  std::string::npos)
            << text;
        EXPECT_NE(text.find("pipeline.numbers is 'paper'"), std::string::npos) << text;
    }
}

// DeGS paper, Table I: SRAM at 64 PEs; it is shaded and so follows the PEs.
TEST(Configs, GbuHasTheMemoryOfTableI) {
    for (const int pes : {16, 64, 256, 1024}) {
        SCOPED_TRACE(pes);
        const RunConfig loaded = load("gbu-" + std::to_string(pes));
        const auto& config = dynamic_cast<const gbu::Config&>(loaded.accelerator());
        if (pes == 64) {
            EXPECT_EQ(resolved(config).dump(2), resolved(gbu::Config{}).dump(2));
        }
        EXPECT_EQ(config.pes(), pes);
        EXPECT_EQ(config.engines.row_pes, config.tile_size);
        EXPECT_EQ(config.contexts(), pes <= 64 ? 2 : 1);
        const std::int64_t bytes = config.bill().sram_bytes();
        EXPECT_LE(bytes, 91 * 1024 * pes / 64);
        EXPECT_GE(bytes, 0.85 * 91 * 1024 * pes / 64);
    }
}

} // namespace
} // namespace degs::sim
