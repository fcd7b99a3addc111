// SPDX-License-Identifier: Apache-2.0
// Names the keys that would reduce each loss of PE-cycles of a GSCore design.
#include "baselines/gscore/config.hpp"

namespace degs::gscore {

std::vector<LossKey> Config::loss_keys() const {
    using Way = LossKey::Way;
    return with(
        {
            {"gaps", "buffer.bytes", Way::Raise},
            {"answers", "sorting.count", Way::Raise, "buffer.bytes"},
            {"boundary", "array.subtile_skip", Way::Set, "", "exact"},
            {"terminated", "array.termination_cycles", Way::Lower},
            {"blocked", "pixel_buffer.bytes", Way::Raise},
            {"blocked", "pixel_buffer.readout_pixels", Way::Raise},
            {"acknowledgements", "pixel_buffer.writes_in_flight", Way::Raise},
            {"acknowledgements", "pixel_buffer.bytes", Way::Raise},
            {"readout", "pixel_buffer.readout_pixels", Way::Raise},
        },
        common_loss_keys(memory));
}

} // namespace degs::gscore
