// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace degs::sim_test {

using CsvRow = std::map<std::string, std::string>;

/// The cells of a CSV text without quoted ones, by row and heading.
inline std::vector<CsvRow> rows_by_heading(const std::string& csv) {
    std::istringstream lines(csv);
    std::vector<std::string> head;
    std::vector<CsvRow> rows;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream cells(line + ",");
        std::vector<std::string> row;
        for (std::string cell; std::getline(cells, cell, ',');) {
            row.push_back(cell);
        }
        if (head.empty()) {
            head = row;
            continue;
        }
        EXPECT_EQ(row.size(), head.size());
        row.resize(head.size());
        rows.emplace_back();
        for (std::size_t c = 0; c < head.size(); ++c) {
            rows.back()[head[c]] = row[c];
        }
    }
    return rows;
}

} // namespace degs::sim_test
