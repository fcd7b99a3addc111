// SPDX-License-Identifier: Apache-2.0
// Names the keys that would reduce each loss of PE-cycles of an ORANGE design.
#include <algorithm>

#include "baselines/orange/config.hpp"

namespace degs::orange {

std::vector<LossKey> Config::loss_keys() const {
    using Way = LossKey::Way;
    std::vector<LossKey> keys{
        {"vector_units", "cores.vector.lanes", Way::Raise},
        {"gaps", "cores.vector.lanes", Way::Raise},
        {"padding", "cores.array.fill", Way::Set, "", "none"},
        {"acknowledgements", "pixel_buffer.writes_in_flight", Way::Raise},
        {"readout", "pixel_buffer.readout_pixels", Way::Raise},
    };
    // The lists of most tiles are a batch: those that a Sorting Unit waits for, and those that a
    // core does.
    const int lists = sorting.count;
    const int batches = cores.count * std::min(fetching.chunks_in_flight, scratchpad.splat_batches);
    if (batches > lists) {
        keys.push_back({"answers", "sorting.count", Way::Raise});
    } else if (batches < lists) {
        keys.push_back(
            {"answers", "fetching.chunks_in_flight", Way::Raise, "scratchpad.splat_batches"});
    }
    return with(keys, common_loss_keys(memory));
}

} // namespace degs::orange
