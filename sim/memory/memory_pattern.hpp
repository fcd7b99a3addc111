// SPDX-License-Identifier: Apache-2.0
// Synthetic address sequences that characterise a memory.
#pragma once

#include <cstdint>
#include <deque>
#include <random>
#include <string>
#include <vector>

#include "dram/mapping.hpp"

namespace degs::sim {

struct TrafficShape {
    std::string pattern = "stream"; ///< of traffic_patterns()
    int request_bytes = 64;
    int stride_bytes = 256;  ///< pattern strided
    int reads_per_write = 0; ///< on average; 0: reads only
    std::uint64_t seed = 1;
};

/// The names of the patterns of addresses:
/// * stream: one request after the other
/// * stream4: four streams 256 MiB apart, in turn
/// * strided: the first bytes of every stride
/// * random: uniform, aligned to 64 B
const std::vector<std::string>& traffic_patterns();

struct TrafficItem {
    std::uint64_t address = 0;
    bool write = false;
};

/// One sequence, dealt to the channels: each takes its own requests in the order of the sequence,
/// so that a full channel holds up no other.
class TrafficDealer {
public:
    TrafficDealer(const TrafficShape& shape, const dram::Mapping& mapping, std::size_t channels);

    /// The next request of the sequence.
    TrafficItem draw();
    unsigned channel_of(const TrafficItem& item) const {
        return mapping_->place(item.address).channel;
    }
    /// The next request of a channel; false if the sequence does not reach it for a long time.
    bool next_of(std::size_t channel, TrafficItem& item);

private:
    const dram::Mapping* mapping_;
    TrafficShape shape_;
    std::size_t kind_;
    std::mt19937_64 random_;
    std::uint64_t drawn_ = 0;
    std::vector<std::deque<TrafficItem>> dealt_;
    std::size_t waiting_ = 0; // dealt and not taken
};

} // namespace degs::sim
