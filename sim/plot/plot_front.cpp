// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <utility>

#include "sim/plot/log_axis.hpp"
#include "sim/plot/plot_style.hpp"
#include "sim/plot/plot_svg.hpp"
#include "sim/text/words.hpp"

namespace degs::sim {
namespace {

constexpr double kFrontTop = 76;

constexpr const char* kOutside = "#b0b0b0";

LogAxis axis_of(const std::vector<FrontPoint>& points, double FrontPoint::*value, double begin,
                double end) {
    std::vector<double> values;
    values.reserve(points.size());
    for (const FrontPoint& point : points) {
        values.push_back(point.*value);
    }
    return LogAxis::around(values, begin, end);
}

/// Designs outside the limits have an entry only where there are some.
void draw_front_legend(Svg& svg, const std::string& best, bool has_outside) {
    draw_legend(svg, 46, {best, "beaten", "baseline"});
    if (has_outside) {
        const std::string label = "breaks a limit";
        const double x = kPlotWidth - kPlotMargin - text_width(label, kSmallText);
        svg.marker(Marker::Diamond, x - 14, 42, kOutside);
        svg.text(x, 46, label, {kSmallText, kInk, "start", false});
    }
}

/// Designs that matter more lie above the others.
template <class Point, class Place>
void draw_designs(Svg& svg, const std::vector<Point>& designs, const Place& place) {
    const auto draw = [&](Marker shape, const char* colour, const auto& belongs) {
        for (const Point& design : designs) {
            if (belongs(design.mark)) {
                const auto [x, y] = place(design);
                svg.marker(shape, x, y, colour);
            }
        }
    };
    const auto plain = [&](std::size_t line, const auto& belongs) {
        draw(marker_of_line(line), colour_of_line(line), belongs);
    };
    draw(Marker::Diamond, kOutside, [](const FrontMark& mark) { return !mark.within; });
    plain(1, [](const FrontMark& mark) { return mark.within && !mark.on_front; });
    plain(0, [](const FrontMark& mark) { return mark.on_front; });
    plain(2, [](const FrontMark& mark) { return mark.baseline; });
}

template <class Point>
bool has_outside(const std::vector<Point>& designs) {
    return std::any_of(designs.begin(), designs.end(),
                       [](const Point& design) { return !design.mark.within; });
}

/// Places of the charts of all pairs, px: goal c on the horizontal axis of column c, goal r + 1 on
/// the vertical axis of row r.
struct PairGrid {
    explicit PairGrid(std::size_t goals)
        : count(goals - 1),
          side(std::max(kLeastSide,
                        (kPlotWidth - kChartLeft - 20) / static_cast<double>(count) - kGap)) {}
    static constexpr double kLeastSide = 190, kGap = 16, kRowGap = 30, kTop = 84;
    static constexpr double kMostHeight = 240;
    double height() const { return std::min(side, kMostHeight); }
    double left(std::size_t column) const {
        return kChartLeft + static_cast<double>(column) * (side + kGap);
    }
    double top(std::size_t row) const {
        return kTop + static_cast<double>(row) * (height() + kRowGap);
    }
    double width_of_page() const { return std::max(kPlotWidth, left(count) + 4); }
    double height_of_page() const { return top(count) + 40; }

    std::size_t count; ///< of columns and of rows
    double side;       ///< width of a chart
};

LogAxis axis_of(const std::vector<ManyGoals>& designs, std::size_t goal, double begin, double end) {
    std::vector<double> values;
    values.reserve(designs.size());
    for (const ManyGoals& design : designs) {
        values.push_back(design.goals[goal]);
    }
    return LogAxis::around(values, begin, end);
}

/// Long numbers have a unit, because small charts have little room: "1.4 M".
std::string tick_words(double tick) {
    constexpr double kLong = 1e4;
    return tick < kLong ? decimal_text(tick) : scaled(tick);
}

/// Ticks below the lowest chart of a column; a number that would touch the one before is left out.
void draw_ticks_below(Svg& svg, const LogAxis& x, double bottom) {
    double free = x.begin - kChartLeft;
    for (const double tick : x.ticks()) {
        const std::string words = tick_words(tick);
        const double half = text_width(words, kSmallText) / 2;
        svg.line(x.at(tick), bottom, x.at(tick), bottom + 5, kGrey, 1);
        if (x.at(tick) - half > free) {
            svg.text(x.at(tick), bottom + 19, words, {kSmallText, kGrey, "middle", false});
            free = x.at(tick) + half + 6;
        }
    }
}

void draw_pair(Svg& svg, const PairGrid& grid, std::size_t row, std::size_t column,
               const std::vector<ManyGoals>& designs) {
    const double left = grid.left(column), top = grid.top(row), bottom = top + grid.height();
    const LogAxis x = axis_of(designs, column, left, left + grid.side);
    const LogAxis y = axis_of(designs, row + 1, bottom, top);
    for (const double tick : y.ticks()) {
        svg.line(left, y.at(tick), left + grid.side, y.at(tick), kGrid, 1);
        if (column == 0) {
            svg.text(left - 8, y.at(tick) + 4, tick_words(tick), {kSmallText, kGrey, "end", false});
        }
    }
    svg.line(left, bottom, left + grid.side, bottom, kGrey, 1);
    if (row + 1 == grid.count) {
        draw_ticks_below(svg, x, bottom);
    }
    draw_designs(svg, designs, [&](const ManyGoals& design) {
        return std::make_pair(x.at(design.goals[column]), y.at(design.goals[row + 1]));
    });
}

} // namespace

std::string front_svg(const std::string& title, const std::string& x_label,
                      const std::string& y_label, const std::vector<FrontPoint>& points,
                      const std::string& best) {
    Svg svg;
    svg.text(kPlotMargin, 24, fitting(title, 15, kPlotWidth - 2 * kPlotMargin),
             {15, kInk, "start", true});
    draw_front_legend(svg, best, has_outside(points));
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
        if (point.mark.on_front) {
            if (!steps.empty()) {
                steps.emplace_back(x.at(point.x), steps.back().second);
            }
            steps.emplace_back(x.at(point.x), y.at(point.y));
        }
    }
    if (steps.size() > 1) {
        svg.polyline(steps, colour_of_line(0), 1.5);
    }
    draw_designs(svg, points, [&](const FrontPoint& point) {
        return std::make_pair(x.at(point.x), y.at(point.y));
    });
    return svg.document(kPlotWidth, kChartHeight, title);
}

std::string front_pairs_svg(const std::string& title, const std::vector<std::string>& labels,
                            const std::vector<ManyGoals>& designs) {
    const PairGrid grid(labels.size());
    Svg svg;
    svg.text(kPlotMargin, 24, fitting(title, 15, kPlotWidth - 2 * kPlotMargin),
             {15, kInk, "start", true});
    draw_front_legend(svg, "no other beats it", has_outside(designs));
    for (std::size_t row = 0; row < grid.count; ++row) {
        const double width = static_cast<double>(row + 1) * (grid.side + PairGrid::kGap) + 40;
        svg.text(kPlotMargin, grid.top(row) - 8, fitting(labels[row + 1], kSmallText, width),
                 {kSmallText, kGrey, "start", false});
        for (std::size_t column = 0; column <= row && !designs.empty(); ++column) {
            draw_pair(svg, grid, row, column, designs);
        }
    }
    for (std::size_t column = 0; column < grid.count; ++column) {
        svg.text(grid.left(column) + grid.side / 2, grid.top(grid.count) + 14,
                 fitting(labels[column], kSmallText, grid.side),
                 {kSmallText, kGrey, "middle", false});
    }
    return svg.document(grid.width_of_page(), grid.height_of_page(), title);
}

} // namespace degs::sim
