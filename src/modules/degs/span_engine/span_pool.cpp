// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/span_engine/span_pool.hpp"

#include <algorithm>
#include <stdexcept>
#include <string>

#include "modules/kit/job/row_map.hpp"
#include "tlm/has_process.hpp"

namespace degs {

SpanPool::SpanPool(const sc_core::sc_module_name& name, const Config& config, const Timebase& time,
                   const RenderJob& job, const Share& share)
    : SpanStage(name, config, job, std::size_t{1} * share.streams * share.lanes,
                share.streams * reachable(share.index, share.of, share.banks), share.streams),
      self_(time), share_(share), streams_(share.streams), free_from_(share.units, 0) {
    DEGS_HAS_PROCESS(SpanPool);
    SC_THREAD(run);
    self_.show(*this, stats_.busy, share.units);
}

void SpanPool::end_of_elaboration() {
    for (auto& port : in) {
        port->connect_reader(self_);
        Lane& lane = lanes_.emplace_back();
        lane.rows = &port.ring();
        lane.stream = &streams_[(lanes_.size() - 1) / share_.lanes];
    }
    const std::size_t ports = out.size() / streams_.size();
    for (std::size_t i = 0; i < out.size(); ++i) {
        streams_[i / ports].rings.push_back(&out[i].ring());
        out[i]->connect_writer(self_);
    }
    for (Stream& stream : streams_) {
        for (const std::size_t port :
             ports_of_rows(job_.tile_size, share_.index, share_.of, share_.banks)) {
            stream.ring_of_row.push_back(stream.rings[port]);
        }
    }
    for (Lane& lane : lanes_) {
        lane.ring_of_row = lane.stream->ring_of_row.data();
        lane.next = &lane == &lanes_.back() ? &lanes_.front() : &lane + 1;
    }
    next_lane_ = &lanes_.front();
    connect_reports(self_);
    watched_.reserve(lanes_.size());
}

void SpanPool::start_of_simulation() {
    SpanStage::start_of_simulation();
    if (log_ != nullptr) {
        log_->set("pool", 1);
        log_->set("module", share_.index);
        log_->set("modules", share_.of);
        log_->set("banks", share_.banks);
        log_->set("streams", share_.streams);
    }
}

const std::vector<std::unique_ptr<SpanReplay>>& SpanPool::hand_over(Process& bank) {
    const bool one_by_one = share_.units == 1 && share_.lanes == 1 && config_.rows_per_cycle == 1 &&
                            config_.cycles_per_row == 1;
    // Nobody but the bank and the Slicing Units may wait for what SpanTurns does.
    if (!one_by_one || out.size() != streams_.size() || config_.row_ports.limited() ||
        config_.reports_rows || !can_hand_over()) {
        return replays_;
    }
    std::vector<SpanReplay*> streams;
    for (std::size_t stream = 0; stream < streams_.size(); ++stream) {
        SpanStage::hand_over(stream, self_, bank);
        streams.push_back(replays_.back().get());
    }
    turns_ = std::make_unique<SpanTurns>(self_, streams, tiles_);
    return replays_;
}

void SpanPool::run() {
    if (turns_ != nullptr) {
        turns_->run();
        return;
    }
    while (!tiles_.over()) {
        waiting_ = false;
        for (Lane& lane : lanes_) {
            if (!lane.has_row) {
                look_at(lane);
            }
        }
        take_rows();
        self_.advance_to(tiles_.over() ? self_.local() : next_date());
    }
    self_.finish();
}

// True if the lane had a row whose bank has a place for its Span Vector. Inlined in the hot loop.
inline __attribute__((always_inline)) bool SpanPool::take_from(Lane& lane) {
    if (!lane.has_row && !lane.looked_at) {
        look_at(lane);
    }
    if (!lane.has_row) {
        return false;
    }
    if (config_.row_ports.limited() && !has_port(lane)) {
        ++stats_.row_port_waits;
        return false;
    }
    const RowItem& item = lane.rows->front();
    DatedFifo<SpanItem>& ring = *lane.ring_of_row[item.row];
    if (!ring.reserve_now(self_)) {
        waiting_ = true;
        return false;
    }
    ++lane.reads;
    lane.has_row = false;
    lane.looked_at = false;
    const bool covers = solve(item, ring.staged());
    lane.rows->drop(self_);
    report(self_, &lane - lanes_.data());
    if (covers) {
        ring.put_staged(self_);
    }
    return true;
}

// Takes rows for one unit from the lanes in turn. Returns how many.
inline __attribute__((always_inline)) int SpanPool::take_for_unit() {
    int taken = 0;
    const std::size_t lanes = lanes_.size();
    for (std::size_t untried = lanes; untried != 0;) { // since the last row
        Lane& lane = *next_lane_;
        next_lane_ = lane.next;
        if (!take_from(lane)) {
            --untried;
        } else if (++taken == config_.rows_per_cycle) {
            break;
        } else {
            untried = lanes;
        }
    }
    return taken;
}

// Every free unit takes up to rows_per_cycle rows.
void SpanPool::take_rows() {
    const Cycle now = self_.local();
    for (auto unit = free_from_.begin(); unit != free_from_.end(); ++unit) {
        if (*unit > now) {
            continue;
        }
        ends_passed_ = false;
        const std::uint64_t waits_before = stats_.row_port_waits;
        if (take_for_unit() != 0) {
            *unit = now + config_.cycles_per_row;
            stats_.busy += config_.cycles_per_row;
        } else if (!ends_passed_) {
            // The other free units find nothing, either, and wait for the same ports.
            const auto others = std::count_if(unit + 1, free_from_.end(),
                                              [now](Cycle from) { return from <= now; });
            stats_.row_port_waits += (stats_.row_port_waits - waits_before) * others;
            return;
        }
    }
}

// A lane does not run ahead of the other lanes of its stream: tiles end in all of them together.
// Ends cost no unit's time.
void SpanPool::look_at(Lane& lane) {
    lane.looked_at = true;
    const Stream& stream = *lane.stream;
    if (lane.turn != stream.turn) {
        if (stream.ending) {
            pass_end(lane);
        }
    } else if (self_.arrived(*lane.rows)) {
        lane.has_row = !lane.rows->front().end;
        if (!lane.has_row) {
            pass_end(lane);
        }
    }
}

// Takes an end of the lane, unless one of its stream has still to be sent, and sends what is
// complete.
void SpanPool::pass_end(Lane& lane) {
    Stream& stream = *lane.stream;
    if (!stream.ending) {
        const TileNumber tile = lane.rows->front().tile;
        lane.rows->drop(self_);
        ++lane.turn;
        ends_passed_ = true;
        if (++stream.ends == static_cast<std::size_t>(share_.lanes)) {
            stream.ends = 0;
            stream.ending = tile;
            stream.end_port = 0;
        }
    }
    if (!stream.ending) {
        return;
    }
    if (!send_end(stream)) {
        waiting_ = true;
        return;
    }
    ends_passed_ = true;
    for (Lane& other : lanes_) {
        other.looked_at = false;
    }
    lane.has_row = self_.arrived(*lane.rows) && !lane.rows->front().end;
}

// True if the lane can give another row in this cycle: it is an SRAM bank with so many read ports.
bool SpanPool::has_port(Lane& lane) {
    if (lane.read != self_.local()) {
        lane.read = self_.local();
        lane.reads = 0;
    }
    return lane.reads < config_.row_ports.ports;
}

// Sends the end of a tile to every bank that the module reaches. False if a bank has no place yet.
bool SpanPool::send_end(Stream& stream) {
    for (; stream.end_port < stream.rings.size(); ++stream.end_port) {
        DatedFifo<SpanItem>& ring = *stream.rings[stream.end_port];
        if (!ring.reserve_now(self_)) {
            return false;
        }
        SpanItem& end = ring.staged();
        end.tile = *stream.ending;
        end.span.reset();
        ring.put_staged(self_);
    }
    tiles_.count(*stream.ending);
    stream.ending.reset();
    ++stream.turn;
    return true;
}

// The next cycle in which there may be something to take. Ends of tiles do not wait for a unit, so
// it does not matter when one is free.
Cycle SpanPool::next_date() {
    const Cycle from = self_.local() + 1;
    if (waiting_) {
        return from;
    }
    watched_.clear();
    for (const Lane& lane : lanes_) {
        if (lane.turn == lane.stream->turn) {
            if (!lane.rows->empty() && lane.rows->head_date() <= from) {
                return from; // what else comes until then is asked at that date
            }
            watched_.push_back(lane.rows);
        }
    }
    const Cycle date = self_.next_arrival(watched_.data(), watched_.size(), from, kNever);
    if (date >= kNever) {
        throw std::logic_error(std::string(name()) + ": nothing left to wait for, but after " +
                               std::to_string(tiles_.tiles()) + " tiles there is another one");
    }
    return date;
}

} // namespace degs
