// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "sim/plot/plot_style.hpp"
#include "sim/soc/soc_study.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

constexpr double kSocTop = 70; // px
constexpr int kTicks = 5;
constexpr const char* kColour = "#0072b2";

double competing_gb_per_s(const SocPoint& point) {
    double sum = point.cpu_gb_per_s;
    for (const SocPoint::Other& other : point.others) {
        sum += other.gb_per_s;
    }
    return sum;
}

} // namespace

std::string soc_svg(const std::string& title, const std::vector<SocPoint>& points) {
    double load = 1;
    double latency = 1e-6;
    for (const SocPoint& p : points) {
        load = std::max(load, competing_gb_per_s(p));
        latency = std::max(latency, p.latency_ns() / 1e6);
    }
    const double x_tick = tick_of(load, kTicks);
    const double y_tick = tick_of(latency, kTicks);
    const auto x = [&](double v) {
        return kChartLeft + v / (kTicks * x_tick) * (kChartRight - kChartLeft);
    };
    const auto y = [&](double v) {
        return kChartBottom - v / (kTicks * y_tick) * (kChartBottom - kSocTop);
    };
    double last = points.empty() ? 0 : points.front().rate_per_s;
    Svg svg;
    svg.text(16, 30, title, {16, kInk, "start", true});
    for (int i = 0; i <= kTicks; ++i) {
        svg.line(kChartLeft, y(i * y_tick), kChartRight, y(i * y_tick), kGrid, 1);
        svg.text(kChartLeft - 8, y(i * y_tick) + 4, decimal_text(i * y_tick),
                 {kSmallText, kGrey, "end", false});
        svg.line(x(i * x_tick), kSocTop, x(i * x_tick), kChartBottom, kGrid, 1);
        svg.text(x(i * x_tick), kChartBottom + 18, decimal_text(i * x_tick),
                 {kSmallText, kGrey, "middle", false});
    }
    svg.text((kChartLeft + kChartRight) / 2, kChartBottom + 42, "competing traffic, GB/s",
             {kSmallText, kGrey, "middle", false});
    svg.text(kChartLeft, kSocTop - 10, "frame latency, ms", {kSmallText, kGrey, "middle", false});
    // A line for each load of the cores, if others have several rates.
    Svg::Points line;
    for (const SocPoint& p : points) {
        if (!line.empty() && p.rate_per_s == points.front().rate_per_s && p.rate_per_s != last) {
            svg.polyline(line, kColour, 2);
            line.clear();
        }
        last = p.rate_per_s;
        line.emplace_back(x(competing_gb_per_s(p)), y(p.latency_ns() / 1e6));
        svg.marker(Marker::Circle, line.back().first, line.back().second, kColour);
    }
    svg.polyline(line, kColour, 2);
    return svg.document(kPlotWidth, kChartHeight, title);
}

} // namespace degs::sim
