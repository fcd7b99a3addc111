// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "sim/plot/plot_style.hpp"
#include "sim/plot/plot_svg.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

constexpr double kFrontTop = 76;

/// A logarithmic axis with room at its ends.
struct FrontAxis {
    double low = 0, high = 1;  ///< logarithms
    double begin = 0, end = 0; ///< px
    double at(double value) const {
        return begin + (std::log10(value) - low) / (high - low) * (end - begin);
    }
};

FrontAxis axis_of(const std::vector<FrontPoint>& points, double FrontPoint::*value, double begin,
                  double end) {
    FrontAxis axis{1e9, -1e9, begin, end};
    for (const FrontPoint& point : points) {
        axis.low = std::min(axis.low, std::log10(point.*value));
        axis.high = std::max(axis.high, std::log10(point.*value));
    }
    const double room = std::max(0.02, 0.06 * (axis.high - axis.low));
    axis.low -= room;
    axis.high += room;
    return axis;
}

/// Round values inside the axis: 1, 2, 5, 10, ... or, on a short axis, evenly spaced ones.
std::vector<double> ticks_of(const FrontAxis& axis) {
    const double low = std::pow(10, axis.low), high = std::pow(10, axis.high);
    std::vector<double> ticks;
    if (axis.high - axis.low < 1) {
        const double step = tick_of(high - low, 6);
        for (double tick = std::ceil(low / step) * step; tick <= high; tick += step) {
            ticks.push_back(tick);
        }
        return ticks;
    }
    for (double power = std::pow(10, std::floor(axis.low)); power <= high; power *= 10) {
        for (const double factor : {1.0, 2.0, 5.0}) {
            if (factor * power >= low && factor * power <= high) {
                ticks.push_back(factor * power);
            }
        }
    }
    return ticks;
}

void draw_axes(Svg& svg, const FrontAxis& x, const FrontAxis& y) {
    for (const double tick : ticks_of(y)) {
        svg.line(x.begin, y.at(tick), x.end, y.at(tick), kGrid, 1);
        svg.text(x.begin - 8, y.at(tick) + 4, three_digits(tick),
                 {kSmallText, kGrey, "end", false});
    }
    for (const double tick : ticks_of(x)) {
        svg.line(x.at(tick), y.begin, x.at(tick), y.begin + 5, kGrey, 1);
        svg.text(x.at(tick), y.begin + 19, three_digits(tick),
                 {kSmallText, kGrey, "middle", false});
    }
    svg.line(x.begin, y.begin, x.end, y.begin, kGrey, 1);
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
    const FrontAxis x = axis_of(points, &FrontPoint::x, kChartLeft, kChartRight);
    const FrontAxis y = axis_of(points, &FrontPoint::y, kChartBottom, kFrontTop);
    draw_axes(svg, x, y);
    Svg::Points steps;
    for (const FrontPoint& point : points) { // the front goes down from left to right
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
