// SPDX-License-Identifier: Apache-2.0
// The keys of a design that move a loss of PE-cycles. Every accelerator answers for its own.
#pragma once

#include <string>
#include <vector>

#include "modules/kit/config/main_memory_config.hpp"

namespace degs {

/// A key moves a loss until it has come to the end of its range, see describe(), or has the value
/// to set.
struct LossKey {
    enum class Way { Raise, Lower, Set };

    /// What PE-cycles are lost for: a class of slots, a stage that is busy, or one of
    /// * `memory`, its bandwidth, and `latency`, of memory or of the stages before the first task
    /// * two of them, "memory and projection", that work at the same time and take equally long; in
    ///   the order memory, stages, binning
    /// * `gaps`, an array that starves while nothing in front of it is busy
    /// * `answers`, an array that starves, and `acknowledgements`, one that is blocked, because the
    ///   latency of memory is long
    /// * `readout`, of the pixels of the last tiles
    const char* cause;
    const char* key;
    Way way;
    const char* linked = ""; ///< key that has to move with it
    const char* value = "";  ///< to set

    /// "KEY" or "KEY and KEY"
    std::string name() const { return *linked == 0 ? key : std::string(key) + " and " + linked; }
};

/// The keys that move the losses to the memory model in use.
std::vector<LossKey> memory_loss_keys(const MainMemoryConfig& memory);
/// The key that sets the bandwidth of the memory.
const char* bandwidth_key(const MainMemoryConfig& memory);
/// Keys of the memory, and of a Tile Front End with its fetchers.
std::vector<LossKey> common_loss_keys(const MainMemoryConfig& memory);
/// Appends `more` keys to `keys`.
std::vector<LossKey> with(std::vector<LossKey> keys, const std::vector<LossKey>& more);

} // namespace degs
