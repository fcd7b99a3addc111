// SPDX-License-Identifier: Apache-2.0
#include "sim/text/text_table.hpp"

#include <algorithm>
#include <utility>

#include "config/visible_text.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {

void TextTable::add(std::vector<std::string> cells) {
    std::transform(cells.begin(), cells.end(), cells.begin(), visible);
    lines_.push_back(std::move(cells));
}

std::string TextTable::text() const {
    const std::size_t columns = lines_.front().size();
    std::vector<std::size_t> widths(columns, 0);
    std::vector<bool> used(columns, false);
    for (std::size_t row = 0; row < lines_.size(); ++row) {
        for (std::size_t c = 0; c < columns; ++c) {
            widths[c] = std::max({widths[c], characters(lines_[row][c]), std::size_t{1}});
            used[c] = used[c] || c == 0 || (row > 0 && !lines_[row][c].empty());
        }
    }
    std::string text;
    for (const auto& line : lines_) {
        for (std::size_t c = 0; c < columns; ++c) {
            if (!used[c]) {
                continue;
            }
            const std::string cell = line[c].empty() && c != 0 ? "-" : line[c];
            const std::string padding(widths[c] - characters(cell), ' ');
            if (c == 0) {
                text.append(cell).append(padding);
            } else {
                text.append("  ").append(padding).append(cell);
            }
        }
        text.erase(text.find_last_not_of(' ') + 1);
        text += "\n";
    }
    return text;
}

} // namespace degs::sim
