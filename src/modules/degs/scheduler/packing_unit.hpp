// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>

#include <systemc>

#include "config/config.hpp"
#include "modules/degs/array/blending_array.hpp"
#include "modules/degs/scheduler/packet_ports.hpp"
#include "modules/degs/scheduler/passed_packets.hpp"
#include "modules/kit/job/messages.hpp"
#include "modules/kit/job/slot_recorder.hpp"
#include "splat/frame/pixel_mask.hpp"
#include "stats/statistics.hpp"
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
        int bytes = 32 * 1024; ///< of the Packing Buffer of all banks
        int task_bytes = 16;
        int lead_packets = 5;   ///< packets that may wait for the array slice
        int latency_cycles = 2; ///< issue to execution, unloaded: pack, read the buffer
        /// A packet may have tasks of different spans; false: of one span only, so that a segment of
        /// another span closes an open packet.
        bool reorganisation = true;
        SramPorts segment_ports; ///< of the waiting segments, which the Issue Bank keeps
        // What follows from the blocks around the unit; their own sections have the keys.
        int width = 8;  ///< tasks per packet = PEs per array slice
        int depth = 32; ///< packets that wait in the Packing Buffer
        /// A packet has no two tasks that want the same port of the Pixel or Feature Buffer in one
        /// cycle: a task that finds its port taken begins the next packet [assumed].
        PacketPorts::Config ports{};
        void describe(ConfigVisitor& visitor);
    };
    struct Stats {
        std::uint64_t packets = 0, tasks = 0;
        void describe(StatsVisitor& v) const {
            v.count("packets", packets, "packets", "Packets handed to the array slices.");
        }
    };

    FifoPort<TaskPacket> out;

    PackingUnit(const sc_core::sc_module_name& name, const Config& config);
    /// Tells `slice` what executes when, in place of packets: the tasks have been drawn; before the simulation starts.
    /// With a timeline, which shows the Packing Buffer, packets without tasks tell it.
    void tell(ArraySlice& slice, bool timeline) {
        slice_ = &slice;
        packets_ = timeline;
    }
    bool draws() const { return slice_ != nullptr; }
    /// The packets told without the ring.
    const PassedPackets& passed() const { return passed_; }
    /// Records empty slots in `part`, and the tasks if they have been drawn; it may be null; before the simulation
    /// starts.
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
    void send_due(Process& bank, Slot cause);
    /// The cycles [bank.local(), until) are over for the bank; `until` may not lie beyond the date
    /// given by open_until(). Accounts for those in which the array gets nothing, by `cause`.
    void close_cycles(Process& bank, Cycle until, Slot cause);
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
    friend class DrawnBank;
    void end_of_elaboration() override {
        ring_ = &out.ring();
        passed_.hold(ring_->depth());
    }
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
    inline Cycle add_drawn(Process& bank, const TaskRun& run, std::uint32_t mask, int count);
    [[gnu::noinline]] Cycle add_recorded(Process& bank, const TaskRun& run, std::uint32_t mask,
                                         int entry);
    void record_tasks(const TaskRun& run, std::uint32_t part);
    [[gnu::noinline]] void record_packet(Slot cause);
    [[gnu::noinline]] void tell_end(Cycle slot, bool packet);
    void join(const TaskRun& run);
    inline void open_packet(Process& bank);
    inline void send(Process& bank, Slot cause);
    [[gnu::noinline]] void record_packet(const TaskPacket& packet, Slot cause);
    [[gnu::noinline]] void record_cycles(Process& bank, Cycle from, Cycle to, Slot cause);

    Config config_;
    Cycle latency_;
    Cycle width_, capacity_; // tasks: of a packet, of the Packing Buffer
    DatedFifo<TaskPacket>* ring_ = nullptr;
    ArraySlice* slice_ =
        nullptr;          // executes drawn tasks without packets; nullptr: packets go to the ring
    bool packets_ = true; // go through the ring
    PassedPackets passed_;
    // The open packet is filled in its cell of the ring.
    int tasks_ = 0;          // in the open packet; 0: none is open
    bool ends_tile_ = false; // the open packet carries the end of a tile
    TileNumber ended_tile_ = 0;
    std::int16_t ended_context_ = 0;
    // The span of the open packet's first task.
    std::uint32_t first_splat_ = 0;
    std::int16_t first_row_ = 0;
    TileNumber first_tile_ = 0;
    TileNumber latest_tile_ = 0; // of the latest task, if tasks are recorded here
    // Execution date of the open packet; else the first that the next one may have. An open packet
    // goes before now + latency passes its date, so next_execution() need not ask which.
    Cycle next_slot_ = 0;
    Cycle open_until_ = kNever;
    std::optional<PacketPorts> ports_, trial_; // of the open packet, and of one that is tried
    SlotAccount idle_;
    SlotAccount since_last_; // idle after the last packet; counts once another one comes
    SlotPart* part_ = nullptr;
    std::array<TimeSeries*, kSlotClasses.size()> bank_states_{}; // of the bank's track
    Stats stats_;
};

// What follows is inlined in the hot loop of the bank.
inline __attribute__((always_inline)) void PackingUnit::open_packet(Process& bank) {
    if (packets_) {
        ring_->reserve(bank); // free by its dates; the host may not have emptied it yet
        ring_->staged().run_count = 0;
    }
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
    ends_tile_ = false;
}

inline __attribute__((always_inline)) void PackingUnit::send(Process& bank, Slot cause) {
    const Cycle slot = next_slot_++;
    const bool ends = ends_tile_;
    stats_.packets++;
    stats_.tasks += tasks_;
    idle_[cause] += config_.width - tasks_;
    open_until_ = kNever;
    ends_tile_ = false;
    if (draws() && part_ != nullptr) {
        record_packet(cause);
    }
    if (!packets_) {
        tasks_ = 0;
        passed_.pass_packet(bank.local(), slot);
        if (ends) {
            tell_end(slot, true);
        } else {
            slice_->pass_packet(slot);
        }
        return;
    }
    TaskPacket& packet = ring_->staged();
    packet.slot = slot;
    packet.tasks = tasks_;
    packet.ends_tile = ends;
    packet.ended_tile = ended_tile_;
    packet.ended_context = ended_context_;
    if (part_ != nullptr && !draws()) {
        record_packet(packet, cause);
    }
    tasks_ = 0;
    ring_->put_staged(bank);
}

// Without reorganisation the open packet has to know whose tasks it has.
inline void PackingUnit::join(const TaskRun& run) {
    if (!config_.reorganisation && !open()) {
        first_splat_ = run.task.splat;
        first_row_ = run.task.row;
        first_tile_ = run.tile;
    }
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
        send(bank, Slot::Blocked);
    }
    if (draws() && part_ != nullptr) {
        return add_recorded(bank, run, mask, entry);
    }
    if (ports_) {
        return add_by_ports(bank, run, mask, entry);
    }
    if (draws()) {
        return add_drawn(bank, run, mask, count);
    }
    while (count != 0) {
        if (!open()) {
            open_packet(bank);
        }
        join(run);
        execution = next_slot_;
        const int taken = std::min(count, config_.width - tasks_);
        const std::uint32_t part = taken == count ? left : lowest_bits(left, taken);
        put(run, mask, part);
        left ^= part;
        count -= taken;
        tasks_ += taken;
        if (tasks_ == config_.width) {
            send(bank, Slot::Starved);
        }
    }
    return execution;
}

// Where a part ends matters only if a pixel ends with one of its tasks.
inline __attribute__((always_inline)) Cycle
PackingUnit::add_drawn(Process& bank, const TaskRun& run, std::uint32_t mask, int count) {
    std::uint32_t ended = mask & run.drawn.ended;
    std::uint32_t left = mask;
    Cycle first = 0;
    Cycle execution = 0;
    while (count != 0) {
        if (!open()) {
            open_packet(bank);
        }
        join(run);
        execution = next_slot_;
        first = first == 0 ? execution : first;
        const int taken = std::min(count, config_.width - tasks_);
        if (ended != 0) {
            const std::uint32_t part = taken == count ? left : lowest_bits(left, taken);
            left ^= part;
            if ((ended & part) != 0) {
                slice_->end_drawn(run, ended & part, execution);
                ended &= ~part;
            }
        }
        count -= taken;
        tasks_ += taken;
        if (tasks_ == config_.width) {
            send(bank, Slot::Starved);
        }
    }
    slice_->execute(run, mask, first, execution);
    return execution;
}

} // namespace degs
