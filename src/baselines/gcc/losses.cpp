// SPDX-License-Identifier: Apache-2.0
// What moves the losses of GCC.
#include "baselines/gcc/config.hpp"

namespace degs::gcc {

std::vector<LossKey> Config::loss_keys() const {
    using Way = LossKey::Way;
    return with(
        {
            {"projection", "projection.units", Way::Raise, kNoLimit},
            {"colour", "colour.units", Way::Raise, kNoLimit},
            {"grouping", "grouping.means_per_cycle", Way::Raise, kNoLimit},
            {"grouping", "grouping.entries_per_cycle", Way::Raise, kNoLimit},
            {"grouping", "grouping.means_per_cycle", Way::Raise, kNoLimit,
             "grouping.entries_per_cycle"},
            {"drain", "view_size", Way::Lower, "16"},
            {"memory and grouping", "grouping.means_per_cycle", Way::Raise, kNoLimit,
             bandwidth_key(memory)},
            {"answers", "projection.groups_ahead", Way::Raise, kNoLimit, "group_buffer_bytes"},
            {"acknowledgements", "image_buffer.writes_in_flight", Way::Raise, "1024"},
            {"acknowledgements", "image_buffer.bytes", Way::Raise, kNoLimit},
            {"terminated", "array.skip_cycles", Way::Lower, "0"},
            {"conflict", "array.discovery_cycles", Way::Lower, "1"},
            {"blocked", "image_buffer.bytes", Way::Raise, kNoLimit},
            {"blocked", "image_buffer.readout_pixels", Way::Raise, "4096"},
            {"readout", "image_buffer.readout_pixels", Way::Raise, "4096"},
        },
        memory_loss_keys(memory));
}

} // namespace degs::gcc
