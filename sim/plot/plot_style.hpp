// SPDX-License-Identifier: Apache-2.0
// The common style of pictures with many lines.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <utility>
#include <vector>

#include "sim/plot/svg.hpp"

namespace degs::sim {

constexpr double kPlotWidth = 800; ///< px, of a whole picture
constexpr double kPlotMargin = 16; ///< px
constexpr double kSmallText = 12;  ///< px
constexpr double kLabelText = 13;  ///< px
constexpr const char* kInk = "#1a1a1a";
constexpr const char* kGrey = "#555555";
constexpr const char* kGrid = "#d8d8d8";

// Pictures of one chart, px: left and right end, bottom of the chart, height of the picture.
constexpr double kChartLeft = 70, kChartRight = 780, kChartBottom = 370, kChartHeight = 440;

constexpr const char* kLineColours[] = {"#0072b2", "#d55e00", "#009e73", "#cc79a7",
                                        "#e69f00", "#56b4e9", "#1a1a1a"};
constexpr Marker kLineMarkers[] = {Marker::Circle, Marker::Square, Marker::Triangle,
                                   Marker::Diamond};

/// Colours and markers have periods without a common factor, so that 28 lines differ.
inline const char* colour_of_line(std::size_t line) {
    return kLineColours[line % (sizeof kLineColours / sizeof *kLineColours)];
}
inline Marker marker_of_line(std::size_t line) {
    return kLineMarkers[line % (sizeof kLineMarkers / sizeof *kLineMarkers)];
}

/// Explains the lines, from (kPlotMargin, y) on; returns the y below it.
double draw_legend(Svg& svg, double y, const std::vector<std::string>& labels);

/// Markers of all lines lie above the lines of all; points in px.
void draw_lines(Svg& svg, const std::vector<Svg::Points>& lines);

} // namespace degs::sim
