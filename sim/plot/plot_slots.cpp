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
    columns.note_width = std::min(note, 170.0);
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

/// With one decimal if that fits, else none, else nothing.
void draw_share(Svg& svg, double x, double y, double width, double share, const char* colour) {
    for (int decimals : {1, 0}) {
        const std::string words = percent(share, decimals);
        if (text_width(words, kSmallText) + 4 <= width && words != "0") {
            svg.text(x + width / 2, y, words, {kSmallText, ink_on(colour), "middle", false});
            return;
        }
    }
}

void draw_bar(Svg& svg, const Columns& columns, double y, const SlotBar& bar) {
    const double base = y + kBar / 2 + 4.5;
    svg.text(columns.left - 10, base, fitting(bar.label, kLabelText, columns.label_width),
             {kLabelText, kInk, "end", false});
    double x = columns.left;
    for (std::size_t c = 0; c < kSlotClasses.size(); ++c) {
        const double width = bar.shares[c] * (columns.right - columns.left);
        if (width > 0) {
            // A hair of white keeps neighbours apart without colour.
            svg.rectangle(x, y, std::max(width - 0.75, width / 2), kBar, kSlotColours[c]);
            draw_share(svg, x, base, width, bar.shares[c], kSlotColours[c]);
        }
        x += width;
    }
    svg.text(columns.right + 10, base, fitting(bar.note, kSmallText, columns.note_width),
             {kSmallText, kGrey, "start", false});
}

/// Returns the y below it.
double draw_slot_legend(Svg& svg, double y) {
    double x = kPlotMargin;
    for (std::size_t c = 0; c < kSlotClasses.size(); ++c) {
        const char* name = kSlotClasses[c].name;
        const double width = 18 + text_width(name, kSmallText) + 16;
        if (x + width > kPlotWidth - kPlotMargin + 16) {
            x = kPlotMargin;
            y += 20;
        }
        svg.rectangle(x, y - 11, 13, 13, kSlotColours[c]);
        svg.text(x + 18, y, name, {kSmallText, kInk, "start", false});
        x += width;
    }
    return y + 14;
}

void draw_axis(Svg& svg, const Columns& columns, double top, double bottom) {
    for (int tick = 0; tick <= 100; tick += 20) {
        const double x = columns.left + tick / 100.0 * (columns.right - columns.left);
        svg.line(x, top, x, bottom, kGrid, 1);
        svg.text(x, bottom + 17, std::to_string(tick), {kSmallText, kGrey, "middle", false});
    }
    svg.text((columns.left + columns.right) / 2, bottom + 36,
             "% of the PE-cycles from the first task to the last",
             {kSmallText, kGrey, "middle", false});
}

} // namespace

std::string slots_svg(const std::string& title, const std::vector<SlotGroup>& groups) {
    const Columns columns = columns_of(groups);
    Svg svg;
    svg.text(kPlotMargin, 30, title, {16, kInk, "start", true});
    const double top = draw_slot_legend(svg, 56);
    double bottom = top;
    for (const SlotGroup& group : groups) {
        bottom += kHeading + kRow * static_cast<double>(group.bars.size());
    }
    draw_axis(svg, columns, top + kHeading - 6, bottom);
    double y = top;
    for (const SlotGroup& group : groups) {
        // On the grid, so that the heading needs a white ground.
        svg.rectangle(kPlotMargin, y + 6, kPlotWidth - 2 * kPlotMargin, kHeading - 10, "#ffffff");
        svg.text(kPlotMargin, y + 22,
                 fitting(group.heading, kLabelText, kPlotWidth - 2 * kPlotMargin),
                 {kLabelText, kInk, "start", true});
        y += kHeading;
        for (const SlotBar& bar : group.bars) {
            draw_bar(svg, columns, y, bar);
            y += kRow;
        }
    }
    return svg.document(kPlotWidth, bottom + 50, title);
}

} // namespace degs::sim
