// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "stats/statistics.hpp"

namespace degs::dram {

/// What has become of the bytes of all requests, in whole bursts, by a date. A burst is on the bus
/// from its RD or WR command on, as in Energy.
struct TransferAccount {
    std::uint64_t on_bus = 0;    ///< transferred by the data bus
    std::uint64_t queued = 0;    ///< in the controllers: posted writes are answered before they go
    std::uint64_t merged = 0;    ///< written over in a write queue, before they went
    std::uint64_t forwarded = 0; ///< read from a write queue

    std::uint64_t total() const { return on_bus + queued + merged + forwarded; }

    void describe(StatsVisitor& v) const {
        v.count("on_bus", on_bus, "bytes", "Transferred by the data bus.");
        v.count("queued", queued, "bytes", "Still in the controllers' queues.");
        v.count("merged", merged, "bytes", "Written over in a write queue before they went.");
        v.count("forwarded", forwarded, "bytes", "Read from a write queue.");
    }
};

} // namespace degs::dram
