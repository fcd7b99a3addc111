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
        {"projection and binning", "projection.count", Way::Raise, "64", "binning.pairs_per_cycle"},
        {"binning and projection", "projection.count", Way::Raise, "64", "binning.pairs_per_cycle"},
        {"sorting", "sorting.count", Way::Raise, "64"},
        {"sorting", "sorting.keys_per_cycle", Way::Raise, kNoLimit},
        {"fetching", "fetching.chunks_in_flight", Way::Raise, kNoLimit},
        {"fetching", "sorting.count", Way::Raise, "64"},
    };
    const bool channels = memory.model == MemoryModel::Lpddr5;
    const char* const rate = channels ? "memory.lpddr5.channels" : "memory.bandwidth_gb_per_s";
    const char* const most = channels ? "64" : "100000";
    const std::vector<LossKey> bandwidth{
        {"memory", rate, Way::Raise, most},
        {"memory and projection", rate, Way::Raise, most, "projection.count"},
        {"projection and memory", rate, Way::Raise, most, "projection.count"},
        {"memory and binning", rate, Way::Raise, most, "binning.pairs_per_cycle"},
        {"binning and memory", rate, Way::Raise, most, "binning.pairs_per_cycle"},
    };
    if (channels) {
        return with(bandwidth, front_end);
    }
    return with(with(bandwidth, {{"latency", "memory.latency_ns", Way::Lower, "0"}}), front_end);
}

} // namespace degs
