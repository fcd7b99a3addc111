// SPDX-License-Identifier: Apache-2.0
#include "modules/feature_buffer.hpp"

#include <algorithm>

namespace degs {

FeatureBuffer::FeatureBuffer(int entries)
    : entries_(static_cast<std::size_t>(entries)), free_count_(entries_.size()) {
    for (int i = 0; i < entries; ++i) {
        free_.push_back({0, static_cast<std::uint16_t>(i)});
    }
}

bool FeatureBuffer::admit(TileNumber tile, std::uint32_t splat, Cycle now) {
    if (has_current_ && splat_ == splat && tile_ == tile) {
        return true;
    }
    close(now);
    if (next_free() > now) {
        waits_ += waiting_ ? 0 : 1;
        waiting_ = true;
        return false;
    }
    waiting_ = false;
    current_ = free_[first_free_].entry;
    first_free_ = next(first_free_);
    free_count_--;
    entries_[current_] = {0, now, true};
    tile_ = tile;
    splat_ = splat;
    has_current_ = true;
    return true;
}

void FeatureBuffer::release(std::uint16_t entry, Cycle date) {
    Entry& e = entries_[entry];
    e.pending--;
    e.needed_until = std::max(e.needed_until, date);
    if (e.pending == 0 && !e.open) {
        retire(entry, e.needed_until);
    }
}

void FeatureBuffer::close(Cycle now) {
    if (has_current_) {
        has_current_ = false;
        Entry& e = entries_[current_];
        e.open = false;
        if (e.pending == 0) {
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
