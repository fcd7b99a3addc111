// SPDX-License-Identifier: Apache-2.0
// A Packing Unit in the plainest code, see naive_bank.hpp.
#pragma once

#include <algorithm>
#include <vector>

#include "tests/modules/degs/scheduler/naive_facts.hpp"

namespace degs::test {

class NaivePacking {
public:
    NaivePacking(const NaiveFacts& facts, NaiveLines& lines) : facts_(facts), lines_(lines) {}
    void begin_cycle(Number now) {
        now_ = now;
        unwritten_ = std::max<Number>(0, unwritten_ - facts_.packets_per_cycle);
    }
    bool open() const { return tasks_ != 0; }
    /// Date at which the next task executes.
    Number next_slot() const { return next_slot(now_); }
    /// If it is packed at `now`, as far as it is known.
    Number next_slot(Number now) const { return std::max(now + facts_.packet_latency, slot_); }
    bool has_room(const NaiveSegment& segment, Number tasks) const {
        const Number width = facts_.packet_tasks;
        const Number total = (joins(segment) ? tasks_ : width) + tasks;
        const Number before = next_slot() - (now_ + facts_.packet_latency);
        const bool fits = before + (total + width - 1) / width <= facts_.packets_waiting;
        const bool written =
            unwritten_ == 0 || unwritten_ + total / width <= facts_.packets_per_cycle;
        return tasks == 0 || (fits && written);
    }
    /// Packs the tasks of a segment, at least one. Returns the date of the last one.
    Number pack(const NaiveSegment& segment) {
        if (!joins(segment)) {
            send();
        }
        Number last = 0;
        for (std::uint32_t rest = segment.mask; rest != 0;) {
            if (tasks_ == 0) {
                slot_ = next_slot();
            }
            std::uint32_t part = 0;
            for (; rest != 0 && tasks_ < facts_.packet_tasks; ++tasks_, rest &= rest - 1) {
                part |= rest & (~rest + 1);
            }
            runs_.push_back({segment, part});
            last = slot_;
            if (tasks_ == facts_.packet_tasks) {
                send();
            }
        }
        return last;
    }
    /// A packet that is not full goes at the last date at which it still comes in time.
    void send_due(Number now) {
        now_ = now;
        if (open() && slot_ - facts_.packet_latency <= now_) {
            send();
        }
    }
    /// An end of a tile travels with the open packet, one with each, or alone.
    void end_tile(Number tile, Number context) {
        if (open() && ends_) {
            send();
        }
        if (open()) {
            ends_ = true;
            end_ = {tile, context};
        } else {
            lines_.say(now_, "packet", {0, tile, context});
        }
    }

private:
    struct Run {
        NaiveSegment segment;
        std::uint32_t part;
    };
    bool joins(const NaiveSegment& segment) const {
        if (facts_.reorganisation != 0 || !open()) {
            return true;
        }
        const NaiveSegment& first = runs_.front().segment;
        return first.splat == segment.splat && first.row == segment.row &&
               first.tile == segment.tile;
    }
    void send() {
        std::vector<Number> packet{tasks_, ends_ ? end_[0] : -1, ends_ ? end_[1] : -1, slot_};
        for (const Run& run : runs_) {
            const NaiveSegment& s = run.segment;
            packet.insert(packet.end(), {s.tile, s.context, s.domain, s.splat, s.row, s.column,
                                         s.mask, run.part});
        }
        lines_.say(now_, "packet", packet);
        ++slot_;
        ++unwritten_;
        runs_.clear();
        tasks_ = 0;
        ends_ = false;
    }

    const NaiveFacts& facts_;
    NaiveLines& lines_;
    std::vector<Run> runs_; // of the open packet
    Number now_ = 0, tasks_ = 0, slot_ = 0, unwritten_ = 0;
    bool ends_ = false; // the open packet carries the end of a tile
    std::vector<Number> end_{0, 0};
};

} // namespace degs::test
