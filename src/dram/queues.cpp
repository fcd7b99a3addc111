// SPDX-License-Identifier: Apache-2.0
#include "dram/queues.hpp"

#include <algorithm>
#include <cmath>

namespace degs::dram {
namespace {

unsigned entries(double share, int depth) {
    return static_cast<unsigned>(std::floor(share * depth + 0.5));
}

} // namespace

Queues::Queues(const ControllerConfig& config)
    : posted_writes_(config.posted_writes),
      write_high_(std::max(1U, entries(config.write_high, config.write_queue))),
      write_low_(entries(config.write_low, config.write_queue)),
      most_ordinary_(
          std::max(1U, config.read_queue - entries(config.urgent_share, config.read_queue))),
      reads_(config.read_queue, config.qos_step), writes_(config.write_queue),
      reads_in_(config.qos_step) {}

bool Queues::push(const Access& access) {
    if (access.write) {
        ++writes_of_hash_[hash(access)];
        writes_so_far_ = access.writes;
        writes_in_.push_back(access);
        return posted_writes_;
    }
    after_writes_ += access.after_write ? 1 : 0;
    reads_in_.push(access);
    return access.after_write;
}

bool Queues::covered(const Access& access) const {
    const std::uint8_t slot = writes_.find(access.bank, access.row, access.block);
    if (slot == Queue::kNone || (access.bursts & ~writes_[slot].access.bursts) != 0) {
        return false;
    }
    for (unsigned bursts = access.bursts; bursts != 0; bursts &= bursts - 1) {
        const std::uint32_t ahead = access.writes - brought_by_[slot][__builtin_ctz(bursts)];
        if (ahead > ~std::uint32_t{0} / 2) { // by wrapping: the write is the younger one
            return false;
        }
    }
    return true;
}

// The write itself is counted, too.
std::uint8_t Queues::write_to_merge(const Access& access) const {
    return writes_of_hash_[hash(access)] > 1 ? writes_.find(access.bank, access.row, access.block)
                                             : Queue::kNone;
}

unsigned Queues::merge(std::uint8_t slot, const Access& access) {
    const unsigned shared = bursts_of(writes_[slot].left & access.bursts);
    note_bursts(slot, access, access.bursts & ~writes_[slot].access.bursts);
    writes_[slot].access.bursts |= access.bursts;
    writes_[slot].left |= access.bursts;
    --writes_of_hash_[hash(access)];
    return shared;
}

void Queues::remove(unsigned slot) {
    if (writing_) {
        --writes_of_hash_[hash(writes_[slot].access)];
    }
    current().remove(slot);
}

std::uint64_t Queues::bursts_left() const {
    std::uint64_t bursts = reads_.bursts_left() + writes_.bursts_left();
    const auto add = [&bursts](const Access& access) { bursts += bursts_of(access.bursts); };
    reads_in_.for_each(add);
    std::for_each(writes_in_.begin(), writes_in_.end(), add);
    return bursts;
}

bool Queues::idle() const {
    return reads_.size() == 0 && writes_.size() == 0 && waiting() == 0;
}

} // namespace degs::dram
