// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dram/policy_of.hpp"

namespace degs::dram {

/// First ready, first come first served: row hits first, then the oldest. A younger conflict does
/// not close a row that any queued access still wants.
class Frfcfs final : public PolicyOf<Frfcfs> {
public:
    const char* name() const override { return "frfcfs"; }
    const char* doc() const override { return "row hits first, then the oldest"; }
    std::uint8_t hit(const Queue& queue, unsigned bank, std::uint32_t row) const override {
        return queue.oldest_of_row(bank, row);
    }
};

} // namespace degs::dram
