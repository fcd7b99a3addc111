// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/array/feature_buffer.hpp"

#include <algorithm>

namespace degs {

void FeatureBuffer::Config::describe(ConfigVisitor& visitor) {
    visitor.integer("bytes", bytes, 16, 1 << 30, "bytes (paper Table I: 8 KB), split among banks");
    visitor.integer("entry_bytes", entry_bytes, 1, 256,
                    "bytes per splat: A, three colours, tag [assumed]");
    visitor.integer("fill_cycles", fill.cycles, 0, 1024,
                    "cycles that writing an entry takes; its first span waits as far as the "
                    "Packing Unit's pipeline does not hide them [assumed]");
    fill.ports.describe(visitor,
                        "splats written, and splats read by the tasks of a packet, per cycle and "
                        "SRAM bank; 0: unlimited [assumed]",
                        "SRAM banks of an Issue Bank's part [assumed]");
}

FeatureBuffer::FeatureBuffer(int entries, int open_splats, int streams, const Fill& fill)
    : entries_(entries), free_(entries), first_(free_.data()), last_(first_ + entries - 1),
      first_free_(first_), end_free_(first_), free_count_(entries), size_(entries),
      several_open_(open_splats > 1 || streams > 1), fill_(fill),
      write_ports_(std::size_t{1} * fill.ports.sram_banks * fill.ports.ports, 0),
      streams_(streams) {
    for (Stream& stream : streams_) {
        stream.splats.resize(std::min(open_splats, entries / streams));
        stream.first = stream.oldest = stream.next = stream.splats.data();
        stream.end = stream.first + stream.splats.size();
    }
    take_in_order();
}

// Puts all entries on the list of free ones, in the order of their numbers.
void FeatureBuffer::take_in_order() {
    std::uint16_t entry = 0;
    for (Free& place : free_) {
        place = {0, entry++};
    }
    first_free_ = end_free_ = first_;
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
