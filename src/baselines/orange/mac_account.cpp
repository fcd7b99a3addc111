// SPDX-License-Identifier: Apache-2.0
#include "baselines/orange/mac_account.hpp"

#include "splat/pixels/exponent_gemm.hpp"

namespace degs::orange {

void MacAccount::add(const GemmBatch& batch, const BatchOutcome& outcome) {
    if (batch.begin == batch.end) {
        return;
    }
    if (!window_.empty()) {
        const Cycle blocked_from = batch.begin - batch.blocked;
        idle(Slot::Starved, batch.tile, batch.idle_from, blocked_from);
        idle(Slot::Blocked, batch.tile, blocked_from, batch.begin);
    }
    SlotAccount work;
    work[Slot::Useful] = kGemmDepth * outcome.useful;
    work[Slot::Boundary] = kGemmDepth * outcome.boundary;
    work[Slot::Terminated] = kGemmDepth * outcome.terminated;
    work[Slot::Padding] = (batch.end - batch.begin) * macs_ - work.executed();
    slots_ += work;
    window_.include(ActiveWindow{batch.begin, batch.end - 1});
    if (part_ != nullptr) {
        part_->work(batch.tile, batch.begin, batch.end);
        part_->add(Slot::Useful, batch.tile, batch.begin, batch.end, work[Slot::Useful]);
        part_->add(Slot::Boundary, batch.tile, batch.begin, batch.end, work[Slot::Boundary]);
        part_->add(Slot::Terminated, batch.tile, batch.begin, batch.end, work[Slot::Terminated]);
        part_->add(Slot::Padding, batch.tile, batch.begin, batch.end, work[Slot::Padding]);
    }
}

void MacAccount::idle(Slot slot, TileNumber tile, Cycle from, Cycle to) {
    const std::uint64_t count = (to - from) * macs_;
    (slot == Slot::Blocked ? slots_[Slot::Blocked] : slots_[Slot::Starved]) += count;
    if (part_ != nullptr) {
        part_->add(slot, tile, from, to, count);
    }
}

} // namespace degs::orange
