// SPDX-License-Identifier: Apache-2.0
// What moves the losses of ORANGE.
#include "baselines/orange/config.hpp"

namespace degs::orange {

std::vector<LossKey> Config::loss_keys() const {
    using Way = LossKey::Way;
    return with(
        {
            {"vector_units", "cores.vector.lanes", Way::Raise, "65536"},
            {"gaps", "cores.vector.lanes", Way::Raise, "65536"},
            {"padding", "cores.array.fill", Way::Set, "none"},
            {"readout", "pixel_buffer.readout_pixels", Way::Raise, "4096"},
        },
        common_loss_keys(memory));
}

} // namespace degs::orange
