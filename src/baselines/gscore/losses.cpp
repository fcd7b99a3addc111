// SPDX-License-Identifier: Apache-2.0
// What moves the losses of GSCore.
#include "baselines/gscore/config.hpp"

namespace degs::gscore {

std::vector<LossKey> Config::loss_keys() const {
    using Way = LossKey::Way;
    return with(
        {
            {"gaps", "buffer.bytes", Way::Raise, kNoLimit},
            {"boundary", "array.subtile_skip", Way::Set, "exact"},
            {"terminated", "array.termination_cycles", Way::Lower, "1"},
            {"blocked", "pixel_buffer.bytes", Way::Raise, kNoLimit},
            {"blocked", "pixel_buffer.readout_pixels", Way::Raise, "4096"},
            {"readout", "pixel_buffer.readout_pixels", Way::Raise, "4096"},
        },
        common_loss_keys(memory));
}

} // namespace degs::gscore
