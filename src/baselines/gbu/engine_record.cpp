// SPDX-License-Identifier: Apache-2.0
#include "baselines/gbu/engine_record.hpp"

#include <algorithm>

namespace degs::gbu {

void EngineRecord::begin_entry(TileNumber tile, std::size_t pe, Cycle from, Cycle to) {
    if (busy_ != nullptr) {
        busy_->add(from, to, to - from);
    }
    if (part_ == nullptr) {
        return;
    }
    part_->work(tile, from, to);
    if (accounted_.front() == kNever) {
        std::fill(accounted_.begin(), accounted_.end(), from);
    }
    for (const auto& [first, last] : blocked_) {
        for (Cycle& accounted : accounted_) {
            part_->add(Slot::Starved, tile, accounted, first, first - accounted);
            part_->add(Slot::Blocked, tile, first, last, last - first);
            accounted = last;
        }
    }
    blocked_.clear();
    part_->add(Slot::Starved, tile, accounted_[pe], from, from - accounted_[pe]);
    accounted_[pe] = to;
}

void EngineRecord::pixels(TileNumber tile, Cycle date, const BlendOutcome& outcome) {
    if (part_ == nullptr) {
        return;
    }
    const std::uint32_t all = outcome.useful | outcome.boundary | outcome.terminated;
    const bool together = all != 0 && part_->in_one_step(date, date + 32 - __builtin_clz(all));
    const auto add = [&](Slot slot, std::uint32_t mask) {
        if (together && mask != 0) {
            part_->add(slot, tile, date, __builtin_popcount(mask));
            return;
        }
        for (; mask != 0; mask &= mask - 1) {
            part_->add(slot, tile, date + __builtin_ctz(mask), 1);
        }
    };
    add(Slot::Useful, outcome.useful);
    add(Slot::Boundary, outcome.boundary);
    add(Slot::Terminated, outcome.terminated);
}

void EngineRecord::end_probe(TileNumber tile, Cycle date) {
    if (part_ != nullptr) {
        part_->add(Slot::Boundary, tile, date, 1);
    }
}

void EngineRecord::close(TileNumber tile, Cycle end) {
    for (Cycle& accounted : accounted_) {
        if (accounted < end) {
            part_->add(Slot::Starved, tile, accounted, end, end - accounted);
        }
    }
}

} // namespace degs::gbu
