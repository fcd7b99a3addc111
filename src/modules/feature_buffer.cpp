// SPDX-License-Identifier: Apache-2.0
#include "modules/feature_buffer.hpp"

#include <algorithm>

namespace degs {

FeatureBuffer::FeatureBuffer(int entries) : entries_(static_cast<std::size_t>(entries)) {
    for (int i = entries - 1; i >= 0; --i) {
        free_.push_back(static_cast<std::uint16_t>(i));
    }
}

bool FeatureBuffer::admit(TileNumber tile, std::uint32_t splat, Cycle now) {
    if (has_current_ && entries_[current_].splat == splat && entries_[current_].tile == tile) {
        return true;
    }
    close(now);
    collect(now);
    if (free_.empty()) {
        waits_ += waiting_ ? 0 : 1;
        waiting_ = true;
        return false;
    }
    waiting_ = false;
    current_ = free_.back();
    free_.pop_back();
    entries_[current_] = {tile, splat, 0, now, true};
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
    retiring_.push_back({retiring_.empty() ? date : std::max(date, retiring_.back().date), entry});
}

void FeatureBuffer::collect(Cycle now) {
    while (!retiring_.empty() && retiring_.front().date <= now) {
        free_.push_back(retiring_.front().entry);
        retiring_.pop_front();
    }
}

} // namespace degs
