// SPDX-License-Identifier: Apache-2.0
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

} // namespace

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
