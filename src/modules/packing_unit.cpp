// SPDX-License-Identifier: Apache-2.0
#include "modules/packing_unit.hpp"

namespace degs {
namespace {

/// The lowest `count` set bits of `mask`.
std::uint32_t lowest_bits(std::uint32_t mask, int count) {
    std::uint32_t picked = 0;
    for (; count > 0 && mask != 0; --count) {
        picked |= mask & (0U - mask);
        mask &= mask - 1;
    }
    return picked;
}

} // namespace

PackingUnit::PackingUnit(const sc_core::sc_module_name& name, const Config& config)
    : sc_core::sc_module(name), out("out"), config_(config),
      latency_(static_cast<Cycle>(config.latency_cycles)) {}

Cycle PackingUnit::add(Process& bank, const TaskRun& run) {
    std::uint32_t left = run.task.mask;
    int count = __builtin_popcount(left);
    while (count != 0) {
        if (!open()) {
            out->reserve(bank); // free by its dates; the host may not have emptied it yet
        }
        TaskPacket& packet = out->staged();
        if (!open()) {
            slot_ = next_execution(bank.local());
            started_ = true;
            idle_ += since_last_;
            since_last_ = SlotAccount{};
            packet.run_count = 0;
            ends_tile_ = false;
        }
        const int taken = std::min(count, config_.width - tasks_);
        TaskRun& packed = packet.runs[static_cast<std::size_t>(packet.run_count++)];
        packed = run;
        packed.task.mask = taken == count ? left : lowest_bits(left, taken);
        left &= ~packed.task.mask;
        count -= taken;
        tasks_ += taken;
        if (tasks_ == config_.width) {
            send(bank, Idle::Starved);
        }
    }
    return slot_;
}

void PackingUnit::end_tile(Process& bank, TileNumber tile) {
    // An open packet may hold the tile's last tasks and stays open for the next tile's; it can
    // carry one end. Without one, the end travels alone and costs the array nothing.
    if (open() && ends_tile_) {
        send(bank, Idle::Starved);
    }
    if (!open()) {
        out->reserve(bank);
    }
    TaskPacket& packet = out->staged();
    packet.ended_tile = tile;
    if (open()) {
        ends_tile_ = true;
    } else {
        packet.run_count = 0;
        packet.tasks = 0;
        packet.ends_tile = true;
        out->put_staged(bank);
    }
}

void PackingUnit::send_due(Process& bank, Idle cause) {
    if (due(bank.local())) {
        send(bank, cause);
    }
}

void PackingUnit::close_cycles(Process& bank, Cycle until, Idle cause) {
    if (!open() && started_) {
        const Cycle first_idle = std::max(bank.local() + latency_, slot_ + 1);
        const Cycle end_idle = until + latency_;
        if (end_idle > first_idle) {
            since_last_.idle(cause,
                             (end_idle - first_idle) * static_cast<std::uint64_t>(config_.width));
        }
    }
}

void PackingUnit::send(Process& bank, Idle cause) {
    TaskPacket& packet = out->staged();
    packet.slot = slot_;
    packet.tasks = tasks_;
    packet.ends_tile = ends_tile_;
    stats_.packets++;
    stats_.tasks += static_cast<std::uint64_t>(tasks_);
    idle_.idle(cause, static_cast<std::uint64_t>(config_.width - tasks_));
    tasks_ = 0;
    ends_tile_ = false;
    out->put_staged(bank);
}

} // namespace degs
