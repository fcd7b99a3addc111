// SPDX-License-Identifier: Apache-2.0
#include "dram/refresher.hpp"

namespace degs::dram {

Refresher::Step Refresher::next(const Banks& banks) const {
    if (const std::uint32_t activating = held_banks() & banks.activating(); activating != 0) {
        return {Command::Act2, first_bank(activating)};
    }
    if (kind_ == Refresh::AllBank) {
        return {banks.all_closed() ? Command::RefAb : Command::PreAb, 0};
    }
    const unsigned partner = bank_ + steps_;
    for (const unsigned bank : {bank_, partner}) {
        if (banks.state(bank) == BankState::Open) {
            return {Command::Pre, bank};
        }
    }
    const bool partner_later = banks.dates().earliest(Command::RefPb, partner) >
                               banks.dates().earliest(Command::RefPb, bank_);
    return {Command::RefPb, partner_later ? partner : bank_};
}

} // namespace degs::dram
