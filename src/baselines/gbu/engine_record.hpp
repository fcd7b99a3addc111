// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "modules/kit/job/slot_recorder.hpp"
#include "splat/pixels/data_path.hpp"

namespace degs::gbu {

/// The slots of a tile engine with their dates: its Row PEs run ahead of each other, so every one
/// has a date up to which its time is accounted for.
class EngineRecord {
public:
    /// `busy` is the engine's state in the timeline; null without one.
    EngineRecord(SlotPart* part, TimeSeries* busy, std::size_t pes)
        : part_(part), busy_(busy), accounted_(pes, kNever) {}

    /// Records that the engine had no tile in the cycles [from, to), because no context was free.
    void block(Cycle from, Cycle to) {
        if (part_ != nullptr) {
            blocked_.emplace_back(from, to);
        }
    }
    /// Records that a Row PE executes an entry in the cycles [from, to).
    void begin_entry(TileNumber tile, std::size_t pe, Cycle from, Cycle to);
    /// Records the pixels of the entry, one per cycle from `date` on.
    void pixels(TileNumber tile, Cycle date, const BlendOutcome& outcome);
    void end_probe(TileNumber tile, Cycle date);
    /// Records at the end of the run that some PEs had no work up to `end`, the engine's last slot.
    void close(TileNumber tile, Cycle end);

private:
    SlotPart* part_;
    TimeSeries* busy_;
    std::vector<Cycle> accounted_;                 // by Row PE; kNever: nothing executed so far
    std::vector<std::pair<Cycle, Cycle>> blocked_; // since the last slot
};

} // namespace degs::gbu
