// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "sim/plot/log_axis.hpp"
#include "sim/plot/plot_style.hpp"
#include "sim/sweep/bandwidth_curve.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

constexpr std::size_t kMostLines = 7; ///< as many as there are colours
constexpr std::size_t kMostViews = 4;
constexpr double kPanelHeight = 380;

/// What is drawn in one colour: a design, or a part of its frame.
struct PlotLine {
    std::string label;
    std::vector<std::pair<double, double>> points; ///< GB/s, ms
    std::optional<double> unlimited_ms, enough_gb_per_s;
};

using OptionalPart = std::optional<double> BandwidthPoint::*;

PlotLine part_of_frame(const BandwidthCurve& curve, const char* label, OptionalPart part) {
    PlotLine line;
    line.label = label;
    for (const BandwidthPoint& point : curve.points) {
        if (point.*part) {
            line.points.emplace_back(point.gb_per_s, *(point.*part));
        }
    }
    return line;
}

/// Whether all curves are of the same memory, which then needs no mention at each line.
bool have_one_memory(const std::vector<BandwidthCurve>& curves) {
    return std::all_of(curves.begin(), curves.end(), [&curves](const BandwidthCurve& curve) {
        return curve.memory == curves.front().memory;
    });
}

/// One design alone is split into its stages.
std::vector<PlotLine> plot_lines(const std::vector<BandwidthCurve>& curves, std::size_t view) {
    const bool one_memory = have_one_memory(curves);
    std::vector<PlotLine> lines;
    const BandwidthCurve* first = nullptr;
    for (const BandwidthCurve& curve : curves) {
        if (curve.view == view && lines.size() < kMostLines) {
            PlotLine line;
            line.label = (one_memory ? "" : curve.memory + ": ") + curve.label;
            for (const BandwidthPoint& point : curve.points) {
                line.points.emplace_back(point.gb_per_s, point.latency_ms);
            }
            line.unlimited_ms = curve.unlimited_latency_ms;
            line.enough_gb_per_s = curve.enough_gb_per_s;
            lines.push_back(std::move(line));
            first = &curve;
        }
    }
    if (lines.size() == 1) {
        for (const auto& [label, part] :
             {std::pair("preprocessing", OptionalPart(&BandwidthPoint::preprocessing_ms)),
              std::pair("blending", OptionalPart(&BandwidthPoint::blending_ms))}) {
            PlotLine line = part_of_frame(*first, label, part);
            if (!line.points.empty()) {
                lines.push_back(std::move(line));
            }
        }
    }
    return lines;
}

/// A line of dashes along one of the axes.
void draw_dashes(Svg& svg, double x0, double y0, double x1, double y1, const std::string& colour) {
    constexpr double kDash = 6, kGap = 5;
    const double length = std::hypot(x1 - x0, y1 - y0);
    for (double at = 0; at < length; at += kDash + kGap) {
        const double end = std::min(at + kDash, length);
        svg.line(x0 + (x1 - x0) * at / length, y0 + (y1 - y0) * at / length,
                 x0 + (x1 - x0) * end / length, y0 + (y1 - y0) * end / length, colour, 1.5);
    }
}

/// Latency at a bandwidth between two points, by interpolation in the logarithms.
double latency_at(const PlotLine& line, double gb_per_s) {
    for (std::size_t i = 1; i < line.points.size(); ++i) {
        const auto& [b0, t0] = line.points[i - 1];
        const auto& [b1, t1] = line.points[i];
        if (gb_per_s <= b1) {
            return t0 * std::pow(t1 / t0, std::log(gb_per_s / b0) / std::log(b1 / b0));
        }
    }
    return line.points.back().second;
}

/// The mark of the bandwidth that is enough, above the line; the legend has its number, because
/// words would cross the marks of other lines.
void draw_mark(Svg& svg, const PlotLine& line, const char* colour, const LogAxis& x,
               const LogAxis& y) {
    const double at = x.at(*line.enough_gb_per_s);
    draw_dashes(svg, at, y.end, at, y.at(latency_at(line, *line.enough_gb_per_s)), colour);
}

void draw_panel(Svg& svg, const std::vector<PlotLine>& lines, double top) {
    std::vector<double> bandwidths, latencies;
    for (const PlotLine& line : lines) {
        for (const auto& [gb_per_s, ms] : line.points) {
            bandwidths.push_back(gb_per_s);
            latencies.push_back(ms);
        }
        if (line.unlimited_ms) {
            latencies.push_back(*line.unlimited_ms);
        }
    }
    const LogAxis x = LogAxis::around(bandwidths, kChartLeft, kChartRight);
    const LogAxis y = LogAxis::around(latencies, top + kPanelHeight - 60, top + 50);
    draw_log_axes(svg, x, y);
    std::vector<Svg::Points> places;
    for (std::size_t l = 0; l < lines.size(); ++l) {
        places.emplace_back();
        for (const auto& [gb_per_s, ms] : lines[l].points) {
            places.back().emplace_back(x.at(gb_per_s), y.at(ms));
        }
        if (lines[l].unlimited_ms) {
            const double level = y.at(*lines[l].unlimited_ms);
            draw_dashes(svg, kChartLeft, level, kChartRight, level, colour_of_line(l));
        }
        if (lines[l].enough_gb_per_s) {
            draw_mark(svg, lines[l], colour_of_line(l), x, y);
        }
    }
    draw_lines(svg, places);
    svg.text((kChartLeft + kChartRight) / 2, y.begin + 40, "bandwidth of memory, GB/s, log scale",
             {kSmallText, kGrey, "middle", false});
    svg.text(kPlotMargin, y.end - 8, "latency, ms, log scale", {kSmallText, kGrey, "start", false});
}

std::vector<std::string> legend_of(const std::vector<PlotLine>& lines) {
    std::vector<std::string> labels;
    labels.reserve(lines.size());
    for (const PlotLine& line : lines) {
        labels.push_back(line.label + (line.enough_gb_per_s
                                           ? ": " + three_digits(*line.enough_gb_per_s) + " GB/s"
                                           : ""));
    }
    return labels;
}

/// Says what the dashed lines of the panels mean.
std::string explanation(const std::vector<std::vector<PlotLine>>& panels) {
    bool across = false, upright = false;
    for (const std::vector<PlotLine>& lines : panels) {
        for (const PlotLine& line : lines) {
            across |= line.unlimited_ms.has_value();
            upright |= line.enough_gb_per_s.has_value();
        }
    }
    return std::string(across ? "Dashed across: memory without limit. " : "") +
           (upright ? "Dashed upright, with numbers: from there on, 10 % more bandwidth gain less "
                      "than 1 %."
                    : "");
}

} // namespace

std::string bandwidth_picture(const StudyPlan& plan, const Comparison& comparison) {
    const std::vector<BandwidthCurve> curves = bandwidth_curves(plan, comparison);
    if (curves.empty()) {
        return "";
    }
    const std::string title = "Latency over the bandwidth of memory" +
                              (have_one_memory(curves) ? ": " + curves.front().memory : "") +
                              (comparison.is_estimated() ? " (estimated)" : "");
    std::vector<std::vector<PlotLine>> panels;
    for (std::size_t v = 0; v < std::min(comparison.views.size(), kMostViews); ++v) {
        panels.push_back(plot_lines(curves, v));
    }
    Svg svg;
    svg.text(kPlotMargin, 26, title, {16, kInk, "start", true});
    svg.text(kPlotMargin, 46, explanation(panels), {kSmallText, kGrey, "start", false});
    double top = 60;
    for (std::size_t v = 0; v < panels.size(); ++v) {
        const std::vector<PlotLine>& lines = panels[v];
        if (lines.empty()) {
            continue;
        }
        svg.text(kPlotMargin, top + 14, view_words(comparison.views[v]),
                 {kLabelText, kInk, "start", true});
        const double below = draw_legend(svg, top + 36, legend_of(lines));
        draw_panel(svg, lines, below - 14);
        top = below - 14 + kPanelHeight;
    }
    return svg.document(kPlotWidth, top + 6, title);
}

} // namespace degs::sim
