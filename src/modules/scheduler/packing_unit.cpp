// SPDX-License-Identifier: Apache-2.0
#include "modules/scheduler/packing_unit.hpp"

namespace degs {
PackingUnit::PackingUnit(const sc_core::sc_module_name& name, const Config& config)
    : sc_core::sc_module(name), out("out"), config_(config), latency_(config.latency_cycles),
      width_(config.width), capacity_(width_ * config.depth) {
    if (config.ports.limited()) {
        ports_.emplace(config.ports);
        trial_.emplace(config.ports);
    }
}

// Every part ends where the packet is full or a port is taken.
Cycle PackingUnit::add_by_ports(Process& bank, const TaskRun& run, std::uint32_t mask, int entry) {
    Cycle execution = 0;
    for (std::uint32_t left = mask; left != 0;) {
        if (!open()) {
            open_packet(bank);
        }
        execution = next_slot_;
        const std::uint32_t part = ports_->take(run.task, left, entry, config_.width - tasks_);
        if (part != 0) {
            put(run, mask, part);
        }
        left ^= part;
        tasks_ += __builtin_popcount(part);
        if (tasks_ == config_.width) {
            send(bank, Idle::Starved);
        } else if (left != 0) {
            send(bank, Idle::Ports);
        }
    }
    return execution;
}

bool PackingUnit::fits_ports(Cycle now, const TaskRun& run, std::uint32_t mask, int entry) {
    const Cycle queued = next_execution(now) - (now + latency_) + (open() ? 1 : 0);
    if ((queued + ports_->most_packets(mask, config_.width)) * width_ <= capacity_) {
        return true; // even if the open packet takes none of them
    }
    const bool joined = open() && (config_.reorganisation || joins(run));
    Cycle packets = joined ? 0 : 1; // beside the open one
    int tasks = joined ? tasks_ : 0;
    if (joined) {
        trial_->imitate(*ports_, run.task.context);
    } else {
        trial_->clear();
    }
    for (std::uint32_t left = mask; left != 0;) {
        const std::uint32_t part = trial_->take(run.task, left, entry, config_.width - tasks);
        left ^= part;
        if (left != 0) { // in the next packet
            ++packets;
            tasks = 0;
            trial_->clear();
        }
    }
    return (queued + packets) * width_ <= capacity_;
}

// All runs of the packet are of one span.
bool PackingUnit::joins(const TaskRun& run) const {
    if (!open()) {
        return true;
    }
    const TaskRun& other = ring_->staged().runs.front();
    return run.task.splat == other.task.splat && run.task.row == other.task.row &&
           run.tile == other.tile;
}

void PackingUnit::end_tile(Process& bank, TileNumber tile, std::int16_t context) {
    // An open packet may hold the tile's last tasks and stays open for the next tile's; it can
    // carry one end. Without one, the end travels alone and costs the array nothing.
    if (open() && ends_tile_) {
        send(bank, Idle::Starved);
    }
    if (!open()) {
        ring_->reserve(bank);
    }
    TaskPacket& packet = ring_->staged();
    packet.ended_tile = tile;
    packet.ended_context = context;
    if (open()) {
        ends_tile_ = true;
    } else {
        packet.run_count = 0;
        packet.tasks = 0;
        packet.ends_tile = true;
        ring_->put_staged(bank);
    }
}

void PackingUnit::send_due(Process& bank, Idle cause) {
    if (due(bank.local())) {
        send(bank, cause);
    }
}

void PackingUnit::close_cycles(Process& bank, Cycle until, Idle cause) {
    if (leaves_slots(until)) {
        const Cycle first_idle = next_execution(bank.local());
        if (part_ != nullptr) {
            record_cycles(bank, first_idle, until + latency_, cause);
        }
        since_last_.idle(cause, (until + latency_ - first_idle) * width_);
    }
}

void PackingUnit::record_packet(const TaskPacket& packet, Idle cause) {
    part_->settle(packet.runs.front().tile);
    if (packet.tasks != config_.width) {
        part_->add(slot_of(cause), packet.runs[packet.run_count - 1].tile, packet.slot,
                   config_.width - packet.tasks);
    }
}

// Slots [from, to) of the array. For the bank they are the cycles in which it could have filled them.
void PackingUnit::record_cycles(Process& bank, Cycle from, Cycle to, Idle cause) {
    part_->idle(slot_of(cause), from, to, (to - from) * width_);
    if (bank.track() == nullptr) {
        return;
    }
    TimeSeries*& state = bank_states_[static_cast<std::size_t>(cause)];
    if (state == nullptr) {
        state = &bank.track()->state(std::string("no task: ") +
                                     kSlotClasses[static_cast<std::size_t>(slot_of(cause))].name);
    }
    state->add(from - latency_, to - latency_, to - from);
}

} // namespace degs
