// SPDX-License-Identifier: Apache-2.0
#include "sim/config/cost_output.hpp"

#include <cmath>
#include <cstdio>
#include <vector>

#include <nlohmann/json.hpp>

#include "base/json_text.hpp"
#include "sim/text/output_columns.hpp"
#include "sim/text/text_table.hpp"
#include "sim/text/words.hpp"
#include "stats/statistics_document.hpp"

namespace degs::sim {
namespace {

using Cells = std::vector<std::string>;

/// Enough decimals for the smallest row of the paper's Table I, which is 0.001 W.
std::string thousandths(double value) {
    constexpr int kDecimals = 3;
    return percent(value / 100, kDecimals);
}

std::string milli(double value) {
    return three_digits(value * 1e3);
}

std::string size_of(const cost::Block& block) {
    if (block.kind == cost::Block::Kind::Units) {
        return grouped(static_cast<std::uint64_t>(block.size));
    }
    return three_digits(block.size / 1024) + " KB";
}

Cells heading(const std::string& node) {
    return {node.empty() ? "block" : node, "size", "mm²", "W", "leakage mW", "pJ per operation"};
}

std::vector<Cells> rows_of(const cost::BillOfMaterials& bill) {
    std::vector<Cells> rows;
    for (const cost::Block& block : bill.blocks()) {
        rows.push_back({block.name, size_of(block), thousandths(block.area_mm2),
                        thousandths(block.power_w), milli(block.leakage_w),
                        three_digits(block.energy_pj)});
    }
    rows.push_back({"SRAM", three_digits(static_cast<double>(bill.sram_bytes()) / 1024) + " KB",
                    thousandths(bill.sram_mm2()), thousandths(bill.sram_power_w()), "", ""});
    rows.push_back({"total", "", thousandths(bill.area_mm2()), thousandths(bill.power_w()),
                    milli(bill.leakage_w()), ""});
    return rows;
}

std::string markdown_line(const Cells& cells) {
    std::string line = "|";
    for (const std::string& cell : cells) {
        line += " " + cell + " |";
    }
    return line + "\n";
}

} // namespace

std::string cost_text(const cost::BillOfMaterials& bill, const cost::ClockEstimate& clock) {
    TextTable table(heading(bill.technology().node));
    for (Cells& row : rows_of(bill)) {
        table.add(std::move(row));
    }
    const std::string words = "clock: " + clock.words(bill.technology().node);
    return table.text() + folded(words, output_columns()) + "\n";
}

std::string cost_markdown(const cost::BillOfMaterials& bill) {
    std::string table = markdown_line(heading("")) + "|---|---:|---:|---:|---:|---:|\n";
    for (const Cells& row : rows_of(bill)) {
        table += markdown_line(row);
    }
    return table;
}

std::string cost_json(const std::string& name, const cost::BillOfMaterials& bill,
                      const cost::ClockEstimate& clock) {
    nlohmann::ordered_json json;
    json["name"] = name;
    json.update(statistics_json(list_statistics([&](StatsVisitor& visitor) {
        visitor.section("area", bill, "");
        visitor.section("clock", clock, "");
    })));
    return dump_json(json, 2) + "\n";
}

} // namespace degs::sim
