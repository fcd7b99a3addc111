// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/accelerator/loss_keys.hpp"

namespace degs {

using Way = LossKey::Way;

std::vector<LossKey> with(std::vector<LossKey> keys, const std::vector<LossKey>& more) {
    keys.insert(keys.end(), more.begin(), more.end());
    return keys;
}

std::vector<LossKey> common_loss_keys(const MainMemoryConfig& memory) {
    const std::vector<LossKey> front_end{
        {"projection", "projection.count", Way::Raise, "64"},
        {"binning", "binning.pairs_per_cycle", Way::Raise, kNoLimit},
        {"sorting", "sorting.count", Way::Raise, "64"},
        {"sorting", "sorting.keys_per_cycle", Way::Raise, kNoLimit},
        {"fetching", "fetching.chunks_in_flight", Way::Raise, kNoLimit},
        {"fetching", "sorting.count", Way::Raise, "64"},
    };
    if (memory.model == MemoryModel::Lpddr5) {
        return with({{"memory", "memory.lpddr5.channels", Way::Raise, "64"}}, front_end);
    }
    return with(
        {
            {"memory", "memory.bandwidth_gb_per_s", Way::Raise, "100000"},
            {"latency", "memory.latency_ns", Way::Lower, "0"},
            {"readout", "memory.latency_ns", Way::Lower, "0"},
        },
        front_end);
}

} // namespace degs
