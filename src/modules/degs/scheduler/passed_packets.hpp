// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <vector>

#include "tlm/clock_domain.hpp"

namespace degs {

/// Counts packets that reach their array slice without the ring of the Packing Buffer, as that ring
/// would count them; see DatedFifo::Stats.
class PassedPackets {
public:
    std::uint64_t items() const { return items_; }
    Cycle empty_cycles() const { return ready_ - (items_ - ends_); }
    Cycle occupied_cycles() const { return occupied_cycles_; }
    std::size_t high_water() const { return high_water_; }

    /// Prepares for packets that would go through a ring of `depth` cells.
    void hold(std::size_t depth) {
        std::size_t size = 1;
        while (size <= depth) {
            size *= 2;
        }
        reads_.resize(size, kNever);
        mask_ = size - 1;
    }
    /// Counts a packet that leaves at `written` and executes at `slot`.
    __attribute__((always_inline)) void pass_packet(Cycle written, Cycle slot) {
        pass(written, slot);
        ready_ = slot + 1;
    }
    /// The end of a tile alone, which may be read from `date` on.
    Cycle pass_end(Cycle written, Cycle date) {
        const Cycle read = date > ready_ ? date : ready_;
        pass(written, read);
        ready_ = read;
        ++ends_;
        return read;
    }

private:
    __attribute__((always_inline)) void pass(Cycle written, Cycle read) {
        occupied_cycles_ += read - written;
        Cycle* const reads = reads_.data();
        // The mark rises by one where as many items as before it were still inside. The first item
        // raises it, because it asks for a cell that was never read.
        if (reads[(items_ - high_water_) & mask_] > written) {
            high_water_++;
        }
        reads[items_++ & mask_] = read;
    }

    std::vector<Cycle> reads_; // of the latest items, in their order
    std::size_t mask_ = 0;
    std::uint64_t items_ = 0, ends_ = 0; // of these, ends of tiles, which take no cycle
    Cycle ready_ = 0;                    // of the reader
    Cycle occupied_cycles_ = 0;
    std::size_t high_water_ = 0;
};

} // namespace degs
