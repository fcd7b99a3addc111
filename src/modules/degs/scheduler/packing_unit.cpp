// SPDX-License-Identifier: Apache-2.0
#include "modules/degs/scheduler/packing_unit.hpp"

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
    Cycle first = 0, execution = 0;
    for (std::uint32_t left = mask; left != 0;) {
        if (!open()) {
            open_packet(bank);
        }
        execution = next_slot_;
        const std::uint32_t part = ports_->take(run.task, left, entry, config_.width - tasks_);
        if (part != 0) {
            join(run);
            first = first == 0 ? execution : first;
            if (!draws()) {
                put(run, mask, part);
            } else if ((part & run.drawn.ended) != 0) {
                slice_->end_drawn(run, part & run.drawn.ended, execution);
            }
        }
        left ^= part;
        tasks_ += __builtin_popcount(part);
        if (tasks_ == config_.width) {
            send(bank, Slot::Starved);
        } else if (left != 0) {
            send(bank, Slot::Ports);
        }
    }
    if (draws()) {
        slice_->execute(run, mask, first, execution);
    }
    return execution;
}

// Drawn tasks, packet by packet.
Cycle PackingUnit::add_recorded(Process& bank, const TaskRun& run, std::uint32_t mask, int entry) {
    Cycle first = 0, execution = 0;
    for (std::uint32_t left = mask; left != 0;) {
        if (!open()) {
            open_packet(bank);
            part_->settle(run.tile);
        }
        execution = next_slot_;
        const int room = config_.width - tasks_;
        const std::uint32_t part = ports_ ? ports_->take(run.task, left, entry, room)
                                   : room < __builtin_popcount(left) ? lowest_bits(left, room)
                                                                     : left;
        if (part != 0) {
            join(run);
            first = first == 0 ? execution : first;
            record_tasks(run, part);
            if ((part & run.drawn.ended) != 0 && packets_) {
                put(run, mask, part);
            } else if ((part & run.drawn.ended) != 0) {
                slice_->end_drawn(run, part & run.drawn.ended, execution);
            }
        }
        left ^= part;
        tasks_ += __builtin_popcount(part);
        if (tasks_ == config_.width) {
            send(bank, Slot::Starved);
        } else if (left != 0) {
            send(bank, Slot::Ports);
        }
    }
    slice_->execute(run, mask, first, execution);
    return execution;
}

// In the open packet.
void PackingUnit::record_tasks(const TaskRun& run, std::uint32_t part) {
    const auto add = [&](Slot slot, std::uint32_t tasks) {
        if (tasks != 0) {
            part_->add(slot, run.tile, next_slot_, __builtin_popcount(tasks));
        }
    };
    if (tasks_ == 0 || run.tile != latest_tile_) { // else this cycle is known to be the tile's
        part_->work(run.tile, next_slot_, next_slot_ + 1);
    }
    add(Slot::Useful, part & run.drawn.useful);
    add(Slot::Boundary, part & ~run.drawn.inside);
    add(Slot::Terminated, part & run.drawn.inside & ~run.drawn.useful);
    latest_tile_ = run.tile;
}

// The open packet, of drawn tasks; it has left its slot already.
void PackingUnit::record_packet(Slot cause) {
    if (tasks_ != config_.width) {
        part_->add(cause, latest_tile_, next_slot_ - 1, config_.width - tasks_);
    }
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
    return run.task.splat == first_splat_ && run.task.row == first_row_ && run.tile == first_tile_;
}

void PackingUnit::end_tile(Process& bank, TileNumber tile, std::int16_t context) {
    // An open packet may hold the tile's last tasks and stays open for the next tile's; it can
    // carry one end. Without one, the end travels alone and costs the array nothing.
    if (open() && ends_tile_) {
        send(bank, Slot::Starved);
    }
    ended_tile_ = tile;
    ended_context_ = context;
    if (open()) {
        ends_tile_ = true;
    } else if (!packets_) {
        tell_end(passed_.pass_end(bank.local(), bank.local() + latency_), false);
    } else {
        ring_->reserve(bank);
        TaskPacket& packet = ring_->staged();
        packet.ended_tile = tile;
        packet.ended_context = context;
        packet.run_count = 0;
        packet.tasks = 0;
        packet.ends_tile = true;
        ring_->put_staged(bank);
    }
}

// Of a tile.
void PackingUnit::tell_end(Cycle slot, bool packet) {
    slice_->pass_end(ended_tile_, ended_context_, slot, packet);
}

void PackingUnit::send_due(Process& bank, Slot cause) {
    if (due(bank.local())) {
        send(bank, cause);
    }
}

void PackingUnit::close_cycles(Process& bank, Cycle until, Slot cause) {
    if (leaves_slots(until)) {
        const Cycle first_idle = next_execution(bank.local());
        if (part_ != nullptr) {
            record_cycles(bank, first_idle, until + latency_, cause);
        }
        since_last_[cause] += (until + latency_ - first_idle) * width_;
    }
}

void PackingUnit::record_packet(const TaskPacket& packet, Slot cause) {
    part_->settle(packet.runs.front().tile);
    if (packet.tasks != config_.width) {
        part_->add(cause, packet.runs[packet.run_count - 1].tile, packet.slot,
                   config_.width - packet.tasks);
    }
}

// Slots [from, to) of the array. For the bank they are the cycles in which it could have filled them.
void PackingUnit::record_cycles(Process& bank, Cycle from, Cycle to, Slot cause) {
    part_->idle(cause, from, to, (to - from) * width_);
    if (bank.track() == nullptr) {
        return;
    }
    TimeSeries*& state = bank_states_[static_cast<std::size_t>(cause)];
    if (state == nullptr) {
        state = &bank.track()->state(std::string("no task: ") +
                                     kSlotClasses[static_cast<std::size_t>(cause)].name);
    }
    state->add(from - latency_, to - latency_, to - from);
}

} // namespace degs
