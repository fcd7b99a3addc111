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

SegmentQueue::SegmentQueue(int depth, int tiles_in_flight, int domains_per_tile)
    : domains_(domains_per_tile), words_((static_cast<std::size_t>(domains_per_tile) + 63) / 64),
      entries_(static_cast<std::size_t>(depth)),
      lists_(static_cast<std::size_t>(tiles_in_flight * domains_per_tile)),
      slots_(static_cast<std::size_t>(tiles_in_flight)) {
    for (Slot& slot : slots_) {
        slot.occupied.assign(words_, 0);
        slot.cooling.assign(words_, 0);
        slot.wheel.assign(words_ * kWheel, 0);
    }
    for (int i = depth - 1; i >= 0; --i) {
        entries_[static_cast<std::size_t>(i)].next = free_;
        free_ = i;
    }
}

void SegmentQueue::push(int slot, int domain, const Segment& segment) {
    const std::int32_t index = free_;
    Entry& entry = entries_[static_cast<std::size_t>(index)];
    free_ = entry.next;
    size_++;
    entry.segment = segment;
    entry.next = kNone;
    List& list = lists_[at(slot, domain)];
    Slot& tile = slots_[static_cast<std::size_t>(slot)];
    if (list.head == kNone) {
        list.head = index;
        list.head_sequence = segment.sequence;
        tile.occupied[word_of(domain)] |= bit_of(domain);
    } else {
        entries_[static_cast<std::size_t>(list.tail)].next = index;
    }
    list.tail = index;
    list.length++;
    tile.waiting++;
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
        list.head_sequence = head.segment.sequence;
        __builtin_prefetch(&entries_[static_cast<std::size_t>(std::max(head.next, 0))]);
    }
}

void SegmentQueue::set_ready_at(int slot, int domain, Cycle date) {
    Slot& tile = slots_[static_cast<std::size_t>(slot)];
    tile.cooling[word_of(domain)] |= bit_of(domain);
    tile.wheel[date % kWheel * words_ + word_of(domain)] |= bit_of(domain);
}

void SegmentQueue::turn_wheel(Slot& slot, Cycle date) const {
    if (date >= slot.turned + kWheel) {
        std::fill(slot.wheel.begin(), slot.wheel.end(), 0);
        std::fill(slot.cooling.begin(), slot.cooling.end(), 0);
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

int SegmentQueue::pick(int slot, Cycle date, DomainScan scan) {
    Slot& tile = slots_[static_cast<std::size_t>(slot)];
    turn_wheel(tile, date);
    if (scan == DomainScan::RoundRobin) {
        return pick_next(tile);
    }
    // Smallest key wins: arrival order, below (inverse) length where that comes first. Selected
    // without branches, which would be mispredicted half the time.
    const List* lists = &lists_[at(slot, 0)];
    const std::uint64_t by_length = scan == DomainScan::Deepest ? ~std::uint64_t{0} : 0;
    std::uint64_t best_key = ~std::uint64_t{0};
    int best = -1;
    for (std::size_t w = 0; w < words_; ++w) {
        for (std::uint64_t bits = ready(tile, w); bits != 0; bits &= bits - 1) {
            const int domain = static_cast<int>(w) * 64 + __builtin_ctzll(bits);
            const List& list = lists[domain];
            const std::uint64_t inverse_length = (~std::uint64_t{list.length} & 0xFFFFU) << 48;
            const std::uint64_t key = list.head_sequence | (inverse_length & by_length);
            best = key < best_key ? domain : best;
            best_key = key < best_key ? key : best_key;
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
    std::fill(tile.wheel.begin(), tile.wheel.end(), 0);
    std::fill(tile.cooling.begin(), tile.cooling.end(), 0);
    tile.cursor = 0;
}

} // namespace degs
