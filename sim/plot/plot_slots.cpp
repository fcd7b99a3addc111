// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "sim/plot/plot_style.hpp"
#include "sim/plot/plot_svg.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

constexpr double kBar = 24;
constexpr double kRow = 30;
constexpr double kHeading = 34;
constexpr double kAxis = 30;               // below the bars of a group
constexpr const char* kBefore = "#d9d9d9"; // the array has not begun, or has finished
constexpr const char* kAfter = "#bdbdbd";

/// Columns of the picture, chosen by the longest words.
struct Columns {
    double left = 0, right = 0; ///< ends of a full bar
    double label_width = 0, note_width = 0;
};

Columns columns_of(const std::vector<SlotGroup>& groups) {
    double label = 60;
    double note = 0;
    for (const SlotGroup& group : groups) {
        for (const SlotBar& bar : group.bars) {
            label = std::max(label, text_width(bar.label, kLabelText));
            note = std::max(note, text_width(bar.note, kSmallText));
        }
    }
    Columns columns;
    columns.label_width = std::min(label, 230.0);
    columns.note_width = std::min(note, 240.0);
    columns.left = kPlotMargin + columns.label_width + 10;
    columns.right = kPlotWidth - kPlotMargin - columns.note_width - (note > 0 ? 10 : 12);
    return columns;
}

/// Dark words on light colours and light ones on dark.
const char* ink_on(const char* colour) {
    const auto channel = [colour](int at) {
        return std::stoi(std::string(colour + at, 2), nullptr, 16);
    };
    const double light = 0.299 * channel(1) + 0.587 * channel(3) + 0.114 * channel(5);
    return light > 140 ? kInk : "#ffffff";
}

/// With one decimal if that fits, else nothing: 5.9 is not 6.
void draw_share(Svg& svg, double x, double y, double width, double share, const char* colour) {
    const std::string words = percent(share);
    if (text_width(words, kSmallText) + 4 <= width) {
        svg.text(x + width / 2, y, words, {kSmallText, ink_on(colour), "middle", false});
    }
}

/// A piece of a bar, with a hair of white that keeps neighbours apart without colour.
void draw_piece(Svg& svg, double x, double y, double width, const char* colour) {
    if (width > 0) {
        svg.rectangle(x, y, std::max(width - 0.75, width / 2), kBar, colour);
    }
}

/// `scale`: px per ms.
void draw_bar(Svg& svg, const Columns& columns, double y, double scale, const SlotBar& bar) {
    const double base = y + kBar / 2 + 4.5;
    svg.text(columns.left - 10, base, fitting(bar.label, kLabelText, columns.label_width),
             {kLabelText, kInk, "end", false});
    draw_piece(svg, columns.left, y, bar.first_ms * scale, kBefore);
    double x = columns.left + bar.first_ms * scale;
    for (std::size_t c = 0; c < kSlotClasses.size(); ++c) {
        const double width = bar.shares[c] * (bar.last_ms - bar.first_ms) * scale;
        if (width > 0) {
            draw_piece(svg, x, y, width, kSlotColours[c]);
            draw_share(svg, x, base, width, bar.shares[c], kSlotColours[c]);
        }
        x += width;
    }
    draw_piece(svg, x, y, (bar.end_ms - bar.last_ms) * scale, kAfter);
    svg.text(columns.right + 10, base, fitting(bar.note, kSmallText, columns.note_width),
             {kSmallText, kGrey, "start", false});
}

bool occurs(const std::vector<SlotGroup>& groups, std::size_t slot_class) {
    for (const SlotGroup& group : groups) {
        for (const SlotBar& bar : group.bars) {
            if (bar.shares[slot_class] > 0) {
                return true;
            }
        }
    }
    return false;
}

/// Returns the y below it.
double draw_slot_legend(Svg& svg, double y, const std::vector<SlotGroup>& groups) {
    std::vector<std::pair<std::string, const char*>> entries;
    for (std::size_t c = 0; c < kSlotClasses.size(); ++c) {
        if (!kSlotClasses[c].rare || occurs(groups, c)) {
            entries.emplace_back(kSlotClasses[c].name, kSlotColours[c]);
        }
    }
    entries.emplace_back("before the first task", kBefore);
    entries.emplace_back("after the last", kAfter);
    double x = kPlotMargin;
    for (const auto& [name, colour] : entries) {
        const double width = 18 + text_width(name, kSmallText) + 16;
        if (x + width > kPlotWidth - kPlotMargin + 16) {
            x = kPlotMargin;
            y += 20;
        }
        svg.rectangle(x, y - 11, 13, 13, colour);
        svg.text(x + 18, y, name, {kSmallText, kInk, "start", false});
        x += width;
    }
    return y + 14;
}

/// Ticks in ms below the bars.
void draw_axis(Svg& svg, const Columns& columns, double top, double bottom, double scale) {
    const double longest = (columns.right - columns.left) / scale;
    const double tick = tick_of(longest);
    for (int i = 0; i * tick <= longest * 1.0001; ++i) {
        const double x = columns.left + i * tick * scale;
        svg.line(x, top, x, bottom, kGrid, 1);
        svg.text(x, bottom + 17, decimal_text(i * tick) + (i == 0 ? " ms" : ""),
                 {kSmallText, kGrey, "middle", false});
    }
}

double longest_of(const SlotGroup& group) {
    double longest = 0;
    for (const SlotBar& bar : group.bars) {
        longest = std::max(longest, bar.end_ms);
    }
    return longest > 0 ? longest : 1;
}

} // namespace

std::string slots_svg(const std::string& title, const std::vector<SlotGroup>& groups) {
    const Columns columns = columns_of(groups);
    Svg svg;
    svg.text(kPlotMargin, 30, title, {16, kInk, "start", true});
    double y = draw_slot_legend(svg, 56, groups);
    for (const SlotGroup& group : groups) {
        svg.text(kPlotMargin, y + 22,
                 fitting(group.heading, kLabelText, kPlotWidth - 2 * kPlotMargin),
                 {kLabelText, kInk, "start", true});
        y += kHeading;
        const double scale = (columns.right - columns.left) / longest_of(group);
        const double bottom = y + kRow * static_cast<double>(group.bars.size());
        draw_axis(svg, columns, y - 6, bottom, scale);
        for (const SlotBar& bar : group.bars) {
            draw_bar(svg, columns, y, scale, bar);
            y += kRow;
        }
        y += kAxis;
    }
    svg.text((columns.left + columns.right) / 2, y + 8,
             "time of the frame; numbers: % of the PE-cycles from the first task to the last",
             {kSmallText, kGrey, "middle", false});
    return svg.document(kPlotWidth, y + 24, title);
}

} // namespace degs::sim
