// SPDX-License-Identifier: Apache-2.0
#include "modules/segment_queue.hpp"

#include <algorithm>

namespace degs {
namespace {

std::uint64_t bit_of(int domain) {
    return std::uint64_t{1} << (static_cast<unsigned>(domain) % 64U);
}
std::size_t word_of(int domain) {
    return static_cast<std::size_t>(domain) / 64;
}

} // namespace

SegmentQueue::SegmentQueue(int depth, int tiles_in_flight, int domains_per_tile, DomainScan scan)
    : domains_(domains_per_tile), words_((static_cast<std::size_t>(domains_per_tile) + 63) / 64),
      scan_(scan), by_length_(scan == DomainScan::Deepest ? ~std::uint64_t{0} : 0),
      bits_(static_cast<std::size_t>(tiles_in_flight) * words_ * (2 + kWheel)),
      keys_(static_cast<std::size_t>(tiles_in_flight * domains_per_tile)),
      entries_(static_cast<std::size_t>(depth)),
      lists_(static_cast<std::size_t>(tiles_in_flight * domains_per_tile)),
      slots_(static_cast<std::size_t>(tiles_in_flight)) {
    std::uint64_t* bits = bits_.data();
    for (Slot& slot : slots_) {
        slot.occupied = bits;
        slot.cooling = bits + words_;
        slot.wheel = bits + 2 * words_;
        bits += words_ * (2 + kWheel);
    }
    for (int i = depth - 1; i >= 0; --i) {
        entries_[static_cast<std::size_t>(i)].next = free_;
        free_ = i;
    }
}

Segment& SegmentQueue::push(int slot, int domain, std::uint64_t sequence) {
    const std::int32_t index = free_;
    Entry& entry = entries_[static_cast<std::size_t>(index)];
    free_ = entry.next;
    size_++;
    entry.segment.sequence = sequence;
    entry.next = kNone;
    List& list = lists_[at(slot, domain)];
    Slot& tile = slots_[static_cast<std::size_t>(slot)];
    std::uint64_t& head_key = keys_[at(slot, domain)];
    list.length++;
    tile.waiting++;
    if (list.head == kNone) {
        list.head = index;
        head_key = key(sequence, list.length);
        tile.occupied[word_of(domain)] |= bit_of(domain);
    } else {
        entries_[static_cast<std::size_t>(list.tail)].next = index;
        head_key = key(head_key & kSequence, list.length);
    }
    list.tail = index;
    return entry.segment;
}

void SegmentQueue::pop(int slot, int domain) {
    List& list = lists_[at(slot, domain)];
    Slot& tile = slots_[static_cast<std::size_t>(slot)];
    Entry& entry = entries_[static_cast<std::size_t>(list.head)];
    const std::int32_t second = entry.next;
    entry.next = free_;
    free_ = list.head;
    size_--;
    list.head = second;
    list.length--;
    tile.waiting--;
    if (list.head == kNone) {
        tile.occupied[word_of(domain)] &= ~bit_of(domain);
    } else {
        const Entry& head = entries_[static_cast<std::size_t>(list.head)];
        keys_[at(slot, domain)] = key(head.segment.sequence, list.length);
        __builtin_prefetch(&entries_[static_cast<std::size_t>(std::max(head.next, 0))]);
    }
}

void SegmentQueue::set_ready_at(int slot, int domain, Cycle date) {
    Slot& tile = slots_[static_cast<std::size_t>(slot)];
    tile.cooling[word_of(domain)] |= bit_of(domain);
    tile.wheel[date % kWheel * words_ + word_of(domain)] |= bit_of(domain);
}

void SegmentQueue::release_all(Slot& slot) const {
    std::fill_n(slot.cooling, words_, 0);
    std::fill_n(slot.wheel, words_ * kWheel, 0);
}

void SegmentQueue::turn_wheel(Slot& slot, Cycle date) const {
    if (date >= slot.turned + kWheel) {
        release_all(slot);
        slot.turned = date;
    }
    while (slot.turned < date) {
        ++slot.turned;
        for (std::size_t w = 0; w < words_; ++w) {
            std::uint64_t& released = slot.wheel[slot.turned % kWheel * words_ + w];
            slot.cooling[w] &= ~released;
            released = 0;
        }
    }
}

int SegmentQueue::pick(int slot, Cycle date) {
    Slot& tile = slots_[static_cast<std::size_t>(slot)];
    turn_wheel(tile, date);
    if (scan_ == DomainScan::RoundRobin) {
        return pick_next(tile);
    }
    // Selected without branches, which would be mispredicted half the time.
    const std::uint64_t* keys = &keys_[at(slot, 0)];
    std::uint64_t best_key = ~std::uint64_t{0};
    int best = -1;
    for (std::size_t w = 0; w < words_; ++w) {
        for (std::uint64_t bits = ready(tile, w); bits != 0; bits &= bits - 1) {
            const int domain = static_cast<int>(w) * 64 + __builtin_ctzll(bits);
            const std::uint64_t head_key = keys[domain];
            best = head_key < best_key ? domain : best;
            best_key = head_key < best_key ? head_key : best_key;
        }
    }
    return best;
}

// The first ready domain from the cursor on, round the end if need be.
int SegmentQueue::pick_next(Slot& slot) const {
    int domain = -1;
    if (words_ == 1) { // as a rule: then without a branch that depends on the data
        const auto cursor = static_cast<unsigned>(slot.cursor);
        const std::uint64_t bits = ready(slot, 0);
        if (bits == 0) {
            return -1;
        }
        const std::uint64_t rotated = bits >> cursor | bits << ((64 - cursor) % 64);
        domain = (__builtin_ctzll(rotated) + slot.cursor) % 64;
    } else {
        std::size_t w = word_of(slot.cursor);
        std::uint64_t bits = ready(slot, w) & ~(bit_of(slot.cursor) - 1);
        for (std::size_t step = 0; bits == 0 && step < words_; ++step) {
            w = w + 1 < words_ ? w + 1 : 0;
            bits = ready(slot, w); // last the cursor's word, where nothing is left above the cursor
        }
        if (bits == 0) {
            return -1;
        }
        domain = static_cast<int>(w) * 64 + __builtin_ctzll(bits);
    }
    slot.cursor = domain + 1 < domains_ ? domain + 1 : 0;
    return domain;
}

Cycle SegmentQueue::next_ready(int slot) const {
    const Slot& tile = slots_[static_cast<std::size_t>(slot)];
    std::uint64_t waiting = 0;
    for (std::size_t w = 0; w < words_; ++w) {
        waiting |= tile.cooling[w] & tile.occupied[w];
    }
    if (waiting == 0) {
        return kNever;
    }
    for (Cycle date = tile.turned + 1;; ++date) {
        for (std::size_t w = 0; w < words_; ++w) {
            if ((tile.wheel[date % kWheel * words_ + w] & tile.occupied[w]) != 0) {
                return date;
            }
        }
    }
}

void SegmentQueue::clear(int slot) {
    Slot& tile = slots_[static_cast<std::size_t>(slot)];
    for (int d = 0; d < domains_; ++d) {
        lists_[at(slot, d)] = List{};
    }
    release_all(tile);
    tile.cursor = 0;
}

} // namespace degs
