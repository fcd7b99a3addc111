// SPDX-License-Identifier: Apache-2.0
// The constants of the cost model: what published rows of units and memories take, and how that
// scales. docs/cost.md argues each of them.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "config/config.hpp"
#include "cost/logic_laws.hpp"
#include "cost/rows.hpp"

namespace degs::cost {

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

/// The constants that all accelerators share; defaults are those of configs/cost/28nm.yaml. Each
/// accelerator has rows of its own, see RowSection.
struct Technology {
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
    LogicLaws logic;

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

/// The rows of an accelerator: the section `name` of the section of a Technology, which is open. An
/// accelerator describes its rows between the constructor and end().
class RowSection {
public:
    RowSection(const char* name, const char* doc, const Technology& technology,
               ConfigVisitor& visitor);
    RowSection(const RowSection&) = delete;
    RowSection& operator=(const RowSection&) = delete;

    template <class AnyRow>
    void row(const char* key, AnyRow& row, const char* doc) {
        visitor_.section(key, row, doc);
        rows_.emplace_back(key, &row);
    }
    template <class Choice>
    void choice(const char* key, Choice& value, const std::vector<const char*>& names,
                const char* doc) {
        visitor_.choice(key, value, names, doc);
    }
    /// A share of a row, 0 to 1.
    void share(const char* key, double& value, const char* doc) {
        visitor_.real(key, value, 0, 1, doc);
    }
    /// Closes the section, and demands that no row leaks more than its power.
    void end();

private:
    std::string name_;
    const Technology& technology_;
    ConfigVisitor& visitor_;
    std::vector<std::pair<std::string, const Row*>> rows_;
};

} // namespace degs::cost
