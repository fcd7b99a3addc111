// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>

#include "dram/policy_of.hpp"

namespace degs::dram {

/// FR-FCFS that does not starve conflicts: once a row has been hit `row_hits` times since it was
/// opened, no access to it overtakes an older one of the bank that wants another row. Reads and
/// writes count alike, because they share the row.
class FrfcfsCap final : public PolicyOf<FrfcfsCap> {
public:
    const char* name() const override { return "frfcfs_cap"; }
    const char* doc() const override { return "frfcfs with a limit on row hits that overtake"; }
    bool has_keys() const override { return true; }
    void describe(ConfigVisitor& visitor) override {
        visitor.integer("row_hits", row_hits_, 1, 1 << 20,
                        "row hits before an older access to another row goes first [assumed]");
    }

    std::uint8_t hit(const Queue& queue, unsigned bank, std::uint32_t row) const override {
        return hits_[bank] < row_hits_ ? queue.oldest_of_row(bank, row)
                                       : queue.oldest_if_hit(bank, row);
    }
    void served(const Queue::Entry& entry) override {
        hits_[entry.access.bank] += entry.outcome == RowState::Hit ? 1 : 0;
    }
    void opened(unsigned bank, std::uint32_t /*row*/) override { hits_[bank] = 0; }

private:
    int row_hits_ = 4;
    std::array<int, kMostBanks> hits_{}; // since the row was opened
};

} // namespace degs::dram
