// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <optional>

#include <systemc>

#include "config/config.hpp"
#include "modules/degs/array/blending_array.hpp"
#include "modules/degs/scheduler/open_packet.hpp"
#include "modules/degs/scheduler/packet_ports.hpp"
#include "modules/degs/scheduler/passed_packets.hpp"
#include "modules/kit/job/message_rings.hpp"
#include "modules/kit/job/slot_recorder.hpp"
#include "stats/statistics.hpp"

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
        int lead_packets = 5;      ///< packets that may wait for the array slice
        int latency_cycles = 2;    ///< issue to execution, unloaded: pack, read the buffer
        int packets_per_cycle = 1; ///< written to the Packing Buffer
        /// A packet may have tasks of different spans; false: of one span only, so that a segment
        /// of another span closes an open packet.
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
    /// Tells `slice` what executes when in place of sending packets, because a FunctionalModel has
    /// found the outcomes of the tasks; before the simulation starts. With a timeline, which shows
    /// the Packing Buffer, packets without tasks go through the ring and tell it.
    void tell(ArraySlice& slice, bool timeline) {
        slice_ = &slice;
        packets_ = timeline;
    }
    bool replays() const { return slice_ != nullptr; }
    ArraySlice* slice() const { return slice_; }
    const Config& config() const { return config_; }
    /// The packets that the slice was told of without the ring.
    const PassedPackets& passed() const { return passed_; }
    /// Records empty slots in `part`, which may be null, and the tasks if they are replayed; before
    /// the simulation starts.
    void record(SlotPart* part) { part_ = part; }

    /// True if there is room for `tasks` tasks of `run` more at `now`, and if the packets that they
    /// complete can be written. Packets on their way through the pipeline, which are those that
    /// execute before now + latency, lie in its registers.
    bool room(Cycle now, const TaskRun& run, int tasks) const {
        const int closed = config_.reorganisation || joins(run) ? 0 : packet_.room();
        return tasks == 0 || (packet_.fits(now, packet_.next_execution(now), closed + tasks) &&
                              packet_.can_write(now, closed + tasks));
    }
    /// True if there is room for the tasks `mask` with limited ports, where packets need not be
    /// full; `entry` of the Feature Buffer has the parameters of their splat.
    bool room_by_ports(Cycle now, const TaskRun& run, std::uint32_t mask, int entry) {
        return !ports_ || mask == 0 || fits_ports(now, run, mask, entry);
    }
    /// Packs those tasks of a segment that `mask` names, at least one; returns the execution date
    /// of the last one. `entry` as above.
    inline Cycle add(Process& bank, const TaskRun& run, std::uint32_t mask, int entry = 0);
    /// Sends the end of `tile`, which lies in `context` of the Pixel Buffer: the bank has nothing
    /// more for it.
    void end_tile(Process& bank, TileNumber tile, std::int16_t context);
    /// Hands over an open packet whose time has come, its empty slots accounted for by `cause`.
    /// Call it before the bank asks for its next date, because others rely on its doing nothing
    /// until then.
    void send_due(Process& bank, Slot cause);
    /// The cycles [bank.local(), until) are over for the bank; `until` may not lie beyond the date
    /// given by OpenPacket::open_until(). Accounts for those in which the array gets nothing, by
    /// `cause`.
    inline void close_cycles(Process& bank, Cycle until, Slot cause);
    /// The packet that tasks go to next, with its dates.
    OpenPacket& packet() { return packet_; }

    // For a bank that counts the tasks in packets by itself, in place of room() and add().
    /// True if packets need only be counted: their tasks are replayed, nobody records them, and
    /// nothing but the width limits a packet.
    bool counts() const { return replays() && !packets_ && !picky() && config_.reorganisation; }
    /// Hands over the open packet, which leaves the bank at `now`.
    inline void send_counted(Cycle now);
    /// Counts the slots that have stayed empty since the last packet, because another one comes.
    void end_idle() {
        if (idle_pending_) {
            settle_idle();
        }
    }

    const Stats& stats() const { return stats_; }
    /// Slots between the first and the last packet that no task filled.
    const SlotAccount& idle() const { return idle_; }

private:
    class Sink;
    class RingSink;
    class PickySink;

    void end_of_elaboration() override {
        ring_ = &out.ring();
        passed_.hold(ring_->depth());
    }
    bool records_replay() const { return replays() && part_ != nullptr; }
    // True if tasks have to be looked at before they go into a packet.
    bool picky() const { return ports_.has_value() || records_replay(); }
    // Without reorganisation: `run` may go to the packet that is open, if any.
    bool joins(const TaskRun& run) const;
    [[gnu::noinline]] bool fits_ports(Cycle now, const TaskRun& run, std::uint32_t mask, int entry);
    [[gnu::noinline]] Cycle add_picky(Process& bank, const TaskRun& run, std::uint32_t mask,
                                      int entry);
    inline void put(const TaskRun& run, std::uint32_t mask, std::uint32_t part);
    void record_tasks(const TaskRun& run, std::uint32_t part);
    [[gnu::noinline]] void record_packet(Slot cause);
    [[gnu::noinline]] void tell_end(Cycle slot, bool packet);
    [[gnu::noinline]] void separate(Process& bank, const TaskRun& run);
    inline void begin_packet(Process& bank);
    inline void pass_packet(Cycle now, Cycle slot, int tasks, bool ends_tile);
    [[gnu::noinline]] void settle_idle();
    inline void send_packet(Process& bank, Slot cause);
    [[gnu::noinline]] void send(Process& bank, Slot cause);
    [[gnu::noinline]] void record_packet(const TaskPacket& packet, Slot cause);
    [[gnu::noinline]] void record_cycles(Process& bank, Cycle from, Cycle to, Slot cause);

    Config config_;
    DatedFifo<TaskPacket>* ring_ = nullptr;
    ArraySlice* slice_ =
        nullptr; // executes replayed tasks without packets; nullptr: packets go to the ring
    bool packets_ = true; // packets go through the ring
    PassedPackets passed_;
    OpenPacket packet_;      // is filled in its cell of the ring
    bool ends_tile_ = false; // it carries the end of a tile
    TileNumber ended_tile_ = 0;
    std::int16_t ended_context_ = 0;
    // The span of the open packet's first task.
    std::uint32_t first_splat_ = 0;
    std::int16_t first_row_ = 0;
    TileNumber first_tile_ = 0;
    TileNumber latest_tile_ = 0;               // of the latest task, if tasks are recorded here
    std::optional<PacketPorts> ports_, trial_; // of the open packet, and of one that is tried
    SlotAccount idle_;
    SlotAccount since_last_;    // idle after the last packet; counts once another one comes
    bool idle_pending_ = false; // since_last_ has some
    SlotPart* part_ = nullptr;
    std::array<TimeSeries*, kSlotClasses.size()> bank_states_{}; // of the bank's track
    Stats stats_;
};

// What follows is inlined in the hot loop of the bank.
inline __attribute__((always_inline)) void PackingUnit::pass_packet(Cycle now, Cycle slot,
                                                                    int tasks, bool ends_tile) {
    stats_.packets++;
    stats_.tasks += tasks;
    passed_.pass_packet(now, slot);
    if (ends_tile) {
        tell_end(slot, true);
    } else {
        slice_->pass_packet(slot);
    }
}

inline void PackingUnit::close_cycles(Process& bank, Cycle until, Slot cause) {
    if (packet_.leaves_slots(until)) {
        if (part_ != nullptr) {
            record_cycles(bank, packet_.next_execution(bank.local()), until + packet_.latency(),
                          cause);
        }
        since_last_[cause] += packet_.left_slots(bank.local(), until);
        idle_pending_ = true;
    }
}

// Makes room for the packet in its ring, if packets go through it.
inline __attribute__((always_inline)) void PackingUnit::begin_packet(Process& bank) {
    if (packets_) {
        ring_->reserve(bank); // free by its dates; the host may not have emptied it yet
        ring_->staged().run_count = 0;
    }
}

// Tells the slice of the open packet, whose tasks are replayed.
inline __attribute__((always_inline)) void PackingUnit::send_counted(Cycle now) {
    const int tasks = packet_.tasks();
    const bool ends = ends_tile_;
    ends_tile_ = false;
    pass_packet(now, packet_.sent(now), tasks, ends);
}

// Sends the open packet through the ring.
inline __attribute__((always_inline)) void PackingUnit::send_packet(Process& bank, Slot cause) {
    TaskPacket& packet = ring_->staged();
    packet.tasks = packet_.tasks();
    packet.slot = packet_.sent(bank.local());
    packet.ends_tile = ends_tile_;
    packet.ended_tile = ended_tile_;
    packet.ended_context = ended_context_;
    ends_tile_ = false;
    stats_.packets++;
    stats_.tasks += packet.tasks;
    if (part_ != nullptr && !replays()) {
        record_packet(packet, cause);
    }
    ring_->put_staged(bank);
}

// Adds tasks to the open packet.
inline void PackingUnit::put(const TaskRun& run, std::uint32_t mask, std::uint32_t part) {
    TaskPacket& packet = ring_->staged();
    TaskRun& packed = packet.runs[packet.run_count++];
    packed = run;
    packed.task.mask = mask;
    packed.part = part;
}

/// What OpenPacket asks when it packs the tasks of a segment: where they go.
class PackingUnit::Sink {
public:
    Sink(PackingUnit& unit, Process& bank, const TaskRun& run)
        : unit_(unit), bank_(bank), run_(run) {}
    void end_idle() { unit_.end_idle(); }
    __attribute__((always_inline)) void begin() { unit_.begin_packet(bank_); }

protected:
    PackingUnit& unit_;
    Process& bank_;
    const TaskRun& run_;
};

/// Puts the tasks into packets of the ring, because the slice blends them.
class PackingUnit::RingSink : public Sink {
public:
    RingSink(PackingUnit& unit, Process& bank, const TaskRun& run, std::uint32_t mask)
        : Sink(unit, bank, run), mask_(mask) {}
    int take(std::uint32_t& left, int count, int room, Cycle /*slot*/) {
        unit_.put(run_, mask_, take_lowest(left, count, room));
        return std::min(count, room);
    }
    void send(Slot cause) { unit_.send_packet(bank_, cause); } // it is full

private:
    std::uint32_t mask_;
};

inline __attribute__((always_inline)) Cycle PackingUnit::add(Process& bank, const TaskRun& run,
                                                             std::uint32_t mask, int entry) {
    if (!config_.reorganisation) {
        separate(bank, run);
    }
    if (replays() || ports_) {
        return add_picky(bank, run, mask, entry);
    }
    RingSink sink(*this, bank, run, mask);
    return packet_.pack(bank.local(), mask, __builtin_popcount(mask), sink);
}

} // namespace degs
