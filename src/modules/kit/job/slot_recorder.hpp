// SPDX-License-Identifier: Apache-2.0
// PE-cycles with their dates and tiles, for timelines and maps. A run without them has no recorder.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <functional>
#include <utility>
#include <vector>

#include "modules/kit/job/messages.hpp"
#include "modules/kit/job/slot_account.hpp"
#include "tlm/timeline.hpp"

namespace degs {

/// What the array did for one tile. Idle slots belong to the tile of the next task of the same part
/// of the array, those of a packet that is not full to the tile of its last task, and slots after
/// the last task of a part to that task's tile.
struct TileActivity {
    SlotAccount slots;
    ActiveWindow window; ///< first task to last task
    Cycle read_out = 0;  ///< the tile's last pixel had left the Pixel Buffer
};

class SlotRecorder;

/// A part of the array that has tasks of its own: a slice, a cluster, an engine.
class SlotPart {
public:
    SlotPart(SlotRecorder& recorder, int width) : recorder_(&recorder), width_(width) {}

    /// The part works on `tile` in the cycles [from, to).
    void work(TileNumber tile, Cycle from, Cycle to);
    /// `count` PE-cycles at a date, or evenly spread over the cycles [from, to).
    void add(Slot slot, TileNumber tile, Cycle date, std::uint64_t count);
    void add(Slot slot, TileNumber tile, Cycle from, Cycle to, std::uint64_t count);
    /// `count` PE-cycles that count only if another task follows, which decides their tile.
    void idle(Slot slot, Cycle from, Cycle to, std::uint64_t count) {
        pending_.push_back({slot, from, to, count});
    }
    void settle(TileNumber tile);
    void drop_pending() { pending_.clear(); }
    /// True if the timeline, if there is one, does not tell the cycles [from, to) apart.
    bool in_one_step(Cycle from, Cycle to) const;

private:
    friend class SlotRecorder;
    struct Pending {
        Slot slot;
        Cycle from, to;
        std::uint64_t count;
    };
    SlotRecorder* recorder_;
    std::uint64_t width_;
    ActiveWindow window_;
    TileNumber first_tile_ = 0, last_tile_ = 0;
    std::vector<Pending> pending_;
};

/// Where the slots of a run go besides their sums. It must outlive the engine.
class SlotRecorder {
public:
    /// `timeline` may be null.
    explicit SlotRecorder(Timeline* timeline);
    SlotRecorder(const SlotRecorder&) = delete;
    SlotRecorder& operator=(const SlotRecorder&) = delete;

    /// Adds a part of the array that has `width` PEs.
    SlotPart& add_part(int width) { return parts_.emplace_back(*this, width); }
    /// Calls `add` when the run is over, for what a block has still to add then.
    void at_close(std::function<void()> add) { last_additions_.push_back(std::move(add)); }
    void read_out(TileNumber tile, Cycle date) {
        TileActivity& activity = of(tile);
        activity.read_out = std::max(activity.read_out, date);
    }
    /// Adds what the parts missed of the window before their first and after their last task.
    void close();
    /// By tile number; tiles without any slot may be missing at the end.
    const std::vector<TileActivity>& tiles() const { return tiles_; }

private:
    friend class SlotPart;
    TileActivity& of(TileNumber tile) {
        if (tile >= tiles_.size()) {
            tiles_.resize(tile + 1);
        }
        return tiles_[tile];
    }

    const Timeline* timeline_;
    std::array<TimeSeries*, kSlotClasses.size()> series_{};
    std::deque<SlotPart> parts_;
    std::vector<TileActivity> tiles_;
    std::vector<std::function<void()>> last_additions_;
};

inline void SlotPart::add(Slot slot, TileNumber tile, Cycle date, std::uint64_t count) {
    const auto index = static_cast<std::size_t>(slot);
    recorder_->of(tile).slots[slot] += count;
    if (recorder_->series_[index] != nullptr) {
        recorder_->series_[index]->add(date, count);
    }
}

} // namespace degs
