// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "dram/channel.hpp"
#include "stats/statistics.hpp"

namespace degs::dram {

/// Counts of all channels of a memory up to a date, and the load of each of them.
struct Activity {
    Channel::Stats all;                       ///< sums over the channels
    std::vector<std::uint64_t> channel_bytes; ///< that each data bus has transferred

    void describe(StatsVisitor& v) const {
        v.list("bytes", channel_bytes, "bytes", "Transferred by the data bus of each channel.");
        all.describe(v);
    }
};

} // namespace degs::dram
