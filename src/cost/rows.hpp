// SPDX-License-Identifier: Apache-2.0
// Published rows of units and memories, in the node of their table.
#pragma once

#include "config/config.hpp"

namespace degs::cost {

/// A row of Table I: area, and power when everything in it works at Technology::activity.
struct Row {
    double area_mm2 = 0, power_w = 0;
};

/// A row of units that are alike.
struct UnitRow : Row {
    int units = 1;
    UnitRow(double area, double power, int count) : Row{area, power}, units(count) {}
    void describe(ConfigVisitor& visitor);
};

/// A row of SRAM.
struct SramRow : Row {
    int bytes = 1;           ///< capacity
    int bytes_per_cycle = 1; ///< moved while all of its users work: read and written
    SramRow(double area, double power, int capacity, int moved)
        : Row{area, power}, bytes(capacity), bytes_per_cycle(moved) {}
    void describe(ConfigVisitor& visitor);
};

/// A row of SRAM whose design has keys for its ports.
struct PortedSramRow : SramRow {
    int ports = 1;      ///< that its area contains
    int sram_banks = 1; ///< that the area of each part contains
    PortedSramRow(const SramRow& row, int ported, int banked)
        : SramRow(row), ports(ported), sram_banks(banked) {}
    void describe(ConfigVisitor& visitor);
};

} // namespace degs::cost
