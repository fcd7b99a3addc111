// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "dram/queue.hpp"

namespace degs::dram {

/// First come, first served: nothing overtakes the oldest access of the queue.
struct Fcfs {
    static constexpr const char* kName = "fcfs";
    static constexpr bool kSelective = true;
    static std::uint8_t hit(const Queue& queue, unsigned bank, std::uint32_t row) {
        return queue.oldest_if_hit(bank, row);
    }
    static std::uint32_t eligible(const Queue& queue) { return 1U << queue.oldest_bank(); }
};

} // namespace degs::dram
