// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/scheduler/packing_unit.hpp"

namespace degs {
PackingUnit::PackingUnit(const sc_core::sc_module_name& name, const Config& config)
    : sc_core::sc_module(name), out("out"), config_(config),
      packet_(config.width, config.latency_cycles, config.depth, config.packets_per_cycle) {
    if (config.ports.limited()) {
        ports_.emplace(config.ports);
        trial_.emplace(config.ports);
    }
}

// Without reorganisation a packet has tasks of one span, which is `run`'s from now on.
void PackingUnit::separate(Process& bank, const TaskRun& run) {
    if (!joins(run)) {
        send(bank, Slot::Blocked);
    }
    first_splat_ = run.task.splat;
    first_row_ = run.task.row;
    first_tile_ = run.tile;
}

/// Puts tasks into packets that have to be looked at, because they want ports, or because they are
/// replayed and recorded.
class PackingUnit::PickySink : public Sink {
public:
    PickySink(PackingUnit& unit, Process& bank, const TaskRun& run, std::uint32_t mask, int entry)
        : Sink(unit, bank, run), mask_(mask), entry_(entry) {}
    void begin() {
        Sink::begin();
        if (unit_.ports_) {
            unit_.ports_->clear();
        }
        if (unit_.records_replay()) {
            unit_.part_->settle(run_.tile);
        }
    }
    int take(std::uint32_t& left, int count, int room, Cycle slot) {
        std::uint32_t part = 0;
        if (unit_.ports_) {
            part = unit_.ports_->take(run_.task, left, entry_, room);
            left ^= part;
        } else {
            part = take_lowest(left, count, room);
        }
        if (part != 0) {
            first_ = first_ == 0 ? slot : first_;
            put(part, slot);
        }
        return __builtin_popcount(part);
    }
    void send(Slot cause) { unit_.send(bank_, cause); }
    /// Execution date of the first task.
    Cycle first() const { return first_; }

private:
    void put(std::uint32_t part, Cycle slot) {
        if (!unit_.replays()) {
            unit_.put(run_, mask_, part);
            return;
        }
        if (unit_.part_ != nullptr) {
            unit_.record_tasks(run_, part);
        }
        const std::uint32_t ended = part & run_.outcome.ended;
        if (ended != 0 && unit_.packets_ && unit_.part_ != nullptr) {
            unit_.put(run_, mask_, part); // the slice ends the pixels when it reads the packet
        } else if (ended != 0) {
            unit_.slice_->end_replayed(run_, ended, slot);
        }
    }

    std::uint32_t mask_;
    int entry_;
    Cycle first_ = 0;
};

Cycle PackingUnit::add_picky(Process& bank, const TaskRun& run, std::uint32_t mask, int entry) {
    PickySink sink(*this, bank, run, mask, entry);
    const Cycle last = packet_.pack(bank.local(), mask, __builtin_popcount(mask), sink);
    if (replays()) {
        slice_->execute(run, mask, sink.first(), last);
    }
    return last;
}

// Records tasks that go to the open packet.
void PackingUnit::record_tasks(const TaskRun& run, std::uint32_t part) {
    const auto add = [&](Slot slot, std::uint32_t tasks) {
        if (tasks != 0) {
            part_->add(slot, run.tile, packet_.slot(), __builtin_popcount(tasks));
        }
    };
    if (!packet_.open() || run.tile != latest_tile_) { // else this cycle is known to be the tile's
        part_->work(run.tile, packet_.slot(), packet_.slot() + 1);
    }
    add(Slot::Useful, part & run.outcome.useful);
    add(Slot::Boundary, part & ~run.outcome.inside);
    add(Slot::Terminated, part & run.outcome.inside & ~run.outcome.useful);
    latest_tile_ = run.tile;
}

// Records the empty slots of the open packet, whose tasks are replayed.
void PackingUnit::record_packet(Slot cause) {
    if (packet_.room() != 0) {
        part_->add(cause, latest_tile_, packet_.slot(), packet_.room());
    }
}

bool PackingUnit::fits_ports(Cycle now, const TaskRun& run, std::uint32_t mask, int entry) {
    const Cycle queued =
        packet_.next_execution(now) - (now + packet_.latency()) + (packet_.open() ? 1 : 0);
    const Cycle most = config_.depth;
    if (queued + ports_->most_packets(mask, config_.width) <= most && packet_.unwritten(now) == 0) {
        return true; // even if the open packet takes none of them
    }
    const bool joined = packet_.open() && (config_.reorganisation || joins(run));
    Cycle packets = joined ? 0 : 1; // beside the open one
    int tasks = joined ? packet_.tasks() : 0;
    if (joined) {
        trial_->imitate(*ports_, run.task.context);
    } else {
        trial_->clear();
    }
    for (std::uint32_t left = mask; left != 0;) {
        const std::uint32_t part = trial_->take(run.task, left, entry, config_.width - tasks);
        left ^= part;
        tasks += __builtin_popcount(part);
        if (left != 0) { // in the next packet
            ++packets;
            tasks = 0;
            trial_->clear();
        }
    }
    const Cycle before = packet_.open() && !joined ? 1 : 0;
    const Cycle complete = before + packets - (joined ? 0 : 1) + (tasks == config_.width ? 1 : 0);
    return queued + packets <= most && packet_.can_write_packets(now, complete);
}

// The first task stands for all, because without reorganisation a packet has tasks of one span.
bool PackingUnit::joins(const TaskRun& run) const {
    if (!packet_.open()) {
        return true;
    }
    return run.task.splat == first_splat_ && run.task.row == first_row_ && run.tile == first_tile_;
}

void PackingUnit::end_tile(Process& bank, TileNumber tile, std::int16_t context) {
    // An open packet may hold the tile's last tasks and stays open for the next tile's; it can
    // carry one end. Without one, the end travels alone and costs the array nothing.
    if (packet_.open() && ends_tile_) {
        send(bank, Slot::Starved);
    }
    ended_tile_ = tile;
    ended_context_ = context;
    if (packet_.open()) {
        ends_tile_ = true;
    } else if (!packets_) {
        const Cycle now = bank.local();
        tell_end(passed_.pass_end(now, now + packet_.latency()), false);
    } else {
        ring_->reserve(bank);
        TaskPacket& packet = ring_->staged();
        packet.ended_tile = tile;
        packet.ended_context = context;
        packet.run_count = 0;
        packet.tasks = 0;
        packet.slot = bank.local() + packet_.latency();
        packet.ends_tile = true;
        ring_->put_staged(bank);
    }
}

// Tells the slice of the end of a tile without the ring.
void PackingUnit::tell_end(Cycle slot, bool packet) {
    slice_->pass_end(ended_tile_, ended_context_, slot, packet);
}

void PackingUnit::send(Process& bank, Slot cause) {
    idle_[cause] += packet_.room();
    if (records_replay()) {
        record_packet(cause);
    }
    if (packets_) {
        send_packet(bank, cause);
    } else {
        send_counted(bank.local());
    }
}

void PackingUnit::send_due(Process& bank, Slot cause) {
    if (packet_.due(bank.local())) {
        send(bank, cause);
    }
}

void PackingUnit::settle_idle() {
    idle_pending_ = false;
    idle_ += since_last_;
    since_last_ = SlotAccount{};
}

void PackingUnit::record_packet(const TaskPacket& packet, Slot cause) {
    part_->settle(packet.runs.front().tile);
    if (packet.tasks != config_.width) {
        part_->add(cause, packet.runs[packet.run_count - 1].tile, packet.slot,
                   config_.width - packet.tasks);
    }
}

// Slots [from, to) of the array. For the bank they are the cycles in which it could have filled
// them.
void PackingUnit::record_cycles(Process& bank, Cycle from, Cycle to, Slot cause) {
    part_->idle(cause, from, to, (to - from) * packet_.width());
    if (bank.track() == nullptr) {
        return;
    }
    TimeSeries*& state = bank_states_[static_cast<std::size_t>(cause)];
    if (state == nullptr) {
        state = &bank.track()->state(std::string("no task: ") +
                                     kSlotClasses[static_cast<std::size_t>(cause)].name);
    }
    state->add(from - packet_.latency(), to - packet_.latency(), to - from);
}

} // namespace degs
