// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>
#include <map>

#include "sim/accuracy/accuracy.hpp"
#include "sim/plot/plot_style.hpp"

namespace degs::sim {
namespace {

constexpr double kAccuracyPanelHeight = 280;
constexpr double kFloor = 20; ///< dB at the bottom, unless a row lies lower

/// Image heights and PSNR of one set.
using Line = std::vector<std::pair<double, double>>;

struct Panel {
    std::string heading;
    std::map<std::string, Line> lines; ///< by set
};

struct Picture {
    std::vector<Panel> panels;
    std::vector<std::string> sets;                   ///< in the order of the rows
    double low = kFloor, high = kFloor + 20;         ///< dB
    double least_height = INFINITY, most_height = 0; ///< px
};

double height_of(const AccuracyRow& row) {
    return std::stod(row.resolution.substr(row.resolution.find('x') + 1));
}

Picture picture_of(const std::vector<AccuracyRow>& rows) {
    Picture picture;
    for (const AccuracyRow& row : rows) {
        if (row.span_ends.empty()) {
            continue;
        }
        const std::string heading = row.scene + ", camera " +
                                    std::to_string(row.camera.value_or(0)) +
                                    (row.eye.empty() ? "" : ", " + row.eye + " eye");
        auto& panels = picture.panels;
        if (panels.empty() || panels.back().heading != heading) {
            panels.push_back({heading, {}});
        }
        if (std::find(picture.sets.begin(), picture.sets.end(), row.numbers) ==
            picture.sets.end()) {
            picture.sets.push_back(row.numbers);
        }
        picture.least_height = std::min(picture.least_height, height_of(row));
        picture.most_height = std::max(picture.most_height, height_of(row));
        if (row.psnr_db && std::isfinite(*row.psnr_db)) {
            panels.back().lines[row.numbers].emplace_back(height_of(row), *row.psnr_db);
            picture.low = std::min(picture.low, std::floor(*row.psnr_db / 20) * 20);
            picture.high = std::max(picture.high, std::ceil(*row.psnr_db / 20) * 20);
        }
    }
    return picture;
}

/// Where the data of a panel lie, px.
struct AccuracyAxes {
    double left = 0, right = 0, top = 0, bottom = 0;
    const Picture& picture;
    double x(double height) const {
        const double padding = 0.35; // octaves
        const double low = std::log2(picture.least_height) - padding;
        const double high = std::log2(picture.most_height) + padding;
        return left + (std::log2(height) - low) / (high - low) * (right - left);
    }
    double y(double decibels) const {
        return bottom - (decibels - picture.low) / (picture.high - picture.low) * (bottom - top);
    }
};

void draw_axes(Svg& svg, const AccuracyAxes& axes, const Panel& panel) {
    for (double tick = axes.picture.low; tick <= axes.picture.high; tick += 20) {
        const double y = axes.y(tick);
        svg.line(axes.left, y, axes.right, y, tick == axes.picture.low ? kGrey : kGrid, 1);
        svg.text(axes.left - 8, y + 4, std::to_string(std::lround(tick)),
                 {kSmallText, kGrey, "end", false});
    }
    std::map<double, bool> heights;
    for (const auto& [set, line] : panel.lines) {
        for (const auto& point : line) {
            heights[point.first] = true;
        }
    }
    for (const auto& [height, present] : heights) {
        const double x = axes.x(height);
        svg.line(x, axes.bottom, x, axes.bottom + 5, kGrey, 1);
        svg.text(x, axes.bottom + 19, std::to_string(std::lround(height)),
                 {kSmallText, kGrey, "middle", false});
    }
    svg.text((axes.left + axes.right) / 2, axes.bottom + 36, "image height, px",
             {kSmallText, kGrey, "middle", false});
    svg.text(axes.left - 34, axes.top - 10, "PSNR, dB", {kSmallText, kGrey, "start", false});
}

std::vector<Svg::Points> places_of(const AccuracyAxes& axes, const Panel& panel) {
    std::vector<Svg::Points> all;
    for (const std::string& set : axes.picture.sets) {
        Svg::Points places;
        const auto found = panel.lines.find(set);
        if (found != panel.lines.end()) {
            Line line = found->second;
            std::sort(line.begin(), line.end());
            for (const auto& [height, decibels] : line) {
                places.emplace_back(axes.x(height), axes.y(decibels));
            }
        }
        all.push_back(std::move(places));
    }
    return all;
}

} // namespace

std::string accuracy_svg(const std::vector<AccuracyRow>& rows) {
    const Picture picture = picture_of(rows);
    if (picture.panels.empty()) {
        return {};
    }
    const std::string title = "PSNR against double precision";
    Svg svg;
    svg.text(kPlotMargin, 30, title, {16, kInk, "start", true});
    const double top = draw_legend(svg, 56, picture.sets);
    const std::size_t columns = picture.panels.size() > 1 ? 2 : 1;
    const double width = (kPlotWidth - 2 * kPlotMargin) / static_cast<double>(columns);
    double bottom = top;
    for (std::size_t p = 0; p < picture.panels.size(); ++p) {
        const Panel& panel = picture.panels[p];
        const double left = kPlotMargin + width * static_cast<double>(p % columns);
        const std::size_t row = p / columns;
        const double y = top + kAccuracyPanelHeight * static_cast<double>(row);
        const AccuracyAxes axes{left + 36, left + width - 14, y + 56, y + kAccuracyPanelHeight - 48,
                                picture};
        svg.text(left, y + 20, fitting(panel.heading, 13, width - 10), {13, kInk, "start", true});
        draw_axes(svg, axes, panel);
        draw_lines(svg, places_of(axes, panel));
        bottom = y + kAccuracyPanelHeight;
    }
    return svg.document(kPlotWidth, bottom + 6, title);
}

} // namespace degs::sim
