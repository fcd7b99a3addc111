// SPDX-License-Identifier: Apache-2.0
#include "baselines/gscore/chunk_inputs.hpp"

#include <stdexcept>
#include <string>

namespace degs::gscore {

TileNumber ChunkInputs::next_tile() {
    return granted_ ? next_granted() : next_of_job();
}

TileNumber ChunkInputs::next_granted() {
    DatedFifo<SplatChunk>& ring = ports_[0].ring();
    const Cycle ready = self_.local();
    wait_for(ring, kNever);
    ring.count_late(ready);
    const TileNumber tile = ring.front().tile;
    if (tile == kNoTile) {
        ring.drop(self_);
    }
    return tile;
}

// While no tile is there, what still comes for stopped ones is all there is to do.
TileNumber ChunkInputs::next_of_job() {
    if (!job_.lists(next_) && !job_.over(next_)) {
        wait_for_rest();
    }
    return job_.has_tile(self_, next_) ? next_++ : kNoTile;
}

void ChunkInputs::stop(TileNumber tile) {
    stopped_[ring_of(tile)] = true;
    ++stopped_count_;
}

bool ChunkInputs::wait_for(FifoBase& wanted, Cycle limit) {
    for (;;) {
        discard_arrived();
        const Cycle date = next_arrival(&wanted, limit);
        self_.advance_to(date);
        discard_arrived();
        if (date >= limit) {
            return false;
        }
        if (!wanted.empty() && wanted.head_date() <= date) {
            return true;
        }
    }
}

void ChunkInputs::wait_for_rest() {
    for (discard_arrived(); stopped_count_ != 0; discard_arrived()) {
        self_.advance_to(next_arrival(nullptr, kNever));
    }
}

// Each chunk is asked for anew: taking one does not make the next one certain.
void ChunkInputs::discard_arrived() {
    for (std::size_t i = 0; i < stopped_.size() && stopped_count_ != 0; ++i) {
        DatedFifo<SplatChunk>& ring = ports_[i].ring();
        while (stopped_[i] && self_.arrived(ring)) {
            discarded_ += ring.front().count;
            if (ring.front().last) {
                stopped_[i] = false;
                --stopped_count_;
            }
            ring.drop(self_);
        }
    }
}

Cycle ChunkInputs::next_arrival(FifoBase* wanted, Cycle limit) {
    watched_.clear();
    if (wanted != nullptr) {
        watched_.push_back(wanted);
    }
    for (std::size_t i = 0; i < stopped_.size() && stopped_count_ != 0; ++i) {
        FifoBase* const ring = &ports_[i].ring();
        if (stopped_[i] && ring != wanted) {
            watched_.push_back(ring);
        }
    }
    const Cycle date = self_.next_arrival(watched_.data(), watched_.size(), self_.local(), limit);
    if (date == kNever) {
        throw std::logic_error(std::string(watched_.front()->fifo_name()) +
                               ": an array waits for a ring that brings nothing more");
    }
    return date;
}

} // namespace degs::gscore
