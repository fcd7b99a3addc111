// SPDX-License-Identifier: Apache-2.0
// What moves the losses of GBU.
#include "baselines/gbu/config.hpp"

namespace degs::gbu {

std::vector<LossKey> Config::loss_keys() const {
    using Way = LossKey::Way;
    std::vector<LossKey> rows; // without a rate all rows are solved at once
    if (engines.rows_per_cycle != 0) {
        rows.push_back({"row_generation", "engines.rows_per_cycle", Way::Raise, "1024"});
    }
    const std::vector<LossKey> own = with(
        {
            {"row_generation", "engines.count", Way::Raise, kNoLimit},
            {"gaps", "engines.queue_depth", Way::Raise, "4096"},
            {"answers", "fetching.chunks_in_flight", Way::Raise, kNoLimit, "list_buffer.chunks"},
            {"boundary", "engines.end_probe", Way::Set, "false"},
            {"blocked", "pixel_buffer.bytes", Way::Raise, kNoLimit},
            {"blocked", "pixel_buffer.readout_pixels", Way::Raise, "4096"},
            {"acknowledgements", "pixel_buffer.writes_in_flight", Way::Raise, "1024"},
            {"acknowledgements", "pixel_buffer.bytes", Way::Raise, kNoLimit},
            {"readout", "pixel_buffer.readout_pixels", Way::Raise, "4096"},
        },
        common_loss_keys(memory));
    return with(rows, own);
}

} // namespace degs::gbu
