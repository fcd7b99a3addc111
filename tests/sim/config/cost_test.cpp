// SPDX-License-Identifier: Apache-2.0
// Area and power of the shipped designs against Tables I and III, and how they follow the keys.
#include <cmath>
#include <set>

#include "sim/config/cost_output.hpp"
#include "sim/design/run_config.hpp"
#include "tests/sim/process/child.hpp"

namespace degs::sim_test {
namespace {

using cost::BillOfMaterials;

BillOfMaterials bill_of(const std::string& design, const std::vector<std::string>& overrides = {}) {
    return sim::load_run_config(config(design), overrides).accelerator().bill();
}

/// A row of Table I, and the blocks that it stands for.
struct TableRow {
    const char* design;
    std::vector<const char*> blocks;
    double mm2, watts, kilobytes;
    int decimals; ///< of the power
};

const std::vector<TableRow>& table_one() {
    static const std::vector<TableRow> rows{
        {"degs-64", {"projection"}, 0.92, 0.60, 0, 2},
        {"degs-64", {"sorting"}, 0.02, 0.01, 0, 2},
        {"degs-64", {"slicing", "span"}, 0.17, 0.09, 0, 2},
        {"degs-64", {"packing"}, 0.07, 0.04, 0, 2},
        {"degs-64", {"blending"}, 0.88, 0.23, 0, 2},
        {"degs-64", {"gaussian_buffer"}, 0.31, 0.01, 72, 2},
        {"degs-64", {"feature_buffer"}, 0.03, 0.001, 8, 3},
        {"degs-64", {"span_buffer"}, 0.04, 0.001, 2, 3},
        {"degs-64", {"packing_buffer"}, 0.16, 0.02, 32, 2},
        {"degs-64", {"pixel_buffer"}, 0.12, 0.01, 16, 2},
        {"gscore-64", {"projection", "sorting"}, 0.89, 0.58, 0, 2},
        {"gscore-64", {"blending"}, 1.81, 0.25, 0, 2},
        {"gscore-64", {"gaussian_buffer", "pixel_buffer"}, 1.25, 0.04, 272, 2},
        {"gbu-64", {"projection", "sorting"}, 0.89, 0.58, 0, 2},
        {"gbu-64", {"row_pes"}, 2.88, 0.88, 0, 2},
        {"gbu-64", {"row_generation"}, 0.24, 0.07, 0, 2},
        {"gbu-64",
         {"list_buffer", "splat_buffer", "row_queues", "reuse_cache", "pixel_buffer"},
         0.43,
         0.06,
         91,
         2},
        {"gcc-64", {"grouping", "projection", "colour"}, 0.72, 0.30, 0, 2},
        {"gcc-64", {"blending"}, 0.96, 0.44, 0, 2},
        {"gcc-64", {"group_buffer", "pixel_buffer"}, 1.01, 0.05, 190, 2}};
    return rows;
}

TEST(TableOne, EveryRowIsReproduced) {
    std::map<std::string, std::size_t> blocks;
    for (const TableRow& row : table_one()) {
        SCOPED_TRACE(std::string(row.design) + " " + row.blocks.front());
        const BillOfMaterials bill = bill_of(row.design);
        double mm2 = 0;
        double watts = 0;
        double bytes = 0;
        for (const char* name : row.blocks) {
            const cost::Block& block = bill.block(name);
            mm2 += block.area_mm2;
            watts += block.power_w;
            bytes += block.kind == cost::Block::Kind::Sram ? block.size : 0;
        }
        EXPECT_NEAR(mm2, row.mm2, 1e-9);
        EXPECT_NEAR(watts, row.watts, 1e-9);
        EXPECT_EQ(bytes, row.kilobytes * 1024);
        blocks[row.design] += row.blocks.size();
    }
    for (const auto& [design, count] : blocks) { // the table leaves no block out
        EXPECT_EQ(bill_of(design).blocks().size(), count) << design;
    }
}

TEST(TableOne, TheTotalsAreThoseOfThePaperToRounding) {
    struct Total {
        const char* design;
        double mm2, watts;
    };
    for (const Total& total : {Total{"degs-64", 2.72, 1.01}, Total{"gscore-64", 3.95, 0.87},
                               Total{"gbu-64", 4.44, 1.59}, Total{"gcc-64", 2.69, 0.79}}) {
        const BillOfMaterials bill = bill_of(total.design);
        EXPECT_NEAR(bill.area_mm2(), total.mm2, 0.005) << total.design;
        EXPECT_NEAR(bill.power_w(), total.watts, 0.005) << total.design;
    }
    EXPECT_NEAR(bill_of("degs-64").sram_mm2(), 0.66, 0.005);
    EXPECT_NEAR(bill_of("degs-64").sram_power_w(), 0.04, 0.005);
    EXPECT_EQ(bill_of("degs-64").sram_bytes(), 130 * 1024);
}

// The sums of docs/cost.md: shaded rows by their own column of Table III, buffers by their bytes.
TEST(TableTwo, AreaFollowsItsColumns) {
    const std::vector<std::string> table{"cost.logic.widths=false"};
    EXPECT_NEAR(bill_of("degs-16", table).area_mm2(), 1.695, 1e-9);
    EXPECT_NEAR(bill_of("degs-256", table).area_mm2(), 6.51, 1e-9);
    EXPECT_NEAR(bill_of("degs-1024", table).area_mm2(), 21.05, 1e-9);
    EXPECT_NEAR(bill_of("degs-64-tuned", table).area_mm2(), 2.772, 5e-4); // more in dear buffers
    EXPECT_NEAR(bill_of("degs-256-tuned", table).area_mm2(), 6.56, 5e-4);
    EXPECT_NEAR(bill_of("degs-1024-tuned", table).area_mm2(), 21.25, 5e-4);
    EXPECT_NEAR(bill_of("degs-64").area_mm2(), bill_of("degs-64", table).area_mm2(), 1e-9);
    // Rows per cycle of all engines of GBU, for 8 of which Table I has 0.24 mm2.
    for (const auto& [pes, rows] : {std::pair(16, 8), {64, 8}, {256, 16}, {1024, 32}}) {
        const std::string n = std::to_string(pes);
        EXPECT_NEAR(bill_of("gscore-" + n).area_mm2(), 0.89 + 3.06 * pes / 64, 1e-9);
        EXPECT_NEAR(bill_of("gbu-" + n).area_mm2(), 1.13 + 3.31 * pes / 64 + 0.03 * (rows - 8),
                    0.005);
        EXPECT_NEAR(bill_of("gcc-" + n).area_mm2(), 0.72 + 1.97 * pes / 64, 1e-9);
    }
}

/// Doubles one whole-numbered key, whatever the rules say; a bill needs none of them.
class Doubler : public ConfigVisitor {
public:
    using ConfigVisitor::choice;
    using ConfigVisitor::integer;

    explicit Doubler(std::string path) : path_(std::move(path)) {}
    void begin_section(const char* key, const char*) override { open_.push_back(path_of(key)); }
    void end_section() override { open_.pop_back(); }
    void integer(const char* key, std::int64_t& value, std::int64_t, std::int64_t,
                 const char*) override {
        seen.insert(path_of(key));
        value *= path_of(key) == path_ ? 2 : 1;
    }
    void real(const char*, double&, double, double, const char*) override {}
    void boolean(const char*, bool&, const char*) override {}
    void text(const char*, std::string&, const char*) override {}
    void choice(const char*, int&, const std::vector<const char*>&, const char*) override {}
    std::set<std::string> seen;

private:
    std::string path_of(const char* key) const {
        return open_.empty() ? key : open_.back() + "." + key;
    }
    std::string path_;
    std::vector<std::string> open_;
};

struct Moving {
    const char* design;
    std::set<std::string> keys; ///< that area follows; all others leave it alone
    std::vector<std::string> overrides = {};
};

// Over all whole-numbered keys: those of units and bytes raise the area, no other key moves it.
TEST(Area, FollowsTheKeysOfUnitsAndBytesAndNoOthers) {
    const std::vector<std::string> ports{"gaussian_buffer.ports=1", "span_buffer.ports=1",
                                         "packing.ports=1", "feature_buffer.ports=1",
                                         "pixel_buffer.ports=1"};
    std::set<std::string> limited{"clusters",
                                  "projection.count",
                                  "sorting.count",
                                  "slicing.count",
                                  "span.count",
                                  "span.rows_per_cycle",
                                  "scheduler.banks",
                                  "array.pes_per_bank",
                                  "gaussian_buffer.bytes",
                                  "span_buffer.bytes",
                                  "packing.bytes",
                                  "feature_buffer.bytes",
                                  "pixel_buffer.bytes",
                                  "binning.pairs_per_cycle",
                                  "scheduler.queue_segments_per_pe",
                                  "scheduler.segment_length",
                                  "tile_size"};
    std::set<std::string> degs = limited; // ports limit the width of a bank
    degs.insert({"scheduler.issue_width", "scheduler.segments_per_cycle"});
    limited.insert({"gaussian_buffer.ports", "gaussian_buffer.sram_banks", "span_buffer.ports",
                    "packing.ports", "feature_buffer.ports", "feature_buffer.sram_banks",
                    "pixel_buffer.ports", "pixel_buffer.sram_banks"});
    const std::vector<Moving> all{
        {"degs-64", degs},
        {"degs-64", limited, ports},
        {"gscore-64",
         {"clusters", "projection.count", "sorting.count", "array.lanes", "buffer.bytes",
          "binning.pairs_per_cycle"}},
        {"gbu-64",
         {"binning.pairs_per_cycle", "projection.count", "sorting.count", "engines.count",
          "engines.row_pes", "engines.queue_depth", "engines.rows_per_cycle", "engines.entry_bytes",
          "list_buffer.bytes", "list_buffer.chunks", "fetching.chunk", "traffic.splat_bytes",
          "reuse_cache.bytes", "pixel_buffer.bytes"},
         {"engines.rows_per_cycle=4"}},
        {"gcc-64",
         {"clusters", "grouping.means_per_cycle", "projection.units", "colour.units",
          "array.window", "group_buffer_bytes", "image_buffer.bytes"}}};
    for (const Moving& moving : all) {
        const sim::RunConfig shipped =
            sim::load_run_config(config(moving.design), moving.overrides);
        Doubler lister("");
        shipped.accelerator().clone()->describe(lister);
        std::set<std::string> found;
        for (const std::string& key : lister.seen) {
            if (key.rfind("cost.", 0) == 0) {
                continue; // the technology, not the design
            }
            const std::unique_ptr<AcceleratorConfig> changed = shipped.accelerator().clone();
            Doubler doubler(key);
            changed->describe(doubler);
            const double before = shipped.accelerator().bill().area_mm2();
            const double after = changed->bill().area_mm2();
            EXPECT_GE(after, before * (1 - 1e-12)) << moving.design << " " << key;
            if (after > before * (1 + 1e-9)) {
                found.insert(key);
                EXPECT_GT(changed->bill().leakage_w(), shipped.accelerator().bill().leakage_w());
                EXPECT_GT(changed->bill().power_w(), shipped.accelerator().bill().power_w());
            }
        }
        EXPECT_EQ(found, moving.keys) << moving.design;
    }
}

TEST(Area, FollowsTheNumbersOfARunIfTheyAreAskedFor) {
    const auto area = [](const std::string& numbers, const std::string& whose) {
        return bill_of("degs-64", {"pipeline.numbers=" + numbers, "cost.pe.numbers=" + whose})
            .area_mm2();
    };
    EXPECT_NEAR(area("fp32", "table"), 2.72, 1e-9);
    EXPECT_NEAR(area("tuned", "run"), 2.72, 1e-9);
    EXPECT_NEAR(area("fp32", "run"), 2.72 + 0.88 * 2.96, 1e-9);
    EXPECT_GT(area("fp64", "run"), area("fp32", "run"));
}

TEST(CostCommand, PrintsTheBillInThreeForms) {
    const Outcome text = degs({"config", config("degs-64"), "--cost"});
    expect_success(text);
    EXPECT_NE(text.out.find("total"), std::string::npos);
    EXPECT_NE(text.out.find("2.720"), std::string::npos) << text.out;
    EXPECT_NE(text.out.find("clock: our RTL reaches 0.8 of 1 GHz in 28 nm"), std::string::npos);
    const Outcome baseline = degs({"config", config("gbu-64"), "--cost"});
    EXPECT_NE(baseline.out.find("\nclock: 1 GHz as configured"), std::string::npos) << baseline.out;
    const Outcome table = degs({"config", config("degs-64"), "--cost", "--format", "markdown"});
    EXPECT_NE(table.out.find("| total |  | 2.720 | 1.012 | 27.2 |"), std::string::npos)
        << table.out;
    const Outcome data = degs({"config", config("gbu-64"), "--cost", "--format", "json"});
    const nlohmann::json bill = nlohmann::json::parse(data.out);
    EXPECT_NEAR(bill["area"]["mm2"], 4.44, 1e-9);
    EXPECT_EQ(bill["area"]["blocks"]["row_pes"]["units"], 64);
    const Outcome sized = degs({"config", "degs", "--pes", "256", "--cost"});
    EXPECT_NE(sized.out.find("6.729"), std::string::npos) << sized.out;
    expect_mistake(degs({"config", config("gbu-64"), "--cost", "--format", "yaml"}), "json");
    expect_mistake(degs({"config", config("gbu-64"), "--format", "json"}), "--cost");
}

TEST(CostTables, HaveSizesInUnitsOf1024Bytes) {
    const std::string table = sim::cost_markdown(bill_of("degs-64", {"packing.bytes=9216"}));
    EXPECT_NE(table.find("| packing_buffer | 9.00 KB |"), std::string::npos) << table;
}

TEST(CostCommand, TakesATechnologyFromAFile) {
    const Folder folder;
    std::ofstream(folder / "5nm.yaml") << "include: " << DEGS_CONFIGS << "/cost/28nm.yaml\n"
                                       << "node: a smaller one\narea_factor: 0.25\n";
    std::ofstream(folder / "design.yaml") << "include: " << config("degs-64") << "\n"
                                          << "cost: { include: 5nm.yaml }\n";
    const Outcome outcome = degs({"config", folder / "design.yaml", "--cost", "--format", "json"});
    expect_success(outcome);
    const nlohmann::json area = nlohmann::json::parse(outcome.out)["area"];
    EXPECT_EQ(area["node"], "a smaller one");
    EXPECT_NEAR(area["mm2"], 2.72 / 4, 1e-9);
}

class SmallRunEnergy : public testing::TestWithParam<const char*> {};

nlohmann::json report_of(const std::string& design, const std::vector<std::string>& more = {},
                         const std::string& scene = "synthetic:object,gaussians=2000") {
    const Folder folder;
    std::vector<std::string> arguments{"run",   config(design), "--scene",
                                       scene,   "--width",      "200",
                                       "--out", folder / "out", "--no-reference"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    expect_success(degs(arguments));
    return report_in(folder / "out");
}

// Every block has done something, and everything adds up.
TEST_P(SmallRunEnergy, IsTheSumOfItsParts) {
    const nlohmann::json report = report_of(GetParam());
    const nlohmann::json& energy = report["energy"];
    double dynamic = 0;
    double leakage = 0;
    for (const auto& [name, block] : energy["blocks"].items()) {
        EXPECT_GT(block["dynamic_nj"].get<double>(), 0) << name;
        EXPECT_GT(block["leakage_nj"].get<double>(), 0) << name;
        EXPECT_TRUE(report["area"]["blocks"].contains(name)) << name;
        dynamic += block["dynamic_nj"].get<double>();
        leakage += block["leakage_nj"].get<double>();
    }
    EXPECT_EQ(energy["blocks"].size(), report["area"]["blocks"].size());
    const auto total = energy["total_nj"].get<double>();
    EXPECT_NEAR(energy["dynamic_nj"], dynamic, 1e-9 * total);
    EXPECT_NEAR(energy["leakage_nj"], leakage, 1e-9 * total);
    EXPECT_NEAR(dynamic + leakage + energy["dram_nj"].get<double>(), total, 1e-9 * total);
    EXPECT_NEAR(energy["nj_per_frame"], total, 1e-9 * total);
    const double pixels =
        report["camera"]["width"].get<double>() * report["camera"]["height"].get<double>();
    EXPECT_NEAR(energy["nj_per_pixel"].get<double>() * pixels, total, 1e-9 * total);
    const double seconds = report["timing"]["cycles"].get<double>() * 1e-9;
    EXPECT_NEAR(energy["average_power_w"].get<double>() * seconds * 1e9, total, 1e-9 * total);
    std::uint64_t bytes = 0;
    for (const nlohmann::json& buffer : report["buffers"]) {
        bytes += buffer.value("bytes", std::uint64_t{0});
    }
    EXPECT_EQ(report["area"]["sram_bytes"], bytes);
}

// Units work in no more cycles than there are, so that no block takes more than its full power.
TEST_P(SmallRunEnergy, UnitsTakeNoMoreThanAtFullActivity) {
    const nlohmann::json report = report_of(GetParam());
    for (const auto& [name, block] : report["area"]["blocks"].items()) {
        if (block.contains("units")) {
            EXPECT_LE(report["energy"]["blocks"][name]["average_power_w"].get<double>(),
                      block["power_w"].get<double>() * (1 + 1e-9))
                << name;
        }
    }
}

TEST_P(SmallRunEnergy, OfTheArrayAloneLeavesOutWhatWasNotBuilt) {
    const nlohmann::json energy = report_of(GetParam(), {"--array-only"})["energy"];
    EXPECT_TRUE(energy["dram_nj"].is_null());
    EXPECT_FALSE(energy["blocks"].contains("projection"));
    EXPECT_TRUE(energy["blocks"].contains("pixel_buffer"));
    EXPECT_EQ(energy["covers"], "the rasterisation array, without front end and memory");
    EXPECT_GT(energy["total_nj"].get<double>(), 0);
}

TEST(LongEnergyOfBinning, IsLeftOutOfTheArrayAlone) {
    for (const char* design : {"degs-64", "gscore-64", "gbu-64", "orange-o1"}) {
        SCOPED_TRACE(design);
        for (const bool alone : {false, true}) {
            std::vector<std::string> more{"--set", "binning.entries=entries"};
            if (alone) {
                more.emplace_back("--array-only");
            }
            const nlohmann::json report = report_of(design, more);
            EXPECT_TRUE(report["area"]["blocks"].contains("binning_buffer"));
            EXPECT_EQ(report["energy"]["blocks"].contains("binning_buffer"), !alone);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Accelerators, SmallRunEnergy,
                         testing::Values("degs-64", "degs-64-tuned", "gscore-64", "gbu-64",
                                         "gcc-64"));

TEST(SmallRunEnergyOfMemory, IsThatOfItsCommandsIfItHasThem) {
    const nlohmann::json report = report_of("degs-64", {"--set", "memory.model=lpddr5"});
    EXPECT_EQ(report["energy"]["dram_nj"], report["dram"]["energy_nj"]["total"]);
    const nlohmann::json bus = report_of("degs-64");
    const double read = 8 * bus["dram"]["bytes_read"].get<double>();
    const double written = 8 * bus["dram"]["bytes_written"].get<double>();
    const double seconds = bus["timing"]["cycles"].get<double>() * 1e-9;
    EXPECT_NEAR(bus["energy"]["dram_nj"],
                3.15e-3 * read + 2.15e-3 * written + 2.9e6 * 204.8 * seconds, 1);
}

// The constants of the bus are fitted to LPDDR5 on trained views; docs/cost.md states the spread.
TEST(LongEnergyOfTheBus, IsThatOfLpddr5OnTrainedViews) {
    const fs::path scenes = trained_scenes();
    if (!fs::exists(scenes / "garden-crop")) {
        GTEST_SKIP() << "The trained scenes are not in " << scenes << "; set DEGS_SCENES";
    }
    for (const auto& [scene, design] :
         {std::pair("flowers", "degs-64"), std::pair("seal", "gscore-64"),
          std::pair("guitar", "gbu-64"), std::pair("garden-crop", "gcc-64"),
          std::pair("skull", "orange-o1")}) {
        SCOPED_TRACE(scene);
        const auto dram_nj = [&, scene = scene, design = design](const std::string& model) {
            const nlohmann::json report =
                report_of(design, {"--camera", "2", "--set", "memory.model=" + model},
                          (scenes / scene / "scene.ply").string());
            return report["energy"]["dram_nj"].get<double>();
        };
        EXPECT_NEAR(dram_nj("bus") / dram_nj("lpddr5"), 1, 0.15) << design;
    }
}

TEST(SmallRunEnergyOfPaths, IsOfAllFrames) {
    const nlohmann::json one = report_of("degs-64")["energy"];
    const nlohmann::json three = report_of("degs-64", {"--frames", "3"})["energy"];
    EXPECT_NEAR(three["nj_per_frame"].get<double>() * 3, three["total_nj"].get<double>(), 1e-3);
    EXPECT_NEAR(three["nj_per_pixel"].get<double>() / one["nj_per_pixel"].get<double>(), 1, 0.1);
    EXPECT_NEAR(three["dynamic_nj"].get<double>() / one["dynamic_nj"].get<double>(), 3, 0.1);
}

} // namespace
} // namespace degs::sim_test
