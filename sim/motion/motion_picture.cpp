// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "base/ratio.hpp"
#include "sim/motion/motion_output.hpp"
#include "sim/plot/plot_style.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

constexpr double kRight = 620;    // px, end of the path
constexpr double kRankLeft = 668; // px, of the strip of percentiles
constexpr const char* kBands[] = {"#ffffff", "#fff3df", "#ffe3c6", "#ffd2b5"}; // later and later
constexpr std::size_t kLastBand = sizeof kBands / sizeof *kBands - 1;
constexpr double kRankRight = 750;
constexpr const char* kRepeated = "#dddddd";

struct Axes {
    double top_px, most_s, most_ms;
    double x(double s) const { return kChartLeft + (kRight - kChartLeft) * s / most_s; }
    double y(double ms) const {
        return kChartBottom - (kChartBottom - top_px) * std::min(ms / most_ms, 1.0);
    }
};

std::string title_of(const std::string& what, const MotionWords& words) {
    return what + " · " + words.scene + " · " + size_words(words) +
           (words.estimated ? " · estimated" : "");
}

/// From the shortest period on.
std::vector<double> periods_of(const Motion& motion) {
    std::vector<double> periods;
    for (const double hz : motion.rates_hz) {
        periods.push_back(1e3 / hz);
    }
    std::sort(periods.begin(), periods.end());
    return periods;
}

double most_ms(const Motion& motion) {
    double most = 1.15 * periods_of(motion).back();
    for (const DesignMotion& design : motion.designs) {
        most = std::max(most, design.ranks ? design.ranks->worst : 0);
    }
    const double tick = tick_of(most);
    return std::ceil(most / tick) * tick;
}

/// The later a band, the darker; each ends where frames are too late for a display.
void draw_bands(Svg& svg, const Axes& axes, const Motion& motion) {
    const std::vector<double> periods = periods_of(motion);
    double from = 0, label = kChartBottom;
    for (std::size_t band = 0; band <= periods.size(); ++band) {
        const double to = band < periods.size() ? periods[band] : axes.most_ms;
        const double y = axes.y(to);
        svg.rectangle(kChartLeft, y, kRight - kChartLeft, axes.y(from) - y,
                      kBands[std::min(band, kLastBand)]);
        if (band < periods.size()) {
            svg.line(kChartLeft, y, kRight, y, "#b05a00", 1);
            label = std::min(y + 4, label - 11); // labels do not lie on each other
            svg.text(kRight + 4, label, decimal_text(std::round(1e5 / to) / 100) + " Hz",
                     {11, "#8a4600", "start", false});
        }
        from = to;
    }
    svg.text(kRight - 6, axes.top_px + 13, "too late", {11, kGrey, "end", false});
    svg.text(kRight - 6, kChartBottom - 6, "in time", {11, kGrey, "end", false});
}

void draw_frame(Svg& svg, const Axes& axes) {
    const double tick = tick_of(axes.most_ms);
    for (double ms = 0; ms <= axes.most_ms * 1.001; ms += tick) {
        svg.line(kChartLeft - 4, axes.y(ms), kChartLeft, axes.y(ms), kGrey, 1);
        svg.text(kChartLeft - 8, axes.y(ms) + 4, decimal_text(ms),
                 {kSmallText, kGrey, "end", false});
    }
    const double step = tick_of(axes.most_s, 8);
    for (double s = 0; s <= axes.most_s * 1.001; s += step) {
        svg.line(axes.x(s), kChartBottom, axes.x(s), kChartBottom + 4, kGrey, 1);
        svg.text(axes.x(s), kChartBottom + 18, decimal_text(s),
                 {kSmallText, kGrey, "middle", false});
    }
    svg.line(kChartLeft, kChartBottom, kRight, kChartBottom, kGrey, 1);
    svg.text((kChartLeft + kRight) / 2, kChartBottom + 40, "time of the path, s",
             {kSmallText, kGrey, "middle", false});
    svg.text(kPlotMargin, axes.top_px - 10, "latency of the frame, ms",
             {kSmallText, kGrey, "start", false});
}

/// The thick line goes from P50 to P95, the thin one on to the worst frame.
void draw_ranks(Svg& svg, const Axes& axes, const Motion& motion) {
    const double width = (kRankRight - kRankLeft) / real_of(motion.designs.size());
    for (std::size_t d = 0; d < motion.designs.size(); ++d) {
        if (!motion.designs[d].ranks) {
            continue;
        }
        const LatencyRanks& ranks = *motion.designs[d].ranks;
        const double x = kRankLeft + width * (real_of(d) + 0.5);
        const double half = std::min(width / 2 - 2, 8.0);
        svg.line(x, axes.y(ranks.p50), x, axes.y(ranks.worst), colour_of_line(d), 1);
        svg.line(x, axes.y(ranks.p50), x, axes.y(ranks.p95), colour_of_line(d), 5);
        for (const double ms : {ranks.p50, ranks.p95, ranks.p99, ranks.worst}) {
            svg.line(x - half, axes.y(ms), x + half, axes.y(ms), colour_of_line(d), 2);
        }
        if (d + 1 != motion.designs.size()) {
            continue;
        }
        double last = kChartBottom + 30; // labels do not lie on each other
        for (const auto& [ms, words] :
             {std::pair(ranks.p50, "P50"), std::pair(ranks.p95, "P95"), std::pair(ranks.p99, "P99"),
              std::pair(ranks.worst, "worst")}) {
            const double y = std::min(axes.y(ms) + 4, last - 11);
            svg.text(x + half + 3, y, words, {10, kGrey, "start", false});
            last = y;
        }
    }
}

} // namespace

std::string motion_latency_svg(const MotionWords& words, const Motion& motion) {
    Svg svg;
    svg.text(kPlotMargin, 30, title_of("Latency along a path", words), {16, kInk, "start", true});
    std::vector<std::string> labels;
    for (const DesignMotion& design : motion.designs) {
        labels.push_back(design.name);
    }
    const double top = draw_legend(svg, 48, labels) + 24;
    const double last = motion.times_s.back();
    const Axes axes{std::min(top, kChartBottom - 120), last > 0 ? last : 1, most_ms(motion)};
    draw_bands(svg, axes, motion);
    draw_frame(svg, axes);
    for (std::size_t d = 0; d < motion.designs.size(); ++d) {
        Svg::Points line;
        for (std::size_t frame = 0; frame < motion.times_s.size(); ++frame) {
            if (const auto& ms = motion.designs[d].ms[frame]) {
                line.emplace_back(axes.x(motion.times_s[frame]), axes.y(*ms));
            }
        }
        svg.polyline(line, colour_of_line(d), 2);
        if (line.size() <= 40) {
            for (const auto& [x, y] : line) {
                svg.marker(marker_of_line(d), x, y, colour_of_line(d));
            }
        }
    }
    draw_ranks(svg, axes, motion);
    return svg.document(kPlotWidth, kChartHeight, title_of("Latency along a path", words));
}

std::string motion_refresh_svg(const MotionWords& words, const Motion& motion) {
    constexpr double kBarLeft = 230, kBarRight = 560, kBar = 18, kStep = 24, kGap = 14;
    Svg svg;
    const std::string title = title_of("Refreshes with a new image", words);
    svg.text(kPlotMargin, 30, title, {16, kInk, "start", true});
    double y = 56;
    for (std::size_t rate = 0; rate < motion.rates_hz.size(); ++rate) {
        svg.text(kPlotMargin, y + 14, decimal_text(motion.rates_hz[rate]) + " Hz",
                 {kLabelText, kInk, "start", true});
        for (std::size_t d = 0; d < motion.designs.size(); ++d) {
            const DesignMotion& design = motion.designs[d];
            if (design.displays.empty()) {
                continue;
            }
            const DisplayResult& display = design.displays[rate];
            const double share = display.new_images();
            svg.text(kBarLeft - 8, y + 14, fitting(design.name, kSmallText, kBarLeft - 90),
                     {kSmallText, kInk, "end", false});
            svg.rectangle(kBarLeft, y, kBarRight - kBarLeft, kBar, kRepeated);
            svg.rectangle(kBarLeft, y, (kBarRight - kBarLeft) * share, kBar, colour_of_line(d));
            svg.text(kBarRight + 8, y + 14,
                     percent(share) + " % · " + three_digits(display.photon_mean_ms) +
                         " ms to the eye",
                     {kSmallText, kInk, "start", false});
            y += kStep;
        }
        y += kGap;
    }
    svg.rectangle(kBarLeft, y, kBar, kBar, kRepeated);
    svg.text(kBarLeft + kBar + 6, y + 14, "the image before is shown again",
             {kSmallText, kGrey, "start", false});
    return svg.document(kPlotWidth, y + kBar + kPlotMargin, title);
}

} // namespace degs::sim
