// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/accelerator/loss_keys.hpp"

namespace degs {

using Way = LossKey::Way;

std::vector<LossKey> with(std::vector<LossKey> keys, const std::vector<LossKey>& more) {
    keys.insert(keys.end(), more.begin(), more.end());
    return keys;
}

const char* bandwidth_key(const MainMemoryConfig& memory) {
    return memory.model == MemoryModel::Lpddr5 ? "memory.lpddr5.channels"
                                               : "memory.bandwidth_gb_per_s";
}

std::vector<LossKey> memory_loss_keys(const MainMemoryConfig& memory) {
    if (memory.model == MemoryModel::Lpddr5) {
        return {{"memory", bandwidth_key(memory), Way::Raise}};
    }
    std::vector<LossKey> keys{{"memory", bandwidth_key(memory), Way::Raise}};
    for (const char* const cause : {"latency", "answers", "acknowledgements"}) {
        keys.push_back({cause, "memory.latency_ns", Way::Lower});
    }
    return keys;
}

std::vector<LossKey> common_loss_keys(const MainMemoryConfig& memory) {
    const char* const rate = bandwidth_key(memory);
    return with(
        memory_loss_keys(memory),
        {
            {"memory and projection", rate, Way::Raise, "projection.count"},
            {"memory and binning", rate, Way::Raise, "binning.pairs_per_cycle"},
            {"projection", "projection.count", Way::Raise},
            {"binning", "binning.pairs_per_cycle", Way::Raise},
            {"projection and binning", "projection.count", Way::Raise, "binning.pairs_per_cycle"},
            {"sorting", "sorting.count", Way::Raise},
            {"sorting", "sorting.keys_per_cycle", Way::Raise},
            {"fetching", "fetching.chunk", Way::Raise},
        });
}

} // namespace degs
