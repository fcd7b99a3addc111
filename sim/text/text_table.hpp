// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

namespace degs::sim {

/// A table for terminals. A column in which every cell below the heading is empty is left out. Of
/// the others the first is flushed left, the rest right; other empty cells show "-". A table wider
/// than output_columns() goes on below, column by column, and repeats its first one.
class TextTable {
public:
    explicit TextTable(std::vector<std::string> headings) : lines_{std::move(headings)} {}
    /// As many cells as there are headings, each one line, whatever it contains.
    void add(std::vector<std::string> cells);
    std::string text() const;

private:
    std::string text_of(const std::vector<std::size_t>& columns,
                        const std::vector<std::size_t>& widths) const;
    std::vector<std::vector<std::string>> lines_;
};

} // namespace degs::sim
