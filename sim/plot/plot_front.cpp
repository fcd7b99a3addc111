// SPDX-License-Identifier: Apache-2.0
#include "sim/plot/log_axis.hpp"
#include "sim/plot/plot_style.hpp"
#include "sim/plot/plot_svg.hpp"

namespace degs::sim {
namespace {

constexpr double kFrontTop = 76;

LogAxis axis_of(const std::vector<FrontPoint>& points, double FrontPoint::*value, double begin,
                double end) {
    std::vector<double> values;
    values.reserve(points.size());
    for (const FrontPoint& point : points) {
        values.push_back(point.*value);
    }
    return LogAxis::around(values, begin, end);
}

} // namespace

std::string front_svg(const std::string& title, const std::string& x_label,
                      const std::string& y_label, const std::vector<FrontPoint>& points) {
    Svg svg;
    svg.text(kPlotMargin, 24, fitting(title, 15, kPlotWidth - 2 * kPlotMargin),
             {15, kInk, "start", true});
    draw_legend(svg, 46, {"nobody is better in both", "beaten", "baseline"});
    svg.text(kPlotMargin, kFrontTop - 6, y_label, {kSmallText, kGrey, "start", false});
    svg.text((kChartLeft + kChartRight) / 2, kChartBottom + 44, x_label,
             {kLabelText, kGrey, "middle", false});
    if (points.empty()) {
        return svg.document(kPlotWidth, kChartHeight, title);
    }
    const LogAxis x = axis_of(points, &FrontPoint::x, kChartLeft, kChartRight);
    const LogAxis y = axis_of(points, &FrontPoint::y, kChartBottom, kFrontTop);
    draw_log_axes(svg, x, y);
    Svg::Points steps;
    for (const FrontPoint& point : points) { // from the best in x; each holds until the next
        if (point.on_front) {
            if (!steps.empty()) {
                steps.emplace_back(x.at(point.x), steps.back().second);
            }
            steps.emplace_back(x.at(point.x), y.at(point.y));
        }
    }
    if (steps.size() > 1) {
        svg.polyline(steps, colour_of_line(0), 1.5);
    }
    for (const bool on_front : {false, true}) {
        for (const FrontPoint& point : points) {
            if (point.on_front == on_front) {
                svg.marker(marker_of_line(on_front ? 0 : 1), x.at(point.x), y.at(point.y),
                           colour_of_line(on_front ? 0 : 1));
            }
        }
    }
    for (const FrontPoint& point : points) {
        if (point.baseline) {
            svg.marker(marker_of_line(2), x.at(point.x), y.at(point.y), colour_of_line(2));
        }
    }
    return svg.document(kPlotWidth, kChartHeight, title);
}

} // namespace degs::sim
