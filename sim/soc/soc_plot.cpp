// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "sim/soc/soc_study.hpp"
#include "sim/svg.hpp"
#include "sim/words.hpp"

namespace degs::sim {
namespace {

constexpr double kWidth = 800, kHeight = 440;
constexpr double kLeft = 70, kRight = 780, kTop = 70, kBottom = 370;
constexpr int kTicks = 5;
constexpr const char* kGrey = "#555555";
constexpr const char* kGrid = "#d8d8d8";
constexpr const char* kColour = "#0072b2";

} // namespace

std::string soc_svg(const std::string& title, const std::vector<SocPoint>& points) {
    double load = 1;
    double latency = 1e-6;
    for (const SocPoint& p : points) {
        load = std::max(load, p.cpu_gb_per_s);
        latency = std::max(latency, p.frame.latency_ns / 1e6);
    }
    const double x_tick = tick_of(load, kTicks);
    const double y_tick = tick_of(latency, kTicks);
    const auto x = [&](double v) { return kLeft + v / (kTicks * x_tick) * (kRight - kLeft); };
    const auto y = [&](double v) { return kBottom - v / (kTicks * y_tick) * (kBottom - kTop); };
    Svg svg;
    svg.text(16, 30, title, {16, "#1a1a1a", "start", true});
    for (int i = 0; i <= kTicks; ++i) {
        svg.line(kLeft, y(i * y_tick), kRight, y(i * y_tick), kGrid, 1);
        svg.text(kLeft - 8, y(i * y_tick) + 4, three_digits(i * y_tick), {12, kGrey, "end", false});
        svg.line(x(i * x_tick), kTop, x(i * x_tick), kBottom, kGrid, 1);
        svg.text(x(i * x_tick), kBottom + 18, three_digits(i * x_tick),
                 {12, kGrey, "middle", false});
    }
    svg.text((kLeft + kRight) / 2, kBottom + 42, "competing traffic of the cores, GB/s",
             {12, kGrey, "middle", false});
    svg.text(kLeft, kTop - 10, "frame latency, ms", {12, kGrey, "middle", false});
    Svg::Points line;
    for (const SocPoint& p : points) {
        line.emplace_back(x(p.cpu_gb_per_s), y(p.frame.latency_ns / 1e6));
    }
    svg.polyline(line, kColour, 2);
    for (const auto& [px, py] : line) {
        svg.marker(Marker::Circle, px, py, kColour);
    }
    return svg.document(kWidth, kHeight, title);
}

} // namespace degs::sim
