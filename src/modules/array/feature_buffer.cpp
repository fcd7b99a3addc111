// SPDX-License-Identifier: Apache-2.0
#include "modules/array/feature_buffer.hpp"

#include <algorithm>

namespace degs {

FeatureBuffer::FeatureBuffer(int entries, int open_splats, int streams, const Fill& fill)
    : entries_(entries), free_(entries), free_count_(entries_.size()),
      open_splats_(std::min(open_splats, entries / streams)), fill_(fill),
      write_ports_(std::size_t{1} * fill.ports.sram_banks * fill.ports.ports, 0),
      streams_(streams) {
    std::uint16_t entry = 0;
    for (Free& place : free_) {
        place = {0, entry++};
    }
}

bool FeatureBuffer::enter(std::uint64_t splat, Cycle now, std::size_t stream) {
    auto& [open, waiting] = streams_[stream];
    if (open.size() == open_splats_) {
        close_oldest(open, now);
    }
    if (next_free() > now) {
        stats_.waits += waiting ? 0 : 1;
        waiting = true;
        return false;
    }
    waiting = false;
    current_ = free_[first_free_].entry;
    first_free_ = next(first_free_);
    free_count_--;
    entries_[current_] = {now, 1, fill(current_, now)};
    current_key_ = splat;
    open.push_back({splat, current_});
    return true;
}

// One of the stream's open splats beside the current one.
bool FeatureBuffer::find(std::uint64_t splat, std::size_t stream) {
    for (const Open& open : streams_[stream].open) {
        if (open.key == splat) {
            current_key_ = splat;
            current_ = open.entry;
            return true;
        }
    }
    return false;
}

void FeatureBuffer::close(Cycle now, std::size_t stream) {
    std::vector<Open>& open = streams_[stream].open;
    while (!open.empty()) {
        close_oldest(open, now);
    }
}

void FeatureBuffer::close_oldest(std::vector<Open>& open, Cycle now) {
    const Open oldest = open.front();
    open.erase(open.begin());
    if (oldest.key == current_key_) {
        current_key_ = kNobody;
    }
    Entry& e = entries_[oldest.entry];
    if (--e.held == 0) {
        retire(oldest.entry, std::max(now, e.needed_until));
    }
}

// Takes the port of the entry's SRAM bank that is free first; returns the date at which it is done.
Cycle FeatureBuffer::fill(std::uint16_t entry, Cycle now) {
    const int ports = fill_.ports.ports;
    if (ports == 0 || fill_.cycles == 0) {
        return now + fill_.cycles;
    }
    const auto first = write_ports_.begin() + entry % fill_.ports.sram_banks * ports;
    Cycle& port = *std::min_element(first, first + ports);
    port = std::max(port, now) + fill_.cycles;
    return port;
}

void FeatureBuffer::retire(std::uint16_t entry, Cycle date) {
    last_retired_ = std::max(last_retired_, date);
    free_[end_free_] = {last_retired_, entry};
    end_free_ = next(end_free_);
    free_count_++;
}

} // namespace degs
