// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "baselines/orange/gemm_batch.hpp"
#include "modules/kit/job/render_job.hpp"
#include "modules/kit/job/slot_account.hpp"

namespace degs::orange {

/// Pixels of a batch by what became of them; they add up to splats x pixels of a tile.
struct BatchOutcome {
    std::uint64_t useful = 0, boundary = 0, terminated = 0;
};

/// The multiplier-cycles of one systolic array. Every pixel of a splat is kGemmDepth of them, the
/// rest of a product is padding: multipliers that its shape leaves out, filling and draining.
class MacAccount {
public:
    /// `macs`: of the array.
    MacAccount(const RenderJob& job, int macs) : macs_(macs), part_(job.record_part(macs)) {}

    /// Products come in the order in which the array computed them.
    void add(const GemmBatch& batch, const BatchOutcome& outcome);

    const SlotAccount& slots() const { return slots_; }
    const ActiveWindow& window() const { return window_; }

private:
    void idle(Slot slot, TileNumber tile, Cycle from, Cycle to);

    std::uint64_t macs_;
    SlotPart* part_; // null if slots are not recorded
    SlotAccount slots_;
    ActiveWindow window_;
};

} // namespace degs::orange
