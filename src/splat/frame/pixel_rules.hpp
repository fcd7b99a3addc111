// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace degs {

// The pixel rules of the original rasteriser in double precision; the data paths round these
// constants.
constexpr double kAlphaMin = 1.0 / 255.0; ///< a smaller alpha is skipped
constexpr double kAlphaMax = 0.99;        ///< a larger one counts as this
/// A cut includes its limit: pixels up to this far beyond it in q are inside, in every format.
/// Above the rounding of q and of its distance to 2 ln o in single precision (a few 1e-6), and far
/// below anything that a picture shows.
constexpr double kCutMargin = 1e-5;
constexpr double kStopTransmittance = 1e-4; ///< the splat that would push T under it is refused

} // namespace degs
