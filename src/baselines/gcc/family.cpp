// SPDX-License-Identifier: Apache-2.0
// The rule by which GCC designs of other sizes are made. docs/families.md explains it.
#include <algorithm>

#include "baselines/gcc/config.hpp"
#include "modules/kit/job/family_size.hpp"
#include "tlm/ceil_div.hpp"

namespace degs::gcc {

void Config::scale_to(int pes) {
    constexpr int kWidest = 64, kWindowsPerSide = 16;
    require_family_size("gcc", pes, kWidest * kWidest,
                        "must be a square, because the window has a PE per pixel, and at most 4096",
                        [](int number) {
                            const int side = whole_root(number);
                            return side * side == number;
                        });
    name = "gcc-" + std::to_string(pes);
    array.window = whole_root(pes);
    view_size = std::max(4, kWindowsPerSide * array.window);
    group_buffer_bytes = per_pe(group_buffer_bytes, pes);
    const int per_gaussian = group_bytes() / listed_gaussians();
    projection.group =
        std::min(projection.group, power_of_two_below(group_buffer_bytes / per_gaussian));
    colour.block = std::max(colour.block, ceil_div(view_size, BlockMask::kMaxBlocks));
    image_buffer.bytes = image_buffer.state_bytes * view_size * view_size;
    image_buffer.readout_pixels = pes;
}

} // namespace degs::gcc
