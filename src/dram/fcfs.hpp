// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dram/policy_of.hpp"

namespace degs::dram {

/// First come, first served: nothing overtakes the oldest access of the queue.
class Fcfs final : public PolicyOf<Fcfs> {
public:
    const char* name() const override { return "fcfs"; }
    const char* doc() const override { return "in order"; }
    std::uint8_t hit(const Queue& queue, unsigned bank, std::uint32_t row) const override {
        return queue.oldest_if_hit(bank, row);
    }
    bool selective() const override { return true; }
    std::uint32_t eligible(const Queue& queue) const override { return 1U << queue.oldest_bank(); }
};

} // namespace degs::dram
