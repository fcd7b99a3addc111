// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

#include "modules/kit/job/slot_account.hpp"
#include "splat/frame/pixel_mask.hpp"
#include "tlm/clock_domain.hpp"

namespace degs {

/// The packet that tasks go to next, and the date at which the array slice executes it: the
/// arithmetic of the Packing Unit over plain data. What becomes of the tasks is up to a sink, a
/// class with
///     end_idle()                    the array has had nothing to do before the next packet
///     begin()                       another packet begins
///     take(left, count, room, slot) moves some of the tasks `left`, which are `count`, into the
///         packet that executes at `slot` and has room for `room`; returns their number
///     send(cause) sends the packet by calling sent(); `cause` is that of its empty slots
class OpenPacket {
public:
    /// `depth`: packets that wait in the Packing Buffer. `latency`: cycles from issue to execution.
    /// `writes`: packets that are written to the Packing Buffer per cycle.
    OpenPacket(int width, int latency, int depth, int writes)
        : latency_(latency), width_(width), capacity_(Cycle{1} * width * depth), writes_(writes),
          most_(Cycle{1} * width * (writes + 1)) {}

    bool open() const { return tasks_ != 0; }
    int tasks() const { return tasks_; }
    int room() const { return width_ - tasks_; }
    int width() const { return width_; }
    Cycle latency() const { return latency_; }
    /// Execution date of the open packet; else the first that the next one may have. An open packet
    /// goes before now + latency passes its date, so next_execution() need not ask which.
    Cycle slot() const { return slot_; }
    /// Execution date of the next task if it is packed at `now`.
    Cycle next_execution(Cycle now) const { return std::max(now + latency_, slot_); }
    /// True if the Packing Buffer has room for `tasks` tasks more at `now`, the first of which
    /// executes at `slot`: for ceil(tasks / width) packets, that which is open among them. It does
    /// not divide.
    bool fits(Cycle now, Cycle slot, int tasks) const {
        return (slot - (now + latency_)) * width_ + (tasks_ + tasks) <= capacity_;
    }
    /// Complete packets that have not been written before `now`.
    Cycle unwritten(Cycle now) const {
        const Cycle first = now * writes_;
        return next_write_ <= first ? 0 : next_write_ - first;
    }
    /// True if `complete` packets more can be written at `now`, or if no complete packet waits to
    /// be written: those that are left follow in the next cycles, in time, because packets execute
    /// one per cycle.
    bool can_write_packets(Cycle now, Cycle complete) const {
        const Cycle waiting = unwritten(now);
        return waiting == 0 || waiting + complete <= writes_;
    }
    /// Like can_write_packets(), for the packets that `tasks` tasks more complete. It does not
    /// divide.
    bool can_write(Cycle now, int tasks) const {
        const Cycle waiting = unwritten(now);
        return waiting == 0 || waiting * width_ + (tasks_ + tasks) < most_;
    }
    /// The latest date up to which the bank may sleep, because an open packet has to go then;
    /// kNever if no packet is open.
    Cycle open_until() const { return open() ? slot_ - latency_ : kNever; }
    bool due(Cycle now) const { return open() && slot_ - latency_ <= now; }
    /// True if the slice gets nothing in some of the cycles up to `until`.
    bool leaves_slots(Cycle until) const {
        return !open() && slot_ != 0 && until + latency_ > slot_; // a packet has been sent
    }
    /// Task slots that the slice leaves empty up to `until`, if it is `now`.
    Cycle left_slots(Cycle now, Cycle until) const {
        return (until + latency_ - next_execution(now)) * width_;
    }

    /// Fills packets with the tasks `mask`, which are `count`, at least one. Returns the execution
    /// date of the last one.
    template <class Sink>
    inline Cycle pack(Cycle now, std::uint32_t mask, int count, Sink& sink);
    /// Sends the open packet at `now`. Returns the date at which it executes.
    Cycle sent(Cycle now) {
        tasks_ = 0;
        next_write_ = std::max(next_write_, now * writes_) + 1;
        return slot_++;
    }

private:
    Cycle slot_ = 0;
    int tasks_ = 0; // 0: no packet is open
    Cycle latency_;
    int width_;
    Cycle capacity_;
    Cycle writes_; // per cycle
    Cycle next_write_ =
        0;       // the first that is free; cycle t has `writes_` of them from t * writes_ on
    Cycle most_; // tasks beyond which more than these packets are complete
};

// Inlined in the hot loop of the bank.
template <class Sink>
inline __attribute__((always_inline)) Cycle OpenPacket::pack(Cycle now, std::uint32_t mask,
                                                             int count, Sink& sink) {
    std::uint32_t left = mask;
    if (!open()) {
        const Cycle slot = next_execution(now);
        if (slot > slot_) {
            sink.end_idle();
        }
        slot_ = slot;
        sink.begin();
    }
    for (;;) {
        const Cycle execution = slot_;
        const int taken = sink.take(left, count, room(), execution);
        tasks_ += taken;
        count -= taken;
        const bool full = tasks_ == width_;
        if (!full && count == 0) {
            return execution;
        }
        sink.send(full ? Slot::Starved : Slot::Ports);
        if (count == 0) {
            return execution;
        }
        sink.begin(); // the next packet follows in the next cycle
    }
}

/// Moves `most` of the tasks `left`, which are `count`, the lowest first; returns them.
inline std::uint32_t take_lowest(std::uint32_t& left, int count, int most) {
    const std::uint32_t part = count <= most ? left : lowest_bits(left, most);
    left ^= part;
    return part;
}

} // namespace degs
