// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>

#include "splat/pixels/blend_lanes.hpp"
#include "splat/pixels/quantized_row.hpp"

namespace degs {

/// PEs and pixel state of a number set.
class QuantizedPixels {
public:
    virtual ~QuantizedPixels() = default;
    /// What a PE fetches by G_ID.
    virtual void set(std::size_t index, const QuantizedSplat& splat) = 0;
    /// Makes room if need be.
    virtual void clear(std::size_t first, std::size_t count) = 0;
    /// The tasks of a span; `first` is the pixel of mask bit 0. `refuse`: StopRule::Refuse.
    virtual BlendOutcome blend(const BlendTask& task, bool refuse, std::size_t first) = 0;
    /// Blends the pixels of `mask` with q[i] <= QuantizedSplat::q_inside; 32 values.
    virtual BlendOutcome test(std::uint32_t splat, std::uint32_t mask, const double* q, bool refuse,
                              std::size_t first) = 0;
    virtual PixelValue read(std::size_t pixel) const = 0;
    /// All of a value that was read here but its count of updates.
    virtual void write(std::size_t pixel, const PixelValue& value) = 0;
};

/// Lanes if lanes_can() the set, else QuantizedRow pixel by pixel. `row` must live as long.
std::unique_ptr<QuantizedPixels> make_quantized_pixels(const QuantizedRow& row);

} // namespace degs
