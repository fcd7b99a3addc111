// SPDX-License-Identifier: Apache-2.0
#pragma once

namespace degs {

// The pixel rules of the original rasteriser in double precision; the data paths round these constants.
constexpr double kAlphaMin = 1.0 / 255.0;   ///< a smaller alpha is skipped
constexpr double kAlphaMax = 0.99;          ///< a larger one counts as this
constexpr double kStopTransmittance = 1e-4; ///< the splat that would push T under it is refused

} // namespace degs
