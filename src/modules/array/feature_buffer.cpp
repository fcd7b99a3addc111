// SPDX-License-Identifier: Apache-2.0
#include "modules/array/feature_buffer.hpp"

#include <algorithm>

namespace degs {

FeatureBuffer::FeatureBuffer(int entries, int open_splats, int streams, const Fill& fill)
    : entries_(entries), free_(entries), first_free_(free_.data()), end_free_(first_free_),
      free_count_(entries_.size()), fill_(fill),
      write_ports_(std::size_t{1} * fill.ports.sram_banks * fill.ports.ports, 0),
      streams_(streams) {
    for (Stream& stream : streams_) {
        stream.open.resize(std::min(open_splats, entries / streams));
    }
    std::uint16_t entry = 0;
    for (Free& place : free_) {
        place = {0, entry++};
    }
}

// Inlined, because most splats that enter close another one.
inline __attribute__((always_inline)) void FeatureBuffer::close_oldest(Stream& own, Cycle now) {
    Open& oldest = own.open[own.oldest];
    own.oldest = own.oldest + 1 == own.open.size() ? 0 : own.oldest + 1;
    own.count--;
    if (oldest.key == current_key_) {
        current_key_ = kNobody;
    }
    oldest.key = kNobody;
    Entry& e = entries_[oldest.entry];
    if (--e.held == 0) {
        retire(oldest.entry, std::max(now, e.needed_until));
    }
}

void FeatureBuffer::retire(std::uint16_t entry, Cycle date) {
    last_retired_ = std::max(last_retired_, date);
    *end_free_ = {last_retired_, entry};
    end_free_ = next(end_free_);
    free_count_++;
}

bool FeatureBuffer::enter(std::uint64_t splat, Cycle now, std::size_t stream) {
    Stream& own = streams_[stream];
    if (own.count == own.open.size()) {
        close_oldest(own, now);
    }
    if (next_free() > now) {
        stats_.waits += own.waiting ? 0 : 1;
        own.waiting = true;
        return false;
    }
    own.waiting = false;
    stats_.entries++;
    current_ = first_free_->entry;
    first_free_ = next(first_free_);
    free_count_--;
    entries_[current_] = {now, 1, fill(current_, now)};
    current_key_ = splat;
    const std::size_t place = own.oldest + own.count++;
    own.open[place < own.open.size() ? place : place - own.open.size()] = {splat, current_};
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
    Stream& own = streams_[stream];
    while (own.count != 0) {
        close_oldest(own, now);
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

} // namespace degs
