// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/span_engine/span_unit.hpp"

#include "modules/kit/job/row_map.hpp"
#include "tlm/has_process.hpp"

namespace degs {

SpanUnit::SpanUnit(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
                   const RenderJob& job, int index, int banks)
    : SpanStage(name, config, job, 1, reachable(index, config.count, banks), 1), index_(index),
      banks_(banks), self_(time),
      port_of_row_(ports_of_rows(job.tile_size, index, config.count, banks)) {
    DEGS_HAS_PROCESS(SpanUnit);
    if (self_.strict()) {
        SC_THREAD(run);
    }
    self_.show(*this, stats_.busy);
}

void SpanUnit::end_of_elaboration() {
    rows_ = &in[0].ring();
    rows_->connect_reader(self_);
    if (!self_.strict()) {
        self_.pump_with(*this, *rows_);
    }
    for (auto& port : out) {
        rings_.push_back(&port.ring());
        rings_.back()->connect_writer(self_);
    }
    connect_reports(self_);
}

void SpanUnit::start_of_simulation() {
    SpanStage::start_of_simulation();
    if (log_ != nullptr) {
        log_->set("pool", 0);
        log_->set("module", index_);
        log_->set("modules", config_.count);
        log_->set("banks", banks_);
        log_->set("streams", 1);
    }
}

const std::vector<std::unique_ptr<SpanReplay>>& SpanUnit::hand_over(Process& bank) {
    if (rings_.size() == 1 && can_hand_over()) {
        SpanStage::hand_over(0, self_, bank);
        self_.pump_with(*replays_.front(), replays_.front()->lane());
    }
    return replays_;
}

void SpanUnit::run() {
    while (!tiles_.over()) {
        rows_->wait_for_item(self_);
        pump();
    }
}

void SpanUnit::pump() {
    while ((!holding_ || deliver()) && !rows_->empty()) {
        take();
    }
}

// Solves a row in the cell that it will be sent in, or in held_ while there is none. Items are read
// and written in place: a copy of what was just written waits for the write.
void SpanUnit::take() {
    const RowItem& item = rows_->arrive(self_);
    if (item.end) {
        held_.tile = item.tile;
        rows_->drop(self_);
        held_.span.reset();
        next_port_ = 0;
        holding_ = true;
        return;
    }
    next_port_ = port_of_row_[item.row];
    DatedFifo<SpanItem>& ring = *rings_[next_port_];
    holding_ = ring.full();
    const bool covers = solve(item, holding_ ? held_ : ring.staged());
    rows_->drop(self_);
    report(self_, 0);
    if (!covers) {
        holding_ = false;
        self_.work(config_.cycles_per_row, stats_.busy);
    } else if (!holding_) {
        ring.reserve(self_);
        ring.put_staged(self_);
        self_.work(config_.cycles_per_row, stats_.busy);
    }
}

// Hands the held result over; false if a ring has no room yet (without a thread only).
bool SpanUnit::deliver() {
    while (holding_) {
        DatedFifo<SpanItem>& ring = *rings_[next_port_];
        if (ring.full() && !self_.strict()) {
            self_.hold_for(&ring);
            return false;
        }
        self_.hold_for(nullptr);
        ring.put(self_, held_);
        holding_ = !held_.span && ++next_port_ < rings_.size();
        if (held_.span) {
            self_.work(config_.cycles_per_row, stats_.busy);
        } else if (!holding_) {
            tiles_.count(held_.tile);
            if (tiles_.over()) {
                self_.finish();
            }
        }
    }
    return true;
}

} // namespace degs
