// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "sim/accuracy/speed/speed.hpp"
#include "sim/plot/log_axis.hpp"
#include "sim/plot/plot_style.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

constexpr double kSpeedPanelHeight = 330;
constexpr double kLeastError = 0.01; ///< %, at the bottom: where smaller errors are drawn, too

struct SpeedPoint {
    double time = 1;  ///< over the time of the reference image
    double error = 1; ///< %, of the cycles
    std::size_t set = 0;
    std::string label;
};

std::vector<std::string> sets_in(const std::vector<SpeedGroup>& groups) {
    std::vector<std::string> sets;
    for (const SpeedGroup& group : groups) {
        if (std::find(sets.begin(), sets.end(), group.numbers) == sets.end()) {
            sets.push_back(group.numbers);
        }
    }
    return sets;
}

std::vector<SpeedPoint> points_in(const std::vector<SpeedGroup>& groups,
                                  const std::string& accelerator,
                                  const std::vector<std::string>& sets) {
    std::vector<SpeedPoint> points;
    for (const SpeedGroup& group : groups) {
        if (group.accelerator == accelerator) {
            const auto set = std::find(sets.begin(), sets.end(), group.numbers) - sets.begin();
            points.push_back({group.over_render, std::max(kLeastError, 100 * group.cycles_error),
                              static_cast<std::size_t>(set), group.fidelity});
        }
    }
    std::sort(points.begin(), points.end(), [](const SpeedPoint& a, const SpeedPoint& b) {
        return std::make_pair(a.time, a.error) < std::make_pair(b.time, b.error);
    });
    return points;
}

/// Nobody is faster with as small an error; `points` in the order of their time.
void draw_steps(Svg& svg, const LogAxis& x, const LogAxis& y,
                const std::vector<SpeedPoint>& points) {
    Svg::Points steps;
    double least = INFINITY;
    for (const SpeedPoint& point : points) {
        if (point.error < least) {
            least = point.error;
            if (!steps.empty()) {
                steps.emplace_back(x.at(point.time), steps.back().second);
            }
            steps.emplace_back(x.at(point.time), y.at(point.error));
        }
    }
    if (steps.size() > 1) {
        svg.polyline(steps, kGrey, 1.5);
    }
}

/// Words beside the markers, each a line higher than the one that it would cover.
void draw_point_labels(Svg& svg, const LogAxis& x, const LogAxis& y,
                       const std::vector<SpeedPoint>& points) {
    struct Place {
        double left, right, base;
    };
    std::vector<Place> taken;
    for (const SpeedPoint& point : points) {
        const double width = text_width(point.label, kSmallText);
        Place place{x.at(point.time) + 9, 0, y.at(point.error) - 7};
        place.left = std::min(place.left, x.end - width);
        place.right = place.left + width;
        bool free = false;
        while (!free) {
            free = std::none_of(taken.begin(), taken.end(), [&place](const Place& other) {
                return place.left < other.right + 4 && other.left < place.right + 4 &&
                       std::abs(place.base - other.base) < kSmallText;
            });
            place.base -= free ? 0 : kSmallText;
        }
        svg.text(place.left, place.base, point.label, {kSmallText, kInk, "start", false});
        taken.push_back(place);
    }
}

void draw_speed_panel(Svg& svg, double top, const std::string& heading,
                      const std::vector<SpeedPoint>& points) {
    std::vector<double> times, errors{kLeastError, 100 * kLeastError};
    for (const SpeedPoint& point : points) {
        times.push_back(point.time);
        errors.push_back(point.error);
    }
    const double bottom = top + kSpeedPanelHeight - 52;
    const LogAxis x = LogAxis::around(times, kChartLeft, kChartRight - 60);
    const LogAxis y = LogAxis::around(errors, bottom, top + 60);
    svg.text(kPlotMargin, top + 14, heading, {kLabelText, kInk, "start", true});
    svg.text(kPlotMargin, top + 36, "error of the cycles, % (0.01 also stands for less)",
             {kSmallText, kGrey, "start", false});
    draw_log_axes(svg, x, y);
    draw_steps(svg, x, y, points);
    for (const SpeedPoint& point : points) {
        svg.marker(marker_of_line(point.set), x.at(point.time), y.at(point.error),
                   colour_of_line(point.set));
    }
    draw_point_labels(svg, x, y, points);
    svg.text((x.begin + x.end) / 2, bottom + 38, "time of the run / time of the reference image",
             {kSmallText, kGrey, "middle", false});
}

} // namespace

std::string speed_svg(const SpeedResult& result) {
    const std::vector<SpeedGroup> groups = speed_groups(result.rows);
    const std::vector<std::string> sets = sets_in(groups);
    const std::string title = "Speed against error: " + result.view.scene + ", camera " +
                              std::to_string(result.view.camera) + ", " +
                              std::to_string(result.view.width) + "×" +
                              std::to_string(result.view.height);
    Svg svg;
    svg.text(kPlotMargin, 28, fitting(title, 16, kPlotWidth - 2 * kPlotMargin),
             {16, kInk, "start", true});
    double top = draw_legend(svg, 54, sets) + 8;
    std::string done;
    for (const SpeedGroup& group : groups) {
        if (group.accelerator != done) {
            done = group.accelerator;
            draw_speed_panel(svg, top, done, points_in(groups, done, sets));
            top += kSpeedPanelHeight;
        }
    }
    return svg.document(kPlotWidth, top + 6, title);
}

} // namespace degs::sim
