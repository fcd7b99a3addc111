// SPDX-License-Identifier: Apache-2.0
#include "sim/plot/log_axis.hpp"

#include <algorithm>

#include "sim/plot/plot_style.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
LogAxis LogAxis::around(const std::vector<double>& values, double begin, double end) {
    const auto [least, most] = std::minmax_element(values.begin(), values.end());
    LogAxis axis{std::log10(*least), std::log10(*most), begin, end};
    const double room = std::max(0.02, 0.06 * (axis.high - axis.low));
    axis.low -= room;
    axis.high += room;
    return axis;
}

std::vector<double> LogAxis::ticks() const {
    const double least = std::pow(10, low), most = std::pow(10, high);
    std::vector<double> ticks;
    if (high - low < 1) {
        const double step = tick_of(most - least, 6);
        for (double tick = std::ceil(least / step) * step; tick <= most; tick += step) {
            ticks.push_back(tick);
        }
        return ticks;
    }
    constexpr double kLong = 3; // decades
    for (double power = std::pow(10, std::floor(low)); power <= most; power *= 10) {
        for (const double factor : {1.0, 2.0, 5.0}) {
            const bool shown = factor == 1.0 || high - low < kLong;
            if (shown && factor * power >= least && factor * power <= most) {
                ticks.push_back(factor * power);
            }
        }
    }
    return ticks;
}

void draw_log_axes(Svg& svg, const LogAxis& x, const LogAxis& y) {
    for (const double tick : y.ticks()) {
        svg.line(x.begin, y.at(tick), x.end, y.at(tick), kGrid, 1);
        svg.text(x.begin - 8, y.at(tick) + 4, decimal_text(tick),
                 {kSmallText, kGrey, "end", false});
    }
    for (const double tick : x.ticks()) {
        svg.line(x.at(tick), y.begin, x.at(tick), y.begin + 5, kGrey, 1);
        svg.text(x.at(tick), y.begin + 19, decimal_text(tick),
                 {kSmallText, kGrey, "middle", false});
    }
    svg.line(x.begin, y.begin, x.end, y.begin, kGrey, 1);
}

} // namespace degs::sim
