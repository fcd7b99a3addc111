// SPDX-License-Identifier: Apache-2.0
// Names the keys that would reduce each loss of PE-cycles of a GCC design.
#include "baselines/gcc/config.hpp"

namespace degs::gcc {

std::vector<LossKey> Config::loss_keys() const {
    using Way = LossKey::Way;
    return with(
        {
            {"projection", "projection.units", Way::Raise},
            {"colour", "colour.units", Way::Raise},
            {"grouping", "grouping.means_per_cycle", Way::Raise},
            {"grouping", "grouping.entries_per_cycle", Way::Raise},
            {"grouping", "grouping.means_per_cycle", Way::Raise, "grouping.entries_per_cycle"},
            {"drain", "view_size", Way::Lower},
            {"memory and grouping", "grouping.means_per_cycle", Way::Raise, bandwidth_key(memory)},
            {"answers", "projection.groups_ahead", Way::Raise, "group_buffer_bytes"},
            {"acknowledgements", "image_buffer.writes_in_flight", Way::Raise},
            {"acknowledgements", "image_buffer.bytes", Way::Raise},
            {"terminated", "array.skip_cycles", Way::Lower},
            {"conflict", "array.discovery_cycles", Way::Lower},
            {"blocked", "image_buffer.bytes", Way::Raise},
            {"blocked", "image_buffer.readout_pixels", Way::Raise},
            {"readout", "image_buffer.readout_pixels", Way::Raise},
        },
        memory_loss_keys(memory));
}

} // namespace degs::gcc
