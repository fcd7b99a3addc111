// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "splat/frame/frame_workload.hpp"
#include "splat/numbers/number_set.hpp"

namespace degs {

/// How far a number set may be from the reference on the splats of a frame, from its formats alone.
/// It must not be used for sets that derive their record (Derivation::Literal): C - B^2/A may lose
/// all digits.
struct NumberTolerance {
    double alpha = 0;     ///< bound on the error of a fragment's alpha
    double update = 0;    ///< bound on what rounding adds to a pixel per blended splat and unit of
                          ///< colour
    bool outward = false; ///< spans have pixels outside of the ellipse
};

/// First order: half a unit of each format at the largest value that the splats of the frame make
/// there, times how much alpha changes with it. alpha changes by at most 0.61 sqrt(A) per px along
/// a row, by 1.11 per px across (dilated splats), by alpha f per unit of q' (f = 1/2, or ln 2 for
/// binary orders); alpha q f is at most 0.37, so that relative errors of q count so much.
NumberTolerance tolerance_of(const NumberSet& set, const FrameWorkload& workload);

/// How far a channel of a pixel may be from the reference's. Compositing is a contraction: an error
/// of splat i's alpha moves the pixel by at most T_i times the largest colour. Splats whose alpha
/// is within the bound of 1/255 may be drawn by one of the two alone, spans with pixels outside may
/// draw fainter ones, and a pixel whose transmittance comes near 1e-4 may end at another splat.
double pixel_tolerance(const FrameWorkload& workload, int x, int y, const NumberTolerance& numbers);

} // namespace degs
