// SPDX-License-Identifier: Apache-2.0
#include "sim/memory/memory_pattern.hpp"

#include <algorithm>

namespace degs::sim {
namespace {

constexpr std::size_t kMostWaiting = 1U << 16U; // before a channel is taken to be out of reach
constexpr std::uint64_t kStreamDistance = std::uint64_t{256} << 20U;

enum Kind : std::uint8_t { kStream, kStream4, kStrided, kRandom };

} // namespace

const std::vector<std::string>& traffic_patterns() {
    static const std::vector<std::string> names{"stream", "stream4", "strided", "random"};
    return names;
}

TrafficDealer::TrafficDealer(const TrafficShape& shape, const dram::Mapping& mapping,
                             std::size_t channels)
    : mapping_(&mapping), shape_(shape),
      kind_(std::find(traffic_patterns().begin(), traffic_patterns().end(), shape.pattern) -
            traffic_patterns().begin()),
      random_(shape.seed), dealt_(channels) {}

TrafficItem TrafficDealer::draw() {
    const std::uint64_t bytes = shape_.request_bytes;
    const std::uint64_t stride = shape_.stride_bytes;
    // Where a sequence ends it starts again; requests stay below the capacity.
    const std::uint64_t room = mapping_->capacity() - bytes;
    const std::uint64_t i = drawn_++;
    TrafficItem item;
    switch (kind_) {
    case kStream:
        item.address = i * bytes % room;
        break;
    case kStream4:
        item.address = (i % 4 * kStreamDistance + i / 4 * bytes) % room;
        break;
    case kStrided:
        item.address = i * stride % room;
        break;
    default:
        item.address = random_() % (room / 64 + 1) * 64;
    }
    // Drawn by lot: taken in turn, reads and writes would go to different channels.
    const std::uint64_t reads = shape_.reads_per_write;
    item.write = reads != 0 && random_() % (reads + 1) == 0;
    return item;
}

bool TrafficDealer::next_of(std::size_t channel, TrafficItem& item) {
    std::deque<TrafficItem>& mine = dealt_[channel];
    while (mine.empty()) {
        if (waiting_ >= kMostWaiting) {
            return false;
        }
        const TrafficItem drawn = draw();
        dealt_[channel_of(drawn)].push_back(drawn);
        ++waiting_;
    }
    item = mine.front();
    mine.pop_front();
    --waiting_;
    return true;
}

} // namespace degs::sim
