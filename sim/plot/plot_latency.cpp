// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "sim/plot/plot_style.hpp"
#include "sim/plot/plot_svg.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

constexpr double kLatencyTop = 80; // px
constexpr const char* kMean = "#0072b2";
constexpr const char* kTail = "#d55e00";

struct LatencyAxes {
    double top_ns = 1;
    double x(double share) const { return kChartLeft + share * (kChartRight - kChartLeft); }
    double y(double ns) const { return kChartBottom - ns / top_ns * (kChartBottom - kLatencyTop); }
};

void draw_axes(Svg& svg, const LatencyAxes& axes, double tick) {
    for (double ns = 0; ns <= axes.top_ns * 1.001; ns += tick) {
        svg.line(kChartLeft, axes.y(ns), kChartRight, axes.y(ns), kGrid, 1);
        svg.text(kChartLeft - 8, axes.y(ns) + 4, decimal_text(ns),
                 {kSmallText, kGrey, "end", false});
    }
    for (int tenth = 0; tenth <= 10; ++tenth) {
        const double x = axes.x(tenth / 10.0);
        svg.line(x, kLatencyTop, x, kChartBottom, kGrid, 1);
        svg.text(x, kChartBottom + 18, std::to_string(tenth * 10),
                 {kSmallText, kGrey, "middle", false});
    }
    svg.text((kChartLeft + kChartRight) / 2, kChartBottom + 42,
             "load carried, % of the peak bandwidth", {kSmallText, kGrey, "middle", false});
    svg.text(kChartLeft, kLatencyTop - 10, "latency, ns", {kSmallText, kGrey, "middle", false});
}

void draw_curve(Svg& svg, const LatencyAxes& axes, const std::vector<LoadPoint>& points,
                double LoadPoint::*latency, Marker marker, const char* colour) {
    Svg::Points line;
    for (const LoadPoint& point : points) {
        line.emplace_back(axes.x(point.carried), axes.y(point.*latency));
    }
    svg.polyline(line, colour, 2);
    for (const auto& [x, y] : line) {
        svg.marker(marker, x, y, colour);
    }
}

} // namespace

std::string load_latency_svg(const std::string& title, const std::vector<LoadPoint>& points) {
    double most = 1;
    for (const LoadPoint& point : points) {
        most = std::max({most, point.mean_ns, point.p95_ns});
    }
    const double tick = tick_of(most);
    const LatencyAxes axes{std::ceil(most / tick) * tick};
    Svg svg;
    svg.text(16, 30, title, {16, kInk, "start", true});
    svg.marker(Marker::Circle, 560, 52, kMean);
    svg.text(572, 56, "mean", {kSmallText, kInk, "start", false});
    svg.marker(Marker::Triangle, 640, 52, kTail);
    svg.text(652, 56, "95th percentile", {kSmallText, kInk, "start", false});
    draw_axes(svg, axes, tick);
    draw_curve(svg, axes, points, &LoadPoint::p95_ns, Marker::Triangle, kTail);
    draw_curve(svg, axes, points, &LoadPoint::mean_ns, Marker::Circle, kMean);
    return svg.document(kPlotWidth, kChartHeight, title);
}

} // namespace degs::sim
