// SPDX-License-Identifier: Apache-2.0
#include "modules/kit/job/slot_recorder.hpp"

namespace degs {
void SlotPart::work(TileNumber tile, Cycle from, Cycle to) {
    const ActiveWindow cycles{from, to - 1};
    if (window_.empty()) {
        first_tile_ = tile;
    }
    last_tile_ = tile;
    window_.include(cycles);
    recorder_->of(tile).window.include(cycles);
}

void SlotPart::add(Slot slot, TileNumber tile, Cycle from, Cycle to, std::uint64_t count) {
    if (count == 0) {
        return;
    }
    const auto index = static_cast<std::size_t>(slot);
    recorder_->of(tile).slots[slot] += count;
    if (recorder_->series_[index] != nullptr) {
        recorder_->series_[index]->add(from, to, count);
    }
}

bool SlotPart::in_one_step(Cycle from, Cycle to) const {
    const Timeline* const timeline = recorder_->timeline_;
    return timeline == nullptr || from / timeline->step() == (to - 1) / timeline->step();
}

void SlotPart::settle(TileNumber tile) {
    for (const Pending& p : pending_) {
        add(p.slot, tile, p.from, p.to, p.count);
    }
    pending_.clear();
}

SlotRecorder::SlotRecorder(Timeline* timeline) : timeline_(timeline) {
    for (std::size_t i = 0; i < kSlotClasses.size() && timeline != nullptr; ++i) {
        series_[i] = &timeline->series("slots", kSlotClasses[i].name);
    }
}

void SlotRecorder::close() {
    for (const auto& add : last_additions_) {
        add();
    }
    ActiveWindow all;
    TileNumber last_tile = 0;
    for (const SlotPart& part : parts_) {
        all.include(part.window_);
        last_tile = std::max(last_tile, part.last_tile_);
    }
    for (SlotPart& part : parts_) {
        if (all.empty()) {
            return;
        }
        const ActiveWindow own = part.window_;
        const Cycle end = all.last + 1;
        if (own.empty()) {
            part.add(Slot::Drain, last_tile, all.first, end, (end - all.first) * part.width_);
            continue;
        }
        part.add(Slot::Starved, part.first_tile_, all.first, own.first,
                 (own.first - all.first) * part.width_);
        part.add(Slot::Drain, part.last_tile_, own.last + 1, end,
                 (all.last - own.last) * part.width_);
    }
}

} // namespace degs
