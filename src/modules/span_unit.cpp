// SPDX-License-Identifier: Apache-2.0
#include "modules/span_unit.hpp"

#include "modules/row_map.hpp"

namespace degs {

void SpanUnit::Config::describe(ConfigVisitor& visitor) {
    visitor.integer("count", count, 1, 256, "units (paper Table II: 4, 8, 16, 32)");
    visitor.integer("cycles_per_row", cycles_per_row, 1, 64,
                    "cycles per scanline and unit [assumed]");
    visitor.integer("latency_cycles", latency_cycles, 1, 256,
                    "cycles from row item to Span Vector: dy, square, LUT, two sums [assumed]");
    visitor.integer("crossbar_depth", crossbar_depth, 1, 1024,
                    "Span Vectors buffered between a unit and a bank [assumed]");
}

SpanUnit::SpanUnit(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
                   const RenderJob& job, int index, int banks)
    : sc_core::sc_module(name), in("in"), out("out", reachable(index, config.count, banks)),
      config_(config), job_(job), self_(time) {
    std::vector<std::size_t> port_of_bank(static_cast<std::size_t>(banks), 0);
    std::size_t port = 0;
    for (int bank = 0; bank < banks; ++bank) {
        if (shares_row(index, config.count, bank, banks)) {
            port_of_bank[static_cast<std::size_t>(bank)] = port++;
        }
    }
    for (int row = 0; row < job.tile_size; ++row) {
        port_of_row_.push_back(port_of_bank[static_cast<std::size_t>(row % banks)]);
    }
    SC_HAS_PROCESS(SpanUnit);
    if (self_.strict()) {
        SC_THREAD(run);
    }
}

void SpanUnit::end_of_elaboration() {
    rows_ = in.operator->();
    rows_->connect_reader(self_);
    if (!self_.strict()) {
        self_.pump_with(*this, *rows_);
    }
    for (auto& port : out) {
        rings_.push_back(port.operator->());
        rings_.back()->connect_writer(self_);
    }
}

void SpanUnit::run() {
    while (tiles_done_ < job_.tiles.size()) {
        take(rows_->get(self_));
        deliver();
    }
}

void SpanUnit::pump() {
    while (deliver() && !rows_->empty()) {
        take(rows_->get(self_));
    }
}

// Solves a row; the result waits in held_.
void SpanUnit::take(const RowItem& item) {
    held_.tile = item.tile;
    held_.end = item.end;
    if (item.end) {
        next_port_ = 0;
        holding_ = true;
        return;
    }
    const JobTile& tile = job_.tiles[item.tile];
    stats_.rows++;
    stats_.busy += static_cast<Cycle>(config_.cycles_per_row);
    holding_ = job_.path->solve_row(item.splat, tile.y + item.row, tile.x, tile.x + tile.width,
                                    tile.y, held_.span);
    if (holding_) {
        stats_.spans++;
        stats_.tasks += static_cast<std::uint64_t>(held_.span.length);
        next_port_ = port_of_row_[static_cast<std::size_t>(item.row)];
    } else {
        stats_.empty_rows++;
        self_.advance(static_cast<Cycle>(config_.cycles_per_row));
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
        holding_ = held_.end && ++next_port_ < rings_.size();
        if (!held_.end) {
            self_.advance(static_cast<Cycle>(config_.cycles_per_row));
        } else if (!holding_ && ++tiles_done_ == job_.tiles.size()) {
            self_.finish();
        }
    }
    return true;
}

} // namespace degs
