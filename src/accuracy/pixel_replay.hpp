// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "splat/pixels/data_path.hpp"
#include "splat/pixels/quantized_row.hpp"

namespace degs {

/// One pixel drawn splat by splat, in the order of its tile's list.
struct PixelReplay {
    std::vector<double> alpha;  ///< per list entry; 0 where the pixel is not in the splat
    std::vector<double> weight; ///< per list entry: alpha T where it is blended, else 0
    std::size_t ended;          ///< list entry that ended the pixel; the list's length if none
    double rgb[3] = {0, 0, 0};
    double transmittance = 1;
};

/// Draws the pixel as render_reference does.
PixelReplay replay_reference(const FrameWorkload& workload, int x, int y);
/// Draws it as the row path does in the formats of `row`, value by value. A data path's lanes may
/// differ by a unit of a product (quantized_lanes.hpp), and fp32 ones by the order of operations.
PixelReplay replay_row(const FrameWorkload& workload, int x, int y, const QuantizedRow& row,
                       StopRule stop);

/// Largest difference of a channel or of the transmittance; infinite for NaN.
double pixel_distance(const PixelReplay& a, const PixelReplay& b);

/// The cause of the error of a pixel.
struct PixelBlame {
    double error = 0;      ///< of the replay, see pixel_distance
    std::uint32_t id = 0;  ///< Gaussian, index in the cloud
    std::string operation; ///< "mean", "m", "q", "exp", ..., "span ends", "projection"; empty
                           ///< without an error
    double explained = 0;  ///< error that the operation makes, see blame_pixel
    std::string flip;      ///< "stop rule", "span ends", "depth order" or empty
};

/// Replays a pixel. The Gaussian is the one whose alpha moves the reference's pixel most if it
/// alone is taken from the number set. The operation is the one that explains most: the error of a
/// replay in which it alone is rounded, or the part of the error that vanishes if it alone is
/// exact, whichever is larger. `flip` is set if the two disagree on whether the Gaussian is
/// blended: because the pixel ends at another splat, or because only one of them has it in its
/// span.
PixelBlame blame_pixel(const FrameWorkload& workload, int x, int y, const NumberSet& set,
                       StopRule stop);

/// Blames a pixel of a set whose frame was projected in a format of its own: `reference` in double,
/// `projected` in the set's. The operation is "projection" if that explains more than any other:
/// the error of `projected` drawn in double, or the part of the error that vanishes without it. The
/// Gaussian is then the one whose part of the pixel changes most, and the flip may be that splats
/// of both frames come in another order.
PixelBlame blame_pixel(const FrameWorkload& reference, const FrameWorkload& projected, int x, int y,
                       const NumberSet& set, StopRule stop);

} // namespace degs
