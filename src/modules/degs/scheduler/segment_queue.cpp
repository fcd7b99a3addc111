// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/scheduler/segment_queue.hpp"

#include <algorithm>

namespace degs {

SegmentQueue::SegmentQueue(int depth, int tiles_in_flight, int domains_per_tile, DomainScan scan,
                           int streams)
    : domains_(domains_per_tile), words_((domains_per_tile + 63) / 64), scan_(scan),
      entries_(depth), rings_(streams) {
    for (Ring& ring : rings_) {
        add_tiles(ring, tiles_in_flight);
    }
    for (int i = depth - 1; i >= 0; --i) {
        Entry& entry = entries_[i];
        entry.next = free_;
        free_ = &entry;
    }
}

void SegmentQueue::add_tiles(Ring& ring, std::size_t count) {
    const std::size_t sets = words_ * (3 + kWheel);
    const std::size_t domains = domains_;
    Block& block = blocks_.emplace_back();
    block.bits.resize(count * sets);
    block.keys.resize(count * domains);
    block.lists.resize(count * domains);
    for (std::size_t t = 0; t < count; ++t) {
        Tile& tile = ring.tiles.emplace_back();
        tile.lists_ = &block.lists[t * domains];
        tile.keys_ = &block.keys[t * domains];
        tile.occupied_ = &block.bits[t * sets];
        tile.cooling_ = tile.occupied_ + words_;
        tile.held_back_ = tile.occupied_ + 2 * words_;
        tile.wheel_ = tile.occupied_ + 3 * words_;
        clear_lists(tile);
    }
    ring.mask = ring.tiles.size() - 1;
}

// Tiles in flight go to where their turn says.
void SegmentQueue::double_tiles(Ring& ring, std::size_t oldest) {
    const std::size_t before = ring.tiles.size();
    add_tiles(ring, before);
    for (std::size_t turn = oldest; turn < oldest + before; ++turn) {
        Tile& home = ring.at(turn);
        Tile& from = ring.tiles[turn & (before - 1)];
        if (&home != &from) {
            std::swap(home, from);
        }
    }
}

Segment& SegmentQueue::push(Tile& tile, int domain, std::uint64_t sequence) {
    Entry& entry = *free_;
    free_ = entry.next;
    size_++;
    tile.waiting_++;
    entry.segment.sequence = sequence;
    entry.next = nullptr;
    List& list = tile.lists_[domain];
    *list.end = &entry;
    list.end = &entry.next;
    list.length++;
    if (scan_ != DomainScan::RoundRobin) {
        tile.keys_[domain] = key(list.head->segment.sequence, list.length);
    }
    tile.occupied_[word_of(domain)] |= bit_of(domain);
    return entry.segment;
}

void SegmentQueue::set_ready_at(Tile& tile, int domain, Cycle date) const {
    tile.cooling_[word_of(domain)] |= bit_of(domain);
    tile.wheel_[date % kWheel * words_ + word_of(domain)] |= bit_of(domain);
}

void SegmentQueue::release_all(Tile& tile) const {
    std::fill_n(tile.cooling_, words_, 0);
    std::fill_n(tile.wheel_, words_ * kWheel, 0);
}

int SegmentQueue::find(Tile& tile, Cycle date) const {
    return search(tile, date);
}

// The ready domain of the smallest key. Selected without branches, which would be
// mispredicted half the time.
int SegmentQueue::find_least(const Tile& tile) const {
    std::uint64_t best_key = ~std::uint64_t{0};
    int best = -1;
    for (std::size_t w = 0; w < words_; ++w) {
        for (std::uint64_t bits = tile.ready(w); bits != 0; bits &= bits - 1) {
            const int domain = first_of(w, bits);
            const std::uint64_t head_key = tile.keys_[domain];
            best = head_key < best_key ? domain : best;
            best_key = head_key < best_key ? head_key : best_key;
        }
    }
    return best;
}

Cycle SegmentQueue::next_ready(const Tile& tile) const {
    std::uint64_t waiting = 0;
    for (std::size_t w = 0; w < words_; ++w) {
        waiting |= tile.cooling_[w] & tile.occupied_[w];
    }
    if (waiting == 0) {
        return kNever;
    }
    Cycle date = tile.turned_ + 1;
    if (words_ == 1) {
        while ((tile.wheel_[date % kWheel] & waiting) == 0) {
            ++date;
        }
        return date;
    }
    for (;; ++date) {
        for (std::size_t w = 0; w < words_; ++w) {
            if ((tile.wheel_[date % kWheel * words_ + w] & tile.occupied_[w]) != 0) {
                return date;
            }
        }
    }
}

void SegmentQueue::clear_lists(Tile& tile) const {
    for (int d = 0; d < domains_; ++d) {
        tile.lists_[d] = List{};
        tile.lists_[d].end = &tile.lists_[d].head;
    }
}

void SegmentQueue::clear(Tile& tile) const {
    clear_lists(tile);
    release_all(tile);
    tile.cursor_ = 0;
    tile.number_ = kNoTile;
}

} // namespace degs
