// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "sim/plot_svg.hpp"
#include "sim/svg.hpp"
#include "sim/words.hpp"

namespace degs::sim {
namespace {

constexpr double kWidth = 800, kHeight = 440;
constexpr double kLeft = 70, kRight = 780, kTop = 80, kBottom = 370;
constexpr double kSmall = 12;
constexpr const char* kGrey = "#555555";
constexpr const char* kGrid = "#d8d8d8";
constexpr const char* kMean = "#0072b2";
constexpr const char* kTail = "#d55e00";

struct Axes {
    double top_ns = 1;
    double x(double share) const { return kLeft + share * (kRight - kLeft); }
    double y(double ns) const { return kBottom - ns / top_ns * (kBottom - kTop); }
};

void draw_axes(Svg& svg, const Axes& axes, double tick) {
    for (double ns = 0; ns <= axes.top_ns * 1.001; ns += tick) {
        svg.line(kLeft, axes.y(ns), kRight, axes.y(ns), kGrid, 1);
        svg.text(kLeft - 8, axes.y(ns) + 4, three_digits(ns), {kSmall, kGrey, "end", false});
    }
    for (int tenth = 0; tenth <= 10; ++tenth) {
        const double x = axes.x(tenth / 10.0);
        svg.line(x, kTop, x, kBottom, kGrid, 1);
        svg.text(x, kBottom + 18, std::to_string(tenth * 10), {kSmall, kGrey, "middle", false});
    }
    svg.text((kLeft + kRight) / 2, kBottom + 42, "load carried, % of the peak bandwidth",
             {kSmall, kGrey, "middle", false});
    svg.text(kLeft, kTop - 10, "latency, ns", {kSmall, kGrey, "middle", false});
}

void draw_curve(Svg& svg, const Axes& axes, const std::vector<LoadPoint>& points,
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
    const Axes axes{std::ceil(most / tick) * tick};
    Svg svg;
    svg.text(16, 30, title, {16, "#1a1a1a", "start", true});
    svg.marker(Marker::Circle, 560, 52, kMean);
    svg.text(572, 56, "mean", {kSmall, "#1a1a1a", "start", false});
    svg.marker(Marker::Triangle, 640, 52, kTail);
    svg.text(652, 56, "95th percentile", {kSmall, "#1a1a1a", "start", false});
    draw_axes(svg, axes, tick);
    draw_curve(svg, axes, points, &LoadPoint::p95_ns, Marker::Triangle, kTail);
    draw_curve(svg, axes, points, &LoadPoint::mean_ns, Marker::Circle, kMean);
    return svg.document(kWidth, kHeight, title);
}

} // namespace degs::sim
