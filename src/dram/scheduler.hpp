// SPDX-License-Identifier: Apache-2.0
// The scheduling policies of a channel, each in a file of its own in schedulers/.
#pragma once

#include <cstdint>
#include <variant>

#include "dram/bank_fcfs.hpp"
#include "dram/fcfs.hpp"
#include "dram/frfcfs.hpp"
#include "dram/queue.hpp"

namespace degs::dram {

/// Which of the queued accesses may send commands. A variant instead of virtual functions, because
/// hit() runs several times per command and must be inlined.
struct Scheduler {
    const char* name;
    std::variant<Frfcfs, BankFcfs, Fcfs> policy;

    /// The access that a bank serves next from its open row; kNone: the bank closes the row for its
    /// oldest access. Only for banks with a queued access.
    std::uint8_t hit(const Queue& queue, unsigned bank, std::uint32_t row) const {
        return std::visit([&](auto p) { return p.hit(queue, bank, row); }, policy);
    }
    /// True if a new access can change which banks may send commands.
    bool selective() const {
        return std::visit([](auto p) { return p.kSelective; }, policy);
    }
    /// Banks whose accesses may send commands, as a mask. Only if the queue is not empty.
    std::uint32_t eligible(const Queue& queue) const {
        return std::visit([&](auto p) { return p.eligible(queue); }, policy);
    }
};

} // namespace degs::dram
