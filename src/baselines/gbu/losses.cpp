// SPDX-License-Identifier: Apache-2.0
// Names the keys that would reduce each loss of PE-cycles of a GBU design.
#include "baselines/gbu/config.hpp"

namespace degs::gbu {

std::vector<LossKey> Config::loss_keys() const {
    using Way = LossKey::Way;
    std::vector<LossKey> rows; // without a rate all rows are solved at once
    if (engines.rows_per_cycle != 0) {
        rows.push_back({"row_generation", "engines.rows_per_cycle", Way::Raise});
    }
    const std::vector<LossKey> own = with(
        {
            {"row_generation", "engines.count", Way::Raise},
            {"gaps", "engines.queue_depth", Way::Raise},
            {"answers", "fetching.chunks_in_flight", Way::Raise, "list_buffer.chunks"},
            {"boundary", "engines.end_probe", Way::Set, "", "false"},
            {"blocked", "pixel_buffer.bytes", Way::Raise},
            {"blocked", "pixel_buffer.readout_pixels", Way::Raise},
            {"acknowledgements", "pixel_buffer.writes_in_flight", Way::Raise},
            {"acknowledgements", "pixel_buffer.bytes", Way::Raise},
            {"readout", "pixel_buffer.readout_pixels", Way::Raise},
        },
        common_loss_keys(memory));
    return with(rows, own);
}

} // namespace degs::gbu
