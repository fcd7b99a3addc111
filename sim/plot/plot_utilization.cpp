// SPDX-License-Identifier: Apache-2.0
// Utilization over the size of an array, and ratios of designs by view.
#include <algorithm>
#include <cmath>

#include "sim/plot/plot_style.hpp"
#include "sim/plot/plot_svg.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

constexpr double kUtilizationPanelHeight = 300;

/// log2 of the PEs that the axis reaches, with room for the markers at its ends.
struct Range {
    double low = 1e9, high = -1e9;
    int tick_step = 1; ///< powers of two from tick to tick
};

Range range_of(const std::vector<UtilizationPanel>& panels) {
    Range range;
    for (const UtilizationPanel& panel : panels) {
        for (const UtilizationLine& line : panel.lines) {
            for (const auto& [pes, share] : line.points) {
                range.low = std::min(range.low, std::floor(std::log2(pes)));
                range.high = std::max(range.high, std::ceil(std::log2(pes)));
            }
        }
    }
    if (range.high < range.low) {
        range.low = range.high = 0;
    }
    range.tick_step = range.high - range.low > 7 ? 2 : 1;
    return range;
}

/// Where the data of a panel lie, px.
struct UtilizationAxes {
    double left = 0, right = 0, top = 0, bottom = 0;
    Range range;
    double x(double log_pes) const {
        const double padding = 0.35; // octaves
        return left + (log_pes - range.low + padding) / (range.high - range.low + 2 * padding) *
                          (right - left);
    }
    double y(double share) const { return bottom - share * (bottom - top); }
};

void draw_axes(Svg& svg, const UtilizationAxes& axes) {
    for (int tick = 0; tick <= 100; tick += 20) {
        const double y = axes.y(tick / 100.0);
        svg.line(axes.left, y, axes.right, y, tick == 0 ? kGrey : kGrid, 1);
        svg.text(axes.left - 8, y + 4, std::to_string(tick), {kSmallText, kGrey, "end", false});
    }
    const int low = static_cast<int>(axes.range.low);
    for (int power = low; power <= axes.range.high; power += axes.range.tick_step) {
        const double x = axes.x(power);
        svg.line(x, axes.bottom, x, axes.bottom + 5, kGrey, 1);
        svg.text(x, axes.bottom + 19, std::to_string(1LL << power),
                 {kSmallText, kGrey, "middle", false});
    }
    svg.text((axes.left + axes.right) / 2, axes.bottom + 38, "PEs, log scale",
             {kSmallText, kGrey, "middle", false});
    svg.text(axes.left - 34, axes.top - 12, "PE utilization, %",
             {kSmallText, kGrey, "start", false});
}

std::vector<Svg::Points> places_of(const UtilizationAxes& axes,
                                   const std::vector<UtilizationLine>& lines) {
    std::vector<Svg::Points> all;
    for (const UtilizationLine& line : lines) {
        auto points = line.points;
        std::sort(points.begin(), points.end());
        Svg::Points places;
        for (const auto& [pes, share] : points) {
            places.emplace_back(axes.x(std::log2(pes)), axes.y(share));
        }
        all.push_back(std::move(places));
    }
    return all;
}

std::vector<std::string> labels_of(const std::vector<UtilizationPanel>& panels) {
    std::vector<std::string> labels;
    if (!panels.empty()) {
        for (const UtilizationLine& line : panels.front().lines) {
            labels.push_back(line.label);
        }
    }
    return labels;
}

/// Where the bars of a row of groups lie, px.
struct RatioAxes {
    double top = 0, bottom = 0, highest = 1;
    double group = 0, bar = 0; ///< widths
    double y(double ratio) const { return bottom - ratio / highest * (bottom - top); }
};

constexpr double kRatioLeft = kPlotMargin + 36;
constexpr double kRatioRight = kPlotWidth - kPlotMargin;
constexpr double kRatioHeight = 170; // of the bars
constexpr double kRatioRow = 240;    // with the words above and below

/// As many groups side by side as leave bars on which a number can be read upright.
std::size_t groups_per_row(std::size_t groups, std::size_t designs) {
    constexpr double kNarrowest = 14;
    const double group = kNarrowest * (static_cast<double>(designs) + 1);
    const auto most = static_cast<std::size_t>((kRatioRight - kRatioLeft) / group);
    return std::min(groups, std::max<std::size_t>(most, 1));
}

double highest_of(const RatioPanel& panel) {
    double highest = 1;
    for (const RatioGroup& group : panel.groups) {
        for (const std::optional<double>& ratio : group.ratios) {
            highest = std::max(highest, ratio.value_or(0));
        }
    }
    return highest * 1.12; // room for the numbers
}

void draw_ratio_axes(Svg& svg, const RatioAxes& axes) {
    const double tick = tick_of(axes.highest);
    for (int i = 0; i * tick <= axes.highest; ++i) {
        const double y = axes.y(i * tick);
        svg.line(kRatioLeft, y, kRatioRight, y, i == 0 ? kGrey : kGrid, 1);
        svg.text(kRatioLeft - 8, y + 4, decimal_text(i * tick), {kSmallText, kGrey, "end", false});
    }
    svg.line(kRatioLeft, axes.y(1), kRatioRight, axes.y(1), kInk, 1);
}

/// The number stands above its bar, with as many digits as fit.
void draw_ratio_bars(Svg& svg, const RatioAxes& axes, double left, const RatioGroup& group) {
    constexpr double kNumber = 11;
    for (std::size_t d = 0; d < group.ratios.size(); ++d) {
        if (!group.ratios[d]) {
            continue;
        }
        const double x = left + axes.bar * (static_cast<double>(d) + 0.5);
        const double y = axes.y(*group.ratios[d]);
        svg.rectangle(x, y, axes.bar - 1, axes.bottom - y, colour_of_line(d));
        for (const int decimals : {2, 1}) {
            const std::string words = percent(*group.ratios[d] / 100, decimals);
            if (text_width(words, kNumber) <= axes.bar + 4) {
                svg.text(x + axes.bar / 2, y - 4, words, {kNumber, kInk, "middle", false});
                break;
            }
        }
    }
    const double width = axes.bar * (static_cast<double>(group.ratios.size()) + 1);
    svg.text(left + width / 2, axes.bottom + 18, fitting(group.label, kSmallText, axes.group - 6),
             {kSmallText, kInk, "middle", false});
}

/// Returns the y below the panel.
double draw_ratio_panel(Svg& svg, double y, const RatioPanel& panel, std::size_t designs) {
    const std::size_t per_row = groups_per_row(panel.groups.size(), designs);
    svg.text(kPlotMargin, y + 22, fitting(panel.heading, kLabelText, kPlotWidth - 2 * kPlotMargin),
             {kLabelText, kInk, "start", true});
    RatioAxes axes;
    axes.highest = highest_of(panel);
    axes.group = (kRatioRight - kRatioLeft) / static_cast<double>(per_row);
    axes.bar = std::min(axes.group / (static_cast<double>(designs) + 1), 60.0);
    for (std::size_t g = 0; g < panel.groups.size(); ++g) {
        if (g % per_row == 0) {
            axes.top = y + 34;
            axes.bottom = axes.top + kRatioHeight;
            draw_ratio_axes(svg, axes);
            y += kRatioRow;
        }
        const double unused = axes.group - axes.bar * (static_cast<double>(designs) + 1);
        const double left = kRatioLeft + axes.group * static_cast<double>(g % per_row);
        draw_ratio_bars(svg, axes, left + unused / 2, panel.groups[g]);
    }
    return y;
}

/// Returns the y below it.
double draw_design_legend(Svg& svg, double y, const std::vector<std::string>& designs) {
    double x = kPlotMargin;
    for (std::size_t d = 0; d < designs.size(); ++d) {
        const std::string name = fitting(designs[d], kSmallText, 300);
        const double width = 18 + text_width(name, kSmallText) + 16;
        if (x + width > kPlotWidth - kPlotMargin + 16) {
            x = kPlotMargin;
            y += 20;
        }
        svg.rectangle(x, y - 11, 13, 13, colour_of_line(d));
        svg.text(x + 18, y, name, {kSmallText, kInk, "start", false});
        x += width;
    }
    return y + 10;
}

} // namespace

std::string ratios_svg(const std::string& title, const std::vector<std::string>& designs,
                       const std::vector<RatioPanel>& panels) {
    Svg svg;
    svg.text(kPlotMargin, 30, title, {16, kInk, "start", true});
    double y = draw_design_legend(svg, 56, designs);
    for (const RatioPanel& panel : panels) {
        y = draw_ratio_panel(svg, y, panel, designs.size());
    }
    return svg.document(kPlotWidth, y, title);
}

std::string utilization_svg(const std::string& title, const std::vector<UtilizationPanel>& panels) {
    Svg svg;
    svg.text(kPlotMargin, 30, title, {16, kInk, "start", true});
    const double top = draw_legend(svg, 56, labels_of(panels));
    const double columns = panels.size() > 1 ? 2 : 1;
    const double panel_width = (kPlotWidth - 2 * kPlotMargin) / columns;
    double bottom = top;
    for (std::size_t p = 0; p < panels.size(); ++p) {
        const double left =
            kPlotMargin + panel_width * (columns > 1 ? static_cast<double>(p % 2) : 0);
        const double y =
            top + kUtilizationPanelHeight * static_cast<double>(columns > 1 ? p / 2 : p);
        UtilizationAxes axes;
        axes.range = range_of(panels);
        axes.left = left + 36;
        axes.right = left + panel_width - 14;
        axes.top = y + 56;
        axes.bottom = y + kUtilizationPanelHeight - 48;
        svg.text(left, y + 20, fitting(panels[p].heading, kLabelText, panel_width - 10),
                 {kLabelText, kInk, "start", true});
        draw_axes(svg, axes);
        draw_lines(svg, places_of(axes, panels[p].lines));
        bottom = y + kUtilizationPanelHeight;
    }
    return svg.document(kPlotWidth, bottom + 6, title);
}

} // namespace degs::sim
