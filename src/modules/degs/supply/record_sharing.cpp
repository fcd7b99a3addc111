// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/supply/record_sharing.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace degs {

RecordSharing::RecordSharing(const RenderJob& job, std::size_t fetchers, std::size_t window,
                             std::size_t cache)
    : job_(job), window_entries_(window), cache_records_(cache), windows_(fetchers) {}

const std::uint32_t* RecordSharing::splats(const SplatChunk& chunk) const {
    return job_.frames[frame_]->tile_splats.data() + chunk.first;
}

const std::vector<std::uint32_t>& RecordSharing::request(std::size_t fetcher,
                                                         const SplatChunk& chunk) {
    frame_ = job_.tiles[chunk.tile].frame;
    known_ = Completion();
    missed_.clear();
    Window& window = windows_[fetcher];
    if (window.tile != chunk.tile) {
        close_window(fetcher);
        window.tile = chunk.tile;
        window.next = window.end = chunk.first;
    }
    for (std::uint32_t i = 0; i < chunk.count; ++i) {
        leave(fetcher, splats(chunk)[i]);
        look_up(window, splats(chunk)[i]);
    }
    stats_.requested += chunk.count;
    move_window(fetcher, chunk);
    return missed_;
}

void RecordSharing::look_up(Window& window, std::uint32_t splat) {
    if (capture_used(window, splat)) {
        stats_.captured++;
    } else if (hit(splat)) {
        stats_.hits++;
    } else {
        missed_.push_back(splat);
        stats_.read++;
    }
}

bool RecordSharing::capture_used(Window& window, std::uint32_t splat) {
    const auto record = window.captured.find(splat);
    if (record == window.captured.end()) {
        return false;
    }
    known_ = latest(known_, record->second);
    window.captured.erase(record);
    return true;
}

bool RecordSharing::hit(std::uint32_t splat) {
    const auto place = places_.find(key_of(splat));
    if (place == places_.end()) {
        return false;
    }
    recent_.splice(recent_.begin(), recent_, place->second);
    known_ = latest(known_, recent_.front().there);
    return true;
}

// The fetcher asks for the record itself, or has captured it.
void RecordSharing::leave(std::size_t fetcher, std::uint32_t splat) {
    if (window_entries_ == 0) {
        return;
    }
    const auto [first, end] = listeners_.equal_range(key_of(splat));
    const auto own =
        std::find_if(first, end, [fetcher](const auto& entry) { return entry.second == fetcher; });
    if (own != end) {
        listeners_.erase(own);
    }
}

void RecordSharing::move_window(std::size_t fetcher, const SplatChunk& chunk) {
    if (chunk.last) {
        close_window(fetcher);
        return;
    }
    Window& window = windows_[fetcher];
    const JobTile& tile = job_.tiles[chunk.tile];
    window.next = chunk.first + chunk.count;
    window.end = std::max(window.end, window.next);
    const std::uint64_t end = std::min(window.next + window_entries_, tile.first + tile.count);
    for (; window.end < end; ++window.end) {
        const std::uint32_t splat = job_.frames[frame_]->tile_splats[window.end];
        listeners_.emplace(key_of(splat), fetcher);
    }
}

void RecordSharing::close_window(std::size_t fetcher) {
    Window& window = windows_[fetcher];
    if (window.tile == kNoTile) {
        return;
    }
    const std::uint32_t frame = frame_;
    frame_ = job_.tiles[window.tile].frame;
    for (std::uint64_t entry = window.next; entry < window.end; ++entry) {
        leave(fetcher, job_.frames[frame_]->tile_splats[entry]);
    }
    frame_ = frame;
    stats_.unused += window.captured.size();
    window = Window();
}

Completion RecordSharing::complete(const Completion& read) {
    for (const std::uint32_t splat : missed_) {
        const auto [first, end] = listeners_.equal_range(key_of(splat));
        for (auto listener = first; listener != end; ++listener) {
            windows_[listener->second].captured.emplace(splat, read);
        }
        listeners_.erase(first, end);
        keep(splat, read);
    }
    return latest(known_, read);
}

void RecordSharing::keep(std::uint32_t splat, const Completion& there) {
    if (cache_records_ == 0) {
        return;
    }
    stats_.cached++;
    const Record record{key_of(splat), there};
    if (recent_.size() < cache_records_) {
        recent_.push_front(record);
        places_[record.key] = recent_.begin();
        return;
    }
    // In the place of the one that was used least recently, so that nothing is allocated.
    auto place = places_.extract(recent_.back().key);
    recent_.splice(recent_.begin(), recent_, std::prev(recent_.end()));
    recent_.front() = record;
    place.key() = record.key;
    places_.insert(std::move(place));
}

} // namespace degs
