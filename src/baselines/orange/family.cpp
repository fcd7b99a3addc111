// SPDX-License-Identifier: Apache-2.0
// The rule by which ORANGE designs of other sizes are made. docs/families.md explains it.
#include <algorithm>

#include "baselines/orange/config.hpp"
#include "modules/kit/job/family_size.hpp"

namespace degs::orange {

// One core with a square array; the rest of the core grows with the array's sides.
void Config::scale_to(int pes) {
    constexpr int kMost = 1 << 14;
    require_family_size(
        "orange", pes, kMost, "must be a square of a power of two from 2 to 128", [](int number) {
            const int side = whole_root(number);
            return side >= 2 && side * side == number && power_of_two_below(side) == side;
        });
    const int side = whole_root(pes);
    name = "orange-" + std::to_string(pes);
    cores.count = 1;
    cores.array.rows = cores.array.columns = side;
    cores.vector.lanes = std::max(1, cores.vector.lanes * side / 32);
    pixel_buffer.bytes /= 4;
    pixel_buffer.readout_pixels /= 4;
}

} // namespace degs::orange
