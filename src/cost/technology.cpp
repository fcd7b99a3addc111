// SPDX-License-Identifier: Apache-2.0
#include "cost/technology.hpp"

#include "config/config_words.hpp"

namespace degs::cost {
namespace {

constexpr double kWPerMw = 1e-3;

// A row whose leakage is more than its power would have a negative energy per operation.
void require_power(const Technology& technology, const std::string& name, const Row& row,
                   ConfigVisitor& visitor) {
    const double leakage = kWPerMw * technology.leakage_mw_per_mm2 * row.area_mm2;
    const std::string power = name + ".power_w";
    const std::string area = name + ".area_mm2";
    visitor.require(row.power_w >= leakage, {power.c_str(),
                                             "must not be below the leakage of its area",
                                             config_words::number(leakage),
                                             {area.c_str(), "leakage_mw_per_mm2"}});
}

} // namespace

RowSection::RowSection(const char* name, const char* doc, const Technology& technology,
                       ConfigVisitor& visitor)
    : name_(name), technology_(technology), visitor_(visitor) {
    visitor_.begin_section(name, doc);
}

void RowSection::end() {
    visitor_.end_section();
    for (const auto& [key, row] : rows_) {
        require_power(technology_, name_ + "." + key, *row, visitor_);
    }
}

void Technology::Sram::describe(ConfigVisitor& visitor) {
    visitor.real("bank_share", bank_share, 0, 1,
                 "share of the area that follows the SRAM banks of a buffer with limited ports "
                 "[assumed]");
    visitor.real("port_share", port_share, 0, 10,
                 "area that each port after the first adds to such a buffer, relative to one port "
                 "[assumed]");
}

void Technology::Pe::describe(ConfigVisitor& visitor) {
    visitor.choice(
        "numbers", numbers, {"table", "run"},
        "format that PEs are built for: that of their row in Table I, or that of pipeline.numbers");
    visitor.real("fp32_area", fp32.area, 0, 1000,
                 "area of a PE in fp32 / FP16 (Horowitz, ISSCC 2014)");
    visitor.real("fp32_energy", fp32.energy, 0, 1000, "energy of a PE in fp32 / FP16 (likewise)");
    visitor.real("fp64_area", fp64.area, 0, 1000, "the same of fp64: the square of fp32 [assumed]");
    visitor.real("fp64_energy", fp64.energy, 0, 1000,
                 "the same of fp64: the square of fp32 [assumed]");
}

void Technology::Dram::describe(ConfigVisitor& visitor) {
    visitor.real(
        "pj_per_bit", pj_per_bit, 0, 1000,
        "pJ per bit read of memory.model bus: burst and a share of activations [fitted to lpddr5]");
    visitor.real("write_pj_per_bit", write_pj_per_bit, 0, 1000,
                 "pJ per bit written, likewise [fitted to lpddr5]");
    visitor.real(
        "standby_mw_per_gb_per_s", standby_mw_per_gb_per_s, 0, 1000,
        "mW per GB/s of memory.bandwidth_gb_per_s, whatever happens, likewise [as lpddr5]");
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
                 "operations per unit and cycle at which they state it [assumed]");
    visitor.real("leakage_mw_per_mm2", leakage_mw_per_mm2, 0, 1e4,
                 "mW per mm2 of logic and SRAM [assumed]");
    visitor.section("sram", sram, "how the area of a buffer follows its banks and ports");
    visitor.section("pe", pe, "number formats of PEs");
    visitor.section("dram", dram, "main memory");
    visitor.section("logic", logic, "logic whose cost follows a width, by synthesis");
    require_power(*this, "logic.pe", logic.pe, visitor);
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
