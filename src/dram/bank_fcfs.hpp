// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dram/policy_of.hpp"

namespace degs::dram {

/// First come, first served within a bank; banks overtake each other.
class BankFcfs final : public PolicyOf<BankFcfs> {
public:
    const char* name() const override { return "bank_fcfs"; }
    const char* doc() const override { return "in order within a bank"; }
    std::uint8_t hit(const Queue& queue, unsigned bank, std::uint32_t row) const override {
        return queue.oldest_if_hit(bank, row);
    }
};

} // namespace degs::dram
