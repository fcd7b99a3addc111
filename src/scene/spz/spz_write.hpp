// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <vector>

#include "splat/model/gaussian.hpp"

namespace degs {

struct SpzWriteOptions {
    int version = 3;          ///< 3 (gzip) or 4 (ZSTD)
    bool antialiased = false; ///< flag of scenes trained with compensated opacity
};

/// Writes a sanitized cloud in RDF as SPZ, in its RUB axes with a record that names them.
/// Everything is rounded to the nearest code: positions to 1/4096, or to 2^-b with fewer bits b if
/// a coordinate is 2048 or more; log scales to 1/16 within -10 .. 5.9375; the three smaller
/// components of rotations to sqrt(1/2) / 511; opacities to 1/255; coefficients of degree 0 to
/// 1/38.25 within -10/3 .. 10/3; others to 1/128 within -127/128 .. 127/128. Returns a sentence for
/// each range that values left, and were clamped to. InputError if a coordinate is 2^23 or more or
/// not finite, the cloud is empty or has 2^31 Gaussians, or the file cannot be written.
std::vector<std::string> write_spz(const GaussianCloud& cloud, const std::string& path,
                                   const SpzWriteOptions& options = {});

} // namespace degs
