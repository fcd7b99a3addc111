// SPDX-License-Identifier: Apache-2.0
#include "cost/technology.hpp"

#include "config/config_words.hpp"

namespace degs::cost {
namespace {

constexpr double kMostArea = 1e4;  // mm2
constexpr double kMostPower = 1e3; // W
constexpr double kWPerMw = 1e-3;

void describe_row(Row& row, ConfigVisitor& visitor) {
    visitor.real("area_mm2", row.area_mm2, 0, kMostArea, "mm2");
    visitor.real("power_w", row.power_w, 0, kMostPower, "W, with leakage");
}

/// A row whose leakage is more than its power would have a negative energy per operation.
void require_power(const char* key, const Row& row, const Technology& technology,
                   ConfigVisitor& visitor) {
    const double leakage = kWPerMw * technology.leakage_mw_per_mm2 * row.area_mm2;
    const std::string path = std::string(key) + ".power_w";
    const std::string area = std::string(key) + ".area_mm2";
    visitor.require(row.power_w >= leakage, {path.c_str(),
                                             "must not be below the leakage of its area",
                                             config_words::number(leakage),
                                             {area.c_str(), "leakage_mw_per_mm2"}});
}

} // namespace

void UnitRow::describe(ConfigVisitor& visitor) {
    describe_row(*this, visitor);
    visitor.integer("units", units, 1, 1 << 20,
                    "units that the row stands for (its column Config)");
}

void SramRow::describe(ConfigVisitor& visitor) {
    describe_row(*this, visitor);
    visitor.integer("bytes", bytes, 1, 1 << 30,
                    "bytes that the row stands for (its column Config)");
    visitor.integer("bytes_per_cycle", bytes_per_cycle, 1, 1 << 20,
                    "bytes read and written per cycle while every user works, in the shipped "
                    "design of 64 PEs [assumed]");
}

void PortedSramRow::describe(ConfigVisitor& visitor) {
    SramRow::describe(visitor);
    visitor.integer("ports", ports, 1, 64,
                    "ports of an SRAM bank that the area contains; as many as the shipped design "
                    "of 64 PEs needs [assumed]");
    visitor.integer("sram_banks", sram_banks, 1, 4096,
                    "SRAM banks of a part that the area contains; the default of the buffer's key "
                    "[assumed]");
}

void Technology::Degs::describe(ConfigVisitor& visitor) {
    visitor.section("projection", projection, "Projection Units");
    visitor.section("sorting", sorting, "Sorting Units");
    visitor.section("span_engine", span_engine,
                    "Gaussian Slicing Units and Span Units, 2 + 8, which weigh the same [assumed]");
    visitor.section("packing_scheduler", packing_scheduler, "Issue Banks with Packing Units");
    visitor.real("scheduler_width_share", scheduler_width_share, 0, 1,
                 "share of an Issue Bank that follows array.pes_per_bank, which is 8 in its row; "
                 "0: Table II widens the packets and Table I counts banks [assumed]");
    visitor.section("blending", blending, "Blending Array");
    visitor.section("gaussian_buffer", gaussian_buffer, "Gaussian Buffer");
    visitor.section("feature_buffer", feature_buffer, "Feature Buffer");
    visitor.section("span_buffer", span_buffer, "Span Buffer");
    visitor.section("packing_buffer", packing_buffer, "Packing Buffer");
    visitor.section("pixel_buffer", pixel_buffer, "Pixel Buffer");
}

void Technology::Gscore::describe(ConfigVisitor& visitor) {
    visitor.section("preprocessing", preprocessing,
                    "P & S: pairs of a culling and conversion unit and a sorting unit");
    visitor.real("sorting_share", sorting_share, 0, 1,
                 "share of P & S that sorts; 0.02 of 0.94 mm2 in DeGS [assumed]");
    visitor.section("blending", blending, "lanes");
    visitor.section("sram", sram, "all buffers");
}

void Technology::Gbu::describe(ConfigVisitor& visitor) {
    visitor.section("preprocessing", preprocessing,
                    "P & S: pairs of a culling and conversion unit and a sorting unit");
    visitor.real("sorting_share", sorting_share, 0, 1,
                 "share of P & S that sorts; 0.02 of 0.94 mm2 in DeGS [assumed]");
    visitor.section("scheduler", scheduler,
                    "Row Generation and dispatch, which Table I does not shade: one for any array");
    visitor.section("blending", blending, "Row PEs");
    visitor.section("sram", sram, "all buffers");
}

void Technology::Gcc::describe(ConfigVisitor& visitor) {
    visitor.section("preprocessing", preprocessing,
                    "P & S: 4 lanes of Stage I, 4 projection units and 4 SH units, which weigh the "
                    "same [assumed]");
    visitor.section("blending", blending, "PEs of the window");
    visitor.section("sram", sram, "all buffers");
}

void Technology::Orange::describe(ConfigVisitor& visitor) {
    visitor.section("preprocessing", preprocessing,
                    "projection and sorting: energy as in GSCore, on the area of the vector units");
    visitor.real("sorting_share", sorting_share, 0, 1,
                 "share of preprocessing that sorts, as in GSCore [assumed]");
    visitor.section("array", array,
                    "multipliers of the systolic arrays: FP16 units of 3000 um2 and 1.5 pJ "
                    "(Horowitz, ISSCC 2014, at 45 nm), 0.39 of the area and half of the energy at "
                    "28 nm [assumed]");
    visitor.section("vector_unit", vector_unit,
                    "lanes of the vector units: 1.7 and 2 times as much as a multiplier [assumed]");
    visitor.section("sram", sram,
                    "scratchpads and Pixel Buffer: what is left of the area, at GSCore's area and "
                    "energy per byte [assumed]");
}

void Technology::Sram::describe(ConfigVisitor& visitor) {
    visitor.real("bank_share", bank_share, 0, 1,
                 "share of the area that follows the SRAM banks of a buffer with limited ports "
                 "[assumed]");
    visitor.real("port_share", port_share, 0, 10,
                 "area that each port after the first adds to a buffer with limited ports, "
                 "relative to one port [assumed]");
}

void Technology::Pe::describe(ConfigVisitor& visitor) {
    visitor.choice("numbers", numbers, {"table", "run"},
                   "format that PEs are built for; table: that of their row in Table I, so that "
                   "fp32 in a run stands for the row's arithmetic; run: that of pipeline.numbers");
    visitor.real("fp32_area", fp32.area, 0, 1000,
                 "area of a PE in fp32 / FP16: multiplier and adder, 11884 / 3000 um2 (Horowitz, "
                 "ISSCC 2014, at 45 nm)");
    visitor.real("fp32_energy", fp32.energy, 0, 1000,
                 "energy of a PE in fp32 / FP16: multiply and add, 4.6 / 1.5 pJ (likewise)");
    visitor.real("fp64_area", fp64.area, 0, 1000, "the same of fp64: the square of fp32 [assumed]");
    visitor.real("fp64_energy", fp64.energy, 0, 1000,
                 "the same of fp64: the square of fp32 [assumed]");
}

void Technology::Dram::describe(ConfigVisitor& visitor) {
    visitor.real("pj_per_bit", pj_per_bit, 0, 1000,
                 "pJ per bit read: 2.75 for the burst, 0.4 for its share of activations; all three "
                 "are for memory.model bus, lpddr5 counts commands [fitted to lpddr5]");
    visitor.real("write_pj_per_bit", write_pj_per_bit, 0, 1000,
                 "pJ per bit written: 1.75 and 0.4 [fitted to lpddr5]");
    visitor.real(
        "standby_mw_per_gb_per_s", standby_mw_per_gb_per_s, 0, 1000,
        "mW per GB/s of memory.bandwidth_gb_per_s, whatever happens; 16 channels of 30 mW, "
        "with refresh 38 mW, have 204.8 GB/s [as lpddr5]");
}

void Technology::describe(ConfigVisitor& visitor) {
    visitor.text("node", node, "what reports call this technology");
    visitor.real("area_factor", area_factor, 1e-6, 1e6, "of this node / of the rows below");
    visitor.real("energy_factor", energy_factor, 1e-6, 1e6,
                 "energy per operation, of this node / of the rows below");
    visitor.real("leakage_factor", leakage_factor, 0, 1e6,
                 "leakage of a block, of this node / of the rows below");
    visitor.real("clock_ghz", clock_ghz, 0.01, 10, "GHz at which the rows state their power");
    visitor.real("activity", activity, 1e-3, 1,
                 "operations per unit and cycle at which they state it; 1: every unit works "
                 "[assumed]");
    visitor.real("leakage_mw_per_mm2", leakage_mw_per_mm2, 0, 1e4,
                 "mW per mm2 of logic and SRAM; the Span Buffer's row allows 25 at most "
                 "[assumed]");
    visitor.section("sram", sram, "how the area of a buffer follows its banks and ports");
    visitor.section("pe", pe, "number formats of PEs");
    visitor.section("dram", dram, "main memory");
    visitor.section("degs", degs, "rows of DeGS (paper Table I)");
    visitor.section("gscore", gscore, "rows of GSCore (paper Table I)");
    visitor.section("gbu", gbu, "rows of GBU (paper Table I)");
    visitor.section("gcc", gcc, "rows of GCC (paper Table I)");
    visitor.section("orange", orange,
                    "ORANGE with four cores: 13.74 mm2 in all, its only public figure");
    const auto require = [&](const char* key, const Row& row) {
        require_power(key, row, *this, visitor);
    };
    require("degs.projection", degs.projection);
    require("degs.sorting", degs.sorting);
    require("degs.span_engine", degs.span_engine);
    require("degs.packing_scheduler", degs.packing_scheduler);
    require("degs.blending", degs.blending);
    require("degs.gaussian_buffer", degs.gaussian_buffer);
    require("degs.feature_buffer", degs.feature_buffer);
    require("degs.span_buffer", degs.span_buffer);
    require("degs.packing_buffer", degs.packing_buffer);
    require("degs.pixel_buffer", degs.pixel_buffer);
    require("gscore.preprocessing", gscore.preprocessing);
    require("gscore.blending", gscore.blending);
    require("gscore.sram", gscore.sram);
    require("gbu.preprocessing", gbu.preprocessing);
    require("gbu.scheduler", gbu.scheduler);
    require("gbu.blending", gbu.blending);
    require("gbu.sram", gbu.sram);
    require("gcc.preprocessing", gcc.preprocessing);
    require("gcc.blending", gcc.blending);
    require("gcc.sram", gcc.sram);
    require("orange.preprocessing", orange.preprocessing);
    require("orange.array", orange.array);
    require("orange.vector_unit", orange.vector_unit);
    require("orange.sram", orange.sram);
}

double Technology::leakage_w(double area_mm2) const {
    return kWPerMw * leakage_mw_per_mm2 * leakage_factor * area_mm2;
}

double Technology::dynamic_pj_per_cycle(const Row& row) const {
    constexpr double kPjPerNj = 1e3;
    const double watts = row.power_w - kWPerMw * leakage_mw_per_mm2 * row.area_mm2;
    return kPjPerNj * energy_factor * watts / (clock_ghz * activity); // W / GHz = nJ
}

double Technology::energy_pj(const UnitRow& row) const {
    return dynamic_pj_per_cycle(row) / row.units;
}

double Technology::energy_pj(const SramRow& row) const {
    return dynamic_pj_per_cycle(row) / row.bytes_per_cycle;
}

PeFactors Technology::pe_factors(Precision precision) const {
    if (pe.numbers == PeNumbers::Table || precision == Precision::Half) {
        return {};
    }
    return precision == Precision::Single ? pe.fp32 : pe.fp64;
}

} // namespace degs::cost
