// SPDX-License-Identifier: Apache-2.0
#include "cost/bill_of_materials.hpp"

#include <algorithm>
#include <stdexcept>

#include "base/ratio.hpp"

namespace degs::cost {
namespace {

/// Sums one number over the blocks that `counts`.
template <class Counts>
double sum_of(const std::vector<Block>& blocks, double Block::*number, const Counts& counts) {
    double sum = 0;
    for (const Block& block : blocks) {
        sum += counts(block) ? block.*number : 0;
    }
    return sum;
}

bool any(const Block&) {
    return true;
}

bool is_sram(const Block& block) {
    return block.kind == Block::Kind::Sram;
}

/// Area of a buffer relative to one of as many bytes with the banks and the ports of its row.
double shape_factor(const Technology::Sram& sram, const PortedSramRow& row,
                    const SramShape& shape) {
    if (shape.ports == 0) {
        return 1;
    }
    const auto of_ports = [&sram](int ports) { return 1 + sram.port_share * (ports - 1); };
    const double banks = rate_of(shape.banks, row.sram_banks);
    const double factor =
        (1 + sram.bank_share * (banks - 1)) * of_ports(shape.ports) / of_ports(row.ports);
    return 1 + shape.share * (factor - 1);
}

} // namespace

void Block::describe(StatsVisitor& visitor) const {
    const auto whole = static_cast<std::uint64_t>(size);
    if (kind == Kind::Units) {
        visitor.count("units", whole, "units", "Units of this kind.");
    } else {
        visitor.count("bytes", whole, "bytes", "Capacity.");
    }
    visitor.real("mm2", area_mm2, "mm2", "Area of all of it.");
    visitor.real("power_w", power_w, "W", "Power at the activity that the table assumes.");
    visitor.real("leakage_w", leakage_w, "W", "The part of it that flows at any activity.");
}

void BillOfMaterials::add_units(const Title& title, const UnitRow& row, double units, double share,
                                const PeFactors& factors) {
    Block block;
    block.kind = Block::Kind::Units;
    block.size = units;
    block.area_mm2 = row.area_mm2 / row.units * units * share * factors.area;
    block.energy_pj = technology_.energy_pj(row) * share * factors.energy;
    block.full_rate = units;
    add(title, std::move(block));
}

Block BillOfMaterials::sram_of(const SramRow& row, std::int64_t bytes,
                               double bytes_per_cycle) const {
    Block block;
    block.kind = Block::Kind::Sram;
    block.size = real_of(bytes);
    block.area_mm2 = row.area_mm2 / row.bytes * block.size;
    block.energy_pj = technology_.energy_pj(row);
    block.full_rate = bytes_per_cycle;
    return block;
}

void BillOfMaterials::add_sram(const Title& title, const SramRow& row, std::int64_t bytes,
                               double bytes_per_cycle) {
    add(title, sram_of(row, bytes, bytes_per_cycle));
}

void BillOfMaterials::add_sram(const Title& title, const PortedSramRow& row, std::int64_t bytes,
                               double bytes_per_cycle, const SramShape& shape) {
    Block block = sram_of(row, bytes, bytes_per_cycle);
    block.area_mm2 *= shape_factor(technology_.sram, row, shape);
    add(title, std::move(block));
}

// The rows leak by their own area, whose node the factors leave.
void BillOfMaterials::add(const Title& title, Block block) {
    block.name = title.name;
    block.sentence = title.sentence;
    block.front_end = title.front_end;
    block.leakage_w = technology_.leakage_w(block.area_mm2);
    block.area_mm2 *= technology_.area_factor;
    constexpr double kWPerPjGhz = 1e-3;
    block.power_w = block.leakage_w + kWPerPjGhz * block.energy_pj * block.full_rate *
                                          technology_.activity * clock_ghz_;
    blocks_.push_back(std::move(block));
}

const Block& BillOfMaterials::block(const std::string& name) const {
    const auto found = std::find_if(blocks_.begin(), blocks_.end(),
                                    [&name](const Block& block) { return block.name == name; });
    if (found == blocks_.end()) {
        throw std::logic_error("the bill of materials has no block '" + name + "'");
    }
    return *found;
}

double BillOfMaterials::area_mm2() const {
    return sum_of(blocks_, &Block::area_mm2, any);
}

double BillOfMaterials::sram_mm2() const {
    return sum_of(blocks_, &Block::area_mm2, is_sram);
}

std::int64_t BillOfMaterials::sram_bytes() const {
    return static_cast<std::int64_t>(sum_of(blocks_, &Block::size, is_sram));
}

double BillOfMaterials::power_w() const {
    return sum_of(blocks_, &Block::power_w, any);
}

double BillOfMaterials::sram_power_w() const {
    return sum_of(blocks_, &Block::power_w, is_sram);
}

double BillOfMaterials::leakage_w() const {
    return sum_of(blocks_, &Block::leakage_w, any);
}

void BillOfMaterials::describe(StatsVisitor& visitor) const {
    visitor.text("node", technology_.node, "Technology that the numbers are for.");
    visitor.real("mm2", area_mm2(), "mm2", "Area of all blocks.");
    visitor.real("units_mm2", area_mm2() - sram_mm2(), "mm2", "Area of the units.");
    visitor.real("sram_mm2", sram_mm2(), "mm2", "Area of the buffers.");
    visitor.count("sram_bytes", static_cast<std::uint64_t>(sram_bytes()), "bytes",
                  "Capacity of the buffers.");
    visitor.real("power_w", power_w(), "W", "Power at the activity that the table assumes.");
    visitor.real("leakage_w", leakage_w(), "W", "The part of it that flows at any activity.");
    visitor.begin_section("blocks", "Every kind of unit and every buffer.");
    for (const Block& block : blocks_) {
        visitor.section(block.name, block, block.sentence);
    }
    visitor.end_section();
}

} // namespace degs::cost
