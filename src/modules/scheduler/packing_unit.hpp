// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>

#include <systemc>

#include "config/config.hpp"
#include "config/statistics.hpp"
#include "modules/array/slot_recorder.hpp"
#include "modules/messages.hpp"
#include "modules/scheduler/packet_ports.hpp"
#include "splat/pixel_mask.hpp"
#include "tlm/dated_fifo.hpp"

namespace degs {

/// Compacts segments of varying length into packets as wide as its array slice and queues them in
/// the Packing Buffer (paper, Sec. IV-B: prefix sum and shift). A packet that is not full stays
/// open until the array wants it, so packing never costs the array a cycle.
///
/// The array executes one packet per cycle in order and never stalls, so the cycle in which a task
/// will execute is known when it is packed. The scoreboard of the Issue Bank works with those
/// dates, which keeps the reuse distance at the array also when queued packets drain back to back.
///
/// The unit has no process: the Issue Bank calls it in its own cycle.
class PackingUnit : public sc_core::sc_module {
public:
    struct Config {
        int width = 8;          ///< tasks per packet = PEs per array slice
        int latency_cycles = 2; ///< issue to execution, unloaded: pack, read the buffer
        int depth = 32;         ///< packets that wait in the Packing Buffer
        /// A packet may have tasks of different spans; false: of one span only, so that a segment of
        /// another span closes an open packet.
        bool reorganisation = true;
        /// A packet has no two tasks that want the same port of the Pixel or Feature Buffer in one
        /// cycle: a task that finds its port taken begins the next packet [assumed].
        PacketPorts::Config ports{};
    };
    struct Stats {
        std::uint64_t packets = 0, tasks = 0;
        void describe(StatsVisitor& v) const {
            v.count("packets", packets, "packets", "Packets handed to the array slices.");
        }
    };

    FifoPort<TaskPacket> out;

    PackingUnit(const sc_core::sc_module_name& name, const Config& config);
    /// Records empty slots in `part`, which may be null; before the simulation starts.
    void record(SlotPart* part) { part_ = part; }

    /// Execution date of the next task if it is packed at `now`.
    Cycle next_execution(Cycle now) const { return std::max(now + latency_, next_slot_); }
    /// True if there is room for `tasks` tasks of `run` more at `now`. Packets on their way through
    /// the pipeline, which are those that execute before now + latency, lie in its registers.
    bool room(Cycle now, const TaskRun& run, int tasks) const {
        return fits(now, tasks_ + tasks) &&
               (config_.reorganisation || joins(run) || fits(now, config_.width + tasks));
    }
    /// The same for the tasks `mask` with limited ports, where packets need not be full; `entry` of
    /// the Feature Buffer has the parameters of their splat.
    bool room_by_ports(Cycle now, const TaskRun& run, std::uint32_t mask, int entry) {
        return !ports_ || mask == 0 || fits_ports(now, run, mask, entry);
    }
    /// Packs those tasks of a segment that `mask` names, at least one; returns the execution date
    /// of the last one. `entry` as above.
    inline Cycle add(Process& bank, const TaskRun& run, std::uint32_t mask, int entry = 0);
    /// Sends the end of `tile`, which lies in `context` of the Pixel Buffer: the bank has nothing
    /// more for it.
    void end_tile(Process& bank, TileNumber tile, std::int16_t context);
    /// True if an open packet must go at `now`.
    bool due(Cycle now) const { return open_until_ <= now; }
    /// Hands over an open packet whose time has come, its empty slots accounted for by `cause`. Call
    /// it before the bank asks for its next date, because others rely on its doing nothing until then.
    void send_due(Process& bank, Idle cause);
    /// The cycles [bank.local(), until) are over for the bank; `until` may not lie beyond the date
    /// given by open_until(). Accounts for those in which the array gets nothing, by `cause`.
    void close_cycles(Process& bank, Cycle until, Idle cause);
    /// Latest date up to which the bank may sleep: an open packet has to go then. kNever if none.
    Cycle open_until() const { return open_until_; }
    /// True if close_cycles(bank, until, ...) would account for empty slots; otherwise
    /// its cause does not matter.
    bool leaves_slots(Cycle until) const {
        return !open() && started() && until + latency_ > next_slot_;
    }

    const Stats& stats() const { return stats_; }
    /// Slots between the first and the last packet that no task filled.
    const SlotAccount& idle() const { return idle_; }

private:
    void end_of_elaboration() override { ring_ = &out.ring(); }
    bool open() const { return tasks_ != 0; }
    bool started() const { return next_slot_ != 0; } // a packet has been sent or opened
    // ceil(tasks / width) packets fit, that which is open among them; without dividing.
    bool fits(Cycle now, int tasks) const {
        const Cycle queued = next_execution(now) - (now + latency_);
        return queued * width_ + tasks <= capacity_;
    }
    // Without reorganisation: `run` may go to the packet that is open, if any.
    bool joins(const TaskRun& run) const;
    [[gnu::noinline]] bool fits_ports(Cycle now, const TaskRun& run, std::uint32_t mask, int entry);
    [[gnu::noinline]] Cycle add_by_ports(Process& bank, const TaskRun& run, std::uint32_t mask,
                                         int entry);
    inline void put(const TaskRun& run, std::uint32_t mask, std::uint32_t part);
    inline void open_packet(Process& bank);
    inline void send(Process& bank, Idle cause);
    [[gnu::noinline]] void record_packet(const TaskPacket& packet, Idle cause);
    [[gnu::noinline]] void record_cycles(Process& bank, Cycle from, Cycle to, Idle cause);

    Config config_;
    Cycle latency_;
    Cycle width_, capacity_; // tasks: of a packet, of the Packing Buffer
    DatedFifo<TaskPacket>* ring_ = nullptr;
    // The open packet is filled in its cell of the ring.
    int tasks_ = 0;          // in the open packet; 0: none is open
    bool ends_tile_ = false; // the open packet carries the end of a tile
    // Execution date of the open packet; else the first that the next one may have. An open packet
    // goes before now + latency passes its date, so next_execution() need not ask which.
    Cycle next_slot_ = 0;
    Cycle open_until_ = kNever;
    std::optional<PacketPorts> ports_, trial_; // of the open packet, and of one that is tried
    SlotAccount idle_;
    SlotAccount since_last_; // idle after the last packet; counts once another one comes
    SlotPart* part_ = nullptr;
    std::array<TimeSeries*, 4> bank_states_{}; // of the bank's track, by Idle
    Stats stats_;
};

// What follows is inlined in the hot loop of the bank.
inline __attribute__((always_inline)) void PackingUnit::open_packet(Process& bank) {
    ring_->reserve(bank); // free by its dates; the host may not have emptied it yet
    const Cycle slot = next_execution(bank.local());
    if (slot > next_slot_) { // else nothing was idle
        idle_ += since_last_;
        since_last_ = SlotAccount{};
    }
    next_slot_ = slot;
    if (ports_) {
        ports_->clear();
    }
    open_until_ = slot - latency_;
    ring_->staged().run_count = 0;
    ends_tile_ = false;
}

inline __attribute__((always_inline)) void PackingUnit::send(Process& bank, Idle cause) {
    TaskPacket& packet = ring_->staged();
    packet.slot = next_slot_++;
    packet.tasks = tasks_;
    packet.ends_tile = ends_tile_;
    if (part_ != nullptr) {
        record_packet(packet, cause);
    }
    stats_.packets++;
    stats_.tasks += tasks_;
    idle_.idle(cause, config_.width - tasks_);
    tasks_ = 0;
    open_until_ = kNever;
    ends_tile_ = false;
    ring_->put_staged(bank);
}

// In the open packet; tasks_ counts them elsewhere.
inline void PackingUnit::put(const TaskRun& run, std::uint32_t mask, std::uint32_t part) {
    TaskPacket& packet = ring_->staged();
    TaskRun& packed = packet.runs[packet.run_count++];
    packed = run;
    packed.task.mask = mask;
    packed.part = part;
}

inline __attribute__((always_inline)) Cycle PackingUnit::add(Process& bank, const TaskRun& run,
                                                             std::uint32_t mask, int entry) {
    std::uint32_t left = mask;
    int count = __builtin_popcount(left);
    Cycle execution = 0;
    if (!config_.reorganisation && !joins(run)) {
        send(bank, Idle::Blocked);
    }
    if (ports_) {
        return add_by_ports(bank, run, mask, entry);
    }
    while (count != 0) {
        if (!open()) {
            open_packet(bank);
        }
        execution = next_slot_;
        const int taken = std::min(count, config_.width - tasks_);
        const std::uint32_t part = taken == count ? left : lowest_bits(left, taken);
        put(run, mask, part);
        left ^= part;
        count -= taken;
        tasks_ += taken;
        if (tasks_ == config_.width) {
            send(bank, Idle::Starved);
        }
    }
    return execution;
}

} // namespace degs
