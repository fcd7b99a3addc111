// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

#include "dram/queue.hpp"

namespace degs::dram {

/// First ready, first come first served: row hits first, then the oldest. A younger conflict does
/// not close a row that any queued access still wants.
struct Frfcfs {
    static constexpr const char* kName = "frfcfs";
    static constexpr bool kSelective = false;
    static std::uint8_t hit(const Queue& queue, unsigned bank, std::uint32_t row) {
        return queue.oldest_of_row(bank, row);
    }
    static std::uint32_t eligible(const Queue& /*queue*/) { return ~0U; }
};

} // namespace degs::dram
