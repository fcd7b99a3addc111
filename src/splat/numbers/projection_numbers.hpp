// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

#include "splat/numbers/number_format.hpp"

namespace degs {

/// Formats of what makes splats out of Gaussians. By default those of the reference: Gaussians as
/// the scene has them, everything else in double, and depths compared as fp32 (the original code
/// sorts by the bits of a float).
struct ProjectionNumbers {
    NumberFormat format; ///< of every operation; fp64 and fp32 are native
    // A Gaussian in memory, rounded before use; fp64: as the scene has it, in words of fp32.
    NumberFormat mean;     ///< three coordinates, scene units; see StoredGaussians
    NumberFormat scale;    ///< three standard deviations, scene units
    NumberFormat rotation; ///< four parts of a unit quaternion
    NumberFormat opacity;  ///< 0..1
    NumberFormat sh_dc;    ///< SH coefficients of degree 0
    NumberFormat sh_rest;  ///< SH coefficients of higher degrees
    NumberFormat depth_key = parse_format("fp32"); ///< depths in list entries; equal: by index

    /// Are splats and their order those of the reference?
    bool is_reference() const { return *this == ProjectionNumbers(); }
    /// Is a Gaussian used as the scene has it?
    bool keeps_gaussians() const;
    /// Bits of a mean, of scale, rotation and opacity together, and of the coefficients of all
    /// degrees up to `degree` in memory.
    int mean_bits() const;
    int shape_bits() const;
    int sh_bits(int degree) const;
    /// The format, and the others where they are not the default: "fp32, means e5m18, scales fp16,
    /// rotations q1.15, opacities uq0.16, SH q3.5 and q1.7, depth keys ue4m12". Different numbers
    /// have different names.
    std::string name() const;

    bool operator==(const ProjectionNumbers& other) const;
    bool operator!=(const ProjectionNumbers& other) const { return !(*this == other); }
};

} // namespace degs
