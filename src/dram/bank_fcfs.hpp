// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "dram/queue.hpp"

namespace degs::dram {

/// First come, first served within a bank; banks overtake each other.
struct BankFcfs {
    static constexpr const char* kName = "bank_fcfs";
    static constexpr bool kSelective = false;
    static std::uint8_t hit(const Queue& queue, unsigned bank, std::uint32_t row) {
        return queue.oldest_if_hit(bank, row);
    }
    static std::uint32_t eligible(const Queue& /*queue*/) { return ~0U; }
};

} // namespace degs::dram
