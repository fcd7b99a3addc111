// SPDX-License-Identifier: Apache-2.0
// The areas in configs/degs-*.yaml, worked out from Tables I and II.
#include "modules/degs_config.hpp"
#include "sim/run_config.hpp"
#include "tests/sim/child.hpp"

namespace degs::sim_test {
namespace {

DegsConfig shipped(int pes) {
    const sim::RunConfig file = sim::load_run_config(config("degs-" + std::to_string(pes)), {});
    return dynamic_cast<const DegsConfig&>(file.accelerator());
}

/// A row of Table I: mm2 with 64 PEs, and what it follows.
struct AreaRow {
    const char* name;
    double mm2;
    double (*size)(const DegsConfig& config);
};

const std::vector<AreaRow>& unshaded_rows() {
    static const auto constant = [](const DegsConfig&) { return 1.0; };
    static const std::vector<AreaRow> rows{{"Projection Unit", 0.92, constant},
                                           {"Sorting Unit", 0.02, constant},
                                           {"Gaussian Buffer", 0.31, constant},
                                           {"Feature Buffer", 0.03, constant}};
    return rows;
}

const std::vector<AreaRow>& shaded_rows() {
    using C = const DegsConfig&;
    static const std::vector<AreaRow> rows{
        {"Span Engine", 0.17, [](C c) { return 1.0 * c.slicing.count + c.span.count; }},
        {"Packing Scheduler", 0.07, [](C c) { return 1.0 * c.scheduler.banks; }},
        {"Blending Array", 0.88, [](C c) { return 1.0 * c.pes(); }},
        {"Span Buffer", 0.04, [](C c) { return 1.0 * c.span_buffer.bytes; }},
        {"Packing Buffer", 0.16, [](C c) { return 1.0 * c.packing.bytes; }},
        {"Pixel Buffer", 0.12, [](C c) { return 1.0 * c.pixel_buffer.bytes; }}};
    return rows;
}

double sum_of_rows(const std::vector<AreaRow>& rows, const DegsConfig& config) {
    const DegsConfig table = shipped(64);
    double sum = 0;
    for (const AreaRow& row : rows) {
        sum += row.mm2 * row.size(config) / row.size(table);
    }
    return sum;
}

// Every unshaded row stays and every shaded one follows its column of Table II, or its bytes. What
// the Feature Buffer has more than Table I says is added.
TEST(DegsArea, IsThatOfTableIByTheColumnsOfTableII) {
    for (const int pes : {16, 64, 256, 1024}) {
        SCOPED_TRACE(pes);
        const DegsConfig config = shipped(pes);
        EXPECT_NEAR(config.area.fixed_mm2, sum_of_rows(unshaded_rows(), config), 1e-9);
        const double more = 0.03 * (config.feature_buffer.bytes / 8192.0 - 1);
        EXPECT_NEAR(config.area.array_mm2, sum_of_rows(shaded_rows(), config) + more, 1e-9);
    }
    EXPECT_NEAR(shipped(64).area.total(), 2.72, 1e-9); // the table's own total
    EXPECT_NEAR(shipped(1024).area.total(), 21.05, 1e-9);
}

} // namespace
} // namespace degs::sim_test
