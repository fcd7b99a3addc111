// SPDX-License-Identifier: Apache-2.0
// The constants of the cost model: what published rows of units and memories take, and how that
// scales. docs/cost.md argues each of them.
#pragma once

#include <string>

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
    int sram_banks = 1; ///< likewise, of each part
    PortedSramRow(const SramRow& row, int ported, int banked)
        : SramRow(row), ports(ported), sram_banks(banked) {}
    void describe(ConfigVisitor& visitor);
};

/// What the arithmetic of a PE costs, relative to the row of its accelerator.
struct PeFactors {
    double area = 1, energy = 1;
};

/// Whose number format the PEs of an array are built for: that of their row, whatever the run
/// computes in, or that of the run.
enum class PeNumbers { Table, Run };

/// Width of the numbers that a PE computes in. Half stands for every set of formats of 16 bits and
/// less.
enum class Precision { Half, Single, Double };

/// Every constant of the model; defaults are those of configs/cost/28nm.yaml.
struct Technology {
    struct Degs {
        UnitRow projection{0.92, 0.60, 4}, sorting{0.02, 0.01, 4}, span_engine{0.17, 0.09, 10};
        UnitRow packing_scheduler{0.07, 0.04, 8}, blending{0.88, 0.23, 64};
        double scheduler_width_share = 0; ///< of an Issue Bank, that follows the PEs it feeds
        PortedSramRow gaussian_buffer{{0.31, 0.01, 72 * 1024, 192}, 1, 4};
        PortedSramRow feature_buffer{{0.03, 0.001, 8 * 1024, 256}, 1, 8};
        PortedSramRow span_buffer{{0.04, 0.001, 2 * 1024, 128}, 1, 1};
        PortedSramRow packing_buffer{{0.16, 0.02, 32 * 1024, 2240}, 2, 1};
        PortedSramRow pixel_buffer{{0.12, 0.01, 16 * 1024, 1024}, 1, 32};
        void describe(ConfigVisitor& visitor);
    };
    struct Gscore {
        UnitRow preprocessing{0.89, 0.58, 4}, blending{1.81, 0.25, 64};
        double sorting_share = 0.02; ///< of preprocessing
        SramRow sram{1.25, 0.04, 272 * 1024, 2240};
        void describe(ConfigVisitor& visitor);
    };
    struct Gbu {
        UnitRow preprocessing{0.89, 0.58, 4}, scheduler{0.24, 0.07, 1}, blending{2.88, 0.88, 64};
        double sorting_share = 0.02; ///< of preprocessing
        SramRow sram{0.43, 0.06, 91 * 1024, 2368};
        void describe(ConfigVisitor& visitor);
    };
    struct Gcc {
        UnitRow preprocessing{0.72, 0.30, 12}, blending{0.96, 0.44, 64};
        SramRow sram{1.01, 0.05, 190 * 1024, 2112};
        void describe(ConfigVisitor& visitor);
    };
    struct Orange {
        UnitRow preprocessing{0, 0.58, 4}, array{4.8, 3.1, 4096}, vector_unit{4.1, 3.0, 2048};
        double sorting_share = 0.02; ///< of preprocessing
        SramRow sram{4.84, 0.15, 1032 * 1024, 8256};
        void describe(ConfigVisitor& visitor);
    };
    struct Sram {
        double bank_share = 0.2;  ///< of the area, that follows the number of SRAM banks
        double port_share = 0.75; ///< of the area, that each port after the first adds
        void describe(ConfigVisitor& visitor);
    };
    struct Pe {
        PeNumbers numbers = PeNumbers::Table;
        PeFactors fp32{3.96, 3.07}, fp64{15.7, 9.4};
        void describe(ConfigVisitor& visitor);
    };
    struct Dram {
        double pj_per_bit = 3.15; ///< read; all three: of the model `bus`
        double write_pj_per_bit = 2.15;
        double standby_mw_per_gb_per_s = 2.9;
        void describe(ConfigVisitor& visitor);
    };

    std::string node = "28 nm";
    double area_factor = 1, energy_factor = 1, leakage_factor = 1;
    double clock_ghz = 1; ///< at which the rows state their power
    double activity = 1;  ///< operations per unit and cycle at that power
    double leakage_mw_per_mm2 = 10;
    Sram sram;
    Pe pe;
    Dram dram;
    Degs degs;
    Gscore gscore;
    Gbu gbu;
    Gcc gcc;
    Orange orange;

    void describe(ConfigVisitor& visitor);

    /// Leakage of an area of the rows' node, W; a node of its own scales it.
    double leakage_w(double area_mm2) const;
    /// Energy of one operation of a row, pJ, in this technology.
    double energy_pj(const UnitRow& row) const;
    /// Energy of one byte read or written, pJ, likewise.
    double energy_pj(const SramRow& row) const;
    PeFactors pe_factors(Precision precision) const;

private:
    double dynamic_pj_per_cycle(const Row& row) const;
};

} // namespace degs::cost
