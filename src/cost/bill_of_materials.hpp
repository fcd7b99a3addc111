// SPDX-License-Identifier: Apache-2.0
// What a design is made of, and what each block of it costs.
#pragma once

#include <string>
#include <vector>

#include "cost/technology.hpp"
#include "stats/statistics.hpp"

namespace degs::cost {

/// A block of a bill. Its name is that of the stage or buffer whose activity it has in reports.
struct Title {
    const char* name;
    const char* sentence;
    bool front_end = false; ///< not part of a rasterisation array alone
};

/// One kind of unit, or one buffer.
struct Block {
    enum class Kind { Units, Sram };
    std::string name;     ///< key in results
    std::string sentence; ///< what it is
    bool front_end = false;
    Kind kind = Kind::Units;
    double size = 0;      ///< units, or bytes
    double area_mm2 = 0;  ///< of all of them
    double leakage_w = 0; ///< of all units or bytes
    double energy_pj = 0; ///< per operation: a cycle of work of a unit, or a byte moved
    double full_rate = 0; ///< operations per cycle while everything works
    double power_w = 0;   ///< at Technology::activity, like the rows of the table

    void describe(StatsVisitor& visitor) const;
};

/// SRAM banks and ports of a buffer, if the design limits them.
struct SramShape {
    int ports = 0;    ///< 0: not limited, the area is that of the row
    int banks = 1;    ///< of each part of the buffer
    double share = 1; ///< of its bytes, that have these ports and banks
};

/// The blocks of a design with their costs.
class BillOfMaterials {
public:
    /// `technology` is copied; `clock_ghz` is that of the design.
    BillOfMaterials(const Technology& technology, double clock_ghz)
        : technology_(technology), clock_ghz_(clock_ghz) {}

    /// `units` of a row; `share`: of the row's area and power that is theirs.
    void add_units(const Title& title, const UnitRow& row, double units, double share = 1,
                   const PeFactors& factors = {});
    /// `bytes_per_cycle`: what the users of this buffer move while all of them work.
    void add_sram(const Title& title, const SramRow& row, std::int64_t bytes,
                  double bytes_per_cycle);
    void add_sram(const Title& title, const PortedSramRow& row, std::int64_t bytes,
                  double bytes_per_cycle, const SramShape& shape);

    const Technology& technology() const { return technology_; }
    const std::vector<Block>& blocks() const { return blocks_; }
    /// The block of this name. Throws std::logic_error if there is none.
    const Block& block(const std::string& name) const;
    double area_mm2() const;
    double sram_mm2() const;
    std::int64_t sram_bytes() const;
    /// With everything at Technology::activity, leakage included.
    double power_w() const;
    double sram_power_w() const;
    double leakage_w() const;

    /// The section `area` of a report.
    void describe(StatsVisitor& visitor) const;

private:
    Block sram_of(const SramRow& row, std::int64_t bytes, double bytes_per_cycle) const;
    void add(const Title& title, Block block);

    Technology technology_;
    double clock_ghz_;
    std::vector<Block> blocks_;
};

} // namespace degs::cost
