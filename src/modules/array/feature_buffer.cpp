// SPDX-License-Identifier: Apache-2.0
#include "modules/array/feature_buffer.hpp"

#include <algorithm>

namespace degs {

FeatureBuffer::FeatureBuffer(int entries)
    : entries_(entries), free_(entries), free_count_(entries_.size()) {
    std::uint16_t entry = 0;
    for (Free& place : free_) {
        place = {0, entry++};
    }
}

bool FeatureBuffer::enter(std::uint64_t splat, Cycle now) {
    close(now);
    if (next_free() > now) {
        stats_.waits += waiting_ ? 0 : 1;
        waiting_ = true;
        return false;
    }
    waiting_ = false;
    current_ = free_[first_free_].entry;
    first_free_ = next(first_free_);
    free_count_--;
    entries_[current_] = {now, 1};
    current_key_ = splat;
    return true;
}

void FeatureBuffer::close(Cycle now) {
    if (current_key_ != kNobody) {
        current_key_ = kNobody;
        Entry& e = entries_[current_];
        if (--e.held == 0) {
            retire(current_, std::max(now, e.needed_until));
        }
    }
}

void FeatureBuffer::retire(std::uint16_t entry, Cycle date) {
    last_retired_ = std::max(last_retired_, date);
    free_[end_free_] = {last_retired_, entry};
    end_free_ = next(end_free_);
    free_count_++;
}

} // namespace degs
