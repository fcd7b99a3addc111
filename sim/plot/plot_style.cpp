// SPDX-License-Identifier: Apache-2.0
#include "sim/plot/plot_style.hpp"

namespace degs::sim {

double draw_legend(Svg& svg, double y, const std::vector<std::string>& labels) {
    double x = kPlotMargin;
    for (std::size_t i = 0; i < labels.size(); ++i) {
        const std::string label = fitting(labels[i], kSmallText, 300);
        const double width = 34 + text_width(label, kSmallText) + 18;
        if (x > kPlotMargin && x + width > kPlotWidth - kPlotMargin + 18) {
            x = kPlotMargin;
            y += 20;
        }
        svg.line(x, y - 4, x + 26, y - 4, colour_of_line(i), 2);
        svg.marker(marker_of_line(i), x + 13, y - 4, colour_of_line(i));
        svg.text(x + 34, y, label, {kSmallText, kInk, "start", false});
        x += width;
    }
    return y + 10;
}

void draw_lines(Svg& svg, const std::vector<Svg::Points>& lines) {
    for (std::size_t i = 0; i < lines.size(); ++i) {
        if (lines[i].size() > 1) {
            svg.polyline(lines[i], colour_of_line(i), 2);
        }
    }
    for (std::size_t i = 0; i < lines.size(); ++i) {
        for (const auto& [x, y] : lines[i]) {
            svg.marker(marker_of_line(i), x, y, colour_of_line(i));
        }
    }
}

} // namespace degs::sim
