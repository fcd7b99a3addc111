// SPDX-License-Identifier: Apache-2.0
// The rule by which GSCore designs of other sizes are made. docs/families.md explains it.
#include "baselines/gscore/config.hpp"
#include "modules/kit/job/family_size.hpp"

namespace degs::gscore {

void Config::scale_to(int pes) {
    require_family_size(
        "gscore", pes, 1024, "must be a square of 4, 8, 16 or 32 px", [](int number) {
            const int side = whole_root(number);
            return side * side == number && side >= 4 && power_of_two_below(side) == side;
        });
    name = "gscore-" + std::to_string(pes);
    array.lanes = pes;
    buffer.bytes = per_pe(buffer.bytes, pes);
    constexpr int kTiles = 2;
    pixel_buffer.bytes = kTiles * pixel_buffer.state_bytes * array.tile_size() * array.tile_size();
    pixel_buffer.readout_pixels = pes;
}

} // namespace degs::gscore
