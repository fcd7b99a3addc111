// SPDX-License-Identifier: Apache-2.0
#include "sim/text/text_table.hpp"

#include <algorithm>
#include <utility>

#include "base/visible_text.hpp"
#include "sim/text/output_columns.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

constexpr std::size_t kGap = 2; // blanks between two columns

} // namespace

void TextTable::add(std::vector<std::string> cells) {
    std::transform(cells.begin(), cells.end(), cells.begin(), visible);
    lines_.push_back(std::move(cells));
}

std::string TextTable::text() const {
    const std::size_t columns = lines_.front().size();
    std::vector<std::size_t> widths(columns, 0), used;
    for (std::size_t c = 0; c < columns; ++c) {
        bool filled = c == 0 && lines_.size() == 1;
        for (std::size_t row = 0; row < lines_.size(); ++row) {
            widths[c] = std::max({widths[c], characters(lines_[row][c]), std::size_t{1}});
            filled = filled || (row > 0 && !lines_[row][c].empty());
        }
        if (filled) {
            used.push_back(c);
        }
    }
    std::string text;
    const std::size_t most = output_columns();
    for (std::size_t first = 1; first < used.size() || text.empty();) {
        std::vector<std::size_t> part{used.front()};
        std::size_t width = widths[used.front()];
        while (first < used.size() &&
               (part.size() == 1 || width + kGap + widths[used[first]] <= most)) {
            width += kGap + widths[used[first]];
            part.push_back(used[first++]);
        }
        text += (text.empty() ? "" : "\n") + text_of(part, widths);
    }
    return text;
}

std::string TextTable::text_of(const std::vector<std::size_t>& columns,
                               const std::vector<std::size_t>& widths) const {
    std::string text;
    for (const auto& line : lines_) {
        for (const std::size_t c : columns) {
            const bool first = c == columns.front();
            const std::string cell = line[c].empty() && !first ? "-" : line[c];
            const std::string padding(widths[c] - characters(cell), ' ');
            if (first) {
                text.append(cell).append(padding);
            } else {
                text.append(kGap, ' ').append(padding).append(cell);
            }
        }
        text.erase(text.find_last_not_of(' ') + 1);
        text += "\n";
    }
    return text;
}

} // namespace degs::sim
