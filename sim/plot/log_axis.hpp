// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <vector>

#include "sim/plot/svg.hpp"

namespace degs::sim {

/// A logarithmic axis with room at its ends.
struct LogAxis {
    double low = 0, high = 1;  ///< logarithms
    double begin = 0, end = 0; ///< px

    /// With room for all values, which are positive; at least one.
    static LogAxis around(const std::vector<double>& values, double begin, double end);

    double at(double value) const {
        return begin + (std::log10(value) - low) / (high - low) * (end - begin);
    }
    /// Round values inside the axis: 1, 2, 5, 10, ..., on a long axis powers of ten alone, and on a
    /// short one evenly spaced values.
    std::vector<double> ticks() const;
};

/// Draws lines of the grid for `y`, which begins at the bottom, and ticks below for `x`, with their
/// values.
void draw_log_axes(Svg& svg, const LogAxis& x, const LogAxis& y);

} // namespace degs::sim
