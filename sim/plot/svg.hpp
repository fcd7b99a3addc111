// SPDX-License-Identifier: Apache-2.0
// Just enough SVG for charts: shapes and text on a white page, colours as "#rrggbb".
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace degs::sim {

struct TextStyle {
    double size = 13; ///< px
    const char* colour = "#1a1a1a";
    const char* anchor = "start"; ///< or middle, end
    bool bold = false;
};

/// Shapes that distinguish lines without colour.
enum class Marker { Circle, Square, Triangle, Diamond };

/// Coordinates in px from the top left; later shapes lie on earlier ones.
class Svg {
public:
    using Points = std::vector<std::pair<double, double>>;

    void rectangle(double x, double y, double width, double height, const std::string& fill);
    void line(double x0, double y0, double x1, double y1, const std::string& colour, double width);
    void polyline(const Points& points, const std::string& colour, double width);
    void marker(Marker shape, double x, double y, const std::string& colour);
    /// (x, y) is the anchor on the base line.
    void text(double x, double y, const std::string& words, const TextStyle& style = {});

    /// Returns the whole file; a screen reader reads `title` aloud. It has the command that
    /// state_command() was told.
    std::string document(double width, double height, const std::string& title) const;

private:
    std::string body_;
};

/// From now on every picture says that this command made it; none does before.
void state_command(const std::string& command);

/// Upper bound of the width of `words` in a usual sans-serif font, px; fonts are not looked up.
double text_width(const std::string& words, double size, bool bold = false);
/// The longest beginning of `words` that fits, with an ellipsis if something is missing.
std::string fitting(const std::string& words, double size, double width);

/// Distance of the grid lines of an axis from 0 to `value`: the next of 1, 2, 5, 10 ... that needs
/// no more than `lines` of them.
double tick_of(double value, int lines = 5);

} // namespace degs::sim
