// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "splat/numbers/number_format.hpp"

namespace degs {

/// Formats of what makes splats out of Gaussians. By default those of the reference: SH
/// coefficients as the scene has them, everything else in double, and depths compared as fp32 (the
/// original code sorts by the bits of a float).
struct ProjectionNumbers {
    NumberFormat format;  ///< of every operation; fp64 and fp32 are native
    NumberFormat sh_dc;   ///< SH coefficients of degree 0 in memory, rounded before use
    NumberFormat sh_rest; ///< SH coefficients of higher degrees
    NumberFormat depth_key = parse_format("fp32"); ///< depths in list entries; equal: by index

    /// Are splats and their order those of the reference?
    bool is_reference() const { return *this == ProjectionNumbers(); }
    /// The format, and the others where they are not the default: "fp32, SH q3.5 and q1.7, depth
    /// keys ue4m12". Different numbers have different names.
    std::string name() const;

    bool operator==(const ProjectionNumbers& other) const {
        return format == other.format && sh_dc == other.sh_dc && sh_rest == other.sh_rest &&
               depth_key == other.depth_key;
    }
    bool operator!=(const ProjectionNumbers& other) const { return !(*this == other); }
};

} // namespace degs
