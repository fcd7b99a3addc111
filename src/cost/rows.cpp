// SPDX-License-Identifier: Apache-2.0
#include "cost/rows.hpp"

namespace degs::cost {
namespace {

constexpr double kMostArea = 1e4;  // mm2
constexpr double kMostPower = 1e3; // W

void describe_row(Row& row, ConfigVisitor& visitor) {
    visitor.real("area_mm2", row.area_mm2, 0, kMostArea, "mm2");
    visitor.real("power_w", row.power_w, 0, kMostPower, "W, with leakage");
}

} // namespace

void UnitRow::describe(ConfigVisitor& visitor) {
    describe_row(*this, visitor);
    visitor.integer("units", units, 1, 1 << 20, "units of the row");
}

void SramRow::describe(ConfigVisitor& visitor) {
    describe_row(*this, visitor);
    visitor.integer("bytes", bytes, 1, 1 << 30, "bytes of the row");
    visitor.integer("bytes_per_cycle", bytes_per_cycle, 1, 1 << 20,
                    "bytes moved while every user works [assumed]");
}

void PortedSramRow::describe(ConfigVisitor& visitor) {
    SramRow::describe(visitor);
    visitor.integer("ports", ports, 1, 64, "of an SRAM bank, within the area [assumed]");
    visitor.integer("sram_banks", sram_banks, 1, 4096, "of a part, within the area [assumed]");
}

} // namespace degs::cost
