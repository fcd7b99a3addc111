// SPDX-License-Identifier: Apache-2.0
// What moves the losses of GSCore.
#include "baselines/gscore/config.hpp"

namespace degs::gscore {

std::vector<LossKey> Config::loss_keys() const {
    using Way = LossKey::Way;
    return with(
        {
            {"gaps", "buffer.bytes", Way::Raise, kNoLimit},
            {"answers", "sorting.count", Way::Raise, "64", "buffer.bytes"},
            {"boundary", "array.subtile_skip", Way::Set, "exact"},
            {"terminated", "array.termination_cycles", Way::Lower, "1"},
            {"blocked", "pixel_buffer.bytes", Way::Raise, kNoLimit},
            {"blocked", "pixel_buffer.readout_pixels", Way::Raise, "4096"},
            {"acknowledgements", "pixel_buffer.writes_in_flight", Way::Raise, "1024"},
            {"acknowledgements", "pixel_buffer.bytes", Way::Raise, kNoLimit},
            {"readout", "pixel_buffer.readout_pixels", Way::Raise, "4096"},
        },
        common_loss_keys(memory));
}

} // namespace degs::gscore
