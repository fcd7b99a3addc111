// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "splat/frame/pixel_index.hpp"

namespace degs {

/// The record of a splat for the Gaussian Slicing Unit and the Span Unit (paper: Temporary Gaussian
/// Parameter). The mean is its nearest pixel plus an offset in [-0.5, 0.5]: a plain fp32 coordinate
/// would lose 2^-13 px beyond x = 1024, which is enough to move span ends. In single precision all
/// of it is one cache line: splats of a tile lie anywhere in memory.
template <class T>
struct alignas(64) SpanRecord {
    std::int32_t pixel_x, pixel_y;
    T offset_x, offset_y;
    T slope;                  // m = -B/A = b/c (Eq. 10)
    T c_prime;                // C' = C - B^2/A = 1/c, exactly, without the cancellation
    T inverse_a;              // 1/A = det/c
    T a;                      // A
    T q_threshold;            // Q_th
    T limit;                  // of BlendRecord, for tests
    T fold;                   // 2 ln o, subtracted from g0 so that the PE needs exp(-q/2) alone
    PixelRange rows, columns; // of the ellipse
};

} // namespace degs
